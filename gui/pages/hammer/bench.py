"""Computes what hits give, off the main thread; only what was asked for last is told."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from fitting.specimen import PlateSpecimen
from gui.background.task import BackgroundTask, Progress
from gui.pages.hammer.findings import Averaged, Hits, Sight, modes_of
from gui.pages.hammer.records_beside import frfs_of_records
from instrument.hammer_test.expected import expected_modes_hz
from instrument.impact.record import Hit
from instrument.session.configuration import Configuration
from instrument.session.setup import hammer_settings

Function = Callable[[Progress], Any]


class Latest(QObject):
    """Does one thing at a time, and always the last one wanted; of others nothing is told.

    Signals
    -------
    done, failed
        A result; one line.
    """

    done = Signal(object)
    failed = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._wanted: Function | None = None
        self._work: BackgroundTask[Any] | None = None

    @property
    def busy(self) -> bool:
        """Whether a result is still to come."""
        return self._wanted is not None or (self._work is not None and not self._work.unwanted)

    def want(self, function: Function) -> None:
        """Returns at once."""
        self.forget()
        self._wanted = function
        if self._work is None:
            self._next()

    def forget(self) -> None:
        """Nothing is wanted any more."""
        self._wanted = None
        if self._work is not None:
            self._work.cancel()

    def _next(self) -> None:
        if self._wanted is None:
            return
        work, self._wanted = BackgroundTask[Any](self._wanted, self), None
        self._work = work
        work.done.connect(self._has_done)
        work.failed.connect(self._has_failed)
        work.cancelled.connect(self._is_over)
        work.start()

    def _has_done(self, result: object) -> None:
        self._is_over()
        self.done.emit(result)

    def _has_failed(self, said: str) -> None:
        self._is_over()
        self.failed.emit(said)

    def _is_over(self) -> None:
        if self._work is not None:
            self._work.deleteLater()
            self._work = None
        self._next()


class Bench(QObject):
    """Hits in; their average, its modes and the modes expected out.

    Signals
    -------
    averaged
        An `Averaged`; its `Modes` follow.
    modes_found
        A `Modes`.
    expected
        Of the bare plate: frequencies in Hz.
    laid
        FRFs of other files' records, by what they are drawn as.
    failed
        One line.
    not_laid
        One line: of other files' records.
    """

    averaged = Signal(object)
    modes_found = Signal(object)
    expected = Signal(object)
    laid = Signal(object)
    failed = Signal(str)
    not_laid = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._sight = Sight()
        self._band_hz: tuple[float, float] | None = None
        self._averaging, self._finding, self._expecting = Latest(self), Latest(self), Latest(self)
        self._averaging.done.connect(self._is_averaged)
        self._finding.done.connect(self.modes_found)
        self._expecting.done.connect(self.expected)
        for latest in (self._averaging, self._finding, self._expecting):
            latest.failed.connect(self.failed)
        self._laying = Latest(self)
        self._laying.done.connect(self.laid)
        self._laying.failed.connect(self.not_laid)

    @property
    def busy(self) -> bool:
        """Whether an average or its modes are still to come."""
        return self._averaging.busy or self._finding.busy

    def look_at(self, hits: Hits, band_hz: tuple[float, float] | None) -> None:
        """Returns at once; what was asked for before is no longer wanted. Without a band no modes follow."""
        self._finding.forget()
        self._band_hz = band_hz
        sight = self._sight
        self._averaging.want(lambda progress: sight.average(hits, lambda: progress(0.0)))

    def expect(self, configuration: Configuration, below_hz: float) -> None:
        """The modes of the bare plate as its specimen file has them."""
        self._expecting.want(lambda progress: _expected(configuration, below_hz))

    def lay_beside(self, files: Mapping[Path, Sequence[Hit]]) -> None:
        """The FRFs of other files' records; nothing of those asked for before."""
        self._laying.want(lambda progress: frfs_of_records(files, lambda: progress(0.0)))

    def forget(self) -> None:
        """Nothing of the session's hits is wanted any more."""
        for latest in (self._averaging, self._finding, self._expecting):
            latest.forget()

    def _is_averaged(self, averaged: object) -> None:
        assert isinstance(averaged, Averaged)
        band = self._band_hz
        if band is not None:
            self._finding.want(lambda progress: modes_of(averaged, band, lambda: progress(0.5)))
        self.averaged.emit(averaged)


def _expected(configuration: Configuration, below_hz: float) -> Any:
    settings = hammer_settings(configuration)
    sensor = settings.sensor if settings is not None else None
    plate = configuration.the_specimen()
    # A hammer test is of a plate alone.
    assert isinstance(plate, PlateSpecimen)
    return expected_modes_hz(plate, sensor, below_hz)
