"""One message across the window, until it is read; nothing is blocked by it."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QWidget

from gui.theme import Role, current_theme
from gui.widgets import tool

_EDGE_PX = 4


class Notice(QFrame):
    """Not seen where there is nothing to say."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._role: Role = "good"
        self._label = QLabel()
        self._label.setWordWrap(True)
        self._label.setTextFormat(Qt.TextFormat.PlainText)
        self._label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        close = tool("\u2715", "Dismiss (Esc)")
        close.clicked.connect(self.hide)
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 2, 4, 2)
        row.addWidget(self._label, 1)
        row.addWidget(close)
        self.hide()

    @property
    def text(self) -> str:
        """What it says; empty while it is not seen."""
        return self._label.text() if not self.isHidden() else ""

    def refuse(self, message: str) -> None:
        """Something could not be done."""
        self._show(message, "bad")

    def say(self, message: str) -> None:
        """Something was done."""
        self._show(message, "good")

    def paintEvent(self, event: QPaintEvent) -> None:
        """On a ground of its own; the edge says which kind it is."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(current_theme().note))
        painter.fillRect(0, 0, _EDGE_PX, self.height(), current_theme().color(self._role))
        painter.end()

    def _show(self, message: str, role: Role) -> None:
        self._role = role
        self._label.setText(message)
        self.show()
        self.update()
