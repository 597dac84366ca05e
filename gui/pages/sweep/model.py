"""The fitted model's curve: `viscorig predict --fit` in a process of its own, for the latest fit."""

import json
from pathlib import Path

from PySide6.QtCore import QObject, QTemporaryDir, QTimer, Signal

from gui.background_task import BackgroundCommand
from gui.pages.sweep.curve import Curve, Region, grid, regions_of
from gui.state import SessionState
from instrument.facts.prediction import PredictionResult
from instrument.interchange.specimen_toml import specimen_toml
from instrument.session.contents import Contents
from instrument.stream.derived import FitUpdated

_PAUSE_MS = 250
"""Somebody who drags through a recording passes many fits."""


class ModelCurve(QObject):
    """Of one fit at a time; the last wish counts.

    Signals
    -------
    changed
        `curve` or `failure` has come.
    """

    changed = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.curve: Curve | None = None
        self.fit: FitUpdated | None = None
        """The one the curve is of, or is being computed of."""
        self.failure = ""
        self._regions: list[Region] = []
        self._contents: Contents | None = None
        self._command: BackgroundCommand | None = None
        self._folder = QTemporaryDir()
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(_PAUSE_MS)
        self._soon.timeout.connect(self._start)

    @property
    def busy(self) -> bool:
        """Whether a curve is being computed."""
        return self._command is not None or self._soon.isActive()

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
        self.fit, self._regions, self._contents, self.failure = fit, regions, contents, ""
        if fit is not None and regions:
            self._soon.start()

    def rest(self) -> None:
        """Compute nothing any more."""
        self._soon.stop()
        if self._command is not None:
            self._command.close()
            self._command.deleteLater()
            self._command = None
            # Wanted again, it is computed again.
            self.fit, self._regions = None, []

    def _start(self) -> None:
        assert self.fit is not None
        assert self.fit.result is not None
        assert self._contents is not None
        folder = Path(self._folder.path())
        specimen, fit = folder / "specimen.toml", folder / "fit.json"
        specimen.write_text(specimen_toml(self._contents), encoding="utf-8")
        fit.write_text(json.dumps(self.fit.result.as_json()), encoding="utf-8")
        frequencies = ",".join(repr(float(f)) for one in grid(self._regions) for f in one)
        asked = ["predict", str(specimen), "--fit", str(fit), "--frequencies", frequencies]
        damping = self._contents.damping
        if damping is not None and self.fit.result.hammer is not None:
            hammer = folder / "hammer.json"
            hammer.write_text(json.dumps(damping.result.as_json()), encoding="utf-8")
            asked += ["--hammer", str(hammer)]
        self._command = BackgroundCommand(asked, PredictionResult, self)
        self._command.done.connect(self._done)
        self._command.failed.connect(self._failed)
        self._command.start()

    def _done(self, found: PredictionResult) -> None:
        assert self._contents is not None
        acceleration = self._contents.specimen.base_acceleration_m_s2
        self.curve = Curve.of(found, acceleration, self._regions)
        self._ended()

    def _failed(self, why: str) -> None:
        self.failure = why
        self._ended()

    def _ended(self) -> None:
        if self._command is not None:
            self._command.deleteLater()
            self._command = None
        self.changed.emit()
