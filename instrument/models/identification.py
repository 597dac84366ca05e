"""Identify a core from a sweep: models, fit, validation and result in one go, each timed."""

from dataclasses import dataclass, replace
from time import perf_counter
from typing import Literal

from threadpoolctl import threadpool_limits

from fitting.data.aside import LOST, Reasons, reasons
from fitting.data.noise import noise_of
from fitting.data.strays import strays
from fitting.diagnosis.checks.stretches import words_of_stretches
from fitting.discrepancy.theory_error import TheoryError
from fitting.errors import OutsideModel
from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.result import Identification, summarise, sweep_range
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.models.files import File
from instrument.models.files_at_work import SetAside
from instrument.models.free_layers import remark_on_free_layers
from instrument.models.methods import (
    DirectMethod,
    IdentificationMethod,
    IdentificationProblem,
    Joint,
    PaperMethod,
)
from instrument.models.quick_look import remarks_on_reading
from instrument.models.remarks import remarks_on_law, remarks_on_noise, remarks_on_strays
from instrument.models.set_up import Hammer
from instrument.models.theory import stiffer_than_stated
from instrument.progress import Progress, quiet

Method = Literal["direct", "paper"]

_METHODS: dict[Method, type[IdentificationMethod]] = {"direct": DirectMethod, "paper": PaperMethod}
_MOST_WIDENINGS = 2
"""Of the reduced model's domain, whole decades each: a law that runs further off is no core's."""


@dataclass(frozen=True)
class Identified:
    """An identification and how long its parts took."""

    result: Identification
    files: tuple[File, ...]
    """What was given, with what it was measured on as stated."""
    sweep: Sweep
    """The points that were fitted, file after file."""
    given: Sweep
    """The same with what was set aside."""
    why_aside: Reasons
    """Of every reading given why it was set aside. Shape (points,)."""
    setup_seconds: float
    """Models made or loaded."""
    seconds: float
    """Seconds that the fit took."""
    validation_seconds: float
    theory: TheoryError | None = None
    """The layer-wise theory's error under the law found; None for the paper's method."""
    joint: Joint | None = None
    """What a second look at the same fit needs; None for the paper's method."""
    bare: BarePlateFit | None = None
    """What the hammer test gave; None without one."""
    aside: tuple[SetAside, ...] = ()
    """Stretches of files that take no part."""


def identify(
    sweep: Sweep,
    specimen: Specimen,
    method: Method = "direct",
    progress: Progress = quiet,
    hammer: Hammer | None = None,
    like: Specimen | None = None,
) -> Identified:
    """The core's law from a sweep, the specimen's own law as the start.

    The reduced model is certified where the fit ends; beyond that it is widened and the fit repeated. Raises
    `OutsideModel` where the layer-wise theory does not hold for the law found. `hammer` is the bare plate's
    test; `like` as `set_up` takes it, of the direct method.
    """
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
    further = remarks_on_strays(sweep)
    given, why_aside = sweep, reasons(strays(sweep) > 0, LOST)
    sweep = given.take(why_aside == "")
    f, law, noise = sweep.frequency_hz, specimen.core.law, noise_of(sweep)
    way = _METHODS[method](IdentificationProblem(sweep, specimen, noise, hammer, like), progress)
    further += (*remarks_on_law(law, f), *remarks_on_noise(sweep), *way.remarks())
    setup = seconds = 0.0
    for widened in range(_MOST_WIDENINGS + 1):
        began = perf_counter()
        models = way.set_up()
        ready = perf_counter()
        with threadpool_limits(1, "blas"), progress(f"fitting ({method})") as report:
            fit = way.fit(law.to_fit(f), report)
        setup, seconds = setup + ready - began, seconds + perf_counter() - ready
        if not models.uncertified(fit.law, f):
            break
        if widened == _MOST_WIDENINGS:
            further += (
                "the law found lies where the reduced model is not certified: take it as provisional",
            )
        way.widen(fit.law)
    further += (*way.remarks_on(fit), *words_of_stretches(sweep, way.parts()))
    theory = way.theory(fit)
    further += tuple(filter(None, [stiffer_than_stated(specimen, fit.law, f)]))
    began = perf_counter()
    with threadpool_limits(1, "blas"), progress("validating") as report:
        validation = way.validated(fit, report)
    result = summarise(method, sweep, noise, fit, validation, further)
    reading = remarks_on_reading(sweep, way.problem.specimen, result.rms_percent, progress)
    result = replace(result, warnings=(*reading, *result.warnings))
    if way.joint is not None:
        covariance, reach_hz = result.uncertainty.covariance, sweep_range(sweep)
        free = remark_on_free_layers([specimen], result.law, covariance, reach_hz, way.joint.quantities)
        result = replace(result, warnings=(*result.warnings, *free))
    took = perf_counter() - began
    files = (File(given, specimen, like=like),)
    return Identified(
        result, files, sweep, given, why_aside, setup, seconds, took, theory, way.joint, way.bare
    )
