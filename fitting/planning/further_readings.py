"""Readings that were not made yet, and where their unknowns are among those of a fit."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.of_files import Place, inner_of, own_unknowns
from fitting.effects.base import Effect, EffectParameter
from fitting.planning.known_mass import KnownMass
from fitting.planning.sensitivity import ReadingNoise
from fitting.reduced.reduced_plate import ReducedPlate

Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class FurtherReadings:
    """Readings at frequencies of a sweep that was made, otherwise than they were made."""

    member: DiagnosisProblem
    """The sweep's, at another level, time or spot. All its points; those not in `at` are not asked for."""
    at: Places
    """Points that are read."""
    dwell_s: Array
    """How long each of these points is read."""
    same_errors: bool | Mask = True
    """Whether the model errs as in the first sweep, in proportion to what it reads; else anew. Of each of
    these points where they differ."""
    new: frozenset[str] = frozenset()
    """Kinds of stated numbers that are others (`fitting.stated.tolerances`): as uncertain as they are
    stated."""
    without: frozenset[str] = frozenset()
    """Effects that are not in it."""
    remounted: bool = False
    """Whether the specimen is clamped anew: numbers that a mounting changes are others by so much."""
    mass: KnownMass | None = None
    noise: ReadingNoise | None = None
    """Of channels of its own; None: as the sweep's."""
    reduced: ReducedPlate | None = None
    """Where the model errs anew in a way of its own: the plate that says how. None: as in the first sweep."""
    other_reference: bool = False
    """Whether another channel is the reference: what was wrong in one may have been in the first one's."""
    like: Places | None = None
    """Of frequencies that were not measured: the first sweep's points that the model errs like."""


@dataclass(frozen=True, eq=False)
class UnknownsOfReadings:
    """The unknowns of readings in a response's order: law, stated numbers, effects, a known mass."""

    of_law: int
    """How many the law has."""
    stated: list[int | None]
    """Where each stated number is among those fitted; None for one that the fit does not know."""
    effects: list[Effect]
    """The fit's that the readings have."""
    places: list[Places]
    """Where the unknowns of each are among those fitted."""
    mass: KnownMass | None
    u: Array
    """All but the law's. Shape (unknowns,)."""

    def with_mass(self, effects: list[Effect]) -> list[Effect]:
        """The known mass, where there is one, at the end of `effects`."""
        return effects if self.mass is None else [*effects, self.mass]

    @property
    def at_mass(self) -> int:
        """Row of the known mass's first derivative."""
        return self.of_law + len(self.stated) + sum(len(p) for p in self.places)

    def of_effects(self) -> Iterator[tuple[EffectParameter, int, int]]:
        """Each unknown of an effect, where it is among those fitted, and the row of its derivative."""
        row = self.of_law + len(self.stated)
        for effect, place in zip(self.effects, self.places, strict=True):
            for parameter, g in zip(effect.parameters, place.tolist(), strict=True):
                yield parameter, g, row
                row += 1


def effects_at(
    fitted: Refitted, place: Place, without: frozenset[str] = frozenset()
) -> tuple[list[Effect], list[Places]]:
    """Effects of a fit that readings at a place have, and where the unknowns of each are in the fit's `u`."""
    effects, places = [], []
    for e, part in fitted.each():
        own, inner = own_unknowns(e, place), inner_of(e)
        if own is not None and inner.name not in without:
            effects.append(inner)
            places.append(part.start + own)
    return effects, places


def unknowns_of(
    fitted: Refitted, further: FurtherReadings, place: Place, names: Mapping[str, int]
) -> UnknownsOfReadings:
    """Unknowns of readings at a place, at the fit's values where the fit has them.

    `names`: the first sweep's stated numbers, and where each is among those fitted.
    """
    member = further.member
    effects, places = effects_at(fitted, place, further.without)
    stated = [None if q.kind in further.new else names.get(q.name) for q in member.nuisances.each]
    z = [0.0 if g is None else fitted.u[g] for g in stated]
    u = np.concatenate([z, *(fitted.u[p] for p in places)])
    if further.mass is not None:
        longer = sum(e.longer_m(fitted.u[p]) for e, p in zip(effects, places, strict=True))
        u = np.concatenate([u, further.mass.unknowns_on(member.plate.length_m, longer)])
    return UnknownsOfReadings(len(fitted.law.names), stated, effects, places, further.mass, u)
