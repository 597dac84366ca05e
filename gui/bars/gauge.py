"""A value beside its limit: the numbers, and a bar that says how near it is."""

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from gui.state.readings import FRESH_S
from gui.style.theme import Role, current_theme

_NEAR, _AT = 0.8, 1.0
_BAR_PX = 3
_OLD = "Nothing newer has come"


class Gauge(QLabel):
    """One quantity; `large` to be read from afar."""

    def __init__(self, name: str, parent: QWidget | None = None, *, large: bool = False) -> None:
        super().__init__(parent)
        self._name, self._share, self._said, self._large = name, 0.0, "", large
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
        said = f"{self._name} \u2013"
        if value is not None:
            # Where there is room for part of it the age counts most, and no limit is near of what is over.
            said = (
                f"{self._name} {_old(age_s)} ago: {_short(value)} {unit}"
                if self.marked
                else f"{self._name} {_short(value)} / {_short(limit)} {unit}"
            )
        if share != self._share or said != self._said:
            self._share, self._said = share, said
            self.setText(f"<span style='font-size:large'>{said}</span>" if self._large else said)
            self.setToolTip(_OLD if self.marked else "")
            self.setEnabled(not self.marked)
            self.update()

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
