"""Several sweeps of several specimens under one law, each with its own matrices and channels.

The stated numbers of all members are the unknowns, those of the same thing once (`shared`). An effect stands
for all files or for one of them (`OfFiles`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.model_error import OfOnePlate, model_error, own_errors
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.problem.small_problem import BENT_MORE
from fitting.diagnosis.several import one_plate
from fitting.diagnosis.several.errors_between_files import alike, of_one_rig, own_cores, own_temperatures
from fitting.diagnosis.several.joining import joined, joined_points, parts_of, side_by_side
from fitting.diagnosis.several.member_laws import law_at
from fitting.diagnosis.several.mountings import mountings
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.one_plate import Taken
from fitting.diagnosis.several.shared_nuisances import SharedNuisances
from fitting.diagnosis.several.sharing import Places, shared, with_narrow
from fitting.diagnosis.several.wandering import Wandering
from fitting.errors import OutsideModel
from fitting.identification.adjusted import Adjusted
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep


def _by_what(files: Mapping[int, str]) -> str:
    """Which files have which, by their numbers: `absolute: file 1, 3; relative: file 2`."""
    each = {what: [str(n) for n, one in files.items() if one == what] for what in files.values()}
    return "; ".join(f"{what}: file {', '.join(numbers)}" for what, numbers in each.items())


@dataclass(frozen=True)
class SeveralProblem(DiagnosisProblem):
    """Members side by side: their points, one after the other."""

    members: tuple[DiagnosisProblem, ...]
    reduced: tuple[ReducedPlate | None, ...]
    places: Places
    """Of every member's stated numbers among all."""
    owners: tuple[tuple[int, ...], ...]
    """Members that each stated number belongs to."""
    belongs: tuple[Place, ...] = ()
    """File and spot of each member."""
    plates: one_plate.Plates = ()
    """Which of them are one plate, driven and read at several points."""
    wandering: Wandering | None = None
    """How far gain and phase wander, where files disagree beyond their noise."""
    taken: Taken = field(default_factory=Taken, init=False, compare=False, repr=False)

    @classmethod
    def of_members(
        cls,
        members: Sequence[DiagnosisProblem],
        reduced: Sequence[ReducedPlate | None],
        of: Sequence[Place] = (),
        *,
        stays: Sequence[int] | None = None,
        own_spots: bool = False,
    ) -> "SeveralProblem":
        """One problem of several, `of` these files, a file each by default.

        `stays`: of every member the first one whose specimen it is, which stayed where it is, spot and all;
        with `own_spots` all but the spot.
        Raises `OutsideModel` where they cannot be fitted together.
        """
        of = tuple(of) or tuple(Place(k + 1) for k in range(len(members)))
        reads = {of[k].file: m.points.reads for k, m in enumerate(members) if m.points.drive == "base"}
        if len(set(reads.values())) > 1:
            raise OutsideModel(
                f"some files read absolute, others relative to the base ({_by_what(reads)}), expected one of "
                "them: correct reads of [pickup] in their specimen files, or leave one kind out"
            )
        parts = {of[k].file: "phasors" if m.sweep.has_phase else "amplitudes" for k, m in enumerate(members)}
        if len(set(parts.values())) > 1:
            raise OutsideModel(
                f"some files hold phasors, others amplitudes ({_by_what(parts)}), expected one of them: give "
                "amplitudes alone in all of them, or leave one kind out"
            )
        if len({m.specimen.exact for m in members}) > 1:
            raise OutsideModel("some specimens are exact, others not, expected one of them")
        plates = one_plate.plates_of(members)
        mounted = mountings(members, plates) if stays is None else stays
        each, places, owners = shared(members, of, mounted, stays, own_spots=own_spots)
        sweep = joined([m.sweep for m in members])
        rational = side_by_side([m.rational for m in members])
        nodes = EveryPoint.at(sweep.omega)
        grid = NodeGrid(nodes, rational)
        first = members[0]
        return cls(
            sweep,
            first.specimen,
            first.plate,
            joined_points([m.points for m in members]),
            rational,
            grid,
            grid,
            nodes,
            SharedNuisances(first.nuisances.specimen, each, first=first.nuisances, places=places[0]),
            tuple(members),
            tuple(reduced),
            places,
            owners,
            of,
            plates,
        )

    def __getstate__(self) -> dict[str, object]:
        # Another process fits effects: the reduced plates have said by then what the model gets wrong.
        return {**vars(self), "reduced": ()}

    @property
    def starts_at(self) -> list[slice]:
        """Where each member's points are."""
        return parts_of([m.sweep for m in self.members])

    @property
    def file_of_points(self) -> NDArray[np.intp]:
        """Numbers of files, from 1. Shape (points,)."""
        return np.concatenate(
            [np.full(len(m.sweep), b.file) for m, b in zip(self.members, self.belongs, strict=True)]
        )

    @property
    def files_without_time(self) -> tuple[int, ...]:
        """As `DiagnosisProblem.files_without_time`."""
        each = [(m.points.timed, b.file) for m, b in zip(self.members, self.belongs, strict=True)]
        lacking = tuple(sorted({file for timed, file in each if not timed}))
        return lacking if any(timed for timed, _ in each) else ()

    @property
    def resonances(self) -> Complex:
        """Poles of all members, one member after another. Shape (poles,)."""
        return np.concatenate([m.resonances for m in self.members])

    @property
    def freedom(self) -> float:
        """As much as any member asks for, and more where files disagree."""
        return max(BENT_MORE if self.wandering is not None else 1.0, *(m.freedom for m in self.members))

    def condensed(self, law: CoreLaw, sides: Sequence[Array] = ()) -> "SeveralProblem":
        """Every member condensed."""
        laws = [law_at(law, k) for k in range(len(self.members))]
        members = one_plate.condensed(self.members, self.plates, laws)
        return replace(self, members=members, plate=members[0].plate)

    @property
    def with_stated_fixed(self) -> "SeveralProblem":
        """Itself."""
        return self

    def around(self, law: CoreLaw, poles: PlatePoles | None = None) -> "SeveralProblem":
        """Every member's grids made for a law."""
        laws = [law_at(law, k) for k in range(len(self.members))]
        return replace(self, members=one_plate.around(self.members, self.plates, laws))

    @property
    def errs_as_found(self) -> bool:
        """Where any member's does."""
        return any(m.errs_as_found for m in self.members)

    def with_narrow(self, law: CoreLaw, sweeps: Sequence[Sweep] = ()) -> Self:
        """Every member with those of its plate: alike in all its files, where they lie alike."""
        moved = one_plate.with_narrow(
            self.members, self.plates, [law_at(law, k) for k in range(len(self.members))]
        )
        if all(a is b for a, b in zip(moved, self.members, strict=True)):
            return self
        each, places, owners = with_narrow(self.nuisances.each, self.places, self.owners, moved, self.belongs)
        first = moved[0]
        return replace(
            self,
            plate=first.plate,
            nuisances=SharedNuisances(
                first.nuisances.specimen, each, first=first.nuisances, places=places[0]
            ),
            members=moved,
            places=places,
            owners=owners,
        )

    def as_found(self, z: Array) -> "SeveralProblem":
        """Every member with its own. `z` of shape (numbers,)."""
        each = zip(self.members, self.places, strict=True)
        return replace(self, members=tuple(m.as_found(np.asarray(z)[at]) for m, at in each))

    def model_error(self, law: CoreLaw, v: Complex) -> Complex:
        """Each member's own, those of one plate's theory together. Shape (any, points)."""
        rows, theory = [], OfOnePlate(len(v))
        each = zip(self.members, self.reduced, self.starts_at, strict=True)
        for k, (m, reduced, part) in enumerate(each):
            if reduced is not None and isinstance(m.specimen, PlateSpecimen):
                found = own_errors(m, reduced, law_at(law, k), v[part])
                theory.add(m.specimen, part, found)
                own = found.of_channels
            else:
                own = model_error(m, reduced, law_at(law, k), v[part])
            block = np.zeros((len(own), len(v)), complex)
            block[:, part] = own
            rows.append(block)
        rows += [theory.rows, own_temperatures(self.members, self.belongs, law, v) * v]
        if self.wandering is not None:
            rows.append(self.wandering.rows(np.log(self.sweep.frequency_hz), self.file_of_points, v))
            rows.append(own_cores(self.members, law, v) * v)
        elif (size := alike(self.members, self.belongs)) > 0:
            rows.append(size * np.array([v, 1j * v]))
        rows.append(of_one_rig(self.members, self.belongs) * v)
        return np.concatenate(rows)

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """Under the names of `nuisances`; each as its first owner states it. Shape (numbers,)."""
        found = []
        for k, n in enumerate(self.nuisances.each):
            owner = self.members[self.owners[k][0]]
            own = replace(n, name=n.name.split(" [")[0])
            (one,) = replace(owner, nuisances=replace(owner.nuisances, each=(own,))).adjusted(
                z[k : k + 1], errors[k : k + 1]
            )
            found.append(replace(one, name=n.name))
        return tuple(found)
