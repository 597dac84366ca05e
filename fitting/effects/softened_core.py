"""A core as soft as its own strain makes it, and how that moves as something strains it otherwise."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.effects.given import Strain
from fitting.laws.kraus import Kraus

_AT_REST = 1e-10
"""A step of the strain over the reference, at most, for the last one."""
_ITERATIONS = 60
"""Half steps would come within 1e-10 in 34 where strain hardly falls, secants do in 8 to 20. A bound."""
_PASSES = 8
"""Over what is kept: a point that comes to be the largest softens those after it. Two do, mostly."""
_OFF = 1e-7
"""Of a strain, that it may be off what it makes of itself: far below any noise."""
_FARTHEST, _NEAREST = 40.0, 1e-4
"""Times the strain of a core that does not soften: how far another may lie, of that the least looked at."""
_PLACES = 120
"""Looked at between them, 8 % from one to the next."""
_SHARES = np.arange(1, 8)[:, None] / 8
"""Of a gap, looked at in one go. Shape (places, 1)."""
_ROUNDS = 10
"""Of that, in each an eighth of the gap is left: 1e-10 of a strain in the end."""
_SMALL = 1e-12
"""A change of what is off from which a secant says nothing."""
_FULL = (0.25, 2.0)
"""Of what is off, the least and the most that a step takes: as far as a secant may be trusted. A choice."""
_H = 1e-6
"""Step of differences, of the logarithm of a strain."""
_LEAST_HELD = 0.05
"""Of how far a strain gives way to itself less than wholly: beyond, a core is about to jump, and its slope is
held at twenty times that of a core alone. Chosen."""
_TINY = 1e-300
"""A strain whose logarithm is asked for where nothing drives a core."""


@lru_cache(maxsize=2)
def softened_core(curve: Kraus, strain: Strain, points: int, kept: float, time_s: bytes) -> "SoftenedCore":
    """Of a sweep's points; the latest are kept, as a derivative to the law asks for one again and again."""
    return SoftenedCore(curve, strain, points, kept, np.frombuffer(time_s))


@dataclass(frozen=True, eq=False)
class SoftenedCore:
    """What a core has lost and gained under the strain that it has as softened as it then is.

    Shape (points,) each.
    """

    curve: Kraus
    strain: Strain
    points: int
    kept: float
    """Of what is lost, the share that the largest strain so far has taken and that does not come back."""
    time_s: Array
    """Empty where nothing is kept."""

    @cached_property
    def lost(self) -> Array:
        """Share of the modulus."""
        return self._lost(self._s, self._s[self._largest])

    @cached_property
    def gained(self) -> Array:
        """Loss modulus over sqrt(G' G'')."""
        return self.curve.gained(self._s)

    def along(self, ways: Array) -> tuple[Array, Array]:
        """Derivatives of both as ln strain at the same softness moves. Shape (ways, points) each."""
        how = self._gives_way
        alone = ways / how.held
        then = np.where(how.first, alone, alone + how.by_earlier / how.held * alone[:, self._largest])
        return how.lost * then + how.lost_before * then[:, self._largest], how.gained * then

    def along_own(self, beside: Sequence["SoftenedCore"]) -> tuple[Array, Array]:
        """What both differ by between two cores `beside` it, a small step in its own numbers above and below.

        These are not brought to rest: what they would be at this one's strain says how that moves. Shape
        (points,) each.
        """
        s, earlier = self._s, self._s[self._largest]
        above, below = ((one._lost(s, earlier), one.curve.gained(s)) for one in beside)
        strains = [one._under(*at) for one, at in zip(beside, (above, below), strict=True)]
        lost, gained = self.along((_log(strains[0]) - _log(strains[1]))[None])
        return lost[0] + above[0] - below[0], gained[0] + above[1] - below[1]

    @cached_property
    def _gives_way(self) -> "_GivesWay":
        s, earlier = self._s, self._s[self._largest]
        lost, gained = self._lost(s * (1 + _H), earlier), self.curve.gained(s * (1 + _H))
        before = self._lost(s, earlier * (1 + _H))
        here = _log(self._under(self.lost, self.gained))
        by_own = (_log(self._under(lost, gained)) - here) / _H
        by_earlier = (_log(self._under(before, self.gained)) - here) / _H if self.kept else 0 * s
        first = self._largest == np.arange(self.points)
        # What is the largest so far depends on itself alone, and others on it.
        held = 1 - by_own - np.where(first, by_earlier, 0.0)
        held = np.where(np.abs(held) < _LEAST_HELD, np.copysign(_LEAST_HELD, held), held)
        return _GivesWay(
            held,
            by_earlier,
            first,
            (lost - self.lost) / _H,
            (before - self.lost) / _H,
            (gained - self.gained) / _H,
        )

    @cached_property
    def _s(self) -> Array:
        """Strain over the reference."""
        none = np.zeros(self.points)
        s = self._at_rest(self._then(none, none), none)
        for _ in range(_PASSES if self.kept else 0):
            before, s = s, self._at_rest(s, _largest_before(s, self.time_s))
            if np.max(np.abs(s - before)) < _AT_REST:
                break
        return s

    def _at_rest(self, s: Array, earlier: Array) -> Array:
        """What a strain comes to from `s` on, after the largest of `earlier`. Shape (points,) each."""
        step, off = np.zeros(self.points), np.zeros(self.points)
        for _ in range(_ITERATIONS):
            before, off = off, self._then(s, earlier) - s
            # Half a step where nothing is known: where the strain falls with softening full ones may swing.
            fell = before - off
            known = (np.abs(fell) > _SMALL) & (step != 0)
            share = np.divide(step, fell, out=np.full(self.points, 0.5), where=known)
            step = off * np.clip(share, *_FULL)
            s = np.maximum(s + step, 0.0)
            if np.max(np.abs(step)) < _AT_REST:
                return s
        return self._halved(s, earlier)

    def _halved(self, s: Array, earlier: Array) -> Array:
        """The same where steps came to no end: the least strain between one that rises and one that falls.

        Beside a fold steps creep or go round: there a core may be at rest at two strains, or has just jumped.
        """
        off = np.abs(self._then(s, earlier) - s) > _OFF * np.maximum(s, _OFF)
        if not off.any():
            return s
        most = _FARTHEST * np.maximum(self._then(np.zeros(self.points), earlier), s)
        places = np.concatenate([[0.0], np.geomspace(_NEAREST, 1.0, _PLACES)])[:, None] * most
        for _ in range(_ROUNDS + 1):
            rises = self._then(places, earlier) > places
            last = np.argmax(rises[:-1] & ~rises[1:], axis=0)
            low, high = (np.take_along_axis(places, k[None], axis=0)[0] for k in (last, last + 1))
            places = np.concatenate([low[None], low + (high - low) * _SHARES, high[None]])
        return np.where(off, (low + high) / 2, s)

    @cached_property
    def _largest(self) -> NDArray[np.intp]:
        """The point of the largest strain so far, of each; itself where nothing is kept."""
        return _largest_so_far(self._s, self.time_s) if self.kept else np.arange(self.points)

    def _then(self, s: Array, earlier: Array) -> Array:
        return self._under(self._lost(s, np.maximum(s, earlier)), self.curve.gained(s))

    def _under(self, lost: Array, gained: Array) -> Array:
        return self.strain(lost, gained) if self.curve.loss else self.strain(lost)

    def _lost(self, s: Array, largest: Array) -> Array:
        lost = self.curve.lost(s)
        return self.kept * self.curve.lost(largest) + (1 - self.kept) * lost if self.kept else lost


@dataclass(frozen=True)
class _GivesWay:
    """How a core gives way to its own strain, per logarithm of it. Shape (points,) each."""

    held: Array
    """What ln strain would move by, over what it does, as it gives way to itself."""
    by_earlier: Array
    """Of ln strain, to the largest before."""
    first: NDArray[np.bool_]
    """Whether it is the largest so far."""
    lost: Array
    lost_before: Array
    """Of what is lost, to the largest before."""
    gained: Array


def _largest_so_far(s: Array, time_s: Array) -> NDArray[np.intp]:
    order = np.argsort(time_s, kind="stable")
    then = s[order]
    first = then >= np.maximum.accumulate(then)
    found = np.empty(len(s), dtype=np.intp)
    found[order] = order[np.maximum.accumulate(np.where(first, np.arange(len(s)), 0))]
    return found


def _largest_before(s: Array, time_s: Array) -> Array:
    """The largest strain before each point, zero before the first. Shape (points,)."""
    order = np.argsort(time_s, kind="stable")
    found = np.zeros(len(s))
    found[order[1:]] = np.maximum.accumulate(s[order])[:-1]
    return found


def _log(strain: Array) -> Array:
    return np.asarray(np.log(np.maximum(strain, _TINY)))
