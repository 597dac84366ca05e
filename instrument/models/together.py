"""Files with their specimens under one law: any structure, one file or several; diagnosed."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.diagnosis.diagnose import diagnose_problem, seen_in_channels
from fitting.diagnosis.several.effect_among_files import among
from fitting.diagnosis.several.joining import joined
from fitting.diagnosis.verdict.confounded import last_word
from fitting.diagnosis.verdict.result import FoundEffect, ParameterEstimate
from fitting.effects import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from instrument.models.diagnosis import Diagnosed
from instrument.models.effect_names import effects_among
from instrument.models.exchanged import exchanged
from instrument.models.file_remarks import (
    remarks_on_files,
    remarks_on_one_specimen,
)
from instrument.models.files import File, mounted, numbers_of, one_plate
from instrument.models.files_at_work import FilesAtWork, SetAside
from instrument.models.other_processes import executor
from instrument.models.set_up import Hammer
from instrument.models.theory import check_each_theory
from instrument.models.transfer import with_transfer
from instrument.progress import Progress, quiet


def diagnose_together(
    files: Sequence[File],
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
    accept: Sequence[str] | None = None,
    hammer: Hammer | None = None,
) -> Diagnosed:
    """What one law cannot explain, traced to an effect of all files or of one.

    `hammer` is the test of the bare plate that all files are of. Raises as `identify_together`.
    """
    began = perf_counter()
    kinds = {f.specimen.kind for f in files}
    if len(kinds) > 1:
        raise OutsideModel(
            f"{' and '.join(sorted(kinds))} together, expected specimens of one kind to diagnose"
        )
    among_files = effects_among([f.specimen for f in files], without, accept)
    effects = [e for e, _ in among_files]
    work = FilesAtWork(files, progress, with_effects=True, hammer=hammer)
    with threadpool_limits(1, "blas"), executor() as workers:
        channels = _channels(files, among_files, work)
        work.problem()
        ready = perf_counter()
        with progress("tracing the residual") as report:
            if accept is None and (other := exchanged(files)) is not None:
                raise OutsideModel(other.words)
            work.set_disturbances_aside()
            channels += [_fixture(one, max(numbers_of(files))) for one in work.aside]
            problem, noise = work.problem()
            tried = _tried(files, among_files)
            result = diagnose_problem(
                problem,
                reduced=None,
                effects=tried,
                noise=noise,
                bare=work.bare,
                start=work.start,
                channels=tuple(channels),
                why_aside=np.concatenate(work.why_aside),
                report=report,
                accepted_by_hand=accept,
                executor=workers,
                settle=last_word(kinds),
            )
            if "fixture_transfer" in {e.name for e in effects} and result.verdict == "unknown":
                result = with_transfer(result, work)
    theory = _check_theories(files, result.after.law)
    same_one = remarks_on_one_specimen(files, result.before.rms_percent)
    further = (*same_one, *remarks_on_files(files), *theory, *(one.words(files) for one in work.aside))
    result = replace(result, warnings=(*result.warnings, *further))
    asked = tuple(tried) if accept is None else ()
    seconds = perf_counter() - ready
    whole = joined([f.sweep for f in files])
    return Diagnosed(result, tuple(files), whole, ready - began, seconds, asked, tuple(work.aside))


def _channels(
    files: Sequence[File], among_files: Sequence[tuple[Effect, tuple[bool, ...]]], work: FilesAtWork
) -> list[FoundEffect]:
    """What the channels of each file show; the readings that are lost by it are left out of the work."""
    found: list[FoundEffect] = []
    numbers = numbers_of(files)
    for k, file in enumerate(files):
        why, seen, _ = seen_in_channels(file.sweep, [e for e, on in among_files if on[k]])
        work.leave_out(k, why)
        found += [_of_spot(_with_file(one, numbers[k], max(numbers)), file.pickup) for one in seen]
    return found


def _tried(files: Sequence[File], among_files: Sequence[tuple[Effect, tuple[bool, ...]]]) -> list[Effect]:
    """The effects as they may stand in these files: in all of them, or in one."""
    if len(files) == 1:
        return [e for e, _ in among_files]
    count, same = max(numbers_of(files)), one_plate(files)
    spots = sorted({f.pickup for f in files if f.pickup is not None})
    return [
        e if e.replaces_law else among(e, count, spots, one_plate=same, mounted=mounted(files, on))
        for e, on in among_files
    ]


def _check_theories(files: Sequence[File], law: CoreLaw) -> tuple[str, ...]:
    return check_each_theory([f.specimen for f in files], law, [f.sweep.frequency_hz for f in files])


def _with_file(one: FoundEffect, file: int, files: int) -> FoundEffect:
    if files == 1:
        return one
    return replace(
        one, parameters={**one.parameters, "file": ParameterEstimate(float(file), float("nan"), "1")}
    )


def _of_spot(one: FoundEffect, spot: int | None) -> FoundEffect:
    if spot is None:
        return one
    return replace(
        one, parameters={**one.parameters, "pickup": ParameterEstimate(float(spot), float("nan"), "1")}
    )


def _fixture(one: SetAside, files: int) -> FoundEffect:
    """A stretch set aside, as what it probably is."""
    nan, g = float("nan"), one.glitch
    values = {
        "frequency": ParameterEstimate(float(np.sqrt(g.low_hz * g.high_hz)), nan, "Hz"),
        "from": ParameterEstimate(g.low_hz, nan, "Hz"),
        "to": ParameterEstimate(g.high_hz, nan, "Hz"),
        "size": ParameterEstimate(g.largest, nan, "1"),
    }
    return _with_file(FoundEffect("fixture_resonance", values), one.file, files)
