"""A value beside its limit: the numbers, and a bar that says how near it is.

A unit that is cut is another unit. Where there is no room for all of it the limit is left out, which the bar
shows too; where there still is none, the line is shortened so that it shows.
"""

from PySide6.QtCore import QEvent, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from gui.state.readings import FRESH_S
from gui.style.theme import Role, current_theme

_NEAR, _AT = 0.8, 1.0
_BAR_PX = 3
_SPARE_PX = 2
"""A label rounds the width of its text up, and rich text that of each word."""
_LARGE = 1.2
"""Type that is `large` to Qt's rich text, over the usual one."""
_OLD = "Nothing newer has come"


class Gauge(QLabel):
    """One quantity; `large` to be read from afar."""

    def __init__(self, name: str, parent: QWidget | None = None, *, large: bool = False) -> None:
        super().__init__(parent)
        self._name, self._share, self._large = name, 0.0, large
        self._said: tuple[str, ...] = ()
        """All of it first, then less and less."""
        self.value: float | None = None
        self.marked = False
        """Whether it says that the value is not of now."""
        self.setContentsMargins(0, 0, 0, _BAR_PX + 1)
        # Numbers that change their width must not move everything around them.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.show_value(None)

    def show_value(self, value: float | None, limit: float = 1.0, unit: str = "", age_s: float = 0.0) -> None:
        """The value, the limit it is held under, and how old it is; None where there is none."""
        self.value, self.marked = value, value is not None and age_s > FRESH_S
        share = 0.0 if value is None else min(1.0, value / limit)
        said: tuple[str, ...] = (f"{self._name} \u2013",)
        if value is not None:
            # Where there is room for part of it the age counts most, and no limit is near of what is over.
            now = f"{self._name} {_short(value)}"
            said = (
                (f"{self._name} {_old(age_s)} ago: {_short(value)} {unit}",)
                if self.marked
                else (f"{now} / {_short(limit)} {unit}", f"{now} {unit}")
            )
        if share != self._share or said != self._said:
            self._share, self._said = share, said
            self._show()
            self.setEnabled(not self.marked)
            self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """More of it, or less."""
        super().resizeEvent(event)
        self._show()

    def changeEvent(self, event: QEvent) -> None:
        """Type follows the window's."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_said"):
            self._show()

    def _show(self) -> None:
        font = QFont(self.font())
        if self._large:
            font.setPointSizeF(_LARGE * font.pointSizeF())
        metrics, room = QFontMetrics(font), self.contentsRect().width() - _SPARE_PX
        fitting = [said for said in self._said if metrics.horizontalAdvance(said) <= room]
        # Of a value its name goes first, of an old one what it was.
        side = Qt.TextElideMode.ElideRight if self.marked else Qt.TextElideMode.ElideLeft
        shown = fitting[0] if fitting else metrics.elidedText(self._said[-1], side, room)
        self.setText(f"<span style='font-size:large'>{shown}</span>" if self._large else shown)
        cut = self._said[0] if shown != self._said[0] else ""
        self.setToolTip("\n".join(filter(None, (cut, _OLD if self.marked else ""))))

    def paintEvent(self, event: QPaintEvent) -> None:
        """The numbers, and the bar below them."""
        super().paintEvent(event)
        painter = QPainter(self)
        theme = current_theme()
        groove = QRectF(0, self.height() - _BAR_PX, self.width() - 8, _BAR_PX)
        painter.fillRect(groove, theme.color("grid"))
        painter.fillRect(
            QRectF(groove.topLeft(), groove.size()).adjusted(0, 0, -(1 - self._share) * groove.width(), 0),
            theme.color(self._role),
        )
        painter.end()

    @property
    def _role(self) -> Role:
        if self.marked:
            return "faint"
        if self._share >= _AT:
            return "bad"
        return "fair" if self._share >= _NEAR else "good"


def _old(seconds: float) -> str:
    return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 1000 else f"{value:.3g}"
