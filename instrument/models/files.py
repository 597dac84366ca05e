"""Files with their specimens, each spot of a file for itself; and the models of those that are plates."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.mountings import of_mounting
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam
from fitting.sweep import Sweep
from instrument.models.set_up import Hammer, set_up, set_up_spots, with_hammer
from instrument.progress import Progress


@dataclass(frozen=True)
class File:
    """One set of data and what it was measured on."""

    sweep: Sweep
    specimen: AnySpecimen
    name: str = ""
    number: int = 0
    """Of the file, from 1; in order where it is not said: several spots of one file share it."""
    pickup: int | None = None
    """Which spot of the file, where it has several."""
    like: PlateSpecimen | None = None
    """As `instrument.models.set_up.set_up` takes it."""


def spots_of(sweep: Sweep, specimen: AnySpecimen, name: str = "", number: int = 1) -> list[File]:
    """A file's data, each of its spots for itself."""
    if sweep.pickup is None or not isinstance(specimen, PlateSpecimen | Beam):
        return [File(sweep, specimen, name, number)]
    return [
        File(replace(sweep.take(sweep.pickup == k), pickup=None), specimen.at_pickup(k), name, number, k)
        for k in np.unique(sweep.pickup).tolist()
    ]


def lone_plate(files: Sequence[File]) -> PlateSpecimen | None:
    """The plate, where all there is is one file of it: nothing is joined then, and nothing told apart."""
    first = files[0].specimen
    return first if len(files) == 1 and isinstance(first, PlateSpecimen) else None


def numbers_of(files: Sequence[File]) -> list[int]:
    """Of each of them the number of its file."""
    return [f.number or k + 1 for k, f in enumerate(files)]


def name_of(files: Sequence[File], number: int) -> str:
    """Of a file by its number."""
    return files[numbers_of(files).index(number)].name


def one_plate(files: Sequence[File]) -> bool:
    """Whether the specimens differ in what drives them, in the spot and in masses put on them alone."""
    plates = [f.specimen for f in files if isinstance(f.specimen, PlateSpecimen)]
    whole = [replace(s, force_m=None, pickup_m=None, further_pickups_m=(), masses=()) for s in plates]
    if len({s.drive for s in plates}) > 1:
        whole = [replace(s.as_it_stands, masses=()) for s in plates]
        if len({s.boundary for s in plates}) > 1:
            # Hung free it is as long as it is, not as far as it stands out of a clamp.
            whole = [replace(s, boundary="free", length_m=plates[0].length_m, modal_ratios=()) for s in whole]
    return len(whole) == len(files) and all(s == whole[0] for s in whole)


def mounted(files: Sequence[File], stands: Sequence[bool]) -> tuple[int, ...]:
    """Of each number of a file the first one of its mounting; 0 of those on which nothing `stands`."""
    numbers, stated = numbers_of(files), [f.specimen for f in files]
    found = [0] * max(numbers)
    for k, number in enumerate(numbers):
        if stands[k]:
            found[number - 1] = numbers[of_mounting(stated, k, k)]
    return tuple(found)


def plates_of(
    files: Sequence[File],
    sweeps: Sequence[Sweep],
    hammer: Hammer | None,
    progress: Progress,
    *,
    with_effects: bool,
) -> tuple[dict[int, tuple[DiagnosisProblem, ReducedPlate]], BareModes | None]:
    """The problems of files that are of plates, by their place, and what a bare plate's test says.

    `sweeps` are what is used of the files' data. Plates that differ in the point of a force and in the spot
    alone have one model.
    """
    alike: list[tuple[object, list[int]]] = []
    for k, file in enumerate(files):
        if isinstance(s := file.specimen, PlateSpecimen):
            whole = replace(s, force_m=None if s.force_m is None else (0.0, 0.0), pickup_m=None), file.like
            its = next((its for one, its in alike if one == whole), None)
            if its is None:
                alike.append((whole, [k]))
            else:
                its.append(k)
    found: dict[int, tuple[DiagnosisProblem, ReducedPlate]] = {}
    bare: BareModes | None = None
    first = files[0].specimen
    for _, group in alike:
        specimens = [s for k in group if isinstance(s := files[k].specimen, PlateSpecimen)]
        # The bare plate was struck as the first file's plate is held.
        held_alike = isinstance(first, PlateSpecimen) and specimens[0].edges == first.edges
        test = hammer if held_alike else None
        like = files[group[0]].like
        if len(group) > 1 and like is None:
            tested = [with_hammer(s, test) for s in specimens]
            bare = bare or tested[0][1]
            each = set_up_spots(
                [sweeps[k] for k in group], [s for s, _ in tested], progress, with_effects=with_effects
            )
            found |= dict(zip(group, each, strict=True))
            continue
        for k, s in zip(group, specimens, strict=True):
            ready = set_up(sweeps[k], s, test, progress, with_effects=with_effects, like=like)
            bare = bare or ready.bare
            found[k] = ready.problem, ready.reduced
    return found, bare
