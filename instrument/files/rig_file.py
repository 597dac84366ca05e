"""RIG.toml: which instruments, where, and what hangs on which input.

A device's address is where it answers; "simulated" means the one stood up for the run as `[simulation]` says.
"""

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from drivers.shaker.register_map import DEFAULT
from instrument.files.toml import NotNegative, Number, Positive, Table
from instrument.stepped_sine.settings import Limits

SIMULATED = "simulated"
NOT_KEPT = "-"
"""Address of a simulated device in a session: it was another one each time."""
Input = Annotated[int, Field(ge=1, le=64)]


_LIMITS = Limits()


class Shaker(Table):
    """The shaker's controller or amplifier."""

    kind: Literal["modbus-tcp", "modbus-rtu"] = "modbus-tcp"
    address: str
    """host:port, or a serial port."""
    baud: Annotated[int, Field(gt=0)] = 115200
    unit: Annotated[int, Field(ge=0, le=255)] = 1
    registers: dict[str, Annotated[int, Field(ge=0, le=65535)]] = Field(default_factory=dict)
    """Addresses that differ from the documented map, by name."""
    heartbeat_timeout_s: Annotated[float, Field(ge=0.5, le=10)] = 2.0
    """Told to the device: without a beat for so long it goes silent. The run beats five times a second."""

    @model_validator(mode="after")
    def _reachable(self) -> "Shaker":
        DEFAULT.with_addresses(self.registers)
        if self.kind == "modbus-tcp" and self.address not in (SIMULATED, NOT_KEPT):
            host, _, port = self.address.rpartition(":")
            if not host or not port.isdecimal() or not 0 < int(port) < 65536:
                raise ValueError(f"address: {self.address!r}, expected host:port")
        return self


class Vibrometer(Table):
    """The laser vibrometer. Its samples come through the front-end."""

    kind: Literal["polytec"] = "polytec"
    address: str
    model: Literal["OFV-5000", "OFV-5000 VD-08", "PDV-100"] = "OFV-5000"
    baud: Annotated[int, Field(gt=0)] = 115200
    reads: Literal["absolute", "relative"] = "absolute"
    """A laser on a tripod reads absolute velocity; one that rides with the clamp, relative."""


class FrontEnd(Table):
    """The data acquisition."""

    kind: Literal["lan-xi", "ni-daqmx"] = "lan-xi"
    address: str
    """URL, or the name of the device."""
    sample_rate_hz: Annotated[float, Field(ge=100, le=1e6)] = 8192.0
    paced_by_reader: bool = False
    """Of a `viscorig simulate --virtual-time` alone: it makes samples as they are asked for."""


class Sensor(Table):
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

    @property
    def units_per_volt(self) -> float:
        """Signed."""
        return (-1000.0 if self.invert else 1000.0) / self.sensitivity_mv_per_unit


class Response(Sensor):
    """The hammer test's accelerometer."""

    mass_g: NotNegative = 0.0
    """A gram at the tip moves mode 1 by half a percent."""


class Channels(Table):
    """What is measured on which input."""

    base: Sensor
    velocity: Sensor
    force: Sensor | None = None
    response: Response | None = None
    temperature: Sensor | None = None

    @model_validator(mode="after")
    def _apart(self) -> "Channels":
        used: dict[int, str] = {}
        for name, sensor in self.named().items():
            if sensor.input in used:
                raise ValueError(f"input {sensor.input} is given to both {used[sensor.input]} and {name}")
            used[sensor.input] = name
        return self

    def named(self) -> dict[str, Sensor]:
        """Those there are, by name."""
        return {n: s for n in type(self).model_fields if (s := getattr(self, n)) is not None}


class RigLimits(Table):
    """What this rig can bear, whatever an experiment asks."""

    base_m_s2: Positive = _LIMITS.base_m_s2
    velocity_m_s: Positive = _LIMITS.velocity_m_s
    travel_mm: Positive = 1e3 * _LIMITS.travel_m
    drive_v: Positive = _LIMITS.drive_v


class Operator(Table):
    """Who mounts plates, aims the laser and swings the hammer."""

    kind: Literal["person", "simulated"] = "person"


class Simulation(Table):
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
    double_hit_every: Annotated[int, Field(ge=0)] = 4
    """Every so many hits one bounces; 0 for never."""
    log: str | None = None
    """Beside this file: the rig's own record of its shaker, JSON lines."""


class RigDocument(Table):
    """RIG.toml."""

    name: str = "rig"
    shaker: Shaker
    vibrometer: Vibrometer
    front_end: FrontEnd
    channels: Channels
    limits: RigLimits = RigLimits()
    operator: Operator = Operator()
    simulation: Simulation | None = None

    @model_validator(mode="after")
    def _whole(self) -> "RigDocument":
        given = [d.address == SIMULATED for d in (self.shaker, self.vibrometer, self.front_end)]
        if any(given) and not all(given):
            raise ValueError('address = "simulated" is for all three devices or none: they share one plate')
        if any(given) and self.simulation is None:
            raise ValueError('address = "simulated" needs a [simulation] table, it may be empty')
        return self

    @property
    def is_simulated(self) -> bool:
        """Whether the devices are stood up for the run."""
        return self.shaker.address == SIMULATED

    def anywhere(self) -> "RigDocument":
        """The same rig wherever its instruments answer: to compare two."""
        devices = {"shaker": self.shaker, "vibrometer": self.vibrometer, "front_end": self.front_end}
        kept = {name: device.model_copy(update={"address": NOT_KEPT}) for name, device in devices.items()}
        return self.model_copy(update={**kept, "simulation": None})

    def without_simulation(self) -> "RigDocument":
        """What may be kept with a session: not what the simulated rig hides."""
        return self.anywhere() if self.is_simulated else self.model_copy(update={"simulation": None})
