"""An effect among several files or spots: common to all of them, or of one."""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.effects.base import CLAMP, Effect, EffectParameter, Tie
from fitting.effects.form import taken_over
from fitting.effects.given import BarePlateModes, Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

FILE, PICKUP = "file", "pickup"
_ALL = -1
"""Instead of a spot's number: the effect is at all of them."""
ALIKE, EACH = 0, -1
"""Instead of a file's number: it is in all files, with one size, or with a size of its own in each."""
_ALONE = 1 / 30
"""Probability that an effect is in one file or at one spot alone, over that it is there at all. One channel
reads all spots of a file; what is on a plate, or wrong with a rig, is so in every file. A judgement."""


class Place(NamedTuple):
    """The file and the spot that some data were measured in."""

    file: int
    """From 1."""
    pickup: int | None = None
    """From 0; None where the file has one spot."""


class OfFiles(Effect):
    """`inner` in every file (`file` 0) or in one, counted from 1; the forms are tried apart.

    With `spots` it may also be at one of them in every file (`pickup`, -1 for all); an effect on how the
    plate is read may be at the first spot of the first file alone too. An effect that comes with a mounting,
    or differs from file to file, is also tried with a size of its own in each (`file` -1). Keys of further
    files end in the file's number; their priors are about the first file's size, as wide as mountings differ
    (`EffectParameter.mounting`).
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
        stays: bool = False,
        mounted: tuple[int, ...] = (),
    ) -> None:
        """`apart`: whether it may be in one file alone; `stays`: whether that is seldom so.

        `mounted`: for each file the first file of the same mounting, or 0 where the effect has no meaning; by
        default every file is a mounting of its own.
        """
        self.apart, self.stays = apart, stays
        self.mounted = mounted or tuple(range(1, files + 1))
        self.inner, self.files, self.file, self.spots, self.spot = inner, files, file, spots, spot
        own = self.own
        where = [EffectParameter(FILE, "1", float(EACH), float(files), float(file), neutral=None, fixed=True)]
        self.copies = len(own) if file == EACH else 1
        """How many times it has the unknowns of `inner`."""
        further = [replace(q, key=f"{q.key}_{k}") for k in own[1 : self.copies] for q in inner.parameters]
        alone = (inner.enters == "channel" and spot != _ALL) or (stays and file > ALIKE and len(own) > 1)
        if spots:
            last = float(max(spots))
            where.append(EffectParameter(PICKUP, "1", _ALL, last, float(spot), neutral=None, fixed=True))
        self._where = np.array([q.typical for q in where])
        vars(self).update(
            taken_over(inner),
            chance=inner.chance * (_ALONE if alone else 1.0),
            parameters=(*inner.parameters, *further, *where),
            spans=inner.spans,
        )

    def holds(self, place: Place) -> bool:
        """Whether some data have it."""
        here = self._of(place.file)
        return here > 0 and self.file in (EACH, ALIKE, here) and self.spot in (_ALL, place.pickup)

    def _of(self, file: int) -> int:
        """Number of the mounting (or file) whose size applies in a file; 0 where the effect is absent."""
        mounted = self.mounted[file - 1]
        return mounted if self.needs_mounting or not mounted else file

    @property
    def own(self) -> list[int]:
        """The numbers it goes by, each with a size of its own where they have one."""
        return sorted({of for k in range(1, self.files + 1) if (of := self._of(k)) > 0})

    def places(self, place: Place) -> NDArray[np.intp]:
        """Which of its unknowns are those of `inner` for some data. Shape (parameters of inner,)."""
        count = len(self.inner.parameters)
        copy = self.own.index(self._of(place.file)) if self.file == EACH else 0
        return copy * count + np.arange(count)

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        # The bare plate is that of the first file.
        if not self.holds(Place(1, 0 if self.spots else None)):
            return super().bare_shift(bare, u)
        return self.inner.bare_shift(bare, u[: len(self.inner.parameters)])

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return self.inner.objection(points, plate)

    def passes_for_a_law(self, points: Points) -> bool:
        return self.inner.passes_for_a_law(points)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.append(np.tile(u, self.copies), self._where) for u in self.inner.starts(plate, points)]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        low, high = self.inner.limits(plate)
        where = self.parameters[-len(self._where) :]
        low, high = np.tile(low, self.copies), np.tile(high, self.copies)
        return np.append(low, [q.lower for q in where]), np.append(high, [q.upper for q in where])

    def scaled(self, u: Array, a: float) -> Array:
        return np.concatenate([*(self.inner.scaled(one, a) for one in self._each(u)), self._where])

    def shows(self, points: Points, resonances: Complex, u: Array) -> bool:
        # By any file's points: they say nothing of whose they are.
        return any(self.inner.shows(points, resonances, one) for one in self._each(u))

    def is_beyond(self, u: Array) -> bool:
        return any(self.inner.is_beyond(one) for one in self._each(u))

    def _each(self, u: Array) -> list[Array]:
        """Its unknowns as `inner` has them, once or for each file. Shape (parameters of inner,) each."""
        return np.split(u[: -len(self._where)], self.copies)

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        each = [self.inner.within(one) for one in self._each(u)]
        found = []
        for parts in zip(*each, strict=True):
            form = self.form(parts[0][0], self.file, self.spots, self.spot)
            found.append((form, np.concatenate([*(part for _, part in parts), self._where])))
        return tuple(found)

    def elsewhere(self, plate: EnrichedReducedPlate, u: Array) -> list[Array]:
        if self.copies > 1:
            return []
        own = self.inner.elsewhere(plate, u[: len(self.inner.parameters)])
        return [np.append(one, u[len(one) :]) for one in own]

    @property
    def ties(self) -> tuple[Tie, ...]:
        inner = self.inner.parameters
        return tuple(
            Tie(m, k * len(inner) + m, q.mounting)
            for k in range(1, self.copies)
            for m, q in enumerate(inner)
            if q.mounting is not None
        )

    @property
    def needs_mounting(self) -> bool:
        """Whether it is another one with every mounting."""
        return self.inner.needs >= CLAMP

    def variants(self) -> tuple[Effect, ...]:
        forms, own = self.inner.variants(), self.own
        several = len(own) > 1
        numbers = [ALIKE, *own] if several and self.apart else [ALIKE]
        if several and (self.needs_mounting or self.inner.anew):
            numbers.append(EACH)
        elif not several and 0 in self.mounted:
            # It has a meaning there alone: that is its only form.
            numbers = own
        found: list[Effect] = [self.form(form, k, self.spots, _ALL) for k in numbers for form in forms]
        found += [self.form(form, ALIKE, self.spots, k) for k in self.spots for form in forms]
        if several and self.spots and self.inner.enters == "observation":
            # A laser that was aimed once more is off once.
            found += [self.form(form, own[0], self.spots, self.spots[0]) for form in forms]
        return tuple(found)

    def form(self, inner: Effect, file: int, spots: tuple[int, ...], spot: int) -> "OfFiles":
        """Another form of it."""
        return OfFiles(
            inner,
            self.files,
            file,
            spots,
            spot,
            apart=self.apart,
            stays=self.stays,
            mounted=self.mounted,
        )

    def story(self, u: Mapping[str, float]) -> str:
        every = "in every file" if 0 not in self.mounted else "in every file where it can be"
        # What channels show by themselves names no file where there is one.
        file = u.get(FILE, ALIKE)
        where = every if file <= ALIKE else f"in file {file:.0f}"
        if file == EACH:
            where = f"{every}, in each of another size (that of the first is said),"
        if u.get(PICKUP, _ALL) != _ALL:
            at = f"at pickup {u[PICKUP]:.0f}"
            where = at if file <= ALIKE else f"{where} {at}"
        elif self.files == 1:
            where = "at every pickup"
        return f"{where} {self.inner.story(u)}"


def inner_of(effect: Effect) -> Effect:
    """The effect itself, of whichever files its form is."""
    return effect.inner if isinstance(effect, OfFiles) else effect


def own_unknowns(effect: Effect, place: Place) -> NDArray[np.intp] | None:
    """Which of an effect's unknowns `inner_of` it has at a place; None where that lacks it.

    Shape (parameters of the inner effect,).
    """
    if not isinstance(effect, OfFiles):
        return np.arange(len(effect.parameters))
    return effect.places(place) if effect.holds(place) else None


def copies_of(effect: Effect) -> list[NDArray[np.intp]]:
    """Which of an effect's unknowns are those of `inner_of` it, once for each size that it has.

    Shape (parameters of the inner effect,) each.
    """
    count = len(inner_of(effect).parameters)
    copies = effect.copies if isinstance(effect, OfFiles) else 1
    return [k * count + np.arange(count) for k in range(copies)]
