"""Which stated numbers several members share: the same thing is one unknown."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_alone import plate_alone
from fitting.diagnosis.several.of_files import Place
from fitting.identification.adjusted import stated_number
from fitting.nuisances.nuisance import Nuisance
from fitting.stated.tolerances import NUMBERS, of_scope

OF_EACH_SPOT = of_scope("spot", "channel")
"""Kinds of stated numbers that are another one at every spot, though they are stated alike."""
OF_EACH_MOUNTING = of_scope("specimen", "mounting", "temperature", "file", "spot", "channel")
"""Those that are another one in a file of its own, mounted anew and driven as before: the chain stays."""
_SAME = 1e-3
"""Relative difference of frequency within which two files' resonances are the same one."""
Places = tuple[NDArray[np.intp], ...]


def shared(
    members: Sequence[DiagnosisProblem],
    of: Sequence[Place],
    mounted: Sequence[int],
    stays: Sequence[int] | None = None,
    *,
    own_spots: bool = False,
) -> tuple[tuple[Nuisance, ...], Places, tuple[tuple[int, ...], ...]]:
    """All stated numbers, those of the same thing once: where each member's are, and whose each is.

    `mounted`: of every member the first one of its mounting. `stays`: the first one that it was measured in
    the place of, spot and all, so that only the channels are another matter; None: none was.
    With `own_spots` the laser was aimed anew there each time.
    """
    there = of if stays is None else [of[k] for k in stays]
    keys: dict[tuple[object, ...], int] = {}
    each: list[Nuisance] = []
    owners: list[list[int]] = []
    places = []
    for k, m in enumerate(members):
        at = []
        for n in m.nuisances.each:
            key: tuple[object, ...] = (n.name, n.sigma, stated_number(m.specimen, n).in_si)
            match NUMBERS[n.kind].scope:
                case "chain":
                    key = (n.name, n.sigma, m.points.drive)
                case "channel":
                    key = (n.name, of[k])
                case "spot":
                    key = (n.name, of[k] if own_spots else there[k])
                case "specimen" | "mounting":
                    # The same where one plate is struck, there or elsewhere: it was not mounted anew.
                    key = (n.name, there[mounted[k]].file)
                case "temperature":
                    key = (n.name, of[k].file)
                case "file":
                    key = (n.name, there[k].file)
            if key not in keys:
                keys[key] = len(each)
                each.append(n)
                owners.append([])
            owners[keys[key]].append(k)
            at.append(keys[key])
        places.append(np.array(at, dtype=np.intp))
    named = [_named(n, its, of) for n, its in zip(each, owners, strict=True)]
    return tuple(named), tuple(places), tuple(tuple(its) for its in owners)


def with_narrow(
    each: Sequence[Nuisance],
    places: Places,
    owners: Sequence[tuple[int, ...]],
    members: Sequence[DiagnosisProblem],
    of: Sequence[Place],
) -> tuple[tuple[Nuisance, ...], Places, tuple[tuple[int, ...], ...]]:
    """The same with the members' narrow resonances, the last numbers of each, behind all others.

    One of a plate is off alike in all its files, as long as it lies where it did.
    """
    known: list[tuple[object, float, Nuisance]] = []
    whose: list[list[int]] = []
    found = []
    for k, m in enumerate(members):
        at = []
        plate, narrow = plate_alone(m.specimen), m.nuisances.narrow
        lies = [one.frequency_hz for one in narrow.each for _ in one.numbers] + [0.0]
        for n, f in zip(narrow.numbers, lies, strict=bool(narrow)):
            same = [j for j, one in enumerate(known) if one[0] == plate and _alike((f, n), one[1:])]
            if not same:
                same = [len(known)]
                known.append((plate, f, n))
                whose.append([])
            whose[same[0]].append(k)
            at.append(len(each) + same[0])
        found.append(np.append(places[k], np.array(at, dtype=np.intp)))
    named = [_named(n, its, of) for (*_, n), its in zip(known, whose, strict=True)]
    return (*each, *named), tuple(found), (*owners, *(tuple(its) for its in whose))


def _alike(one: tuple[float, Nuisance], other: tuple[float, Nuisance]) -> bool:
    """Whether the numbers of two resonances of one plate, which lie there (Hz), are the same one's."""
    return one[1].name == other[1].name and abs(one[0] - other[0]) <= _SAME * one[0]


def _named(n: Nuisance, its: Sequence[int], of: Sequence[Place]) -> Nuisance:
    """Under a name that says whose it is, if it is not of all."""
    if len(its) == len(of):
        return n
    return replace(n, name=f"{n.name} [{_whose(n, [of[k] for k in its], of)}]")


def _whose(n: Nuisance, its: Sequence[Place], every: Sequence[Place]) -> str:
    """The files a number is of, and the spot of one that is a spot's."""
    several = len({p.file for p in every}) > 1
    said = [", ".join(str(file) for file in dict.fromkeys(p.file for p in its))] if several else []
    if n.kind in OF_EACH_SPOT and its[0].pickup is not None:
        said.append(f"pickup {its[0].pickup}")
    return ", ".join(said)
