"""What the run asks of the operator, where nobody can overlook it."""

from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QWidget

from gui.theme import current_theme
from gui.widgets import button

ANSWERS = {"mount": "It is mounted", "aim": "It is aimed", "content": "Use these hits"}


class Banner(QFrame):
    """Not seen where nothing is asked.

    Signals
    -------
    answered
        The button was pressed.
    """

    answered = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.words = QLabel()
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.RichText)
        self.button = button("", "Tell the run (Ctrl+Return)")
        self.button.clicked.connect(self.answered)
        row = QHBoxLayout(self)
        row.setContentsMargins(16, 8, 8, 8)
        row.addWidget(self.words, 1)
        row.addWidget(self.button)
        self.hide()

    def ask(self, words: str, what: str = "") -> None:
        """Show this; `what` decides the button. Without words there is nothing to see."""
        self.setVisible(bool(words))
        self.words.setText(f"<span style='font-size:large'><b>{words}</b></span>")
        self.button.setVisible(what in ANSWERS)
        self.button.setText(ANSWERS.get(what, ""))

    def paintEvent(self, event: QPaintEvent) -> None:
        """On a ground of its own."""
        painter, theme = QPainter(self), current_theme()
        painter.fillRect(self.rect(), theme.note)
        painter.fillRect(QRectF(0, 0, 8, self.height()), theme.color("fair"))
        painter.end()
