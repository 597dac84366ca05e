"""What happened, line by line."""

from PySide6.QtCore import QEvent
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication, QDockWidget, QPlainTextEdit, QWidget

from gui.state import SessionState
from gui.state.log import LogLine
from instrument.results.typeset import typeset

_MOST_LINES = 5000
_NO_CLOCK = 8 * "\u2007"
_SIGNS = {"said": " ", "warning": "!", "fault": "\u2716"}


class LogPane(QDockWidget):
    """Grows at its end."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("Log", parent)
        self.setObjectName("log")
        self.setToolTip(
            "Time of day by the session's clock, which runs ahead on a simulated rig; time of the "
            "session; what happened"
        )
        self._text = QPlainTextEdit()
        self._text.setReadOnly(True)
        self._text.setMaximumBlockCount(_MOST_LINES)
        self._text.setPlaceholderText("What happens is written here.")
        self.setWidget(self._text)
        self._size()
        self._at_end = True
        bar = self._text.verticalScrollBar()
        bar.valueChanged.connect(self._scrolled)
        bar.rangeChanged.connect(self._stay_at_end)
        self._shown_of: SessionState | None = None
        self._shown = 0

    def changeEvent(self, event: QEvent) -> None:
        """Type follows the window's: what has its own hears of another size by the style sheet alone."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange and hasattr(self, "_text"):
            self._size()

    def _size(self) -> None:
        """Take the window's type as its own: where the two are one, Qt writes the title in the system's."""
        font = QApplication.font()
        # Says nothing that shows, but makes it another one.
        font.setStyleHint(QFont.StyleHint.SansSerif)
        if font != self.font():
            self.setFont(font)

    @property
    def text(self) -> str:
        """All of it."""
        return self._text.toPlainText()

    def _scrolled(self, value: int) -> None:
        self._at_end = value == self._text.verticalScrollBar().maximum()

    def _stay_at_end(self, _: int, last: int) -> None:
        """Larger type, or less room: the newest line is still seen whole."""
        if self._at_end:
            self._text.verticalScrollBar().setValue(last)

    def show_state(self, state: SessionState | None) -> None:
        """Write the lines that are new."""
        if state is not self._shown_of:
            self._text.clear()
            self._shown_of, self._shown = state, 0
        if state is None:
            return
        log = state.log
        new = log.lines[max(0, self._shown - log.dropped) :]
        if new:
            self._text.appendPlainText("\n".join(_written(line) for line in new))
            self._shown = log.dropped + len(log.lines)


def _written(line: LogLine) -> str:
    minutes, seconds = divmod(line.time_s, 60)
    wall = line.wall.astimezone().strftime("%H:%M:%S") if line.wall is not None else _NO_CLOCK
    return f"{wall} {int(minutes):4d}:{seconds:04.1f} {_SIGNS[line.kind]} {typeset(line.text)}"
