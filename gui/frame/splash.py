"""What is seen while the program loads."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QSplashScreen

from gui.style.theme import Theme, current_theme

_WIDTH, _HEIGHT = 420, 180
_EDGE = 32.0
_BEAM, _LAYER = 44.0, 7.0
"""Of the plate drawn: its place from below, and a layer's height."""


def splash() -> QSplashScreen:
    """Name and plate, in the colours of the window that comes."""
    made = QSplashScreen()
    ratio = made.devicePixelRatio()
    picture = QPixmap(round(_WIDTH * ratio), round(_HEIGHT * ratio))
    picture.setDevicePixelRatio(ratio)
    theme = current_theme()
    picture.fill(QColor(theme.base))
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _draw(painter, theme, made.font())
    painter.end()
    made.setPixmap(picture)
    return made


def _draw(painter: QPainter, theme: Theme, font: QFont) -> None:
    painter.setPen(QPen(theme.color("grid"), 1.0))
    painter.drawRect(QRectF(0.5, 0.5, _WIDTH - 1.0, _HEIGHT - 1.0))
    size = font.pointSizeF()
    font.setPointSizeF(2.2 * size)
    painter.setFont(font)
    painter.setPen(theme.color("text"))
    room = QRectF(_EDGE, _EDGE, _WIDTH - 2 * _EDGE, _HEIGHT)
    painter.drawText(room, Qt.AlignmentFlag.AlignLeft, "viscorig")
    font.setPointSizeF(size)
    painter.setFont(font)
    painter.setPen(theme.color("faint"))
    painter.drawText(room.translated(0, 48), Qt.AlignmentFlag.AlignLeft, "loading ...")
    # A plate, its core, its constraining layer.
    below = _HEIGHT - _BEAM
    for number, color in enumerate((theme.color("faint"), theme.color("model"), theme.color("faint"))):
        layer = QRectF(_EDGE, below - number * _LAYER, _WIDTH - 2 * _EDGE, _LAYER - 1.0)
        painter.fillRect(layer, color)
