"""The model's curves: `viscorig predict` in a process of its own, for the latest fit and before any."""

import json
from pathlib import Path

from PySide6.QtCore import QObject, QTemporaryDir, QTimer, Signal

from gui.background.one_command import OneCommand
from gui.pages.sweep.curve import Curve, grid, regions_of
from gui.state import SessionState
from instrument.check.piece import Region
from instrument.facts.prediction import PredictionResult
from instrument.interchange.specimen_toml import specimen_toml
from instrument.session.configuration import Configuration
from instrument.session.contents import Contents
from instrument.stream.derived import FitUpdated

_PAUSE_MS = 250
"""Somebody who drags through a recording passes many fits."""


class ResponseCurve(QObject):
    """One at a time; the last wish counts.

    Signals
    -------
    changed
        `curve` or `failure` has come.
    """

    changed = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.curve: Curve | None = None
        self.failure = ""
        self._regions: list[Region] = []
        self._contents: Contents | None = None
        self.command = OneCommand(self)
        """That of the curve being computed."""
        self.command.done.connect(self._done)
        self.command.failed.connect(self._failed)
        self._folder = QTemporaryDir()
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(_PAUSE_MS)
        self._soon.timeout.connect(self._start)

    @property
    def busy(self) -> bool:
        """Whether a curve is being computed."""
        return self.command.running or self._soon.isActive()

    def rest(self) -> None:
        """Compute nothing any more; wanted again, it is computed again."""
        self._soon.stop()
        if self.command.running:
            self.command.drop()
            self._forget()

    def _forget(self) -> None:
        self._regions = []

    def _ask(self, contents: Contents, regions: list[Region]) -> None:
        self._contents, self._regions, self.failure = contents, regions, ""
        self._soon.start()

    def _asked(self, contents: Contents, folder: Path) -> list[str]:
        """What `predict` is asked beside the frequencies."""
        specimen = folder / "specimen.toml"
        specimen.write_text(specimen_toml(contents), encoding="utf-8")
        # Whoever ran it has answered for what it states.
        return ["predict", str(specimen), "--force"]

    def _start(self) -> None:
        assert self._contents is not None
        frequencies = ",".join(repr(float(f)) for one in grid(self._regions) for f in one)
        asked = self._asked(self._contents, Path(self._folder.path()))
        self.command.start([*asked, "--frequencies", frequencies], PredictionResult)

    def _done(self, found: PredictionResult) -> None:
        assert self._contents is not None
        acceleration = self._contents.specimen.base_acceleration_m_s2
        self.curve = Curve.of(found, acceleration, self._regions)
        self.changed.emit()

    def _failed(self, why: str) -> None:
        self.failure = why
        self.changed.emit()


class ModelCurve(ResponseCurve):
    """The model's curve by the latest fit."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.fit: FitUpdated | None = None
        """The one the curve is of, or is being computed of."""

    def want(self, state: SessionState | None) -> None:
        """The curve of the session's latest fit, over the segments begun so far.

        Another fit's curve is gone at once; `changed` comes with the new one.
        """
        contents = state.contents if state is not None else None
        fit = contents.fit if contents is not None and contents.fit is not None else None
        if fit is not None and fit.result is None:
            fit = None
        regions = regions_of(contents.segments) if contents is not None else []
        if fit == self.fit and regions == self._regions:
            return
        if fit != self.fit:
            self.curve = None
        self.rest()
        self.fit, self._regions, self.failure = fit, regions, ""
        if fit is not None and regions and contents is not None:
            self._ask(contents, regions)

    def _forget(self) -> None:
        super()._forget()
        self.fit = None

    def _asked(self, contents: Contents, folder: Path) -> list[str]:
        assert self.fit is not None
        assert self.fit.result is not None
        fit = folder / "fit.json"
        fit.write_text(json.dumps(self.fit.result.as_json()), encoding="utf-8")
        asked = [*super()._asked(contents, folder), "--fit", str(fit)]
        damping = contents.damping
        if damping is not None and self.fit.result.hammer is not None:
            hammer = folder / "hammer.json"
            hammer.write_text(json.dumps(damping.result.as_json()), encoding="utf-8")
            asked += ["--hammer", str(hammer)]
        return asked


class ForeseenCurve(ResponseCurve):
    """Of the specimen as stated, with the law to start from: known before anything is measured."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._of: Configuration | None = None

    def want(self, state: SessionState | None) -> None:
        """Over every segment that is known of, begun or not."""
        configuration = state.configuration if state is not None else None
        regions = list(state.plan.regions) if state is not None else []
        if configuration is self._of and regions == self._regions:
            return
        if configuration is not self._of:
            self.curve = None
        self.rest()
        self._of, self._regions = configuration, regions
        if state is not None and regions:
            self._ask(state.contents, regions)

    def _forget(self) -> None:
        super()._forget()
        self._of = None
