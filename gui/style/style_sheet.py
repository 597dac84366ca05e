"""How widgets look: edges, room, states of a button. Colours come from the theme, room in steps of 4 px."""

from collections.abc import Mapping
from pathlib import Path
from string import Template

_TICK = (Path(__file__).parent / "tick.svg").as_posix()
"""In a colour that is seen on light and on dark."""
PRIMARY, STOP = "primary", "stop"
"""Object names of the one button that goes on, and of the one that stops."""

_SHEET = Template(
    """
QPushButton { background: $button; border: 1px solid $grid; border-radius: 4px; padding: 3px 10px; }
QPushButton { min-height: 18px; }
QPushButton:hover { border-color: $accent; }
QPushButton:focus { border: 2px solid $accent; padding: 2px 9px; }
QPushButton:pressed { background: $grid; }
QPushButton:disabled { color: $faint; background: $window; border-color: $grid; }
QPushButton::menu-indicator { subcontrol-position: right center; right: 4px; }
QPushButton#primary { background: $accent; color: $accent_text; border-color: $accent; font-weight: bold; }
QPushButton#primary:hover { border-color: $text; }
QPushButton#primary:focus { border: 2px solid $text; }
QPushButton#primary:pressed { background: $text; color: $base; }
QPushButton#primary:disabled { background: $window; color: $faint; border-color: $grid; }
QPushButton#stop { background: $stop; color: $stop_text; border: 1px solid $stop; font-weight: bold; }
QPushButton#stop:hover { border-color: $stop_text; }
QPushButton#stop:focus { border: 2px solid $text; }
QPushButton#stop:pressed { background: $text; color: $base; }
QPushButton#stop:disabled { background: $window; color: $faint; border-color: $grid; }
QToolButton[popupMode="2"] { padding: 3px 18px 3px 4px; }
QToolButton::menu-indicator { subcontrol-position: right center; subcontrol-origin: padding; right: 3px; }
QToolButton:hover { background: $grid; border-radius: 4px; }
QToolButton:focus { background: $grid; border: 2px solid $accent; border-radius: 4px; }
QCheckBox::indicator:focus { border: 2px solid $accent; }
QCheckBox::indicator, QTreeView::indicator { border: 1px solid $faint; border-radius: 3px; }
QCheckBox::indicator, QTreeView::indicator { background: $base; width: 12px; height: 12px; }
QCheckBox::indicator:checked, QTreeView::indicator:checked { image: url("$tick"); }
QCheckBox::indicator:disabled { border-color: $grid; }
QTabWidget::pane { border: none; border-top: 1px solid $grid; }
QTabBar { qproperty-drawBase: 0; }
QTabBar::tab { color: $faint; padding: 5px 12px; border: none; border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: $text; }
QTabBar::tab:selected { color: $text; border-bottom-color: $accent; }
QHeaderView { background: $window; border: none; }
QHeaderView::section { background: $window; color: $faint; border: none; padding: 3px 4px; }
QHeaderView::section { border-bottom: 1px solid $grid; }
QTableView, QTreeView, QListWidget, QTextEdit { border: 1px solid $grid; border-radius: 4px; }
QTableView:focus, QTreeView:focus, QListWidget:focus, QTextEdit:focus { border-color: $accent; }
QPlainTextEdit:focus { border-color: $accent; }
QTabBar::tab:selected:focus { color: $accent; }
QTableView { gridline-color: $grid; }
QPlainTextEdit { border: 1px solid $grid; border-radius: 4px; }
QLineEdit { background: $base; border: 1px solid $grid; border-radius: 4px; padding: 1px 4px; }
QAbstractSpinBox { min-height: 22px; }
QAbstractSpinBox QLineEdit { border: none; }
QLineEdit:focus { border-color: $accent; }
QLineEdit:disabled { background: $window; color: $faint; }
QLineEdit[wrong="true"] { border: 1px solid $bad; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: $grid; border-radius: 4px; margin: 1px; }
QScrollBar::handle:vertical { min-height: 24px; }
QScrollBar::handle:horizontal { min-width: 24px; }
QScrollBar::handle:hover { background: $faint; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QProgressBar { background: $grid; border: none; border-radius: 3px; max-height: 6px; min-height: 6px; }
QProgressBar::chunk { background: $accent; border-radius: 3px; }
QToolTip { background: $note; color: $text; border: 1px solid $grid; padding: 4px; }
QMenuBar { background: $window; }
QMenuBar::item { padding: 4px 8px; background: transparent; }
QMenuBar::item:selected { background: $grid; border-radius: 4px; }
QDockWidget::title { background: $window; padding: 4px 8px; border-top: 1px solid $grid; }
"""
)


def style_sheet(colors: Mapping[str, str]) -> str:
    """Of the whole application, in the colours of a theme, by their names there."""
    return _SHEET.substitute(colors, tick=_TICK)
