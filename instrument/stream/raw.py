"""Raw events: what the runner did and what the instruments gave."""

from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict

from instrument.facts.follow_up import FollowUp, Support
from instrument.stream.event import Event, Positive
from instrument.stream.scaling import volts_of

Part = Literal["hammer", "calibration", "sweep", "struck"]
"""hammer: blows on the bare plate; struck: on the treated one."""
Purpose = Literal["loop-check", "calibration", "step", "sentinel"]


@dataclass(frozen=True)
class SessionBegan(Event):
    """A run, or its continuation after a break."""

    utc: str
    version: str
    instruments: dict[str, str]
    """Identity of each, as it states itself."""
    ranges: tuple[str, ...]
    """Of the vibrometer, from the most sensitive to the coarsest."""
    resumed: bool = False


@dataclass(frozen=True)
class AcquisitionBegan(Event):
    """Sampling began: the sample counter is zero."""

    number: int
    part: Part
    sample_rate_hz: Positive
    channels: tuple[str, ...]
    """What each measures: base, velocity, force, response, temperature."""


@dataclass(frozen=True)
class BlockAcquired(Event):
    """Samples in a row from every channel."""

    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(arbitrary_types_allowed=True)

    first_sample: int
    samples: int
    volts_per_count: tuple[float, ...]
    full_scale_v: tuple[float, ...]
    overload: tuple[bool, ...]
    cable_fault: tuple[bool, ...]
    counts: NDArray[np.int32] = field(
        default_factory=lambda: np.zeros((0, 0), dtype=np.int32), compare=False, repr=False
    )
    """Shape (channels, samples); kept beside the JSON."""

    def facts(self) -> dict[str, Any]:
        """All but the samples."""
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name != "counts"}

    @property
    def volts(self) -> NDArray[np.float64]:
        """Shape (channels, samples)."""
        return volts_of(self.counts, self.volts_per_count)


@dataclass(frozen=True)
class RangeSet(Event):
    """The vibrometer's range, as read back."""

    name: str
    scale_m_s_v: float
    full_scale_v: float
    highest_hz: float
    delay_s: float | None


@dataclass(frozen=True)
class SignalLevelRead(Event):
    """How much light came back to the vibrometer, 0 to 1."""

    value: float


@dataclass(frozen=True)
class SoakBegan(Event):
    """The chamber has its set point, and is waited for, the shaker silent."""

    set_point_c: float
    """As the chamber read it back."""
    within_c: float
    soak_s: float
    """To stay within, without a break."""
    most_s: float


@dataclass(frozen=True)
class TemperatureRead(Event):
    """Of the chamber or the thermometer: before every step, and again and again in a soak."""

    value_c: float
    set_point_c: float | None
    """As the chamber keeps it; None for a thermometer."""
    soak_s: float | None = None
    """Since the soak began; None outside of one."""


@dataclass(frozen=True)
class SoakEnded(Event):
    """The temperature stayed long enough."""

    seconds: float
    """Since the soak began."""


@dataclass(frozen=True)
class SegmentBegan(Event):
    """A resonance region begins."""

    segment: int
    sweep: int
    low_hz: float
    high_hz: float
    steps: int


@dataclass(frozen=True)
class StepBegan(Event):
    """One frequency begins."""

    step: int
    """Counts through the session."""
    purpose: Purpose
    segment: int
    sweep: int
    frequency_hz: Positive
    level_m_s2: float | None
    """Base acceleration asked for; None where the drive itself is (a loop check)."""
    drive_v: float
    """To begin with."""
    decay_1_s: float
    """Of the slowest transient expected here, by what is known of the plate at this moment."""


@dataclass(frozen=True)
class ShakerCommanded(Event):
    """A command and its receipt."""

    sequence: int
    frequency_hz: float
    drive_v: float
    """Accepted: the device's own limit may hold it below what was asked."""
    ramp_s: float
    sample: int | None
    """At which it took effect; None where the device does not know."""


@dataclass(frozen=True)
class Held(Event):
    """The run waits, the shaker silent; the step it was at begins again afterwards."""


@dataclass(frozen=True)
class SegmentEnded(Event):
    """All its steps are measured."""

    segment: int
    sweep: int


@dataclass(frozen=True)
class OperatorDid(Event):
    """Something only a person can do or decide."""

    what: Literal["mounted", "aimed", "changed", "accepted", "rejected", "undone"]
    detail: str
    """The plate mounted, the point aimed at, what was changed; empty for hits."""
    hit: int = 0


@dataclass(frozen=True)
class HammerTestEnded(Event):
    """Enough hits, or the operator says so."""


@dataclass(frozen=True)
class FitStarted(Event):
    """The live identification took up the points there were."""

    number: int
    last_step: int
    """Points of this and all earlier steps take part."""


@dataclass(frozen=True)
class FitFailed(Event):
    """The live identification broke off; the measurement goes on.

    Where the points as they are allow no fit, `FitUpdated` says so instead.
    """

    number: int
    """Of the fit that had started."""
    message: str
    """Why, in a line."""

    @property
    def words(self) -> str:
        """Which fit, and why, in a line."""
        return f"fit {self.number} failed: {self.message}"


@dataclass(frozen=True)
class ChoiceStarted(Event):
    """A sweep that chooses its own steps took up the points there were."""

    number: int
    last_step: int
    """Points of this and all earlier steps take part."""
    pending_hz: float | None
    """Measured meanwhile: it counts as taken. None where nothing is."""
    declined_hz: tuple[float, ...] = ()
    """Steps that a person would not have: they are not chosen again."""


@dataclass(frozen=True)
class StepDeclined(Event):
    """A person would not have this step; nothing of it is kept."""

    step: int
    segment: int
    sweep: int
    frequency_hz: float


@dataclass(frozen=True)
class PlanOverruled(Event):
    """A person's word to a sweep that chooses its own steps; it holds once this choice is there."""

    number: int
    """Number of the choice that it holds after."""
    what: Literal["add", "end"]
    """A step of their own before those chosen; or none any more."""
    frequency_hz: float | None = None
    """Frequency of the step that is added."""


@dataclass(frozen=True)
class DiagnosisStarted(Event):
    """The sweep is whole, and what its fit cannot explain is being traced."""

    number: int
    last_step: int
    """Points of this and all earlier steps take part."""


@dataclass(frozen=True)
class FollowUpProposed(Event):
    """A diagnosis ended in a group: what would tell its members apart, best first."""

    number: int
    """Of the measurement that is to follow."""
    diagnosis: int
    """Number of the diagnosis."""
    offers: tuple[FollowUp, ...]
    """Those that can be done in this run."""

    def facts(self) -> dict[str, Any]:
        """The offers as the diagnosis has them."""
        offers = [one.as_json() for one in self.offers]
        return {"number": self.number, "diagnosis": self.diagnosis, "offers": offers}


@dataclass(frozen=True)
class FollowUpDecided(Event):
    """Whether an offer is taken, and on whose word."""

    number: int
    offer: int
    """Which one, from 0."""
    agreed: bool
    by: Literal["experiment", "person"]


@dataclass(frozen=True)
class SpotMoved(Event):
    """The laser points at another spot: what follows is read there."""

    pickup: int
    """Its number; 0 is the specimen file's own."""
    spot_mm: tuple[float, float]
    """x from the clamp, y from a long edge."""


@dataclass(frozen=True)
class MassPut(Event):
    """A known mass was put on the plate, and nothing else is on it."""

    mass_kg: float
    at_mm: tuple[float, float]
    """x from the clamp, y from a long edge."""


@dataclass(frozen=True)
class ClampedAnew(Event):
    """The plate was taken out of its clamp and clamped again: its clamp is another one from here on."""

    mounting: int
    """Its number; 0 is the run's first."""


@dataclass(frozen=True)
class StrikingBegan(Event):
    """The treated plate is ready for blows: how it is held, where it is hit and where the laser reads."""

    held: Support
    struck_mm: tuple[float, float]
    """x from the clamp, of a plate hung free from the end that was clamped; y from a long edge."""
    spot_mm: tuple[float, float] | None
    """None: where the laser was."""
    size_mm: tuple[float, float]
    """Length and width: as it stands out of its clamp, or of all that hangs."""
    mounting: int = 0
    """How often the plate had been clamped anew."""


@dataclass(frozen=True)
class FollowUpEnded(Event):
    """All of it is measured."""

    number: int


Ending = Literal["done", "stopped by the user", "stopped safely", "stopped, shaker NOT known to be silent"]
"""How a run ended; safely: with the shaker silent."""


@dataclass(frozen=True)
class SessionEnded(Event):
    """The run is over, and why."""

    why: Ending
    message: str
