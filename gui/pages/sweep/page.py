"""The page of the sweep: which segment, which point; the panes draw."""

import numpy as np
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut, QShowEvent
from PySide6.QtWidgets import QCheckBox, QSplitter, QStackedLayout, QTabWidget, QVBoxLayout, QWidget

from fitting.gravity import PUBLISHED_G_M_S2
from gui.actions.controller import AppController
from gui.actions.rediagnosis import ShownDiagnosis
from gui.page import Page
from gui.pages.sweep.chooser import Chooser
from gui.pages.sweep.drift import DriftPane
from gui.pages.sweep.fit_words import doubt_of, said_of_fit
from gui.pages.sweep.model import ForeseenCurve, ModelCurve
from gui.pages.sweep.nyquist import NyquistPane
from gui.pages.sweep.overlay import besides
from gui.pages.sweep.pane_scheduler import PaneScheduler
from gui.pages.sweep.points import PointsMeasured
from gui.pages.sweep.predicted import Predicted
from gui.pages.sweep.quality import QualityPane
from gui.pages.sweep.record import RecordPane
from gui.pages.sweep.response import ResponsePane
from gui.pages.sweep.samples import SamplesPane
from gui.pages.sweep.seen import PaneContents
from gui.pages.sweep.segments import standings
from gui.pages.sweep.step import StepPane
from gui.state import SessionState
from gui.widgets.basic import hint
from instrument.check.piece import Region
from instrument.results.set_aside import why_aside
from instrument.session.configuration import Configuration
from instrument.stepped_sine.settings import SweepSettings

_BAND = (
    "The band is what the noise of the points lets the fitted response move by, scaled by the residual; "
    "an effect that the model lacks is not in it"
)
_LEFT_DIGITS = 32
_CHOOSER_PX, _RECORD_PX = 190, 330
_NONE = (
    "The sweep appears here: amplitude and phase of every segment with the fitted model through the points, "
    "the step in progress, the quality of each point. Open a session, or start a run."
)
_LEFT_PX, _MIDDLE_PX, _RIGHT_PX = 260, 600, 476


class SweepPage(Page):
    """Response, current step, quality of every point."""

    title = "Sweep"
    hint = "Response, current step, quality of every point"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.chooser, self.record = Chooser(), RecordPane()
        self.follow = QCheckBox("follow the run")
        self.follow.setChecked(True)
        self.follow.setToolTip("Show each segment as it begins")
        self.response, self.step = ResponsePane(), StepPane()
        self.nyquist, self.quality = NyquistPane(), QualityPane()
        self.drift, self.samples = DriftPane(), SamplesPane()
        self.model, self.foreseen = ModelCurve(self), ForeseenCurve(self)
        self.tabs = QTabWidget()
        self.seen = PaneContents(PointsMeasured.of((), SweepSettings()))
        self._looked_at: int | None = None
        self._configuration: Configuration | None = None
        self._running: tuple[int, int] | None = None
        self.turns = PaneScheduler(self, self._panes, self._draw_pane)
        self._arrange()
        self._connect()

    # From the window

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed."""
        self._layers.setCurrentIndex(1)
        if state.configuration is not self._configuration:
            self._configuration = state.configuration
            self._looked_at = self._running = None
        self._want_curves(state)
        regions = state.plan.regions
        if self.news("points", "sentinels", "fits", "damping", "diagnosis") or regions != self.seen.regions:
            self._look_again(state, regions)
        if self.news("run"):
            self.chooser.show_standings(standings(state, self.seen.points))
            self._follow(state)
        if self.news("step", "samples"):
            self.turns.mark(self.step)
        self.turns.go_on()

    def clear(self) -> None:
        """There is no session any more."""
        self._layers.setCurrentIndex(1 if self.seen.beside else 0)
        self._want_curves(None)
        self.seen = PaneContents(
            PointsMeasured.of((), SweepSettings()), way=self.response.way, beside=self.seen.beside
        )
        self._looked_at = self._running = None
        self.chooser.show_standings([])
        self.step.clear()

    def redraw(self) -> None:
        """Its panes by their own turns."""
        super().redraw()
        self.turns.mark(self.step)
        self._draw_all()

    def showEvent(self, event: QShowEvent) -> None:
        """Go on where hiding broke off: in a run pane by pane, all at once it would hold up the window."""
        super().showEvent(event)
        if not self.controller.running:
            self._want_curves(self._state)
            self._draw_all()

    def changeEvent(self, event: QEvent) -> None:
        """Plots follow the colours by themselves; lists and legends are written again."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_layers"):
            self.turns.mark(self.step)
            self._draw_all()

    def hideEvent(self, event: QHideEvent) -> None:
        """Nothing is computed for a page that nobody sees."""
        super().hideEvent(event)
        self.model.rest()
        self.foreseen.rest()

    # From a person

    def choose(self, number: int) -> None:
        """Look at a point."""
        self._looked_at = self.seen.points.timed[number].point.step
        self.seen = self.seen.but(chosen=number)
        self._draw_all()

    def walk(self, by: int) -> None:
        """Look at a point further along the frequency."""
        number = self.seen.neighbour(by)
        if number is not None:
            self.choose(number)

    # Inside

    def _want_curves(self, state: SessionState | None) -> None:
        """One computation at a time; the fit's comes first."""
        self.model.want(state)
        if not self.model.busy:
            self.foreseen.want(state)

    def _look_again(self, state: SessionState, regions: tuple[Region, ...]) -> None:
        """Points, fits or regions are others."""
        points = self.seen.points.up_to(state.contents.points, state.limits)
        fit, sweep, own = state.contents.fit, state.plan.sweep, state.contents.diagnosis
        shown = self._shown(state)
        result = fit.result if fit is not None else None
        measured = [t.point for t in points.timed]
        by_fit = why_aside(measured, result.points_set_aside if result is not None else ())
        # The diagnosis looks for more.
        by_diagnosis = why_aside(measured, shown.found.points_set_aside if shown is not None else ())
        points = points.setting_aside(np.where(by_fit == "", by_diagnosis, by_fit))
        self.seen = self.seen.but(
            points=points,
            regions=regions,
            reads=state.configuration.rig.vibrometer.reads,
            chosen=points.of_step(self._looked_at) if self._looked_at is not None else None,
            predicted=Predicted.by_fit(points, fit, by_fit != ""),
            explained=Predicted.with_effects(
                points, shown, own.last_step if own is not None else None, by_diagnosis != ""
            ),
            fit=fit.number if fit is not None else 0,
            doubt=doubt_of(state, shown),
            curve=self.model.curve,
            foreseen=self.foreseen.curve,
            planned_m_s2=sweep.level_g * PUBLISHED_G_M_S2 if sweep is not None else PUBLISHED_G_M_S2,
        )
        self._mark_all()

    def _follow(self, state: SessionState) -> None:
        began = state.run.segment
        running = (began.sweep, began.segment) if began is not None and began.sweep > 0 else None
        if running == self._running:
            return
        self._running = running
        if running is not None and self.follow.isChecked() and not state.run.over:
            self.chooser.choose(running[1])

    def _rediagnosed(self) -> None:
        """Another diagnosis is shown, recorded or made here, or none any more."""
        self._version = -1
        self._seen.pop("diagnosis", None)
        if self.isVisible() and self._state is self.controller.state:
            self._draw()

    def _beside_changed(self) -> None:
        self.seen = self.seen.but(beside=besides(self.controller.beside))
        if self._state is not None or self.seen.beside:
            self._layers.setCurrentIndex(1)
        self._draw_all()

    def _segment_chosen(self) -> None:
        self.seen = self.seen.but(segment=self.chooser.segment)
        self.nyquist.whole()
        self._draw_all()

    def _way_changed(self) -> None:
        self.seen = self.seen.but(way=self.response.way)
        self._draw_all()

    def _model_changed(self) -> None:
        self._want_curves(self._state)
        self.seen = self.seen.but(curve=self.model.curve, foreseen=self.foreseen.curve)
        self._mark_all()
        self.turns.go_on()

    def _tab_changed(self) -> None:
        self.turns.mark(self.tabs.currentWidget())
        self.turns.at_once()

    def _draw_all(self) -> None:
        self._mark_all()
        self.turns.at_once()

    def _mark_all(self) -> None:
        self.turns.mark(self.record, self.response, self.nyquist, self.quality, self.drift, self.samples)

    def _panes(self) -> list[QWidget]:
        return [self.record, self.response, self.tabs.currentWidget()]

    def _draw_pane(self, pane: QWidget) -> None:
        state = self._state
        limits = state.limits if state is not None else SweepSettings()
        if pane is self.response:
            self.response.show_seen(self.seen)
            said = ""
            if state is not None:
                aside, doubt = int(self.seen.points.aside.sum()), doubt_of(state, self._shown(state))
                said = said_of_fit(state, self.model, aside, doubt)
            self.response.model.setText(said)
            self.response.model.setToolTip(f"{said}\n{_BAND}")
        elif pane is self.record:
            self.record.show_seen(self.seen, limits)
        elif pane is self.step and state is not None:
            self.step.show_step(state)
        elif pane is self.nyquist:
            self.nyquist.show_seen(self.seen)
        elif pane is self.quality:
            self.quality.show_seen(self.seen, limits)
        elif pane is self.drift:
            self.drift.show_seen(self.seen, state.contents.sentinels if state is not None else ())
        elif pane is self.samples:
            self.samples.show_seen(self.seen, self.controller.session)

    def _shown(self, state: SessionState) -> ShownDiagnosis | None:
        """The diagnosis shown, where it is of this session."""
        shown = self.controller.rediagnosis.shown(state)
        return shown if shown is not None and shown.is_of(self.controller.session) else None

    def _back(self) -> None:
        self.walk(-1)

    def _on(self) -> None:
        self.walk(1)

    def _connect(self) -> None:
        self.controller.beside_changed.connect(self._beside_changed)
        self.controller.rediagnosis.changed.connect(self._rediagnosed)
        self.chooser.chosen.connect(self._segment_chosen)
        self.response.way_changed.connect(self._way_changed)
        self.response.others_unwanted.connect(self.controller.data_beside.take_away)
        self.record.stepped.connect(self.walk)
        for curve in (self.model, self.foreseen):
            curve.changed.connect(self._model_changed)
        self.response.segment_wanted.connect(self.chooser.choose)
        self.tabs.currentChanged.connect(self._tab_changed)
        for pane in (self.response, self.nyquist, self.quality, self.drift):
            pane.chosen.connect(self.choose)
        for key, slot in (("Left", self._back), ("Right", self._on)):
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            shortcut.activated.connect(slot)

    def _arrange(self) -> None:
        for pane, name, tip in (
            (self.step, "Step", "The step in progress: time signal, settling, drive and level"),
            (self.nyquist, "Nyquist", "Imaginary against real part"),
            (self.quality, "Quality", "Noise, distortion, level error and settling of every point"),
            (self.drift, "Drift", "The sentinel against its first time; temperature"),
            (self.samples, "Samples", "The samples the point looked at was read from"),
        ):
            self.tabs.setTabToolTip(self.tabs.addTab(pane, name), tip)
        self.tabs.setDocumentMode(True)
        top = QWidget()
        column = QVBoxLayout(top)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.chooser, 1)
        column.addWidget(self.follow)
        left = QSplitter(Qt.Orientation.Vertical)
        left.setMinimumWidth(self.fontMetrics().horizontalAdvance("0") * _LEFT_DIGITS)
        left.addWidget(top)
        left.addWidget(self.record)
        left.setSizes([_CHOOSER_PX, _RECORD_PX])
        across = QSplitter(Qt.Orientation.Horizontal)
        for widget, stretch in ((left, 0), (self.response, 4), (self.tabs, 3)):
            across.addWidget(widget)
            across.setStretchFactor(across.count() - 1, stretch)
        across.setSizes([_LEFT_PX, _MIDDLE_PX, _RIGHT_PX])
        inside = QVBoxLayout(self)
        inside.setContentsMargins(6, 0, 6, 0)
        self._layers = QStackedLayout()
        inside.addLayout(self._layers)
        none = hint(_NONE)
        none.setAlignment(Qt.AlignmentFlag.AlignCenter)
        none.setMargin(40)
        self._layers.addWidget(none)
        self._layers.addWidget(across)
