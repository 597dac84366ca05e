"""How the unknowns of a response lie in one vector: the stated numbers, then those of each effect."""

from collections.abc import Sequence

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter

_H = 1e-4
"""Step of differences, of an unknown's typical size."""

STATED_NUMBER = EffectParameter("stated", "1", -12.0, 12.0, 1.0)
"""A stated number, in standard deviations of its tolerance."""


class Unknowns:
    """Of `stated` numbers and some effects. `u` has shape (unknowns,)."""

    def __init__(self, stated: int, effects: Sequence[Effect]) -> None:
        self.effects = tuple(effects)
        self.parameters: tuple[EffectParameter, ...] = (
            *(STATED_NUMBER,) * stated,
            *(q for e in effects for q in e.parameters),
        )
        self.stated = slice(0, stated)
        self.slices, start = [], stated
        for effect in self.effects:
            self.slices.append(slice(start, start + len(effect.parameters)))
            start += len(effect.parameters)

    def of(self, k: int, u: Array) -> Array:
        """Those of effect k."""
        return u[self.slices[k]]

    def owner(self, n: int) -> int:
        """The effect that has unknown n."""
        return next(k for k, part in enumerate(self.slices) if part.start <= n < part.stop)

    def step(self, n: int, u: Array) -> float:
        """Of a difference along unknown n."""
        q = self.parameters[n]
        return _H * (abs(u[n]) if q.logarithmic else q.typical or 1.0)


def stepped(u: Array, n: int, h: float) -> Array:
    """`u` with number n more by `h`. Shape (unknowns,) of both."""
    found = u.copy()
    found[n] += h
    return found
