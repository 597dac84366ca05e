"""A plate with a part that swings on it: the plate's own motions are smooth, the part's are at every point.

At a frequency w the part is felt as a mass m(w) (`Effect.sharply`) at one place, whose row is c. With the
receptances of the plate without it, `lo` from its load to what is observed, `lc` to the place, `co` and `cc`
from a unit force at the place, and e = 1 where the base moves by a unit of acceleration, else 0,

    y = (lc - m e cc) / (1 - w^2 m cc)        the place
    x = lo + m co (w^2 y - e)                 what is observed

So receptances alone go from the nodes to every point (Sherman and Morrison's formula, Annals of Mathematical
Statistics 21 (1950) 124).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.plate_answer import Motions
from fitting.diagnosis.response.unknowns import Unknowns, stepped
from fitting.effects.base import Effect
from fitting.effects.given import Swings
from fitting.widened.enriched_plate import EnrichedReducedPlate

Spread = Callable[[Complex], Complex]
"""From the nodes to every point. Shape (any, nodes) to (any, points)."""


@dataclass(frozen=True)
class Loaded:
    """One answer of a plate with the part on it. Shape (points,) each."""

    lo: Complex
    lc: Complex
    co: Complex
    cc: Complex
    felt_kg: Complex
    square: Array
    """Of w, rad^2/s^2."""
    base: float
    """How far the base itself moves the part along: e above."""

    @cached_property
    def x(self) -> Complex:
        """The displacement that is observed."""
        return np.asarray(self.lo + self.felt_kg * self.co * self._pull)

    def along(self, lo: Complex, lc: Complex, co: Complex, cc: Complex) -> Complex:
        """Its derivative where these are those of the receptances. Shape (any, points) each."""
        by_co, by_lc = self.felt_kg * self._pull, self.felt_kg * self.square * self._carried
        return np.asarray(lo + by_co * co + by_lc * lc + by_co * by_lc * cc)

    @cached_property
    def by_felt(self) -> Complex:
        """Its derivative to the mass that is felt, per kg."""
        return np.asarray(self._carried * self._pull)

    @cached_property
    def _held(self) -> Complex:
        """A force at the place over what moves it with the part on it."""
        return np.asarray(1 - self.square * self.felt_kg * self.cc)

    @cached_property
    def _carried(self) -> Complex:
        """What is observed of a unit force at the place, with the part on it."""
        return np.asarray(self.co / self._held)

    @cached_property
    def _pull(self) -> Complex:
        """What the part pulls at the place, per mass that is felt: w^2 y - e."""
        y = (self.lc - self.felt_kg * self.base * self.cc) / self._held
        return np.asarray(self.square * y - self.base)


@dataclass(frozen=True)
class WithPart:
    """Both answers: to a base that moves, or to a force, and to a base that turns."""

    heave: Loaded
    turned: Loaded

    def along(
        self,
        heave: Complex,
        turned: Complex,
        co: Complex,
        cc: Complex,
        lc: Complex,
        pc: Complex | float = 0.0,
    ) -> tuple[Complex, Complex]:
        """Derivatives of both along those of the receptances, `pc` that of a turning base at the place.

        Shape (any, points) each.
        """
        return self.heave.along(heave, lc, co, cc), self.turned.along(turned, np.asarray(pc), co, cc)


class SwingingPart:
    """Effect number `of` among those of a response. `u` has shape (unknowns,)."""

    def __init__(self, unknowns: Unknowns, of: int, omega: Array, *, at_base: bool) -> None:
        self.of, self._unknowns, self._omega = of, unknowns, omega
        self._base = 1.0 if at_base else 0.0

    def row(self, plate: EnrichedReducedPlate, u: Array) -> Array:
        """Reads its place. Shape (k,)."""
        return self._swings(plate, u).row

    def on(
        self,
        plate: EnrichedReducedPlate,
        u: Array,
        x: Complex,
        turned: Complex,
        co: Complex,
        cc: Complex,
        lc: Complex,
        pc: Complex | float = 0.0,
    ) -> WithPart:
        """What becomes of the answers of the plate without it. Shape (points,) each."""
        (felt, _), square = self._there(plate, u), self._omega**2
        return WithPart(
            Loaded(x, lc, co, cc, felt, square, self._base),
            Loaded(turned, np.asarray(pc), co, cc, felt, square, 0.0),
        )

    def by_own(
        self, n: int, plate: EnrichedReducedPlate, u: Array, moved: Motions, spread: Spread, at: WithPart
    ) -> tuple[Complex, Complex]:
        """Derivatives of both answers to unknown n, which is its own. Shape (points,) each."""
        h = self._unknowns.step(n, u)
        up, down = stepped(u, n, h), stepped(u, n, -h)
        (more_felt, more_row), (less_felt, less_row) = (self._there(plate, one) for one in (up, down))
        felt, row = (more_felt - less_felt) / (2 * h), (more_row - less_row) / (2 * h)
        heave, turned = at.heave.by_felt * felt, at.turned.by_felt * felt
        if np.any(row):
            assert moved.c is not None
            motions = [moved.z, 2 * moved.c, moved.q, *([] if moved.p is None else [moved.p])]
            none = np.zeros(1, complex)
            more = at.along(none, none, *spread(np.array([one @ row for one in motions])))
            heave, turned = heave + more[0], turned + more[1]
        return heave, turned

    def _there(self, plate: EnrichedReducedPlate, u: Array) -> tuple[Complex, Array]:
        """The mass that it is felt as, and the row of its place. Shapes (points,), (k,)."""
        swings = self._swings(plate, u)
        factor = self._effect.sharply(self._omega, self._unknowns.of(self.of, u))
        assert factor is not None
        return np.asarray(swings.mass_kg * factor), swings.row

    def _swings(self, plate: EnrichedReducedPlate, u: Array) -> Swings:
        found = self._effect.swings(plate, self._unknowns.of(self.of, u))
        assert found is not None
        return found

    @property
    def _effect(self) -> Effect:
        return self._unknowns.effects[self.of]
