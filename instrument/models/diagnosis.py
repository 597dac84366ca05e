"""Diagnose a sweep: models made or loaded, then everything in `fitting.diagnosis`, timed."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from threadpoolctl import threadpool_limits

from fitting.data.aside import Reasons
from fitting.diagnosis.diagnose import diagnose_problem, seen_in_channels
from fitting.diagnosis.verdict.result import Diagnosis
from fitting.effects import Effect
from fitting.errors import OutsideModel
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.models.clamp_remarks import remarks_on_clamps
from instrument.models.effect_names import effects_on
from instrument.models.files import File
from instrument.models.files_at_work import SetAside
from instrument.models.other_processes import executor
from instrument.models.remarks import (
    remarks_on_damping,
    remarks_on_law,
    remarks_on_noise,
    remarks_on_patches,
    remarks_on_tolerances,
)
from instrument.models.set_up import Hammer, set_up
from instrument.models.theory import stiffer_than_stated, theory_over, theory_remark
from instrument.progress import Progress, quiet


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
    sweep: Sweep,
    specimen: Specimen,
    hammer: Hammer | None = None,
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
    accept: Sequence[str] | None = None,
    like: Specimen | None = None,
    resamples: int | None = None,
) -> Diagnosed:
    """What the specimen's law cannot explain, traced to an effect. Raises `BadInput`, `FittingError`.

    `OutsideModel` also where the layer-wise theory does not hold for the law it ends with.

    `hammer` is the bare plate's test as `fit_bare_plate` takes it; names in `without` are not considered.
    Where `accept` is given its effects are fitted on the user's word, and nothing is searched for; empty
    declines them all. `like` as `set_up` takes it. The search is repeated on
    `resamples` sweeps without effects, by default where points are few.
    """
    effects = effects_on(specimen, without, accept)
    both = sorted(set(without) & set(accept or ()))
    if both:
        raise BadInput(f"effect {both[0]!r} both accepted and left out, expected one of them")
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to diagnose, expected [core] and [constraining]")
    start = specimen.core.law
    began = perf_counter()
    with threadpool_limits(1, "blas"), executor() as workers:
        why_aside, channels, noise = seen_in_channels(sweep, effects)
        ready_made = set_up(sweep.take(why_aside == ""), specimen, hammer, progress, like=like)
        ready = perf_counter()
        with progress("tracing the residual") as report:
            result = diagnose_problem(
                ready_made.problem,
                reduced=ready_made.reduced,
                effects=effects,
                noise=noise,
                bare=ready_made.bare,
                start=start,
                channels=channels,
                why_aside=why_aside,
                report=report,
                accepted_by_hand=accept,
                executor=workers,
                remade=ready_made.remade,
                resamples=resamples,
            )
    seconds = perf_counter() - ready
    theory_over(specimen, result.after.law, sweep.frequency_hz)
    further = _remarks(sweep, why_aside, specimen, result, tested=hammer is not None)
    result = replace(result, warnings=(*result.warnings, *further))
    files, looked_for = (File(sweep, specimen, like=like),), () if accept is not None else tuple(effects)
    return Diagnosed(result, files, sweep, ready - began, seconds, looked_for)


def _remarks(
    sweep: Sweep, why_aside: Reasons, specimen: Specimen, result: Diagnosis, *, tested: bool
) -> tuple[str, ...]:
    """What is to be said beside the diagnosis; `tested` says whether there was a hammer test."""
    assert specimen.core is not None
    f = sweep.frequency_hz
    said = (
        *remarks_on_law(specimen.core.law, f),
        *remarks_on_noise(sweep.take(why_aside == "")),
        *remarks_on_tolerances(specimen),
        *remarks_on_patches(specimen),
        *remarks_on_clamps(specimen),
        *remarks_on_damping(specimen, tested=tested),
    )
    said += tuple(filter(None, [stiffer_than_stated(specimen, result.after.law, f)]))
    before = theory_remark(specimen, result.before.law, f)
    if before:
        said += (f"before, without any effect, the law is outside the theory: {before}",)
    return said
