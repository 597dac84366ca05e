"""Diagnose a sweep: models made or loaded, then everything in `fitting.diagnosis`, timed."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.bare_modes import Sensor
from fitting.diagnosis.diagnose import diagnose_task, seen_in_channels
from fitting.diagnosis.evidence import BareModes
from fitting.diagnosis.result import Diagnosis
from fitting.diagnosis.task import Task
from fitting.effects import CATALOGUE, SPANS
from fitting.effects.full_plate import FullPlate
from fitting.effects.spanned import SpannedPlate, span_plate
from fitting.errors import OutsideModel
from fitting.identification.bare_plate import CLAMP, MatchedModes, match_modes
from fitting.rational import RationalSweep, rational_sweep
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.cache import cached
from instrument.errors import BadInput
from instrument.models import Models
from instrument.progress import Progress, quiet
from instrument.second_process import hands

Array = NDArray[np.float64]
Hammer = tuple[Array, Array] | tuple[Array, Array, Sensor | None]

_USUAL_RATIO = 2e-3
_USUAL_MODES = 12


@dataclass(frozen=True)
class Diagnosed:
    """A diagnosis and how long its parts took."""

    result: Diagnosis
    setup_seconds: float
    """Models made or loaded."""
    seconds: float
    """Everything else."""


def diagnose(
    sweep: Sweep,
    specimen: Specimen,
    hammer: Hammer | None = None,
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
    accept: Sequence[str] | None = None,
) -> Diagnosed:
    """What the specimen's law cannot explain, traced to an effect. Raises `BadInput`, `FittingError`.

    `hammer` is the bare plate's test as `fit_bare_plate` takes it; names in `without` are not considered.
    Where `accept` is given its effects are fitted on the user's word, and nothing is searched for; empty
    declines them all.
    """
    unknown = sorted({*without, *(accept or ())} - set(CATALOGUE))
    if unknown:
        raise BadInput(f"effect {unknown[0]!r}, expected one of {', '.join(sorted(CATALOGUE))}")
    both = sorted(set(without) & set(accept or ()))
    if both:
        raise BadInput(f"effect {both[0]!r} both accepted and left out, expected one of them")
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to diagnose, expected [core] and [constraining]")
    start = specimen.core.law
    began = perf_counter()
    with threadpool_limits(1, "blas"), hands() as workers:
        modes = match_modes(specimen, *hammer) if hammer is not None else None
        if modes is not None:
            specimen = replace(specimen, modal_ratios=modes.ratios)
        effects = [e for name, e in CATALOGUE.items() if name not in without]
        used, channels, noise = seen_in_channels(sweep, effects)
        task, reduced = set_up(sweep.take(used), specimen, progress)
        ready = perf_counter()
        bare = _bare(modes) if modes is not None else None
        with progress("tracing the residual") as report:
            result = diagnose_task(
                task, reduced, effects, noise, bare, start, channels, used, report, accept, workers
            )
    return Diagnosed(result, ready - began, perf_counter() - ready)


def set_up(sweep: Sweep, specimen: Specimen, progress: Progress = quiet) -> tuple[Task, ReducedPlate]:
    """Models for a sweep. They are kept for all damping ratios: those are put in afterwards."""
    usual = replace(specimen, modal_ratios=(_USUAL_RATIO,) * max(_USUAL_MODES, len(specimen.modal_ratios)))
    models = Models.of(usual, sweep.frequency_hz, progress)
    factor = np.zeros(len(usual.modal_ratios))
    factor[: len(specimen.modal_ratios)] = np.array(specimen.modal_ratios) / _USUAL_RATIO
    reduced, spanned = models.reduced, _spanned(models)
    # Only modes even in y are in the reduced plate; which they are is read off the frequencies.
    reduced = replace(reduced, d=reduced.d * _factors(reduced.d, spanned.d, factor))
    spanned = replace(spanned, d=spanned.d * factor)

    def rational(omega: Array) -> RationalSweep:
        with progress("preparing the frequency grid") as report:
            return rational_sweep(reduced, omega, report)

    return Task.of(sweep, specimen, spanned, rational), reduced


def _factors(some: Array, every: Array, factor: Array) -> Array:
    return np.array([factor[np.argmin(np.abs(every - d))] for d in some])


def _spanned(models: Models) -> SpannedPlate:
    reduced = models.reduced

    def build() -> SpannedPlate:
        full = FullPlate(models.plate, models.damping)
        with models.progress("spanning what effects change") as report:
            return span_plate(full, models.plate.even @ reduced.V, SPANS, report)

    return cached("spanned", [models.without_law, models.domain], SpannedPlate, build)


def _bare(modes: MatchedModes) -> BareModes:
    return BareModes(modes.shift, modes.softness, modes.scatter, modes.air, CLAMP)
