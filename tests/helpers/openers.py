"""Everything in a window that can open something, found by walking it; and a person's key and click."""

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QDialog, QMenu, QWidget
from shiboken6 import isValid

from gui.plots import Plot

Opener = tuple[str, Callable[[], object]]


def openers(inside: QWidget) -> list[Opener]:
    """Every action and button below a widget, whether it can be seen now or not."""
    actions = [a for w in (inside, *inside.findChildren(QWidget), *_plot_menus(inside)) for a in w.actions()]
    found: list[Opener] = []
    for action in actions:
        if action.menu() is None and not action.isSeparator() and not action.isCheckable():
            found.append((action.text() or action.objectName(), _able(action, action.trigger)))
    for button in inside.findChildren(QAbstractButton):
        if not button.isCheckable():
            found.append((button.text() or button.objectName(), _able(button, button.click)))
    return found


def popups(inside: QWidget) -> list[Opener]:
    """Every menu and every list that drops down."""
    menus = [m for m in (*inside.findChildren(QMenu), *_plot_menus(inside)) if m.actions()]
    lists = [c for c in inside.findChildren(QComboBox) if c.isVisible() and c.count()]
    at = inside.mapToGlobal(inside.rect().center())
    return [(m.title() or "menu", lambda m=m: m.popup(at)) for m in menus] + [
        (c.currentText() or "list", c.showPopup) for c in lists
    ]


def _plot_menus(inside: QWidget) -> list[QMenu]:
    """Of one plot of each kind: the others have the same."""
    return [plot.getViewBox().getMenu() for plot in {type(p): p for p in inside.findChildren(Plot)}.values()]


def dialogs() -> set[QDialog]:
    """Those seen now."""
    return {w for w in QApplication.topLevelWidgets() if isinstance(w, QDialog) and w.isVisible()}


def opened_by(opener: Opener) -> QDialog:
    """The dialog that came at once."""
    before = dialogs()
    opener[1]()
    (dialog,) = dialogs() - before
    return dialog


def visit(qtbot, opener: Opener, look: Callable[[QDialog], object]) -> None:
    """Look at every dialog that comes, then dismiss it; also at one that is waited for inside."""
    before, looked, done = dialogs(), set(), []

    def dismiss() -> None:
        # A button that opens a menu waits in it; what the menu holds is found by itself.
        close_popups()
        for dialog in dialogs() - before - looked:
            looked.add(dialog)
            look(dialog)
            dialog.reject()

    watch = QTimer()
    watch.timeout.connect(dismiss)
    watch.start(5)
    QTimer.singleShot(0, lambda: (opener[1](), done.append(True)))
    qtbot.waitUntil(lambda: bool(done))
    watch.stop()
    dismiss()


def press(widget: QWidget, key: Qt.Key) -> None:
    """As the keyboard does, through the widget's window."""
    QTest.keyClick(widget.window().windowHandle(), key)


def click(button: QWidget) -> None:
    """As the mouse does, through the button's window; Qt hands it to what is open above."""
    at = button.mapTo(button.window(), button.rect().center())
    QTest.mouseClick(button.window().windowHandle(), Qt.MouseButton.LeftButton, pos=at)


def close_all() -> None:
    """Dialogs and popups."""
    close_popups()
    for dialog in dialogs():
        dialog.reject()


def close_popups() -> None:
    """Menus and lists."""
    while (popup := QApplication.activePopupWidget()) is not None:
        popup.close()


def aside(window: QWidget, dialog: QWidget) -> None:
    """Where it does not cover the window's stop button."""
    dialog.move(window.mapToGlobal(QPoint(0, window.height() // 2)))


def _able(one: QAction | QAbstractButton, act: Callable[[], object]) -> Callable[[], object]:
    def do() -> None:
        if not isValid(one):
            return
        one.setEnabled(True)
        act()

    return do
