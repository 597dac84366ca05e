"""The sweep's points as arrays to draw, and in which groups. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import NDArray

from instrument.interchange.contents import TimedPoint
from instrument.quality import QUALITIES, quality_of
from instrument.report.measured import noise_of
from instrument.stepped_sine.settings import STANDARD_GRAVITY_M_S2, SweepSettings
from instrument.stream.derived import PointMeasured

if TYPE_CHECKING:
    from gui.plots.plot import Symbol
    from gui.theme import Role

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]

_GOOD, _REMARKS, _OUT = range(3)
_LOOKS: "tuple[tuple[Role, Symbol], ...]" = (
    ("data", "o"),
    ("second", "s"),
    ("third", "d"),
    ("fourth", "star"),
)
"""Of the passes; they repeat after the last."""


@dataclass(frozen=True)
class Group:
    """Points that are drawn alike."""

    name: str
    role: "Role"
    symbol: "Symbol"
    index: Index
    """Which points."""


@dataclass(frozen=True)
class Points:
    """Steps and sentinels in the order of measuring. Shape (points,) each."""

    timed: tuple[TimedPoint, ...]
    quality: Index
    """Number in `QUALITIES`."""

    @classmethod
    def of(cls, timed: Sequence[TimedPoint], settings: SweepSettings) -> Self:
        """Of a session so far."""
        quality = [QUALITIES.index(quality_of(t.point, settings)) for t in timed]
        return cls(tuple(timed), np.array(quality, dtype=np.intp))

    def __len__(self) -> int:
        return len(self.timed)

    @cached_property
    def measured(self) -> list[PointMeasured]:
        """The points without their times."""
        return [t.point for t in self.timed]

    @cached_property
    def frequency_hz(self) -> Array:
        """Of each point."""
        return self._all("frequency_hz")

    @cached_property
    def over_base_s(self) -> Complex:
        """Velocity over base acceleration."""
        base = np.array([p.base_m_s2 for p in self.measured], dtype=complex)
        return np.array([p.velocity_m_s for p in self.measured], dtype=complex) / base

    @cached_property
    def level_m_s2(self) -> Array:
        """Base acceleration asked for."""
        return self._all("level_m_s2")

    @cached_property
    def segment(self) -> Index:
        """Number of the resonance region."""
        return np.array([p.segment for p in self.measured], dtype=np.intp)

    @cached_property
    def time_s(self) -> Array:
        """Since the session's first sample."""
        return np.array([t.time_s for t in self.timed])

    @cached_property
    def sentinel(self) -> Mask:
        """Whether it is a sentinel."""
        return np.array([p.purpose == "sentinel" for p in self.measured], dtype=bool)

    @cached_property
    def phase_deg(self) -> Array:
        """Of velocity over base acceleration, without jumps inside a segment."""
        phase = np.degrees(np.angle(self.over_base_s))
        for number in np.unique(self.segment):
            mine = np.flatnonzero(self.segment == number)
            mine = mine[np.argsort(self.frequency_hz[mine], kind="stable")]
            phase[mine] = np.unwrap(phase[mine], period=360.0)
        return phase

    def noise_percent(self, channel: str) -> Array:
        """Standard deviation of "velocity" or "base" over its amplitude."""
        return 100 * noise_of(self.measured, channel)

    def percent(self, name: str) -> Array:
        """Any other quantity of the points by its field."""
        return self._all(name)

    @cached_property
    def passes(self) -> list[tuple[int, float]]:
        """Sweep and level of each pass there is, in order."""
        return sorted({(p.sweep, round(p.level_m_s2, 6)) for p in self.measured if p.purpose == "step"})

    def named_pass(self, one: tuple[int, float]) -> str:
        """What tells a pass from the others; empty where there is only one."""
        sweep, level = one
        said = [f"pass {sweep}"] if len({s for s, _ in self.passes}) > 1 else []
        if len({v for _, v in self.passes}) > 1:
            said.append(f"{level / STANDARD_GRAVITY_M_S2:.3g} g")
        return ", ".join(said)

    def groups(self, wanted: Mask) -> list[Group]:
        """The wanted points: good ones by pass, then those with remarks, out of limits, and sentinels."""
        step = wanted & ~self.sentinel
        found = [
            Group(self.named_pass(one) or "good", *_LOOKS[k % len(_LOOKS)], self._in_pass(one, step))
            for k, one in enumerate(self.passes)
        ]
        found += [
            Group("with remarks", "fair", "t1", np.flatnonzero(step & (self.quality == _REMARKS))),
            Group("out of limits", "bad", "x", np.flatnonzero(step & (self.quality == _OUT))),
            Group("sentinel", "faint", "+", np.flatnonzero(wanted & self.sentinel)),
        ]
        return [group for group in found if group.index.size]

    def in_order(self, wanted: Mask) -> Index:
        """The wanted points by frequency, as one walks along them."""
        index = np.flatnonzero(wanted)
        return index[np.argsort(self.frequency_hz[index], kind="stable")]

    def of_step(self, step: int) -> int | None:
        """The point of a step, if it is there."""
        return next((k for k, p in enumerate(self.measured) if p.step == step), None)

    def _in_pass(self, one: tuple[int, float], step: Mask) -> Index:
        sweep, level = one
        alike = [p.sweep == sweep and round(p.level_m_s2, 6) == level for p in self.measured]
        return np.flatnonzero(step & np.array(alike, dtype=bool) & (self.quality == _GOOD))

    def _all(self, name: str) -> Array:
        return np.array([getattr(p, name) for p in self.measured], dtype=float)
