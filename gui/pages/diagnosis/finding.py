"""The verdict in large, where it comes from, and what to measure next."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from gui.actions.rediagnosis import ShownDiagnosis
from gui.style.theme import Role, current_theme
from gui.widgets.mark import Mark
from instrument.facts.doubts import doubts_of
from instrument.results.diagnosis_words import verdict_line
from instrument.results.next_words import beyond_words
from instrument.results.typeset import capitalised, note, typeset

_EDGE_PX = 5
_GAP_PX = 12
_MEANINGS: dict[str, tuple[Role, str]] = {
    "none": ("good", "No structure beyond noise and the model's own error."),
    "effect": ("data", "One explanation, nothing else near it."),
    "ambiguous": ("fair", "More than one explanation is left."),
    "unknown": ("bad", "Structure that nothing in the catalogue explains."),
}
_BY_HAND: tuple[Role, str] = ("fair", "Your word: the data were not asked.")


class Finding(QWidget):
    """One line of verdict, one box of advice."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.verdict, self.origin = Mark(large=True), Mark()
        self.verdict.setWordWrap(True)
        self.next = Advice()
        self.story = QLabel()
        self.story.setWordWrap(True)
        self.story.setTextFormat(Qt.TextFormat.PlainText)
        self.story.hide()
        self.corner = QHBoxLayout()
        """For what can be done about it."""
        row = QHBoxLayout()
        row.addWidget(self.verdict, 1)
        row.addWidget(self.origin)
        row.addSpacing(_GAP_PX)
        row.addLayout(self.corner)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(row)
        column.addWidget(self.story)
        column.addWidget(self.next)

    def show_followed(self, lines: Sequence[str]) -> None:
        """What was measured because a diagnosis before this one ended in a group."""
        self.story.setText("\n".join(lines))
        self.story.setVisible(bool(lines))

    def show_diagnosis(self, shown: ShownDiagnosis) -> None:
        """In words."""
        accepted = shown.asked is not None and shown.asked.accept is not None
        role, meaning = _BY_HAND if accepted else _MEANINGS[shown.found.verdict]
        doubts = doubts_of(shown.found)
        if accepted and doubts:
            role, meaning = "bad", " ".join(map(note, doubts))
        self.verdict.say(headline(shown), role, bold=True)
        self.verdict.setToolTip(meaning)
        made_here = shown.asked is not None
        said = f"● {shown.origin}" if made_here else shown.origin
        self.origin.say(said, "fair" if made_here else "faint", bold=made_here)
        self.origin.setToolTip(str(shown.asked.data) if shown.asked is not None else "")
        self.next.say(shown.found.next_measurement, beyond_words(shown.found))

    def show_none(self, said: str) -> None:
        """There is no diagnosis."""
        self.verdict.say(said, "faint", bold=True)
        self.verdict.setToolTip("")
        self.origin.say("", "faint")
        self.origin.setToolTip("")
        self.next.say("")


def headline(shown: ShownDiagnosis) -> str:
    """The verdict, or what a person decided: then the data were not asked."""
    said = typeset(verdict_line(shown.found).removeprefix("verdict: "))
    if shown.asked is not None and shown.asked.accept is not None:
        said = f"by hand: {said.partition(': ')[2]}"
    return capitalised(said)


class Advice(QFrame):
    """The measurement advised, on a ground of its own; not seen where there is none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._label = QLabel()
        self._label.setWordWrap(True)
        self._label.setTextFormat(Qt.TextFormat.PlainText)
        self._label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setAutoFillBackground(True)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 5, 8, 5)
        row.addWidget(self._label)
        self.hide()

    @property
    def text(self) -> str:
        """The text that is shown."""
        return self._label.text()

    def say(self, next_measurement: str, beside: str = "") -> None:
        """Show what to measure next, and what is said beside; hidden where there is nothing."""
        said = f"Measure next. {next_measurement} {beside}".rstrip()
        self._label.setText(said if next_measurement else "")
        self.setVisible(bool(next_measurement))
        self._tint()

    def changeEvent(self, event: QEvent) -> None:
        """Colours follow the window's."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._tint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """An edge in the colour of attention."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.fillRect(0, 0, _EDGE_PX, self.height(), current_theme().color("fair"))
        painter.end()

    def _tint(self) -> None:
        palette = QPalette()
        palette.setColor(QPalette.ColorRole.Window, QColor(current_theme().note))
        self.setPalette(palette)
