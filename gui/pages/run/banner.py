"""What the run asks of the operator, where nobody can overlook it."""

from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QWidget

from fitting.specimen import PlateSpecimen
from gui.pages.run.plate_view import PlateView
from gui.style.theme import current_theme
from gui.widgets.basic import button

ANSWERS = {
    "mount": "It is mounted",
    "aim": "It is aimed",
    "content": "Use these hits",
    "change": "It is done",
    "follow-up": "Measure it",
}
_SKETCH_PX = (240, 140)


class Banner(QFrame):
    """Not seen where nothing is asked.

    Signals
    -------
    answered
        The button was pressed.
    declined
        The other one was, where there is one.
    """

    answered, declined = Signal(), Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.words = QLabel()
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.RichText)
        self.button = button("", "Tell the run (Ctrl+Return)")
        self.button.clicked.connect(self.answered)
        self.other = button("Not this", "Ask for the next one, or end")
        self.other.clicked.connect(self.declined)
        self.sketch = PlateView()
        self.sketch.setFixedSize(*_SKETCH_PX)
        self.sketch.setToolTip("The plate to scale, clamped on the left")
        row = QHBoxLayout(self)
        row.setContentsMargins(16, 8, 8, 8)
        row.addWidget(self.words, 1)
        row.addWidget(self.sketch)
        row.addWidget(self.other)
        row.addWidget(self.button)
        self.hide()

    def ask(self, words: str, what: str = "") -> None:
        """Show this; `what` decides the button. Without words there is nothing to see."""
        self.setVisible(bool(words))
        self.words.setText(f"<span style='font-size:large'><b>{words}</b></span>")
        self.button.setVisible(what in ANSWERS)
        self.button.setText(ANSWERS.get(what, ""))
        self.other.setVisible(what == "follow-up")
        self.sketch.hide()

    def show_place(
        self,
        specimen: PlateSpecimen,
        at_mm: tuple[float, float],
        mark: str,
        read_mm: tuple[float, float] | None = None,
    ) -> None:
        """Where on the plate something is to be done, and where it is to be read where that is elsewhere."""
        self.sketch.show_place(specimen, at_mm, mark, read_mm)
        held = "clamped on the left" if specimen.boundary == "cantilever" else "hung free"
        self.sketch.setToolTip(f"The plate to scale, {held}")
        self.sketch.show()

    def paintEvent(self, event: QPaintEvent) -> None:
        """On a ground of its own."""
        painter, theme = QPainter(self), current_theme()
        painter.fillRect(self.rect(), theme.note)
        painter.fillRect(QRectF(0, 0, 8, self.height()), theme.color("fair"))
        painter.end()
