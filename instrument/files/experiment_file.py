"""EXPERIMENT.toml: which plate on which rig, which hits and which frequencies.

What a sweep is measured with where the file is silent stands in `instrument/stepped_sine/settings.py`.
"""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from instrument.errors import BadInput
from instrument.files.file_kind import kind_of_file, refuse_another
from instrument.files.toml import (
    NotNegative,
    Positive,
    TomlTable,
    document_faults,
    read_document,
)
from instrument.stepped_sine.patience import LONGEST_S
from instrument.stepped_sine.settings import Dwell, LevelControl, Settle

Count = Annotated[int, Field(ge=1, le=1000)]
Frequency = Annotated[float, Field(ge=0.5, le=1e5)]
MOST_RECORD_S = 300
"""Of a hit: five minutes of samples, for the slowest of beams."""
_LEAST_RATIO = 1.05
"""Of the ends of a band."""
_CONTROL, _SETTLE, _DWELL = LevelControl(), Settle(), Dwell()


class Mounting(TomlTable):
    """How the plate is held: two mountings are two clamps."""

    bolts: Annotated[int, Field(ge=0, le=100)] = 0
    torque_n_m: NotNegative = 0.0
    remount: Annotated[int, Field(ge=0)] = 0
    """How often it was taken out and put back."""


class Hammer(TomlTable):
    """The bare plate's hammer test."""

    hits: Count = 5
    hit_x_mm: NotNegative
    hit_y_mm: NotNegative
    response_x_mm: NotNegative
    response_y_mm: NotNegative
    band_hz: Annotated[list[Positive], Field(min_length=2, max_length=2)] = Field(
        default_factory=lambda: [10.0, 550.0]
    )
    record_s: Annotated[float, Field(ge=0.1, le=MOST_RECORD_S)] | Literal["auto"] = "auto"
    """auto: until the slowest mode has decayed to 1 %, the one whose frequency times its stated damping ratio
    is least; 8 s where a plate states no ratio, 60 s at most."""
    pre_trigger_s: Annotated[float, Field(gt=0, le=0.1)] = 0.05
    wait_s: Annotated[float, Field(ge=1, le=3600)] = 60.0
    """For a hit, before the test gives up."""
    whole_length_mm: Positive | None = None
    """Of the treated plate, what its clamp grips included: with it a run may have the plate hung free and
    struck, to tell explanations apart."""

    @model_validator(mode="after")
    def _ordered(self) -> "Hammer":
        low, high = self.band_hz
        if low >= high:
            raise ValueError(f"band_hz = [{low:g}, {high:g}], expected the lower frequency first")
        return self


class SegmentSection(TomlTable):
    """A resonance region: from low to high, around a mode of the specimen as it is known, or step by step."""

    low_hz: Frequency | None = None
    high_hz: Frequency | None = None
    mode: Annotated[int, Field(ge=1, le=30)] | None = None
    span_percent: Annotated[float, Field(gt=0, le=100)] = 40.0
    """Of the mode's frequency, low to high."""
    points: Annotated[int, Field(ge=2, le=2000)] | None = None
    step_hz: Annotated[float, Field(ge=1e-3, le=1e4)] | None = None
    frequencies_hz: Annotated[list[Frequency], Field(min_length=1, max_length=2000)] | None = None
    """Of single steps, in this order."""
    range: str | None = None
    """Of the vibrometer; chosen from the predicted response where none is given."""

    @model_validator(mode="after")
    def _whole(self) -> "SegmentSection":
        if self.frequencies_hz is not None:
            return self._listed(self.frequencies_hz)
        by_edges = self.low_hz is not None and self.high_hz is not None
        if by_edges == (self.mode is not None) or (self.low_hz is None) != (self.high_hz is None):
            raise ValueError("expected either low_hz and high_hz, or mode, or frequencies_hz")
        if by_edges and not self.low_hz < self.high_hz:  # type: ignore[operator]
            raise ValueError(f"low_hz = {self.low_hz:g} is not below high_hz = {self.high_hz:g}")
        if (self.points is None) == (self.step_hz is None):
            raise ValueError("expected either points or step_hz")
        return self

    def _listed(self, frequencies_hz: list[float]) -> "SegmentSection":
        others = [
            n for n in ("low_hz", "high_hz", "mode", "points", "step_hz") if getattr(self, n) is not None
        ]
        if others:
            raise ValueError(f"frequencies_hz and {others[0]}: expected one way to say which steps")
        twice = [f for f in frequencies_hz if frequencies_hz.count(f) > 1]
        if twice:
            raise ValueError(f"frequencies_hz has {twice[0]:g} twice, expected each once")
        return self


class ControlTable(TomlTable):
    """Level control."""

    tolerance_percent: Annotated[float, Field(gt=0, le=20)] = 100 * _CONTROL.tolerance
    abort_percent: Annotated[float, Field(gt=0, le=500)] = 100 * _CONTROL.abort
    ramp_s: Annotated[float, Field(ge=1e-3, le=10)] = _CONTROL.ramp_s


class SettleTable(TomlTable):
    """When a response counts as steady."""

    tolerance_percent: Annotated[float, Field(gt=0, le=20)] = 100 * _SETTLE.tolerance
    most_s: Annotated[float, Field(ge=0.1, le=LONGEST_S)] = _SETTLE.most_s


class DwellTable(TomlTable):
    """How long it is read then."""

    cycles: Annotated[float, Field(ge=1, le=1e4)] = _DWELL.cycles
    least_s: Annotated[float, Field(ge=0.01, le=300)] = _DWELL.least_s
    most_s: Annotated[float, Field(ge=0.05, le=300)] = _DWELL.most_s


class LimitsTable(TomlTable):
    """Limits of this experiment; the rig's own hold besides."""

    base_m_s2: Positive | None = None
    velocity_m_s: Positive | None = None
    travel_mm: Positive | None = None
    drive_v: Positive | None = None


class SentinelTable(TomlTable):
    """One frequency, measured again after every segment: it shows whether the plate drifts."""

    frequency_hz: Frequency | None = None
    """The first segment's middle where none is given."""


class CalibrationTable(TomlTable):
    """The vibrometer against the accelerometer, the laser on the base."""

    frequencies_hz: Annotated[list[Frequency], Field(min_length=3, max_length=100)] = Field(
        default_factory=lambda: [40.0, 80.0, 120.0, 160.0, 200.0, 240.0, 280.0]
    )
    level_g: Annotated[float, Field(ge=1e-4, le=1e3)] = 1.0


class AdaptiveTable(TomlTable):
    """When a sweep that chooses its own steps ends."""

    band_hz: Annotated[list[Frequency], Field(min_length=2, max_length=2)]
    """Where G' and the loss factor are to be known."""
    target_percent: Annotated[float, Field(ge=0.01, le=100)] = 2.0
    """Standard error of both, everywhere in the band."""
    causes_percent: Annotated[float, Field(ge=0, le=80)] = 25.0
    """Of rig time, for steps that separate what the model may lack."""
    most_s: Annotated[float, Field(ge=10, le=1e5)] = 1800.0
    """Of rig time, whatever is known by then."""

    @model_validator(mode="after")
    def _ordered(self) -> "AdaptiveTable":
        low, high = self.band_hz
        if low * _LEAST_RATIO > high:
            raise ValueError(f"band_hz = [{low:g}, {high:g}], expected low and high at least 5 % apart")
        return self


class SweepTable(TomlTable):
    """The stepped sine."""

    plan: Literal["fixed", "adaptive"] = "fixed"
    """fixed: the segments as they stand; adaptive: each step by what is known so far."""
    level_g: Annotated[float, Field(ge=1e-4, le=1e3)] = 1.0
    sweeps: Count = 1
    segments: Annotated[list[SegmentSection], Field(default_factory=list, max_length=100)]
    adaptive: AdaptiveTable | None = None
    control: ControlTable = ControlTable()
    settle: SettleTable = SettleTable()
    dwell: DwellTable = DwellTable()
    limits: LimitsTable = LimitsTable()
    sentinel: SentinelTable | None = SentinelTable()
    calibration: CalibrationTable | None = CalibrationTable()
    """Leave it out with `calibration = false` in favour of nothing measured in place."""

    @model_validator(mode="before")
    @classmethod
    def _switches(cls, given: Any) -> Any:
        """`sentinel = false` and `calibration = false` leave them out."""
        if not isinstance(given, dict):
            return given
        off = {k: None for k in ("sentinel", "calibration") if given.get(k) is False}
        return {**given, **off}

    @model_validator(mode="after")
    def _one_plan(self) -> "SweepTable":
        if self.plan == "fixed":
            if self.adaptive is not None:
                raise ValueError('adaptive: unknown beside plan = "fixed", expected plan = "adaptive"')
            if not self.segments:
                raise ValueError("segments: missing, expected at least one")
            return self
        if self.adaptive is None:
            raise ValueError('plan = "adaptive": expected [sweep.adaptive] with band_hz')
        if self.segments or self.sweeps != 1:
            raise ValueError('plan = "adaptive" chooses its own steps, expected neither segments nor sweeps')
        return self


class TemperatureTable(TomlTable):
    """The chamber's set point for the sweep, and how long the plate soaks there first."""

    set_point_c: Annotated[float, Field(ge=-100, le=400)]
    within_c: Annotated[float, Field(ge=0.01, le=20)] = 0.5
    """So near counts as there."""
    soak_s: Annotated[float, Field(ge=0, le=1e5)] = 600.0
    """To stay there without a break: the plate follows the air more slowly than the chamber's thermometer."""
    most_s: Annotated[float, Field(gt=0, le=1e6)] = 7200.0
    """For all of it, before the run gives up."""

    @model_validator(mode="after")
    def _possible(self) -> "TemperatureTable":
        if self.soak_s >= self.most_s:
            raise ValueError(f"soak_s = {self.soak_s:g} is not below most_s = {self.most_s:g}")
        return self


class DiagnosisTable(TomlTable):
    """What a run does where its diagnosis ends in a group of explanations."""

    follow_up: Literal["none", "offer", "do"] = "none"
    """none: it says what would tell them apart; offer: a person is asked, then it is measured; do: what the
    rig can do alone is measured at once, a person is asked for the rest."""
    follow_up_at_most: Annotated[int, Field(ge=1, le=10)] = 2
    """Measurements, one after the other, each followed by a diagnosis of everything."""
    follow_up_most_s: Annotated[float, Field(ge=10, le=1e5)] = 1800.0
    """For all of them, hands included."""


class ExperimentDocument(TomlTable):
    """EXPERIMENT.toml. Paths are relative to it."""

    title: str = ""
    operator: str = ""
    specimen: str
    rig: str
    mounting: Mounting = Mounting()
    hammer: Hammer | None = None
    temperature: TemperatureTable | None = None
    sweep: SweepTable | None = None
    diagnosis: DiagnosisTable = DiagnosisTable()

    @property
    def whole_length_m(self) -> float | None:
        """Of the treated plate, what its clamp grips included; None where it is not stated."""
        stated = self.hammer.whole_length_mm if self.hammer is not None else None
        return None if stated is None else 1e-3 * stated


def read_experiment(path: Path) -> ExperimentDocument:
    """Read and check an experiment. Raises `BadInput`."""
    _refuse_another(path)
    return read_document(path, ExperimentDocument)


def experiment_faults(path: Path) -> list[str]:
    """Everything wrong with it at once."""
    try:
        _refuse_another(path)
    except BadInput as error:
        return [str(error)]
    return document_faults(path, ExperimentDocument)


def _refuse_another(path: Path) -> None:
    """Raise `BadInput` for another file: it lacks all that an experiment has."""
    more = "; 'viscorig doctor' asks a rig's instruments" if kind_of_file(path) == "a rig" else ""
    expected = "an experiment, which names its specimen and its rig (viscorig new experiment)"
    refuse_another(path, "an experiment", f"{expected}{more}")
