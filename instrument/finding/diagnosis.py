"""Diagnose files with their specimens: models made or loaded, then all of `fitting.diagnosis`, each timed."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from threadpoolctl import threadpool_limits

from fitting.diagnosis.diagnose import DiagnosisOptions, diagnose_problem
from fitting.diagnosis.verdict.result import Diagnosis
from fitting.effects import Effect
from fitting.errors import OutsideModel
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.finding.effect_names import effects_among
from instrument.finding.files_at_work import SetAside
from instrument.finding.files_diagnosis import FilesDiagnosis
from instrument.finding.plate_diagnosis import PlateDiagnosis
from instrument.models.files import File, lone_plate
from instrument.models.set_up import Hammer
from instrument.processes.other_processes import executor
from instrument.progress import Progress, quiet
from instrument.remarks.theory import check_each_theory


@dataclass(frozen=True)
class Diagnosed:
    """A diagnosis and how long its parts took."""

    result: Diagnosis
    files: tuple[File, ...]
    """What was given, with what it was measured on as stated."""
    sweep: Sweep
    """All points given, file after file."""
    setup_seconds: float
    """Models made or loaded."""
    seconds: float
    """Everything else."""
    effects: tuple[Effect, ...] = ()
    """What was looked for; empty where effects were accepted by hand."""
    aside: tuple[SetAside, ...] = ()
    """Stretches of files that take no part."""


def diagnose(
    files: Sequence[File],
    hammer: Hammer | None = None,
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
    accept: Sequence[str] | None = None,
    resamples: int | None = None,
) -> Diagnosed:
    """What one law cannot explain, traced to an effect of all files or of one.

    `hammer` is the test of the bare plate that all files are of; names in `without` are not considered.
    Where `accept` is given its effects are fitted on the user's word, and nothing is searched for; empty
    declines them all. Of one plate read at one spot the search is repeated on `resamples` sweeps without
    effects, by default where points are few.

    Raises `BadInput`, `FittingError`; `OutsideModel` also where the layer-wise theory does not hold for the
    law it ends with.
    """
    specimens = [file.specimen for file in files]
    kinds = {specimen.kind for specimen in specimens}
    if len(kinds) > 1:
        raise OutsideModel(
            f"{' and '.join(sorted(kinds))} together, expected specimens of one kind to diagnose"
        )
    standing = effects_among(specimens, without, accept)
    if resamples and accept is not None:
        raise BadInput("resamples with accepted effects: no search to repeat, expected one of them")
    plate = lone_plate(files)
    if resamples is not None and plate is None:
        raise BadInput("resamples: expected one sweep of a plate at one spot")
    began = perf_counter()
    way: PlateDiagnosis | FilesDiagnosis
    if plate is not None:
        way = PlateDiagnosis(files[0], plate, [e for e, _ in standing], hammer, resamples)
    else:
        way = FilesDiagnosis(files, standing, hammer, progress, searches=accept is None)
    with threadpool_limits(1, "blas"), executor() as workers:
        way.set_up(progress)
        ready = perf_counter()
        with progress("tracing the residual") as report:
            result = way.traced(diagnose_problem, DiagnosisOptions(report, workers, accept))
    theory = check_each_theory(specimens, result.after.law, [file.sweep.frequency_hz for file in files])
    result = replace(result, warnings=(*result.warnings, *way.remarks(result, theory)))
    asked = tuple(way.effects) if accept is None else ()
    seconds = perf_counter() - ready
    return Diagnosed(result, tuple(files), way.given, ready - began, seconds, asked, tuple(way.aside))
