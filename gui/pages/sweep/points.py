"""The sweep's points as arrays to draw, and in which groups. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.data.aside import Reasons
from instrument.files.acceleration import acceleration_unit
from instrument.files.point_columns import stored
from instrument.results.quality import QUALITIES, quality_of
from instrument.results.set_aside import NAME
from instrument.session.contents import TimedPoint
from instrument.session.points import place_of
from instrument.stepped_sine.settings import SweepSettings

if TYPE_CHECKING:
    from gui.plots.curve import Symbol
    from gui.style.theme import Role

Index = NDArray[np.intp]

Channel = Literal["velocity", "base"]

_GOOD, _REMARKS, _OUT = range(3)
_LOOKS: "tuple[tuple[Role, Symbol], ...]" = (
    ("data", "o"),
    ("second", "s"),
    ("third", "d"),
    ("fourth", "star"),
)
"""Of the passes; they repeat after the last."""

Pass = tuple[int, float, str]
"""Number of the sweep, level in m/s^2, and where the plate was read where not as its file says."""


@dataclass(frozen=True)
class Group:
    """Points that are drawn alike."""

    name: str
    role: "Role"
    symbol: "Symbol"
    index: Index
    """Which points."""
    hollow: bool = False


_COLUMNS = tuple(column.field for column in stored())


@dataclass(frozen=True)
class PointsMeasured:
    """Steps and sentinels in the order of measuring. Shape (points,) each."""

    timed: tuple[TimedPoint, ...]
    table: Array
    """A row a point: `_COLUMNS`, then its time in s, whether it is a sentinel, its number in `QUALITIES`."""
    why_aside: Reasons = field(default_factory=lambda: np.zeros(0, dtype=object))
    """Why a fit leaves it out; empty where it does not."""

    @classmethod
    def of(cls, timed: Sequence[TimedPoint], settings: SweepSettings) -> Self:
        """Of a session so far."""
        return cls((), np.zeros((0, len(_COLUMNS) + 3))).up_to(timed, settings)

    def setting_aside(self, why: Reasons) -> Self:
        """A copy of these points, some of them left out by a fit."""
        return self if np.array_equal(why, self.why_aside) else replace(self, why_aside=why)

    def up_to(self, timed: Sequence[TimedPoint], settings: SweepSettings) -> Self:
        """With what was measured since; all of them again where these are no beginning of it."""
        known = len(self)
        if known > len(timed) or (known and self.timed[-1] is not timed[known - 1]):
            return type(self).of(timed, settings)
        if known == len(timed):
            return self
        rows = [_row(t, settings) for t in timed[known:]]
        none = np.full(len(rows), "", dtype=object)
        return type(self)(
            tuple(timed),
            np.concatenate([self.table, np.array(rows, dtype=float)]),
            np.concatenate([self.why_aside, none]),
        )

    def __len__(self) -> int:
        return len(self.timed)

    def column(self, name: str) -> Array:
        """A quantity of the points by its field; NaN where it is not known."""
        return np.asarray(self.table[:, _COLUMNS.index(name)])

    @property
    def frequency_hz(self) -> Array:
        """Frequency of each point."""
        return self.column("frequency_hz")

    @cached_property
    def over_base_s(self) -> Complex:
        """Velocity over base acceleration."""
        return np.asarray(self._phasor("velocity_re_m_s") / self._phasor("base_accel_re_m_s2"))

    @property
    def level_m_s2(self) -> Array:
        """Base acceleration asked for."""
        return self.column("level_m_s2")

    @cached_property
    def segment(self) -> Index:
        """Number of the resonance region."""
        return self.column("segment").astype(np.intp)

    @property
    def time_s(self) -> Array:
        """Since the session's first sample."""
        return np.asarray(self.table[:, -3])

    @cached_property
    def sentinel(self) -> Mask:
        """Whether it is a sentinel."""
        return np.asarray(self.table[:, -2] > 0)

    @cached_property
    def aside(self) -> Mask:
        """Whether a fit leaves it out."""
        return np.asarray(self.why_aside != "", dtype=bool)

    @cached_property
    def quality(self) -> Index:
        """Number in `QUALITIES`."""
        return self.table[:, -1].astype(np.intp)

    @cached_property
    def place(self) -> tuple[str, ...]:
        """Of each point another spot, a known mass or another clamping, in words; empty: as the file says."""
        return tuple(place_of(t.point) for t in self.timed)

    @cached_property
    def places(self) -> tuple[str, ...]:
        """What `place` says of steps, each once, in the order of measuring."""
        said = zip(self.place, self.sentinel, strict=True)
        return tuple(dict.fromkeys(where for where, sentinel in said if not sentinel))

    def read_at(self, place: str) -> Mask:
        """Points of which `place` says this. Shape (points,)."""
        return np.asarray(self._place == place)

    @cached_property
    def _place(self) -> NDArray[np.str_]:
        return np.array(self.place, dtype=np.str_)

    @cached_property
    def phase_deg(self) -> Array:
        """Of velocity over base acceleration, without jumps along the steps of a segment at one place."""
        phase, f = np.degrees(np.angle(self.over_base_s)), self.frequency_hz
        for place in self.places:
            here = self.read_at(place)
            # A signal that was lost has any phase.
            followed = here & ~self.sentinel & ~self.aside
            for number in np.unique(self.segment[followed]):
                mine = self.in_order(followed & (self.segment == number))
                phase[mine] = np.unwrap(phase[mine], period=360.0)
                beside = here & (self.segment == number) & (self.sentinel | self.aside)
                off = np.interp(f[beside], f[mine], phase[mine]) - phase[beside]
                phase[beside] += 360.0 * np.round(off / 360.0)
        return phase

    def noise_percent(self, channel: Channel) -> Array:
        """Standard deviation of each part of a channel's phasor over its amplitude."""
        if channel == "velocity":
            return 100 * self.column("velocity_std_m_s") / np.abs(self._phasor("velocity_re_m_s"))
        return 100 * self.column("base_accel_std_m_s2") / np.abs(self._phasor("base_accel_re_m_s2"))

    @cached_property
    def passes(self) -> list[Pass]:
        """Each there is: by sweep and level, then as they were measured."""
        steps = dict.fromkeys(
            one for one, sentinel in zip(self._pass, self.sentinel, strict=True) if not sentinel
        )
        return sorted(steps, key=lambda one: one[:2])

    def named_pass(self, one: Pass) -> str:
        """What tells a pass from the others; empty where there is only one."""
        sweep, level, where = one
        said = [f"pass {sweep}"] if len({s for s, _, _ in self.passes}) > 1 else []
        if len({v for _, v, _ in self.passes}) > 1:
            said.append(acceleration_unit().said(level, ".3g"))
        if where:
            said.append(where)
        return ", ".join(said)

    def groups(self, wanted: Mask) -> list[Group]:
        """The wanted points: good ones by pass, those with remarks, out of limits, sentinels, set aside."""
        step = wanted & ~self.sentinel & ~self.aside
        good = step & (self.quality == _GOOD)
        found = [
            Group(
                self._good_name(one),
                *_LOOKS[k % len(_LOOKS)],
                np.flatnonzero(good & (self.number_of_pass == k)),
            )
            for k, one in enumerate(self.passes)
        ]
        found += [
            Group("with remarks", "fair", "t1", np.flatnonzero(step & (self.quality == _REMARKS))),
            Group("out of limits", "bad", "x", np.flatnonzero(step & (self.quality == _OUT))),
            Group("sentinel", "faint", "+", np.flatnonzero(wanted & self.sentinel & ~self.aside)),
            Group(NAME, "bad", "t", np.flatnonzero(wanted & self.aside), hollow=True),
        ]
        return [group for group in found if group.index.size]

    def in_order(self, wanted: Mask) -> Index:
        """The wanted points by frequency, as one walks along them."""
        index = np.flatnonzero(wanted)
        return index[np.argsort(self.frequency_hz[index], kind="stable")]

    def of_step(self, step: int) -> int | None:
        """The point of a step, if it is there."""
        place = np.flatnonzero(self.column("step") == step)
        return int(place[0]) if place.size else None

    @cached_property
    def _pass(self) -> list[Pass]:
        """Of each point, as they are compared."""
        columns = self.column("sweep").astype(int).tolist(), np.round(self.level_m_s2, 6).tolist()
        return list(zip(*columns, self.place, strict=True))

    @cached_property
    def number_of_pass(self) -> Index:
        """Of each point: which of `passes`; -1 of a sentinel of none. Shape (points,)."""
        numbers = {one: k for k, one in enumerate(self.passes)}
        return np.array([numbers.get(one, -1) for one in self._pass], dtype=np.intp)

    def _good_name(self, one: Pass) -> str:
        which = self.named_pass(one)
        return f"good, {which}" if which else "good"

    def _phasor(self, real: str) -> Complex:
        """Real and imaginary part stand side by side."""
        k = _COLUMNS.index(real)
        return np.asarray(self.table[:, k] + 1j * self.table[:, k + 1])


def _row(timed: TimedPoint, settings: SweepSettings) -> list[float | None]:
    p = timed.point
    quality = QUALITIES.index(quality_of(p, settings))
    return [*(getattr(p, name) for name in _COLUMNS), timed.time_s, p.purpose == "sentinel", quality]
