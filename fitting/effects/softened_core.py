"""A core as soft as its own strain makes it, and how that moves as something strains it otherwise."""

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
"""Half steps would come within 1e-10 in 34 where strain hardly falls, secants do in some 8. A bound."""
_SMALL = 1e-12
"""A change of what is off from which a secant says nothing."""
_FULL = (0.25, 2.0)
"""Of what is off, the least and the most that a step takes: as far as a secant may be trusted. A choice."""
_H = 1e-6
"""Step of differences, of the logarithm of a strain."""
_LEAST_HELD = 0.05
"""Of how far a strain gives way to itself less than wholly: beyond, a core jumps: it has no slope. Chosen."""


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
        s, earlier = self._s, self._s[self._largest]
        lost, gained = self._lost(s * (1 + _H), earlier), self.curve.gained(s * (1 + _H))
        before = self._lost(s, earlier * (1 + _H))
        here = np.log(self._under(self.lost, self.gained))
        by_own = (np.log(self._under(lost, gained)) - here) / _H
        by_earlier = (np.log(self._under(before, self.gained)) - here) / _H if self.kept else 0 * s
        first = self._largest == np.arange(self.points)
        # What is the largest so far depends on itself alone, and others on it.
        held = 1 - by_own - np.where(first, by_earlier, 0.0)
        held = np.where(np.abs(held) < _LEAST_HELD, np.copysign(_LEAST_HELD, held), held)
        alone = ways / held
        then = np.where(first, alone, alone + by_earlier / held * alone[:, self._largest])
        return (
            ((lost - self.lost) * then + (before - self.lost) * then[:, self._largest]) / _H,
            (gained - self.gained) * then / _H,
        )

    @cached_property
    def _s(self) -> Array:
        """Strain over the reference."""
        s = self._then(np.zeros(self.points))
        step, off = np.zeros(self.points), np.zeros(self.points)
        for _ in range(_ITERATIONS):
            before, off = off, self._then(s) - s
            # Half a step where nothing is known: where the strain falls with softening full ones may swing.
            fell = before - off
            known = (np.abs(fell) > _SMALL) & (step != 0)
            share = np.divide(step, fell, out=np.full(self.points, 0.5), where=known)
            step = off * np.clip(share, *_FULL)
            s = np.maximum(s + step, 0.0)
            if np.max(np.abs(step)) < _AT_REST:
                break
        return s

    @cached_property
    def _largest(self) -> NDArray[np.intp]:
        """The point of the largest strain so far, of each; itself where nothing is kept."""
        return _largest_so_far(self._s, self.time_s) if self.kept else np.arange(self.points)

    def _then(self, s: Array) -> Array:
        largest = s[_largest_so_far(s, self.time_s)] if self.kept else s
        return self._under(self._lost(s, largest), self.curve.gained(s))

    def _under(self, lost: Array, gained: Array) -> Array:
        return self.strain(lost, gained) if self.curve.loss else self.strain(lost)

    def _lost(self, s: Array, largest: Array) -> Array:
        lost = self.curve.lost(s)
        return self.kept * self.curve.lost(largest) + (1 - self.kept) * lost if self.kept else lost


def _largest_so_far(s: Array, time_s: Array) -> NDArray[np.intp]:
    order = np.argsort(time_s, kind="stable")
    then = s[order]
    first = then >= np.maximum.accumulate(then)
    found = np.empty(len(s), dtype=np.intp)
    found[order] = order[np.maximum.accumulate(np.where(first, np.arange(len(s)), 0))]
    return found
