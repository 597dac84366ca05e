"""RIG.toml: which instruments, where, and what hangs on which input.

A device's address is where it answers; "simulated" means the one stood up for the run as `[simulation]` says.
"""

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import Field, SerializeAsAny, model_validator

from drivers.chamber.driver import ChamberOptions
from drivers.front_end.driver import FrontEndOptions
from drivers.options import NOT_KEPT, SIMULATED, DeviceOptions
from drivers.shaker.driver import ShakerOptions
from drivers.vibrometer.driver import VibrometerOptions
from instrument.files.devices import by_kind
from instrument.files.toml import NotNegative, Number, Positive, TomlTable
from instrument.stepped_sine.settings import Limits

Input = Annotated[int, Field(ge=1, le=64)]


_LIMITS = Limits()

Shaker = Annotated[SerializeAsAny[ShakerOptions], by_kind("shaker")]
"""The shaker's table, as its driver has it."""
Vibrometer = Annotated[SerializeAsAny[VibrometerOptions], by_kind("vibrometer")]
"""The vibrometer's table, as its driver has it."""
FrontEnd = Annotated[SerializeAsAny[FrontEndOptions], by_kind("front_end")]
"""The front-end's table, as its driver has it."""
Chamber = Annotated[SerializeAsAny[ChamberOptions], by_kind("chamber")]
"""The chamber's table, as its driver has it."""


_FEBRUARY = 2


def year_after(day: date) -> date:
    """The day a year later; for the 29th of February the 28th."""
    return date(day.year + 1, day.month, min(day.day, 28) if day.month == _FEBRUARY else day.day)


class SensorSection(TomlTable):
    """What hangs on an input."""

    input: Input
    sensitivity_mv_per_unit: Annotated[float, Field(ge=1e-6, le=1e9)] = 1000.0
    """Per m/s^2, N or degree Celsius, as the channel's name says; the vibrometer's comes from its range."""
    range_v: Annotated[float, Field(ge=1e-3, le=1000)] = 10.0
    iepe: bool = False
    invert: bool = False
    """The sensor's positive direction is the other way."""
    serial: str = ""
    calibrated: date | None = None
    calibrated_until: date | None = None
    """Where it is not said, a year after `calibrated`."""

    @property
    def valid_until(self) -> date | None:
        """Last day of its calibration; None where nothing is said of one."""
        if self.calibrated_until is not None or self.calibrated is None:
            return self.calibrated_until
        return year_after(self.calibrated)

    @property
    def units_per_volt(self) -> float:
        """Signed."""
        return (-1000.0 if self.invert else 1000.0) / self.sensitivity_mv_per_unit


class ResponseSection(SensorSection):
    """The hammer test's accelerometer."""

    mass_g: NotNegative = 0.0
    """A gram at the tip moves mode 1 by half a percent."""


class Channels(TomlTable):
    """What is measured on which input."""

    base: SensorSection
    velocity: SensorSection
    force: SensorSection | None = None
    response: ResponseSection | None = None
    temperature: SensorSection | None = None

    @model_validator(mode="after")
    def _apart(self) -> "Channels":
        used: dict[int, str] = {}
        for name, sensor in self.named().items():
            if sensor.input in used:
                raise ValueError(f"input {sensor.input} is given to both {used[sensor.input]} and {name}")
            used[sensor.input] = name
        return self

    def named(self) -> dict[str, SensorSection]:
        """Sensors there are, by name."""
        return {n: s for n in type(self).model_fields if (s := getattr(self, n)) is not None}


class RigLimits(TomlTable):
    """What this rig can bear, whatever an experiment asks."""

    base_m_s2: Positive = _LIMITS.base_m_s2
    velocity_m_s: Positive = _LIMITS.velocity_m_s
    travel_mm: Positive = 1e3 * _LIMITS.travel_m
    drive_v: Positive = _LIMITS.drive_v


class OperatorSection(TomlTable):
    """Who mounts plates, aims the laser and swings the hammer."""

    kind: Literal["person", "simulated"] = "person"


class SimulatedChamberSection(TomlTable):
    """How fast the simulated chamber is. Both follow as first-order lags."""

    air_s: Positive = 120.0
    """Time constant of the air behind the set point."""
    plate_s: Positive = 300.0
    """Time constant of the plate behind the air."""


class SimulatedMemorySection(TomlTable):
    """What a sensor says of itself to the simulated front-end."""

    serial: str
    model: str = "SIM"
    sensitivity_mv_per_unit: Positive


class Simulation(TomlTable):
    """What the simulated rig is like, and what it hides. Never kept with a session."""

    seed: Annotated[int, Field(ge=0)] = 0
    noise: NotNegative = 1.0
    """Times the sensors' own noise; 0 for none."""
    hum_v: NotNegative = 0.0
    mains_hz: Positive = 50.0
    vibrometer_delay_s: Annotated[float, Field(ge=0, le=0.1)] = 1.1e-3
    skew_samples: Annotated[float, Field(ge=0, le=10)] = 0.5
    """Between neighbouring inputs."""
    signal_level: Annotated[float, Field(ge=0, le=1)] = 0.8
    effects: dict[str, dict[str, Number | str | list[Number]]] = Field(default_factory=dict)
    core: dict[str, Any] = Field(default_factory=dict)
    """g_inf_mpa, g_mpa, tau_s: another core than the standard one."""
    specimen: str | None = None
    """Beside this file: a specimen file with the beam or shear pair that stands on the simulated shaker."""
    chamber: SimulatedChamberSection = SimulatedChamberSection()
    double_hit_every: Annotated[int, Field(ge=0)] = 4
    """Every so many hits one bounces; 0 for never."""
    memory: dict[str, SimulatedMemorySection] = Field(default_factory=dict)
    """Sensors with a memory (TEDS), by the name of their channel."""
    log: str | None = None
    """Beside this file: the rig's own record of its shaker, JSON lines."""


class RigDocument(TomlTable):
    """RIG.toml."""

    name: str = "rig"
    shaker: Shaker
    vibrometer: Vibrometer
    front_end: FrontEnd
    chamber: Chamber | None = None
    channels: Channels
    sensors: str | None = None
    """A file of sensors, beside this one: a channel's `serial` is looked up there."""
    limits: RigLimits = RigLimits()
    operator: OperatorSection = OperatorSection()
    simulation: Simulation | None = None

    @model_validator(mode="after")
    def _whole(self) -> "RigDocument":
        given = [d.address == SIMULATED for d in self.devices().values()]
        if any(given) and not all(given):
            raise ValueError('address = "simulated" is for all devices or none: they share one plate')
        if any(given) and self.simulation is None:
            raise ValueError('address = "simulated" needs a [simulation] table, it may be empty')
        return self

    @property
    def is_simulated(self) -> bool:
        """Whether the devices are stood up for the run."""
        return self.shaker.address == SIMULATED

    def devices(self) -> dict[str, DeviceOptions]:
        """Devices there are, by the name of their table."""
        found = {"shaker": self.shaker, "vibrometer": self.vibrometer, "front_end": self.front_end}
        return found | ({"chamber": self.chamber} if self.chamber is not None else {})

    def anywhere(self) -> "RigDocument":
        """The rig without where its instruments answer: to compare two."""
        kept = {n: device.model_copy(update={"address": NOT_KEPT}) for n, device in self.devices().items()}
        return self.model_copy(update={**kept, "simulation": None})

    def without_simulation(self) -> "RigDocument":
        """What may be kept with a session: not what the simulated rig hides."""
        return self.anywhere() if self.is_simulated else self.model_copy(update={"simulation": None})
