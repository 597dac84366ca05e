"""What a diagnosis does with files under one law: any structure, one file or several."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fitting.diagnosis.diagnose import ChannelsSeen, DiagnosisOptions, Trace, seen_in_channels
from fitting.diagnosis.several.effect_among_files import among
from fitting.diagnosis.several.joining import joined
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.diagnosis.verdict.confounded import last_word
from fitting.diagnosis.verdict.result import Diagnosis, FoundEffect, ParameterEstimate
from fitting.effects import Effect
from fitting.errors import OutsideModel
from instrument.finding.exchanged import exchanged
from instrument.finding.files_at_work import FilesAtWork, SetAside
from instrument.finding.transfer import with_transfer
from instrument.models.files import File, mounted, numbers_of, one_plate
from instrument.models.set_up import Hammer
from instrument.progress import Progress
from instrument.remarks.common_cause import remarks_on_common_causes
from instrument.remarks.file_remarks import remarks_on_files, remarks_on_one_specimen

Standing = tuple[Effect, tuple[bool, ...]]
"""An effect, and in which files it has a meaning."""


class FilesDiagnosis:
    """Files of specimens of one kind; `searches`: nothing was accepted by hand."""

    def __init__(
        self,
        files: Sequence[File],
        standing: Sequence[Standing],
        hammer: Hammer | None,
        progress: Progress,
        *,
        searches: bool,
    ) -> None:
        self._files, self._standing, self._searches = files, standing, searches
        self.given = joined([f.sweep for f in files])
        self.effects = _tried(files, standing)
        self._work = FilesAtWork(files, progress, with_effects=True, hammer=hammer)

    @property
    def aside(self) -> Sequence[SetAside]:
        """Stretches that take no part."""
        return self._work.aside

    def set_up(self, progress: Progress) -> None:
        """See what the channels of each file show, and make or load the models for the rest."""
        self._channels: list[FoundEffect] = []
        numbers = numbers_of(self._files)
        for k, file in enumerate(self._files):
            why, seen, _ = seen_in_channels(file.sweep, [e for e, on in self._standing if on[k]])
            self._work.leave_out(k, why)
            self._channels += [
                _of_spot(_with_file(one, numbers[k], max(numbers)), file.pickup) for one in seen
            ]
        self._work.problem()

    def traced(self, trace: Trace, options: DiagnosisOptions) -> Diagnosis:
        """Hand on what `trace` asks for. Raises `OutsideModel` where files and specimens were exchanged."""
        files, work = self._files, self._work
        if self._searches and (other := exchanged(files)) is not None:
            raise OutsideModel(other.words)
        work.set_disturbances_aside()
        fixtures = [_fixture(one, max(numbers_of(files))) for one in work.aside]
        problem, noise = work.problem()
        case = DiagnosisCase(problem, self.effects, noise, work.start, bare=work.bare)
        seen = ChannelsSeen((*self._channels, *fixtures), np.concatenate(work.why_aside))
        settle = last_word({f.specimen.kind for f in files})
        result = trace(case, seen, replace(options, settle=settle))
        if "fixture_transfer" in {e.name for e, _ in self._standing} and result.verdict == "unknown":
            return with_transfer(result, work)
        return result

    def remarks(self, result: Diagnosis, theory: Sequence[str]) -> tuple[str, ...]:
        """On what is stated and read, and on the theory; `theory` is what is said of the law it ends with."""
        return (
            *remarks_on_one_specimen(self._files, result.before.rms_percent),
            *remarks_on_files(self._files),
            *remarks_on_common_causes(result, max(numbers_of(self._files))),
            *theory,
            *(one.words(self._files) for one in self.aside),
        )


def _tried(files: Sequence[File], standing: Sequence[Standing]) -> list[Effect]:
    """The effects as they may stand in these files: in all of them, or in one."""
    if len(files) == 1:
        return [e for e, _ in standing]
    count, same = max(numbers_of(files)), one_plate(files)
    spots = sorted({f.pickup for f in files if f.pickup is not None})
    return [
        e if e.replaces_law else among(e, count, spots, one_plate=same, mounted=mounted(files, on))
        for e, on in standing
    ]


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
