"""Identify a core from files with their specimens: fit, validation and result in one go, each timed."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from threadpoolctl import threadpool_limits

from fitting.data.aside import Reasons
from fitting.discrepancy.theory_error import TheoryError
from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.result import Identification, summarise, sweep_range
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.finding.files_at_work import SetAside
from instrument.finding.files_method import FilesMethod
from instrument.finding.methods import DirectMethod, IdentificationMethod, Joint, Method, PaperMethod
from instrument.mistakes.quick_look import remarks_on_reading
from instrument.models.files import File, lone_plate
from instrument.models.set_up import Hammer
from instrument.progress import Progress, quiet
from instrument.remarks.free_layers import remark_on_free_layers


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
    """The layer-wise theory's error under the law found, of one plate; None for the paper's method."""
    joint: Joint | None = None
    """What a second look at the same fit needs; None for the paper's method."""
    bare: BarePlateFit | None = None
    """What the hammer test gave; None without one."""
    aside: tuple[SetAside, ...] = ()
    """Stretches of files that take no part."""


def identify(
    files: Sequence[File],
    method: Method = "direct",
    progress: Progress = quiet,
    hammer: Hammer | None = None,
) -> Identified:
    """One law from all files, each with its own specimen and channels; the first one's law as the start.

    `hammer` is the test of the bare plate that all files are of. The paper's method is of one plate read at
    one spot: `BadInput` for others. Raises `OutsideModel` where the layer-wise theory does not hold for the
    law found, and `FittingError`.
    """
    way = _way(files, method, progress, hammer)
    fit = way.fitted()
    theory = way.theory(fit)
    began = perf_counter()
    with threadpool_limits(1, "blas"), progress("validating") as report:
        validation = way.validated(fit, report)
    result = summarise(method, way.sweep, way.noise, fit, validation, way.remarks(fit))
    reading = remarks_on_reading(*way.questioned, result.rms_percent, progress)
    warnings = (*reading, *way.doubts, *result.warnings)
    if way.joint is not None:
        stated, covariance = [file.specimen for file in files], result.uncertainty.covariance
        band_hz = sweep_range(way.sweep)
        warnings += remark_on_free_layers(stated, result.law, covariance, band_hz, way.joint.quantities)
    return Identified(
        replace(result, warnings=(*warnings, *way.remarks_on_rest(result))),
        tuple(files),
        way.sweep,
        way.given,
        way.why_aside,
        way.setup_seconds,
        way.seconds,
        perf_counter() - began,
        theory,
        way.joint,
        way.bare,
        tuple(way.aside),
    )


def _way(
    files: Sequence[File], method: Method, progress: Progress, hammer: Hammer | None
) -> IdentificationMethod:
    plate = lone_plate(files)
    if plate is not None:
        of_plate = DirectMethod if method == "direct" else PaperMethod
        return of_plate(files[0], plate, hammer, progress)
    if method == "paper":
        raise BadInput("method 'paper': expected one plate read at one spot")
    return FilesMethod(files, hammer, progress)
