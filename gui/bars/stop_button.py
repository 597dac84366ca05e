"""The stop button: red while there is something to stop, and larger than all others."""

from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication, QPushButton, QSizePolicy, QWidget

from gui.style.style_sheet import STOP

_LARGER = 1.3
_SIGNS = (
    QEvent.Type.Show,
    QEvent.Type.ApplicationFontChange,
    QEvent.Type.StyleChange,
)
"""The last, which comes with a style sheet, is all that a button with a type of its own hears of another."""


class StopButton(QPushButton):
    """Pressed, it acts: nobody is asked again."""

    _sizing = False

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("STOP", parent)
        self.setObjectName(STOP)
        self.setToolTip("Silence the shaker at once, whatever hangs (F12, or Esc twice)")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self._size()

    def event(self, event: QEvent) -> bool:
        """Type follows the window's."""
        if event.type() in _SIGNS and not self._sizing:
            self._sizing = True
            self._size()
            self._sizing = False
        return bool(super().event(event))

    def _size(self) -> None:
        font = QApplication.font()
        font.setBold(True)
        font.setPointSizeF(_LARGER * font.pointSizeF())
        self.setFont(font)
        self.setMinimumWidth(self.fontMetrics().horizontalAdvance("STOP") * 2)
