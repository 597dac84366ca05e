"""What a window shows of a run against what the simulated instruments have, looked at by a thread of its own.

A value shown is as old as the newest moment at which the instruments had it.
"""

from collections import deque
from dataclasses import dataclass, field
from threading import Event, Thread
from time import monotonic

from engine_cases import drive_v
from formula_rig import gain

LOOKS_A_SECOND = 10
_TRUTHS_A_LOOK = 10
_KEPT_S = 30.0
_SAME = 0.03
"""Relative: a block's peak is read off its samples, with their noise."""
_QUANTITIES = ("drive", "base", "velocity")
_DRIVE_V = 1e-3
"""A register's last digit, and a ramp's end."""
_PEAK = 6.0
"""Largest of a block's samples, in standard deviations of the noise of a silent channel."""


@dataclass
class Seen:
    """Of one quantity."""

    looks: int = 0
    marked: int = 0
    nothing: int = 0
    ages_s: list[float] = field(default_factory=list)
    """Of each value that was shown as one of now."""

    @property
    def oldest_s(self) -> float:
        return max(self.ages_s, default=0.0)


class RegisterLooks:
    """Looks ten times a second while it is entered."""

    def __init__(self, window, rig) -> None:
        self._gauges, self._rig = window.bar.gauges.by_name, rig
        self._truth: deque[tuple[float, dict[str, float]]] = deque()
        self._ending = Event()
        self._thread = Thread(target=self._look_on, daemon=True)
        self.seen = {name: Seen() for name in _QUANTITIES}
        self.old: list[str] = []

    def __enter__(self):
        self._began = monotonic()
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ending.set()
        self._thread.join()

    def _look_on(self):
        number = 0
        while not self._ending.wait(1 / (LOOKS_A_SECOND * _TRUTHS_A_LOOK)):
            now = monotonic()
            self._truth.append((now, self._true()))
            while now - self._truth[0][0] > _KEPT_S:
                self._truth.popleft()
            number += 1
            if number % _TRUTHS_A_LOOK == 0:
                for name, seen in self.seen.items():
                    self._look(name, seen)

    def _true(self) -> dict[str, float]:
        volts = drive_v(self._rig)
        piece = self._rig.world.plates["damped"]._pieces[-1]
        f = piece.frequency_hz
        base = abs(gain("base_acceleration", f)) * volts
        return {"drive": volts, "base": base, "velocity": 1e3 * abs(gain("laser", f)) * volts}

    def _look(self, name, seen):
        gauge = self._gauges[name]
        value, marked = gauge.value, gauge.marked
        now = monotonic()
        seen.looks += 1
        if value is None:
            seen.nothing += 1
        elif marked:
            seen.marked += 1
        else:
            age = self._age(name, value, now)
            seen.ages_s.append(age)
            if age > 0.5:
                truth = self._truth[-1][1][name]
                self.old.append(
                    f"{now - self._began:.2f} s: {name} {value:.4g} shown, {truth:.4g} true, {age:.2f} s old"
                )

    def _noise(self, name) -> float:
        """In the unit shown: V, m/s^2, mm/s."""
        if name == "drive":
            return _DRIVE_V
        world = self._rig.world
        if name == "base":
            sensor = world.wiring.inputs[1]
            return _PEAK * sensor.noise_v / abs(sensor.volts_per_unit)
        return _PEAK * 1e3 * world.wiring.inputs[2].noise_v * world.laser.scale_m_s_v

    def _age(self, name, value, now) -> float:
        """Since this was last true, anywhere between two looks at the instruments."""
        truths = list(self._truth)
        noise = self._noise(name)
        for (_, before), (at, after) in zip(truths[-2::-1], truths[:0:-1], strict=True):
            low, high = sorted((before[name], after[name]))
            if low * (1 - _SAME) - noise <= value <= high * (1 + _SAME) + noise:
                return now - at
        return float("inf")
