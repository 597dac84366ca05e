"""The signs on buttons and tabs: drawn here, in lines on a grid of 24, in the colour of the theme."""

from functools import cache

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QAbstractButton

from gui.style.theme import current_theme

_SIZES_PX = (16, 32, 64)
"""Of screens at scale 1, 2 and 4."""
_SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24" fill="none" stroke="{color}" '
    'stroke-width="2" stroke-linecap="round" stroke-linejoin="round">{shape}</svg>'
)
_DOT = '<circle cx="{}" cy="{}" r="2" fill="{{color}}" stroke="none"/>'
_SHAPES = {
    "run": '<path d="M4 20V10M10 20V4M16 20v-7M22 20H2"/>',
    "sweep": '<path d="M2 19h4c3 0 3-15 5-15s2 15 5 15h6"/>',
    "hammer": '<path d="M3 20l9-9M10 5l8 8M9 6c3-4 8-3 11 1l-3 3-6-6z"/>',
    "material": '<path d="M3 3v18h18M6 17c6-1 9-5 14-12"/>',
    "diagnosis": '<circle cx="10" cy="10" r="6"/><path d="M15 15l6 6M7 10h2l1-2 1 4 1-2"/>',
    "open": '<path d="M3 19V5h6l2 3h9v3M3 19l3-8h16l-3 8z"/>',
    "new": '<path d="M6 3h8l5 5v13H6zM12 11v6M9 14h6"/>',
    "save": '<path d="M4 4h13l3 3v13H4zM8 4v5h7V4M8 20v-6h8v6"/>',
    "check": '<path d="M4 13l5 5L20 6"/>',
    "start": '<path d="M7 4l13 8-13 8z"/>',
    "play": '<path d="M7 4l13 8-13 8z"/>',
    "pause": '<path d="M8 4v16M16 4v16"/>',
    "abort": '<circle cx="12" cy="12" r="9"/><path d="M8 8l8 8M16 8l-8 8"/>',
    "back": '<path d="M19 4L8 12l11 8zM5 4v16"/>',
    "on": '<path d="M5 4l11 8L5 20zM19 4v16"/>',
    "up": '<path d="M5 15l7-7 7 7"/>',
    "tiles": '<path d="M4 4h6v6H4zM14 4h6v6h-6zM4 14h6v6H4zM14 14h6v6h-6z"/>',
    "rows": '<path d="M4 6h16M4 12h16M4 18h16"/>',
    "left": '<path d="M15 5l-7 7 7 7"/>',
    "right": '<path d="M9 5l7 7-7 7"/>',
    "report": '<path d="M6 3h8l5 5v13H6zM9 12h7M9 16h7M9 8h2"/>',
    "export": '<path d="M12 15V3M8 7l4-4 4 4M4 14v6h16v-6"/>',
    "compare": '<path d="M3 17c5 0 5-10 10-10h8M3 20c7 0 8-8 18-8"/>',
    "verify": '<path d="M20 12a8 8 0 1 1-3-6M20 3v4h-4M8 12l3 3 5-6"/>',
    "undo": '<path d="M8 4L3 9l5 5M3 9h11a6 6 0 0 1 0 12h-4"/>',
    "close": '<path d="M5 5l14 14M19 5L5 19"/>',
    "plus": '<path d="M12 4v16M4 12h16"/>',
    "minus": '<path d="M4 12h16"/>',
    "whole": '<path d="M3 12h18M7 8l-4 4 4 4M17 8l4 4-4 4"/>',
    "plate": '<path d="M4 3v18M4 6h17v12H4M4 6L1 9M4 12l-3 3M4 18l-3 3"/>' + _DOT.format(14, 12),
}
NAMES = tuple(_SHAPES)


def icon(name: str, color: str = "") -> QIcon:
    """A sign in this colour, the theme's where none is given; fainter where its widget is not enabled.

    Raises `KeyError` for one that there is not.
    """
    theme = current_theme()
    return _icon(name, color or theme.text, theme.faint)


@cache
def _icon(name: str, color: str, faint: str) -> QIcon:
    made = QIcon()
    for mode, drawn_in in ((QIcon.Mode.Normal, color), (QIcon.Mode.Disabled, faint)):
        for size in _SIZES_PX:
            made.addPixmap(_picture(name, drawn_in, size), mode)
    return made


def _picture(name: str, color: str, size: int) -> QPixmap:
    drawing = _SVG.format(color=QColor(color).name(), shape=_SHAPES[name].replace("{color}", color))
    picture = QPixmap(size, size)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    QSvgRenderer(QByteArray(drawing.encode())).render(painter)
    painter.end()
    return picture


class Sign(QObject):
    """A button's sign, which follows the window's colours."""

    def __init__(self, button: QAbstractButton, name: str, role: str = "text") -> None:
        super().__init__(button)
        self._button, self._name, self._role = button, name, role
        button.installEventFilter(self)
        self._draw()

    def show(self, name: str) -> None:
        """Another one."""
        if name != self._name:
            self._name = name
            self._draw()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Another theme."""
        if event.type() == QEvent.Type.PaletteChange:
            self._draw()
        return False

    def _draw(self) -> None:
        self._button.setIcon(icon(self._name, getattr(current_theme(), self._role)))
