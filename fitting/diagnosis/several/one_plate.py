"""Several sweeps of one plate, driven or read elsewhere: its model is one, whatever is made of it made once.

Loads and readings are vectors beside the plate's matrices: members share the matrices themselves.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.laws import CoreLaw
from fitting.specimen import PlateSpecimen
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

_MOST_TAKEN = 12
"""Plates with some effects' columns that are kept: a search comes back to the same few. A bound on memory."""

Plates = tuple[int, ...]
"""Of every member the number of its plate."""


def plates_of(members: Sequence[DiagnosisProblem]) -> Plates:
    """Which members have one plate's matrices."""
    matrices = [id(m.plate.M) for m in members]
    return tuple(matrices.index(one) for one in matrices)


def condensed(
    members: Sequence[DiagnosisProblem], plates: Plates, laws: Sequence[CoreLaw]
) -> tuple[DiagnosisProblem, ...]:
    """Every member condensed to its law, those of one plate for all that drives and reads it."""
    found: dict[int, EnrichedReducedPlate] = {}
    for k, sides in _sides(members, plates).items():
        found[k] = members[k].condensed(laws[k], sides).plate
    return tuple(
        replace(m, plate=_at(found[k], m) if plates.count(k) > 1 else found[k])
        for m, k in zip(members, plates, strict=True)
    )


def with_narrow(
    members: Sequence[DiagnosisProblem], plates: Plates, laws: Sequence[CoreLaw]
) -> tuple[DiagnosisProblem, ...]:
    """Every member with where the narrow resonances of its plate lie among its numbers."""
    found = list(members)
    for number in dict.fromkeys(plates):
        first, *rest = (k for k, plate in enumerate(plates) if plate == number)
        sweeps = [members[k].sweep for k in (first, *rest)]
        found[first] = one = members[first].with_narrow(laws[first], sweeps)
        if one is not members[first]:
            for k in rest:
                plate = replace(members[k].plate, U=one.plate.U, d=one.plate.d)
                found[k] = members[k].moving_each_of(one.nuisances.narrow, plate)
    return tuple(found)


def around(
    members: Sequence[DiagnosisProblem], plates: Plates, laws: Sequence[CoreLaw]
) -> tuple[DiagnosisProblem, ...]:
    """Every member's grids made for its law, a plate's poles found once."""
    poles = {k: PlatePoles(members[k].plate, laws[k]) for k in plates if plates.count(k) > 1}
    return tuple(m.around(law, poles.get(k)) for m, k, law in zip(members, plates, laws, strict=True))


def _sides(members: Sequence[DiagnosisProblem], plates: Plates) -> dict[int, list[Array]]:
    """What drives and reads each plate, where there are several of either."""
    found: dict[int, list[Array]] = {}
    for m, k in zip(members, plates, strict=True):
        each = found.setdefault(k, [])
        if plates.count(k) > 1:
            new = (m.plate.load, m.plate.observe)
            each += [side for side in new if not any(np.array_equal(side, known) for known in each)]
    return found


def _at(plate: EnrichedReducedPlate, member: DiagnosisProblem) -> EnrichedReducedPlate:
    specimen = member.specimen
    assert isinstance(specimen, PlateSpecimen)
    assert specimen.pickup_m is not None
    return plate.at(specimen.force_m, specimen.pickup_m)


class Taken:
    """Plates with the columns of some effects."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, frozenset[str]], EnrichedReducedPlate] = {}

    def __reduce__(self) -> tuple[Callable[[], "Taken"], tuple[()]]:
        # Another process takes what it needs itself.
        return Taken, ()

    def of(self, number: int, member: DiagnosisProblem, spans: Iterable[Span]) -> EnrichedReducedPlate:
        """The plate of a number, as a member drives and reads it."""
        spans = list(spans)
        key = number, frozenset(span.name for span in spans)
        if key not in self._known:
            while len(self._known) >= _MOST_TAKEN:
                del self._known[next(iter(self._known))]
            self._known[key] = member.plate.take(spans)
        return _at(self._known[key], member)
