"""How a run or a recorded session stands: large enough to be read from the rig."""

from pathlib import Path

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from gui.actions.controller import BROKEN_OFF, AppController
from gui.bars.channels import ChannelTable
from gui.bars.gauge import Gauge
from gui.bars.run_gauges import RunGauges, run_color
from gui.feeds.live import LiveFeed
from gui.pages.run.overrule import OverruleRow
from gui.state import SessionState
from gui.style.theme import Role
from gui.widgets.basic import hint
from gui.widgets.tables import Cell, ReadTable
from instrument.check.forecast import distinct
from instrument.engine.messages import Ended
from instrument.files.acceleration import acceleration_unit
from instrument.files.devices import ranges_of
from instrument.results.typeset import typeset
from instrument.stream.raw import SegmentBegan

_COLUMNS = {
    "sweep": "Pass over all segments; 0 is the calibration",
    "segment": "Its number; of a calibration the vibrometer's range",
    "from / Hz": "Lowest frequency",
    "to / Hz": "Highest frequency",
    "steps": "Measured, of those planned",
}
_NOTHING = "No run and no session. How a run stands appears here: state, level, drive and limits, segments."


class NowPane(QWidget):
    """Reads the session state, and of a run how its stop path stands."""

    def __init__(self, controller: AppController, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._controller = controller
        self.state, self.next = QLabel(), QLabel()
        self.next.setWordWrap(True)
        self.next.setTextFormat(Qt.TextFormat.PlainText)
        self.level = Gauge("level", large=True)
        self.gauges = RunGauges(controller, self, large=True)
        self.overrule = OverruleRow(controller.commands)
        self.segments, self.channels = ReadTable(_COLUMNS), ChannelTable()
        self.path = QLabel()
        self.path.setWordWrap(True)
        self.nothing = hint(_NOTHING)
        self._arrange()
        self.clear()

    def clear(self) -> None:
        """There is nothing to show."""
        self.nothing.show()
        self._whole.hide()

    def show_state(self, state: SessionState, live: LiveFeed | None, ending: Ended | None) -> None:
        """As it stands now; `ending` of the run whose recording this is.

        A recording of another one says itself what is left of it.
        """
        self.nothing.hide()
        self._whole.show()
        run = state.run
        self._say_state(state)
        self.next.setText(typeset(run.next_words))
        self.overrule.show_state(state)
        self._show_gauges(state)
        words = path_words(live) if live is not None else ending_words(ending) or self._how_to_go_on(state)
        self.path.setText(words)
        self.path.setVisible(bool(words))

    def changeEvent(self, event: QEvent) -> None:
        """Another theme: the state's colour is one of its own."""
        super().changeEvent(event)
        state = self._controller.state
        if event.type() == QEvent.Type.PaletteChange and state is not None and hasattr(self, "_whole"):
            self._say_state(state)

    def _say_state(self, state: SessionState) -> None:
        style = f"font-size:x-large; color:{run_color(state.run)}"
        self.state.setText(f"<span style='{style}'><b>{state.run.word}</b></span>")

    def _how_to_go_on(self, state: SessionState) -> str:
        recorded = self._controller.recorded
        stopped = recorded is not None and state.run.state == "stopped"
        return go_on_words(recorded.path) if recorded is not None and stopped else ""

    def show_segments(self, state: SessionState) -> None:
        """How far each segment is."""
        plan = state.plan
        rows = []
        for key, began in plan.begun.items():
            done = plan.done.get(key, 0)
            bar: Role = "good" if key in plan.ended else "data"
            rows.append(
                [
                    Cell(str(began.sweep) if began.sweep else "calibration"),
                    Cell(_segment_words(state, began)),
                    Cell(f"{began.low_hz:.4g}"),
                    Cell(f"{began.high_hz:.4g}"),
                    Cell(f"{done} of {began.steps}", fill=bar, share=plan.fraction(key), left=True),
                ]
            )
        self.segments.show_rows(rows)
        self.segments.scrollToBottom()

    def _show_gauges(self, state: SessionState) -> None:
        self.gauges.refresh()
        self.channels.show_feed(self._controller.feed)
        if state.step is None or state.run.over or not state.readings.channels:
            self.level.show_value(None)
            return
        wanted, most, shown = state.step.began.level_m_s2, state.limits.limits.base_m_s2, acceleration_unit()
        self.level.show_value(None if wanted is None else shown.of(wanted), shown.of(most), shown.symbol)

    def _arrange(self) -> None:
        self._whole = QWidget()
        grid = QGridLayout()
        for k, gauge in enumerate((self.level, *self.gauges.by_name.values())):
            grid.addWidget(gauge, k // 2, k % 2)
        inside = QVBoxLayout(self._whole)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.addWidget(self.state)
        inside.addWidget(self.next)
        inside.addWidget(self.overrule)
        inside.addLayout(grid)
        inside.addWidget(self.channels, 1)
        inside.addWidget(self.segments, 2)
        inside.addWidget(self.path)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 6, 6, 6)
        column.addWidget(self.nothing)
        column.addWidget(self._whole, 1)


def _segment_words(state: SessionState, began: SegmentBegan) -> str:
    """Its number; of a calibration, which is numbered among the vibrometer's ranges, its range."""
    ranges = distinct(ranges_of(state.configuration.rig.vibrometer)) if began.sweep == 0 else ()
    return ranges[began.segment - 1].name if 0 < began.segment <= len(ranges) else str(began.segment)


def ending_words(ending: Ended | None) -> str:
    """What a run left on the disk."""
    if ending is None:
        return ""
    said = f"Session: {ending.session}" if ending.session is not None else "There is no session."
    if ending.folder is not None:
        said += f"\nBroken off: to go on, choose {ending.folder.name} beside Begin."
    return said


def go_on_words(session: Path) -> str:
    """What can be done about a recorded run that was stopped: its folder would lie beside its file."""
    folder = session.with_suffix(BROKEN_OFF)
    if folder.is_dir():
        return (
            f"Broken off. To go on: open its experiment, set \u201cSession to\u201d to {session.parent}, "
            f"choose {folder.name} beside Begin, and Start. What it completed is not measured again."
        )
    return (
        f"Broken off. It cannot be carried on: {folder.name} is not beside it. "
        "What was measured can be diagnosed on Diagnosis."
    )


def path_words(live: LiveFeed) -> str:
    """What stands between the stop button and the shaker, and what the window could not show.

    Of a run that is over and left no session to be shown in its place: what it left.
    """
    if live.ending is not None:
        said = ending_words(live.ending)
    elif live.stop_path is None:
        said = "Stop path: no rig is open yet, nothing is driven."
    elif live.stop_path.ready:
        said = "Stop path: ready, a connection to the shaker of the window's own."
    else:
        said = f"Stop path: {live.stop_path.message}."
    if live.blocks_dropped:
        said += f" {live.blocks_dropped} blocks not shown; the session has them."
    if live.recording is not None and live.ending is None:
        said += f"\nRecording: {live.recording.folder}"
    return said.strip()
