"""Identify a core from a sweep: models, fit, validation and result in one go, each timed."""

from dataclasses import dataclass, replace
from time import perf_counter
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.errors import OutsideModel
from fitting.identification import direct, paper
from fitting.identification.fit import Fit
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.identification.result import Identification, differences_percent, summarise
from fitting.identification.systematic import Systematic, systematic_of
from fitting.identification.validation import Mask, Validation, validate
from fitting.laws import CoreLaw
from fitting.noise import Noise, noise_of
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.models import Models
from instrument.progress import Progress, Report, quiet

Array = NDArray[np.float64]
Method = Literal["direct", "paper"]

_MOST_WIDENINGS = 2


@dataclass(frozen=True)
class Identified:
    """An identification and how long its parts took."""

    result: Identification
    setup_seconds: float
    """Models made or loaded."""
    seconds: float
    """The fit."""
    validation_seconds: float


def identify(
    sweep: Sweep, specimen: Specimen, method: Method = "direct", progress: Progress = quiet
) -> Identified:
    """The core's law from a sweep, the specimen's own law as the start.

    The reduced model is certified where the fit ends; beyond that it is widened and the fit repeated.
    """
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
    start, noise = specimen.core.law, noise_of(sweep)
    models = Models.of(specimen, sweep.frequency_hz, progress)
    setup = seconds = 0.0
    further: tuple[str, ...] = ()
    if method == "paper" and specimen.tolerances:
        further = ("the paper's method leaves the stated tolerances out of its band",)
    for widened in range(_MOST_WIDENINGS + 1):
        began = perf_counter()
        task = _Direct(sweep, noise, models) if method == "direct" else _Paper(sweep, models)
        ready = perf_counter()
        with threadpool_limits(1, "blas"), progress(f"fitting ({method})") as report:
            fit = task.fit(start, report)
        setup, seconds = setup + ready - began, seconds + perf_counter() - ready
        if not models.uncertified(fit.law, sweep.frequency_hz):
            break
        if widened == _MOST_WIDENINGS:
            further += (
                "the law found lies where the reduced model is not certified: take it as provisional",
            )
        models = replace(models, domain=models.domain.widened(fit.law, sweep.frequency_hz))
    began = perf_counter()
    with threadpool_limits(1, "blas"), progress("validating") as report:
        validation = _validate(sweep, noise, task, fit, report)
    result = summarise(method, sweep, noise, fit, validation, task.systematic(fit.law), further)
    return Identified(result, setup, seconds, perf_counter() - began)


class _Direct:
    def __init__(self, sweep: Sweep, noise: Noise, models: Models) -> None:
        rational = models.rational(np.unique(sweep.omega))
        model = SweepModel.of(sweep, rational, models.specimen.reads)
        self.residuals = Residuals.of(sweep, noise, model)
        self._sweep, self._models = sweep, models
        self.uses_phase = sweep.has_phase

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        return direct.fit_direct(self.residuals, start)

    def systematic(self, law: CoreLaw) -> Systematic:
        return systematic_of(
            self.residuals, self._sweep.segment, self._models.reduced, self._models.specimen, law
        )

    def learnt(self, law: CoreLaw, points: Mask) -> CoreLaw:
        return direct.refit(self.residuals.take(points), law)

    def velocity(self, law: CoreLaw) -> NDArray[np.complex128]:
        return self.residuals.model.velocity(law)


class _Paper:
    uses_phase = False

    def __init__(self, sweep: Sweep, models: Models) -> None:
        self.problem = paper.PaperProblem.of(sweep, models.real_modes, models.specimen.reads)

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        return paper.fit_paper(self.problem, start, lambda step: report(step / paper.MOST_STEPS))

    def systematic(self, law: CoreLaw) -> None:
        """None stated: the real modes' own error is larger than any of these, and not estimated."""

    def learnt(self, law: CoreLaw, points: Mask) -> CoreLaw:
        return paper.refit(self.problem.take(points), law)

    def velocity(self, law: CoreLaw) -> NDArray[np.complex128]:
        return self.problem.velocity([law])[0]


def _validate(sweep: Sweep, noise: Noise, task: _Direct | _Paper, fit: Fit, report: Report) -> Validation:
    size = np.abs(sweep.response_m_s)
    return validate(
        segment=sweep.segment,
        points_needed=-(-len(fit.law.names) // (2 if task.uses_phase else 1)),
        differences_percent=lambda points: differences_percent(
            sweep, task.velocity(task.learnt(fit.law, points))
        ),
        progress=report,
        noise_percent=100 * noise.std_m_s / size if noise.is_known else np.full(len(sweep), np.nan),
    )
