"""One plate, one clock: what the shaker drives, and what the inputs of the front-end are given.

Sample time is the clock. While sampling it advances with the samples, by whoever asks for them; between
acquisitions it follows the wall in real time and stands still in virtual time.
"""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from drivers.arrays import Array
from drivers.errors import Refused
from drivers.front_end.lan_xi_documents import HEADROOM
from drivers.simulated.drive import DrivePiece
from drivers.simulated.lan_xi_measurement import Acquired
from drivers.simulated.mounted_plate import (
    CanBeChanged,
    CanBeHit,
    CanBePlaced,
    CanBeStruck,
    MountedPlate,
)
from drivers.simulated.sensors import Converted, Input, SimulatedSensor, hum

_UNATTENDED_S = 0.1
"""Nobody asking for samples for so long, a shaker on its way to rest goes there by itself."""
_TICK_S = 0.01
_NOTHING = SimulatedSensor("nothing", 0.0, 5e-6, 10.0)
"""An input with nothing on it."""


@dataclass(frozen=True)
class Wiring:
    """What is on the inputs, and how well."""

    inputs: dict[int, SimulatedSensor]
    """By number."""
    skew_samples: float = 0.0
    """By which each input is sampled before its left neighbour."""
    hum_v: float = 0.0
    mains_hz: float = 50.0
    seed: int = 0


@dataclass
class Laser:
    """The vibrometer's optics as the world sees them."""

    scale_m_s_v: float
    full_scale_v: float
    delay_s: float
    signal_level: float = 0.8
    aimed_at: str = "pickup"
    """Or base."""
    gain: float = 1.0
    rides_with_base: bool = False
    """Reads the plate against the base, instead of against the floor."""


@dataclass
class World:
    """Everything physical about the rig."""

    plates: dict[str, MountedPlate]
    """By name: damped, bare."""
    wiring: Wiring
    laser: Laser
    virtual: bool
    advance: Callable[[float], None] = field(default=lambda now_s: None)
    """Told how far time has come before samples are made: the shaker's ramps end then."""

    def __post_init__(self) -> None:
        self.lock = threading.RLock()
        self.mounted = "damped"
        self._time_s, self._wall = 0.0, time.monotonic()
        self._asked = time.monotonic()
        self._index, self._rate_hz, self._origin_s = 0, 0.0, 0.0
        self._inputs: list[tuple[int, Input]] = []
        self._backlog: list[Acquired] = []
        self._acquisitions = 0

    # The clock

    def clock(self) -> tuple[int, float]:
        """Index of the next sample, and sample time in s."""
        with self.lock:
            if not self._sampling and not self.virtual:
                now = time.monotonic()
                self._time_s, self._wall = self._time_s + now - self._wall, now
            return self._index, self._time_s

    def tick(self, ramping_to_rest: bool) -> None:
        """Called now and then: lets a shaker come to rest where nobody asks for samples any more."""
        with self.lock:
            if not self.virtual or not ramping_to_rest or time.monotonic() - self._asked < _UNATTENDED_S:
                return
            if self._sampling:
                self._backlog.append(self._make(round(_TICK_S * self._rate_hz)))
            else:
                self._time_s += _TICK_S
                self.advance(self._time_s)

    @property
    def _sampling(self) -> bool:
        return self._rate_hz > 0

    # What the front-end asks

    def start(self, channel_numbers: tuple[int, ...], full_scale_v: Array, sample_rate_hz: float) -> None:
        """Sampling begins."""
        with self.lock:
            self.clock()
            self._rate_hz, self._origin_s, self._index = sample_rate_hz, self._time_s, 0
            self._acquisitions += 1
            self._backlog = []
            nominal = full_scale_v / HEADROOM
            self._inputs = [
                (
                    n,
                    Input(
                        self._on(n), float(full), float(range_v), (self.wiring.seed, self._acquisitions, n)
                    ),
                )
                for n, full, range_v in zip(channel_numbers, full_scale_v, nominal, strict=True)
            ]

    def acquire(self, samples: int) -> Acquired:
        """The next samples of every input."""
        with self.lock:
            self._asked = time.monotonic()
            if not self._backlog:
                return self._make(samples)
            parts, self._backlog = self._backlog, []
            have = sum(p.counts.shape[1] for p in parts)
            if have < samples:
                parts.append(self._make(samples - have))
            whole = _joined(parts)
            if have > samples:
                self._backlog = [_part(whole, slice(samples, None))]
                whole = _part(whole, slice(0, samples))
            return whole

    def stop(self) -> None:
        """Sampling has ended."""
        with self.lock:
            self._rate_hz, self._wall = 0.0, time.monotonic()

    # What the shaker and the operator do

    def drive(self, piece: DrivePiece) -> None:
        """A new piece of the shaker's output."""
        for plate in self.plates.values():
            plate.drive(piece)

    def at_operator_channel(self, name: str, body: Any) -> None:
        """What only a person can do: mount, clamp, aim, load, strike, hit. Raises `Refused`, `KeyError`."""
        if name == "strike":
            # Not under the lock: a plate that nobody has hung yet is built first, which takes seconds.
            self._strike(body)
            return
        with self.lock:
            if name == "mount":
                self._mount(body["plate"])
                self._place(body)
            elif name == "aim":
                self.laser.aimed_at = self._aim(body["point"])
                self._look_at(body.get("at_m"))
            elif name == "load":
                self._load(float(body["mass_kg"]), _pair(body["at_m"]))
            elif name == "clamp":
                self._clamp()
            elif name == "hit":
                self._hit()
            else:
                known = "mount, clamp, aim, load, strike or hit"
                raise Refused(f"no {name!r} in the operator channel, expected {known}")

    def _aim(self, point: str) -> str:
        if point not in ("base", "pickup"):
            raise Refused(f"no point {point!r} to aim at, expected base or pickup")
        return point

    @property
    def _plate(self) -> MountedPlate:
        return self.plates[self.mounted]

    def _look_at(self, at_m: Any) -> None:
        """Another spot of the plate, or the one that it always is."""
        if isinstance(plate := self._plate, CanBeChanged) and self.laser.aimed_at == "pickup":
            plate.look_at(None if at_m is None else _pair(at_m))

    def _mount(self, plate: str) -> None:
        if plate not in self.plates:
            raise Refused(f"no plate {plate!r} here, expected one of {', '.join(self.plates)}")
        self.mounted = plate
        if isinstance(mounted := self._plate, CanBeChanged):
            mounted.unload()

    def _clamp(self) -> None:
        """The mounted plate once more, by another person."""
        if isinstance(plate := self._plate, CanBeChanged):
            plate.clamp()

    def _load(self, mass_kg: float, at_m: tuple[float, float]) -> None:
        """A known mass on the mounted plate."""
        if isinstance(plate := self._plate, CanBeChanged):
            plate.load(mass_kg, at_m)

    def _strike(self, body: dict[str, Any]) -> None:
        """The mounted plate ready for blows, hung free or in its clamp; the laser on the plate."""
        if not isinstance(plate := self._plate, CanBeStruck):
            raise Refused(f"the {self.mounted} plate is not for striking")
        hit, read = _pair(body["hit_m"]), body["read_m"]
        self.laser.aimed_at = "pickup"
        plate.strike(hit, _pair(read) if read else None, free=bool(body["free"]))

    def _place(self, body: dict[str, Any]) -> None:
        if isinstance(plate := self._plate, CanBePlaced):
            plate.place(tuple(body["hit_m"]), tuple(body["response_m"]))

    def _hit(self) -> None:
        if not isinstance(plate := self._plate, CanBeHit):
            raise Refused(f"the {self.mounted} plate is not for hitting")
        plate.hit(self._time_s)

    # Samples

    def _on(self, number: int) -> SimulatedSensor:
        return self.wiring.inputs.get(number, _NOTHING)

    def _make(self, count: int) -> Acquired:
        step = 1 / self._rate_hz
        end_s = self._origin_s + (self._index + count) * step
        self.advance(end_s)
        converted = [self._convert(n, one, count, step) for n, one in self._inputs]
        first, self._index, self._time_s = self._index, self._index + count, end_s
        return Acquired(
            first,
            np.stack([c.counts for c in converted]),
            np.array([c.overload for c in converted]),
            np.zeros(len(converted), dtype=bool),
        )

    def _convert(self, number: int, one: Input, count: int, step: float) -> Converted:
        first_s = self._origin_s + self._index * step - (number - 1) * self.wiring.skew_samples * step
        buzz = hum(self.wiring.hum_v, self.wiring.mains_hz, first_s, step, count)
        return one.convert(self._signal(one.sensor.quantity, first_s, step, count), buzz)

    def _signal(self, quantity: str, first_s: float, step: float, count: int) -> Array:
        plate = self._plate
        if quantity == "laser":
            laser = self.laser
            at = first_s - laser.delay_s, step, count
            seen = plate.at("base_velocity" if laser.aimed_at == "base" else "velocity", *at)
            if laser.rides_with_base and laser.aimed_at != "base":
                seen = seen - plate.at("base_velocity", *at)
            return np.asarray(seen * laser.gain / laser.scale_m_s_v)
        if quantity == "nothing":
            return np.zeros(count)
        return plate.at(quantity, first_s, step, count)


def _pair(at: Any) -> tuple[float, float]:
    return float(at[0]), float(at[1])


def _joined(parts: list[Acquired]) -> Acquired:
    return Acquired(
        parts[0].first_sample,
        np.concatenate([p.counts for p in parts], axis=1),
        np.any([p.overload for p in parts], axis=0),
        np.any([p.cable_fault for p in parts], axis=0),
    )


def _part(whole: Acquired, part: slice) -> Acquired:
    first = whole.first_sample + (part.start or 0)
    return Acquired(first, whole.counts[:, part], whole.overload, whole.cable_fault)
