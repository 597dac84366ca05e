"""The dry run: what is wrong with an experiment, or what it is going to look like."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from gui.background.one_command import OneCommand
from gui.bars.top_bar import duration
from gui.style.theme import current_theme
from gui.widgets.basic import hint
from gui.widgets.tables import Cell, ReadTable
from instrument.facts.check import CheckResult, SegmentForecast

_COLUMNS = {
    "segment": "Its number",
    "from / Hz": "Lowest frequency",
    "to / Hz": "Highest frequency",
    "steps": "Frequencies measured",
    "velocity / mm/s": "Largest predicted velocity at the pickup, as the laser sees it",
    "range": "Of the vibrometer",
    "travel / mm": "Largest travel of the base",
    "time": "At least",
}
_NOTHING = (
    "Check shows the predicted response, range, travel and time of every segment. Nothing is connected."
)


class Check(QObject):
    """One at a time, in a process of its own.

    Signals
    -------
    passed
        What `viscorig check` says.
    objected
        What is wrong, a line each.
    """

    passed = Signal(object)
    objected = Signal(list)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._command = OneCommand(self)
        self._command.done.connect(self.passed)
        self._command.failed.connect(self._failed)

    @property
    def running(self) -> bool:
        """Whether one goes on."""
        return self._command.running

    def start(self, experiment: Path) -> None:
        """Of these files, as they are on the disk."""
        self._command.start(["check", str(experiment)], CheckResult)

    def cancel(self) -> None:
        """End it; nothing is told."""
        self._command.drop()

    def _failed(self, message: str) -> None:
        # The last line counts those before it.
        self.objected.emit(self._command.said[:-1] or [message])


class CheckPane(QWidget):
    """What the last check said."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.summary = hint(_NOTHING)
        self.table = ReadTable(_COLUMNS)
        self.warnings = QLabel()
        self.warnings.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 6, 6, 6)
        column.addWidget(self.summary)
        column.addWidget(self.table, 1)
        column.addWidget(self.warnings)
        self.clear()

    def clear(self) -> None:
        """Nothing was checked as it is now."""
        self._say(_NOTHING, faint=True)
        self.table.hide()
        self.warnings.clear()

    def wait(self) -> None:
        """Show that the check goes on."""
        self._say("checking ...", faint=True)
        self.table.hide()
        self.warnings.clear()

    def show_result(self, found: CheckResult) -> None:
        """All is well."""
        said = [f"Nothing is wrong. About {duration(found.seconds)} of measuring."]
        if found.hammer_record_s is not None:
            said.append(f"Hammer: records of {found.hammer_record_s:g} s.")
        said.append("Modes expected at about " + ", ".join(f"{f:.4g}" for f in found.modes_hz) + " Hz.")
        self._say(" ".join(said))
        self.table.show_rows([_row(segment) for segment in found.segments])
        self.table.setVisible(bool(found.segments))
        self._warn(found.warnings, "fair", "\u26a0")

    def show_objections(self, objections: list[str]) -> None:
        """Show why the experiment cannot be run."""
        count = len(objections)
        self._say(f"{count} objection{'s' if count != 1 else ''}: nothing can be run.")
        self.table.hide()
        self._warn(objections, "bad", "\u2716")

    def _say(self, text: str, *, faint: bool = False) -> None:
        self.summary.setEnabled(not faint)
        self.summary.setText(text)

    def _warn(self, lines: Sequence[str], role: Any, sign: str) -> None:
        color = current_theme().color(role).name()
        self.warnings.setText(
            "<br>".join(f"<span style='color:{color}'>{sign}</span> {_escaped(line)}" for line in lines)
        )


def _row(s: SegmentForecast) -> list[Cell]:
    numbers = (
        f"{s.segment}",
        f"{s.low_hz:.4g}",
        f"{s.high_hz:.4g}",
        f"{s.steps}",
        f"{1e3 * s.velocity_m_s:.3g}",
        s.range_name,
        f"{1e3 * s.travel_m:.3g}",
        duration(s.seconds),
    )
    return [Cell(text) for text in numbers]


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")
