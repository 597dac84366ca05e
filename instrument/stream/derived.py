"""Derived events: what follows from the raw ones. Computed live, recorded, and computed again on replay."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from instrument.facts.damping import DampingResult
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import Support
from instrument.facts.identification import IdentificationResult
from instrument.facts.result import Result
from instrument.stream.event import Derived, Positive

_DRIVE_LIMITED = "drive held at its limit"
"""How the remark begins that the control of the level makes; `tests/` hold both together."""
_KEY = "facts_json"
"""Of a result in a line."""


class _OrNothing:
    """Annotates a result that may lack: a line has an object without keys then."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        empty = core_schema.typed_dict_schema({}, extra_behavior="forbid")
        nothing = core_schema.no_info_after_validator_function(lambda _: None, empty)
        return core_schema.union_schema([handler(source), nothing], mode="left_to_right")


@dataclass(frozen=True)
class DriveRequested(Derived):
    """The level at the base wants another drive."""

    step: int
    drive_v: float
    why: str


@dataclass(frozen=True)
class RangeRequested(Derived):
    """The vibrometer's range does not fit; the step begins again with this one."""

    step: int
    name: str
    why: str


@dataclass(frozen=True)
class LoopChecked(Derived):
    """A small drive gave a clean answer at the base."""

    step: int
    frequency_hz: float
    gain_m_s2_v: float
    """Base acceleration per volt of drive."""
    signal_over_noise: float


@dataclass(frozen=True)
class StepSettled(Derived):
    """What is left of the transient is below the tolerance."""

    step: int
    sample: int
    seconds: float
    """Since the last command took effect."""
    remaining_percent: float
    predicted_seconds: float


@dataclass(frozen=True)
class SettlingTimedOut(Derived):
    """The response did not come to rest in time; the point is measured and marked."""

    step: int
    seconds: float
    remaining_percent: float
    limit_percent: float


@dataclass(frozen=True)
class PointMeasured(Derived):
    """One frequency measured. Phasors of e^{+i omega t}, zero to peak, time from the acquisition's start."""

    step: int
    purpose: str
    segment: int
    sweep: int
    frequency_hz: Positive
    level_m_s2: float
    sample: int
    """First of the dwell."""
    dwell_s: float
    settle_s: float
    drive_v: float
    base_accel_re_m_s2: float
    base_accel_im_m_s2: float
    base_accel_std_m_s2: float
    """Standard deviation of each part of the base acceleration."""
    velocity_re_m_s: float
    """As the laser sees it, gain and delay of the calibration taken off."""
    velocity_im_m_s: float
    velocity_std_m_s: float
    control_error_percent: float
    base_distortion_percent: float
    velocity_distortion_percent: float
    range_name: str
    signal_level: float | None
    temperature_c: float | None
    remarks: tuple[str, ...]
    """What speaks against the point; empty for a good one."""
    pickup: int = 0
    """Which spot it was read at: 0 is the specimen file's own."""
    spot_mm: tuple[float, float] | None = None
    """Of another one: x from the clamp, y from a long edge."""
    mass_kg: float = 0.0
    """Known, put on the plate for this point."""
    mass_at_mm: tuple[float, float] | None = None
    """Where it lies; None where there is none."""
    mounting: int = 0
    """How often the plate had been clamped anew."""

    @property
    def drive_limited(self) -> bool:
        """Whether the drive's limit kept the base from its level."""
        return any(r.startswith(_DRIVE_LIMITED) for r in self.remarks)

    @property
    def level_reached_m_s2(self) -> float:
        """The level; what the base did, where the drive's limit kept it from that."""
        return abs(self.base_m_s2) if self.drive_limited else self.level_m_s2

    @property
    def base_m_s2(self) -> complex:
        """Base acceleration."""
        return complex(self.base_accel_re_m_s2, self.base_accel_im_m_s2)

    @property
    def velocity_m_s(self) -> complex:
        """Velocity at the pickup."""
        return complex(self.velocity_re_m_s, self.velocity_im_m_s)


def _place(frequency_hz: float, step: int) -> str:
    if frequency_hz:
        return f"at {frequency_hz:g} Hz"
    return f"step {step}" if step else ""


@dataclass(frozen=True)
class LimitWarned(Derived):
    """A quantity comes near its limit."""

    step: int
    what: str
    value: float
    limit: float
    unit: str
    frequency_hz: float = 0.0
    """Of the step; 0 where there is none, or an older version recorded it."""

    @property
    def place(self) -> str:
        """Where people find it: steps count loop checks and calibration too, which nobody planned."""
        return _place(self.frequency_hz, self.step)


@dataclass(frozen=True)
class LimitExceeded(Derived):
    """A quantity is beyond its limit: the run stops."""

    step: int
    what: str
    value: float
    limit: float
    unit: str
    remedy: str
    frequency_hz: float = 0.0
    """Frequency of the step, as in `LimitWarned`."""

    @property
    def place(self) -> str:
        """As of `LimitWarned`; empty where it is of no step."""
        return _place(self.frequency_hz, self.step)

    @property
    def message(self) -> str:
        """One line for people."""
        value = f"{self.value:.4g} {self.unit}".strip()
        where = f"{self.place}: " if self.place else ""
        limit = f"{self.limit:.4g} {self.unit}".strip()
        return f"{where}{self.what} {value}, limit {limit}: {self.remedy}"


@dataclass(frozen=True)
class CalibrationFound(Derived):
    """The vibrometer against the accelerometer on one point, in one range."""

    range_name: str
    gain: float
    """Reading over true velocity."""
    delay_s: float
    gain_std: float
    delay_std_s: float
    points: int
    utc: str = ""
    """Of the run it was made in."""


@dataclass(frozen=True)
class SentinelCompared(Derived):
    """The sentinel frequency again: how far the response moved since the first time."""

    step: int
    frequency_hz: float
    change_percent: float
    change_degree: float


@dataclass(frozen=True)
class HitJudged(Derived):
    """A blow was caught and looked at."""

    hit: int
    first_sample: int
    samples: int
    peak_n: float
    accepted: bool
    why: str


@dataclass(frozen=True)
class HitRevised(Derived):
    """A hit's standing after the operator's word."""

    hit: int
    accepted: bool


@dataclass(frozen=True)
class DampingFound(Derived):
    """Natural frequencies and ratios of the accepted hits: the result of `viscorig damping`."""

    result: Annotated[DampingResult, Field(validation_alias=_KEY)]

    def facts(self) -> dict[str, Any]:
        """The result under the key it has in every line."""
        return {_KEY: self.result.as_json()}


@dataclass(frozen=True)
class StruckFound(Derived):
    """What the blows on the treated plate give: its mobility, velocity at a spot over force at a point."""

    held: Support
    struck_mm: tuple[float, float]
    spot_mm: tuple[float, float] | None
    """None: the specimen file's own."""
    size_mm: tuple[float, float]
    """Length and width: as it stands out of its clamp, or of all that hangs."""
    mounting: int
    """How often the plate had been clamped anew."""
    hits: int
    """Good ones, averaged."""
    frequency_hz: tuple[float, ...]
    """Lines of the spectrum about the plate's resonances."""
    segment: tuple[int, ...]
    """Which resonance each is about."""
    mobility_re_m_s_n: tuple[float, ...]
    mobility_im_m_s_n: tuple[float, ...]
    mobility_std_m_s_n: tuple[float, ...]
    """Of each part of the mean, as the blows scatter."""
    remarks: tuple[str, ...] = ()

    def added_to(self, known: Sequence["StruckFound"]) -> list["StruckFound"]:
        """After what is known; of the same place and mounting in its stead: that was broken off."""

        def place(one: StruckFound) -> tuple[object, ...]:
            return one.held, one.struck_mm, one.spot_mm, one.mounting

        return [*(one for one in known if place(one) != place(self)), self]


@dataclass(frozen=True)
class StepsChosen(Derived):
    """What an adaptive sweep measures next, and why: by the points, the specimen and the choice before."""

    number: int
    last_step: int
    frequencies_hz: tuple[float, ...]
    """In this order; none where the sweep ends, or where the step being measured may be the last."""
    segments: tuple[int, ...]
    """Resonance region of each."""
    teaches: str
    """`coarse`, `law`, `causes`; empty where nothing is chosen."""
    ended: bool
    why: str
    """For people."""
    worst_percent: float | None
    """Largest relative standard error of G' and eta in the band, the step being measured counted in."""
    limit_percent: float | None
    """What would be left of it though every candidate were measured."""
    law: tuple[float, ...] = ()
    """Logarithms of the law's parameters and bend, as these points have them; empty before any."""
    stated: tuple[float, ...] = ()
    """The stated numbers, in standard deviations of their tolerances."""
    grid_law: tuple[float, ...] = ()
    """The law that the next choice's candidates are laid out for."""
    grid_stated: tuple[float, ...] = ()
    """The stated numbers that they are laid out for."""
    grid_hz: tuple[float, ...] = ()
    """Frequencies measured or chosen when they were laid out: they are among the candidates."""
    causes_s: float = 0.0
    """Rig time chosen so far for steps that separate causes."""


@dataclass(frozen=True)
class FitUpdated(Derived):
    """The live identification's result: that of `viscorig identify` without its seconds."""

    number: int
    last_step: int
    result: Annotated[IdentificationResult | None, _OrNothing(), Field(validation_alias=_KEY)]
    """None where no fit was possible; `message` says why."""
    message: str = ""

    def facts(self) -> dict[str, Any]:
        """The result under the key it has in every line."""
        return _with_result(self.number, self.last_step, self.result, self.message)


@dataclass(frozen=True)
class DiagnosisFound(Derived):
    """What the sweep's residual shows: the result of `viscorig diagnose` without its seconds."""

    number: int
    last_step: int
    result: Annotated[DiagnosisResult | None, _OrNothing(), Field(validation_alias=_KEY)]
    """None where no diagnosis was possible; `message` says why."""
    message: str = ""

    def facts(self) -> dict[str, Any]:
        """The result under the key it has in every line."""
        return _with_result(self.number, self.last_step, self.result, self.message)


def _with_result(number: int, last_step: int, result: Result | None, message: str) -> dict[str, Any]:
    found = result.as_json() if result is not None else {}
    return {"number": number, "last_step": last_step, _KEY: found, "message": message}
