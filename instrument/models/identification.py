"""Identify a core from a sweep: models, fit, validation and result in one go, each timed."""

from dataclasses import dataclass, replace
from time import perf_counter
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Mask
from fitting.aside import LOST, Reasons, reasons
from fitting.diagnosis.begin import Begun, begin
from fitting.diagnosis.freer_law import loosened
from fitting.diagnosis.joint import fit_of
from fitting.diagnosis.overstated_noise import with_own_noise
from fitting.diagnosis.prediction import held_out
from fitting.diagnosis.stretches import parts_held_out, words_of_stretches
from fitting.digits import written_out
from fitting.errors import OutsideModel
from fitting.identification import paper
from fitting.identification.bare_plate import BarePlateFit, fit_bare_plate, with_bare_plate
from fitting.identification.fit import Fit
from fitting.identification.result import LOST_PERCENT, Identification, differences_percent, summarise
from fitting.identification.validation import Validation, rms, validate
from fitting.laws import CoreLaw
from fitting.noise import Noise, noise_of
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen
from fitting.strays import strays
from fitting.sweep import Sweep
from fitting.theory_error import TheoryError
from instrument.models.clamp_remarks import remarks_on_clamps
from instrument.models.quick_look import remarks_on_reading
from instrument.models.remarks import (
    remarks_on_bend,
    remarks_on_damping,
    remarks_on_law,
    remarks_on_noise,
    remarks_on_patches,
    remarks_on_strays,
    remarks_on_tolerances,
)
from instrument.models.set_up import Hammer, SetUp, set_up
from instrument.models.specimen_models import Models
from instrument.models.theory import theory_over
from instrument.progress import Progress, Report, quiet

Method = Literal["direct", "paper"]

_MOST_WIDENINGS = 2
"""Of the reduced model's domain, whole decades each: a law that runs further off is no core's."""


@dataclass(frozen=True)
class Joint:
    """The joint fit itself and the plate it was made with."""

    begun: Begun
    reduced: ReducedPlate | None
    """As stated; None where several were fitted together."""


@dataclass(frozen=True)
class Identified:
    """An identification and how long its parts took."""

    result: Identification
    sweep: Sweep
    """What was fitted."""
    given: Sweep
    """The same with what was set aside."""
    why_aside: Reasons
    """Of every reading given why it was set aside. Shape (points,)."""
    setup_seconds: float
    """Models made or loaded."""
    seconds: float
    """The fit."""
    validation_seconds: float
    theory: TheoryError | None = None
    """The layer-wise theory's error under the law found; None for the paper's method."""
    joint: Joint | None = None
    """What a second look at the same fit needs; None for the paper's method."""
    bare: BarePlateFit | None = None
    """What the hammer test gave; None without one."""


def identify(
    sweep: Sweep,
    specimen: Specimen,
    method: Method = "direct",
    progress: Progress = quiet,
    hammer: Hammer | None = None,
    like: Specimen | None = None,
) -> Identified:
    """The core's law from a sweep, the specimen's own law as the start.

    Directly: law, stated numbers within their tolerances, model error and the bare plate's `hammer` test in
    one posterior. The reduced model is certified where the fit ends; beyond that it is widened and the fit
    repeated. Raises `OutsideModel` where the layer-wise theory does not hold for the law found. `like` as
    `set_up` takes it, of the direct method.
    """
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
    further = remarks_on_strays(sweep)
    given, why_aside = sweep, reasons(strays(sweep) > 0, LOST)
    sweep = given.take(why_aside == "")
    stated, noise = specimen.core.law, noise_of(sweep)
    start = stated.to_fit(sweep.frequency_hz)
    bare = fit_bare_plate(specimen, *hammer) if hammer is not None else None
    if method == "paper" and bare is not None:
        specimen = with_bare_plate(specimen, bare)
    models: Models | None = Models.of(specimen, sweep.frequency_hz, progress) if method == "paper" else None
    setup = seconds = 0.0
    further += (*remarks_on_law(stated, sweep.frequency_hz), *remarks_on_noise(sweep))
    if method == "direct":
        further += (
            *remarks_on_tolerances(specimen),
            *remarks_on_patches(specimen),
            *remarks_on_clamps(specimen),
        )
        further += remarks_on_damping(specimen, tested=hammer is not None)
    elif not specimen.exact:
        further += ("the paper's method takes what is stated for exact: tolerances are not in its band",)
    for widened in range(_MOST_WIDENINGS + 1):
        began = perf_counter()
        if method == "paper":
            assert models is not None
            problem: _Direct | _Paper = _Paper(sweep, models)
        else:
            ready_made = set_up(
                sweep, specimen, hammer, progress, with_effects=False, models=models, like=like
            )
            models, problem = ready_made.models, _Direct(ready_made, noise)
        ready = perf_counter()
        with threadpool_limits(1, "blas"), progress(f"fitting ({method})") as report:
            fit = problem.fit(start, report)
        setup, seconds = setup + ready - began, seconds + perf_counter() - ready
        if not models.uncertified(fit.law, sweep.frequency_hz):
            break
        if widened == _MOST_WIDENINGS:
            further += (
                "the law found lies where the reduced model is not certified: take it as provisional",
            )
        models = replace(models, domain=models.domain.widened(fit.law, sweep.frequency_hz))
    if problem.joint is not None:
        further += remarks_on_bend(fit.law, problem.joint.begun.problem.freedom)
    further += words_of_stretches(sweep, problem.parts())
    theory = _checked(specimen, sweep, fit) if method == "direct" else None
    began = perf_counter()
    with threadpool_limits(1, "blas"), progress("validating") as report:
        validation = problem.validated(sweep, noise, fit, report)
    result = summarise(method, sweep, noise, fit, validation, further)
    reading = remarks_on_reading(sweep, specimen, result.rms_percent, progress)
    result = replace(result, warnings=(*reading, *result.warnings))
    return Identified(
        result,
        sweep,
        given,
        why_aside,
        setup,
        seconds,
        perf_counter() - began,
        theory,
        problem.joint,
        bare,
    )


def _checked(specimen: Specimen, sweep: Sweep, fit: Fit) -> TheoryError:
    """Raises `OutsideModel`; where the fit is lost besides, the line says so."""
    try:
        return theory_over(specimen, fit.law, sweep.frequency_hz)
    except OutsideModel as error:
        off = rms(differences_percent(sweep, fit.velocity_m_s))
        if off < LOST_PERCENT:
            raise
        raise OutsideModel(
            f"{error}; nor does the fit follow the data (rms {written_out(off, 3)} %): check units, level "
            "and pickup"
        ) from None


class _Direct:
    def __init__(self, ready: SetUp, noise: Noise) -> None:
        self._ready, self._noise = ready, noise
        self._begun: Begun | None = None

    @property
    def joint(self) -> Joint | None:
        return Joint(self._begun, self._ready.reduced) if self._begun is not None else None

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        begun = begin(self._ready.problem, self._ready.reduced, self._noise, self._ready.bare, start)
        self._begun = loosened(with_own_noise(begun, self._noise))
        return fit_of(self._begun)

    def validated(self, sweep: Sweep, noise: Noise, fit: Fit, report: Report) -> Validation:
        assert self._begun is not None
        return held_out(self._begun.problem, self._begun.evidence, self._begun.none, self.parts())

    def parts(self) -> NDArray[np.intp]:
        """What is held out, after the fit. Shape (points,)."""
        assert self._begun is not None
        return parts_held_out(self._begun.problem, self._begun.none.law)


class _Paper:
    joint: Joint | None = None

    def __init__(self, sweep: Sweep, models: Models) -> None:
        self._segment = sweep.segment
        self.problem = paper.PaperProblem.of(sweep, models.real_modes, models.specimen.reads)

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        return paper.fit_paper(self.problem, start, lambda step: report(step / paper.MOST_STEPS))

    def learnt(self, law: CoreLaw, points: Mask) -> CoreLaw:
        return paper.refit(self.problem.take(points), law)

    def velocity(self, law: CoreLaw) -> NDArray[np.complex128]:
        return self.problem.velocity([law])[0]

    def parts(self) -> NDArray[np.intp]:
        """Segments alone. Shape (points,)."""
        return self._segment

    def validated(self, sweep: Sweep, noise: Noise, fit: Fit, report: Report) -> Validation:
        size = np.abs(sweep.response_m_s)
        return validate(
            segment=self.parts(),
            points_needed=len(fit.law.names),
            differences_percent=lambda points: differences_percent(
                sweep, self.velocity(self.learnt(fit.law, points))
            ),
            progress=report,
            noise_percent=100 * noise.std_m_s / size if noise.is_known else np.full(len(sweep), np.nan),
        )
