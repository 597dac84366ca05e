"""What a diagnosis does with one plate read at one spot."""

from collections.abc import Sequence
from dataclasses import replace

from fitting.diagnosis.diagnose import ChannelsSeen, DiagnosisOptions, Trace, seen_in_channels
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.diagnosis.verdict.result import Diagnosis
from fitting.effects import Effect
from fitting.errors import OutsideModel
from fitting.specimen import PlateSpecimen
from instrument.finding.files_at_work import SetAside
from instrument.models.files import File
from instrument.models.set_up import Hammer, set_up
from instrument.progress import Progress
from instrument.remarks.as_given import (
    remarks_on_damping,
    remarks_on_law,
    remarks_on_noise,
    remarks_on_patches,
    remarks_on_tolerances,
)
from instrument.remarks.clamp_remarks import remarks_on_clamps
from instrument.remarks.theory import theory_remark


class PlateDiagnosis:
    """One sweep of a plate. Raises `OutsideModel` for a bare one."""

    aside: Sequence[SetAside] = ()
    """Of shear pairs alone."""

    def __init__(
        self,
        file: File,
        plate: PlateSpecimen,
        effects: Sequence[Effect],
        hammer: Hammer | None,
        resamples: int | None,
    ) -> None:
        if plate.core is None:
            raise OutsideModel("a bare plate has no core to diagnose, expected [core] and [constraining]")
        self.given, self.effects = file.sweep, effects
        self._plate, self._start, self._like = plate, plate.core.law, file.like
        self._hammer, self._resamples = hammer, resamples

    def set_up(self, progress: Progress) -> None:
        """See what the channels show, and make or load the models for the rest."""
        self._why_aside, self._channels, self._noise = seen_in_channels(self.given, self.effects)
        self._used = self.given.take(self._why_aside == "")
        self._ready = set_up(self._used, self._plate, self._hammer, progress, like=self._like)

    def traced(self, trace: Trace, options: DiagnosisOptions) -> Diagnosis:
        """Hand on what `trace` asks for."""
        ready = self._ready
        case = DiagnosisCase(
            ready.problem,
            self.effects,
            self._noise,
            self._start,
            bare=ready.bare,
            reduced=ready.reduced,
            remade=ready.remade,
        )
        seen = ChannelsSeen(self._channels, self._why_aside)
        return trace(case, seen, replace(options, resamples=self._resamples))

    def remarks(self, result: Diagnosis, theory: Sequence[str]) -> tuple[str, ...]:
        """On what is stated and read, and on the theory; `theory` is what is said of the law it ends with."""
        plate, f = self._plate, self.given.frequency_hz
        before = theory_remark(plate, result.before.law, f)
        return (
            *remarks_on_law(self._start, f),
            *remarks_on_noise(self._used),
            *remarks_on_tolerances(plate),
            *remarks_on_patches(plate),
            *remarks_on_clamps(plate),
            *remarks_on_damping(plate, tested=self._hammer is not None),
            *theory,
            *([f"before, without any effect, the law is outside the theory: {before}"] if before else []),
        )
