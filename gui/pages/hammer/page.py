"""The page of the hammer test: what stands where, and what follows when something changes."""

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QSplitter, QStackedLayout, QVBoxLayout, QWidget

from fitting.arrays import Array
from fitting.modal.frf import Frf
from gui.actions.controller import AppController
from gui.page import Page
from gui.pages.hammer.bench import Bench
from gui.pages.hammer.choice import WhatIf, overruled, standing_of
from gui.pages.hammer.findings import Averaged, Hits, ModesFound
from gui.pages.hammer.frf_plots import FrfPlots
from gui.pages.hammer.hit_list import HitList
from gui.pages.hammer.hit_plots import HitPlots
from gui.pages.hammer.mode_table import ModeTable
from gui.pages.hammer.mode_words import advice_of, agree, mode_rows, number_of
from gui.pages.hammer.words import hit_rows, prompt_of, source_of, treated_words
from gui.state import SessionState
from gui.widgets.basic import hint
from instrument.engine import Engine
from instrument.session.contents import RecordedHit

_NO_SESSION = (
    "Open a session with a hammer test, or start a run: its hits, the accelerance of the bare plate and the "
    "damping of its modes appear here."
)
_NO_TEST = "This experiment has no hammer test: its file has no table [hammer]."
_BEYOND = 1.1
"""Expected modes are shown so much further than the band."""


class HammerPage(Page):
    """Hits, accelerance and damping of the bare plate; or, once it was struck, hits of the treated one.

    While the test goes on, a word about a hit goes to the run. Otherwise it is a what-if: the damping is
    computed from the hits as they were recorded with the changed choice, and nothing is written.
    """

    title = "Hammer"
    hint = "Hits, accelerance and damping of the bare plate"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.nothing = hint(_NO_SESSION)
        self.nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.hits, self.hit_plots = HitList(), HitPlots()
        self.frf, self.modes = FrfPlots(), ModeTable()
        self.bench = Bench(self)
        self.what_if = WhatIf()
        self._averaged: Averaged | None = None
        self._modes: ModesFound | None = None
        self._expected_hz: Array | None = None
        self._hits: Hits = ()
        """As they count on this page; what the bench was given last."""
        self._failure = ""
        self._records: dict[str, Frf] = {}
        """What other files' records in time give, by what it is drawn as."""
        self._treated = False
        """Whether the hits are those of the treated plate."""
        self._frf_later = QTimer(self)
        self._frf_later.setSingleShot(True)
        self._frf_later.timeout.connect(self._show_frf)
        self._arrange()
        self._connect()

    # From the window

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed."""
        hammer = state.configuration.experiment.hammer
        run, hits, damping = (self.news(topic) for topic in ("run", "hits", "damping"))
        self._stack.setCurrentIndex(0 if hammer is None else 1)
        self.nothing.setText(_NO_TEST)
        if hammer is None:
            return
        if self._expected_hz is None:
            self._expected_hz = np.zeros(0)
            self.frf.show_band(self._band_hz)
            self.bench.expect(state.configuration, _BEYOND * hammer.band_hz[1])
        if hits or run:
            self._choose_plate(state)
        if hits:
            self._take_hits()
        if hits or run:
            self._show_hits()
        if hits or run or damping:
            self._show_modes()

    def begin(self) -> None:
        """Another session: no hit of this one, and nothing tried with it."""
        self.what_if.clear()
        self._forget_hits()
        self._expected_hz = None
        self.modes.deselect()

    def clear(self) -> None:
        """There is no session any more."""
        self._stack.setCurrentIndex(0)
        self.nothing.setText(_NO_SESSION)

    # What is known

    @property
    def _recorded(self) -> list[RecordedHit]:
        """As the stream has them."""
        if self._state is None:
            return []
        contents = self._state.contents
        return contents.struck_hits if self._treated else contents.hits

    @property
    def _engine(self) -> Engine | None:
        """Of the run a word about a hit goes to; None where it is a what-if."""
        live = self.controller.live
        if live is None or not live.engine.running or live.state is None:
            return None
        return live.engine if live.state.run.strikes else None

    @property
    def _is_what_if(self) -> bool:
        return any(self.what_if.changes(h) for h in self._recorded)

    @property
    def _band_hz(self) -> tuple[float, float]:
        hammer = self._state.configuration.experiment.hammer if self._state is not None else None
        return (hammer.band_hz[0], hammer.band_hz[1]) if hammer is not None else (0.0, 1.0)

    # What follows

    def _choose_plate(self, state: SessionState) -> None:
        """The one that is being struck; a person chooses where both were."""
        contents = state.contents
        self.hits.plates.setVisible(bool(contents.hits and contents.struck_hits))
        if state.run.strikes:
            self.hits.plates.setCurrentIndex(int(state.run.state == "struck"))
        elif not contents.hits or not contents.struck_hits:
            self.hits.plates.setCurrentIndex(int(bool(contents.struck_hits)))

    def _plate_chosen(self, index: int) -> None:
        self._treated = bool(index)
        self.what_if.clear()
        self._forget_hits()
        self.modes.deselect()
        self.frf.show_expected(None if self._treated else self._expected_hz)
        self._choice_changed()

    def _take_hits(self) -> None:
        """Have computed what the hits give, where they are not the same as before."""
        hits = self.what_if.applied(self._recorded)
        same = standing_of(hits) == standing_of(self._hits)
        self._hits = hits
        if same:
            return
        self._failure, self._modes = "", None
        if hits:
            self.bench.look_at(hits, None if self._treated else self._band_hz)
        else:
            self._forget_hits()

    def _forget_hits(self) -> None:
        self.bench.forget()
        self._averaged = self._modes = None
        self._hits = ()
        self.frf.empty()
        self.hit_plots.show_hit(None, 0)

    def _show_hits(self) -> None:
        assert self._state is not None
        live = self._engine is not None
        undoable = (h.number for h in self._recorded if (overruled(h) if live else self.what_if.changes(h)))
        self.hits.show_rows(
            hit_rows(self._recorded, self._hits, self.what_if, self._averaged), frozenset(undoable)
        )
        self.hits.prompt.setText(prompt_of(self._state.run, self._hits, live=live))
        feed = self.controller.live
        asked = feed.question.what if live and feed is not None and feed.question is not None else ""
        self.hits.use.setVisible(asked == "content")

    def _show_modes(self) -> None:
        """From the record where the hits count as recorded; else as computed here."""
        if self._state is None:
            # What is expected may be worked out before anything is shown.
            return
        if self._treated:
            self.modes.say(treated_words(self._state.contents.struck), what_if=self._is_what_if)
            self.modes.show_rows([], "")
            return
        recorded = None if self._is_what_if else self._state.contents.damping
        computed = self._modes.result if self._modes is not None else None
        result = recorded.result if recorded is not None else computed
        differs = recorded is not None and computed is not None and not agree(recorded.result, computed)
        self.modes.say(
            source_of(
                self._hits,
                recorded=recorded is not None,
                what_if=self._is_what_if,
                live=self._engine is not None,
                busy=self.bench.busy,
                failure=self._failure or (self._modes.why if self._modes is not None else ""),
                differs=differs,
            ),
            what_if=self._is_what_if,
        )
        self.modes.show_rows(mode_rows(result, self._modes, self._expected_hz), advice_of(result))

    def _show_hit(self) -> None:
        if self._averaged is not None:
            self.hit_plots.show_hit(self._averaged, self.hits.number)
            self.frf.show_hit(self._averaged, self.hits.number)

    def _show_frf(self) -> None:
        if self._averaged is None:
            return
        self.frf.show_average(self._averaged)
        self.frf.show_hit(self._averaged, self.hits.number)
        self.frf.show_expected(None if self._treated else self._expected_hz)
        self._show_beside()
        self.frf.show_modes(self._modes)
        self._zoom()

    def _show_beside(self) -> None:
        """What other files hold: drawn with the session's own hits, once there are any."""
        if self._averaged is None:
            return
        files = self.controller.beside.items()
        frfs = {f"{path.name}: {name}": frf for path, f in files for name, frf, _ in f.frfs}
        self.frf.show_beside(frfs | self._records)

    def _zoom(self) -> None:
        """About the mode selected; the whole band where none is, or none is computed yet."""
        modes, frequency_hz = self._modes, self.modes.frequency_hz
        k = number_of(modes, frequency_hz) if modes is not None and frequency_hz is not None else None
        self.frf.zoom(modes.around[k] if modes is not None and k is not None else None)

    def _beside_changed(self) -> None:
        self._records = {}
        records = {path: found.hits for path, found in self.controller.beside.items() if found.hits}
        self.bench.lay_beside(records)
        self._show_beside()

    # From the bench

    def _is_laid(self, frfs: dict[str, Frf]) -> None:
        self._records = frfs
        self._show_beside()

    def _is_averaged(self, averaged: Averaged) -> None:
        self._averaged = averaged
        self._show_hits()
        self._show_modes()
        self.hit_plots.show_hit(averaged, self.hits.number)
        # In a turn of its own: the window answers in between.
        self._frf_later.start()

    def _has_modes(self, modes: ModesFound) -> None:
        self._modes = modes
        self._show_modes()
        self.frf.show_modes(modes)
        self._zoom()

    def _is_expected(self, frequency_hz: Array) -> None:
        self._expected_hz = frequency_hz
        self.frf.show_expected(None if self._treated else frequency_hz)
        self._show_modes()

    def _has_failed(self, said: str) -> None:
        self._failure = said
        self._show_modes()

    # From a person

    def _accept(self, number: int) -> None:
        if self._engine is not None:
            self._engine.accept(number)
        else:
            self._try(number, accepted=True)

    def _reject(self, number: int) -> None:
        if self._engine is not None:
            self._engine.reject(number)
        else:
            self._try(number, accepted=False)

    def _undo(self, number: int) -> None:
        if self._engine is not None:
            self._engine.undo(number)
        else:
            self._try(number, accepted=None)

    def _try(self, number: int, *, accepted: bool | None) -> None:
        """What if this hit counted, or not; None: as recorded."""
        for hit in self._recorded:
            if hit.number == number:
                self.what_if.say(hit, hit.accepted if accepted is None else accepted)
        self._choice_changed()

    def _as_recorded(self) -> None:
        self.what_if.clear()
        self._choice_changed()

    def _choice_changed(self) -> None:
        self._take_hits()
        self._show_hits()
        self._show_modes()

    def _content(self) -> None:
        if self.controller.live is not None:
            self.controller.live.answer()

    # What stands where

    def _connect(self) -> None:
        self.controller.beside_changed.connect(self._beside_changed)
        self.bench.laid.connect(self._is_laid)
        self.bench.not_laid.connect(self.controller.refused)
        self.bench.averaged.connect(self._is_averaged)
        self.bench.modes_found.connect(self._has_modes)
        self.bench.expected.connect(self._is_expected)
        self.bench.failed.connect(self._has_failed)
        self.hits.selected.connect(self._show_hit)
        self.hits.accepted.connect(self._accept)
        self.hits.rejected.connect(self._reject)
        self.hits.undone.connect(self._undo)
        self.hits.content.connect(self._content)
        self.hits.plates.currentIndexChanged.connect(self._plate_chosen)
        self.modes.selected.connect(self._zoom)
        self.modes.as_recorded.connect(self._as_recorded)
        self.frf.mode_picked.connect(self.modes.select)

    def _arrange(self) -> None:
        whole = QSplitter(Qt.Orientation.Horizontal)
        for above, below in ((self.hit_plots, self.hits), (self.frf, self.modes)):
            half = QSplitter(Qt.Orientation.Vertical)
            half.addWidget(above)
            half.addWidget(below)
            half.setStretchFactor(0, 1)
            whole.addWidget(half)
        whole.setSizes([400, 600])
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(6, 4, 6, 4)
        column.addWidget(whole)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self.nothing)
        self._stack.addWidget(content)
