"""An effect among several files or spots: common to all of them, or of one."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter, Points
from fitting.effects.enriched_plate import EnrichedReducedPlate

FILE, PICKUP = "file", "pickup"
_ALL = -1
"""In the place of a file's number: common to all of them."""
_OF_A_SPOT = ("observation", "channel")
"""Where an effect enters that may be of one spot alone."""
_OF_THE_PLATE = ("stiffness", "damping", "core law")
"""Where it enters that is of the plate itself, however it is driven."""


class Place(NamedTuple):
    """Whose some data are."""

    file: int
    """From 1."""
    pickup: int | None = None
    """From 0; None where the file has one spot."""


def among(effect: Effect, files: int, spots: Sequence[int], *, one_plate: bool = False) -> Effect:
    """An effect among so many files, of which some have several spots.

    Of `one_plate`, driven elsewhere in every file, what is of the plate itself is of all of them.
    """
    by_spot = tuple(spots) if effect.enters in _OF_A_SPOT else ()
    apart = not (one_plate and effect.enters in _OF_THE_PLATE)
    return OfFiles(effect, files, spots=by_spot, apart=apart) if files > 1 or by_spot else effect


class OfFiles(Effect):
    """`inner` in every file (`file` 0) or in one, counted from 1; the forms are tried apart.

    With `spots` also at one of them in every file (`pickup`, -1 for all).
    """

    def __init__(
        self,
        inner: Effect,
        files: int,
        file: int = 0,
        spots: tuple[int, ...] = (),
        spot: int = _ALL,
        *,
        apart: bool = True,
    ) -> None:
        """`apart`: whether it may be of one file alone."""
        self.apart = apart
        self.inner, self.files, self.file, self.spots, self.spot = inner, files, file, spots, spot
        where = [EffectParameter(FILE, "1", 0.0, float(files), float(file), neutral=None, fixed=True)]
        if spots:
            last = float(max(spots))
            where.append(EffectParameter(PICKUP, "1", _ALL, last, float(spot), neutral=None, fixed=True))
        self._where = np.array([q.typical for q in where])
        vars(self).update(
            name=inner.name,
            enters=inner.enters,
            source=inner.source,
            chance=inner.chance,
            unexplained_share=inner.unexplained_share,
            discriminating_test=inner.discriminating_test,
            parameters=(*inner.parameters, *where),
            spans=inner.spans,
        )

    def holds(self, place: Place) -> bool:
        """Whether some data have it."""
        return self.file in (0, place.file) and self.spot in (_ALL, place.pickup)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return self.inner.objection(points, plate)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.append(u, self._where) for u in self.inner.starts(plate, points)]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        low, high = self.inner.limits(plate)
        where = self.parameters[len(low) :]
        return np.append(low, [q.lower for q in where]), np.append(high, [q.upper for q in where])

    def scaled(self, u: Array, a: float) -> Array:
        return np.append(self.inner.scaled(u[: -len(self._where)], a), self._where)

    def variants(self) -> tuple[Effect, ...]:
        forms = self.inner.variants()
        files = range(self.files + 1) if self.files > 1 and self.apart else range(1)
        found = [OfFiles(form, self.files, k, self.spots) for k in files for form in forms]
        found += [OfFiles(form, self.files, 0, self.spots, k) for k in self.spots for form in forms]
        return tuple(found)

    def story(self, u: Mapping[str, float]) -> str:
        where = "in every file" if not u[FILE] else f"in file {u[FILE]:.0f}"
        if u.get(PICKUP, _ALL) != _ALL:
            where = f"at pickup {u[PICKUP]:.0f}"
        elif self.files == 1:
            where = "at every pickup"
        return f"{where} {self.inner.story(u)}"
