"""Several sweeps of several specimens under one law, each with its own matrices and channels.

The stated numbers of all members are the unknowns, those of the same thing once (`shared`). An effect stands
for all files or for one of them (`OfFiles`).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid, spans_of
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.model_error import OfOnePlate, model_error, own_errors
from fitting.diagnosis.problem.plate_answer import motions
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.problem.small_problem import BENT_MORE, LEVEL, SmallProblem
from fitting.diagnosis.response.strains import Reference
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.response.unknowns import STATED_NUMBER
from fitting.diagnosis.several import one_plate
from fitting.diagnosis.several.joining import joined, joined_points, side_by_side
from fitting.diagnosis.several.member_laws import by_all, law_at
from fitting.diagnosis.several.mountings import mountings
from fitting.diagnosis.several.of_files import Place, inner_of, own_unknowns
from fitting.diagnosis.several.one_plate import Taken
from fitting.diagnosis.several.one_rig import alike_rows
from fitting.diagnosis.several.sharing import Places, shared, with_narrow
from fitting.diagnosis.several.wandering import Wandering
from fitting.effects.base import Effect
from fitting.effects.temperature_drift import time_scale
from fitting.errors import OutsideModel
from fitting.identification.adjusted import Adjusted
from fitting.identification.validation import rms
from fitting.laws import CoreLaw
from fitting.nuisances.nuisances import Nuisances
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlacedMass, Specimen
from fitting.sweep import Sweep

KELVIN = 0.1
"""Standard deviation of how much warmer a core is in one file than in another where nobody took care."""


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
    ) -> "SeveralProblem":
        """One problem of several, `of` these files, a file each by default.

        `stays`: of every member the first one whose specimen it is, which stayed where it is, spot and all.
        Raises `OutsideModel` where they cannot be fitted together.
        """
        of = tuple(of) or tuple(Place(k + 1) for k in range(len(members)))
        if len({m.points.reads for m in members if m.points.drive == "base"}) > 1:
            raise OutsideModel("some files read absolute, others relative to the base, expected one of them")
        if len({m.sweep.has_phase for m in members}) > 1:
            raise OutsideModel("some files hold phasors, others amplitudes, expected one of them")
        if len({m.specimen.exact for m in members}) > 1:
            raise OutsideModel("some specimens are exact, others not, expected one of them")
        plates = one_plate.plates_of(members)
        mounted = mountings(members, plates) if stays is None else stays
        each, places, owners = shared(members, of, mounted, stays)
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
        ends = np.cumsum([len(m.sweep) for m in self.members])
        return [slice(int(e) - len(m.sweep), int(e)) for e, m in zip(ends, self.members, strict=True)]

    @property
    def file_of_points(self) -> NDArray[np.intp]:
        """Numbers of files, from 1. Shape (points,)."""
        return np.concatenate(
            [np.full(len(m.sweep), b.file) for m, b in zip(self.members, self.belongs, strict=True)]
        )

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
            if reduced is not None and isinstance(m.specimen, Specimen):
                found = own_errors(m, reduced, law_at(law, k), v[part])
                theory.add(m.specimen, part, found)
                own = found.of_channels
            else:
                own = model_error(m, reduced, law_at(law, k), v[part])
            block = np.zeros((len(own), len(v)), complex)
            block[:, part] = own
            rows.append(block)
        rows += [theory.rows, self.own_temperatures(law, v) * v]
        if self.wandering is not None:
            rows.append(self.wandering.rows(np.log(self.sweep.frequency_hz), self.file_of_points, v))
            rows.append(self.own_cores(law, v) * v)
        elif (alike := self.alike) > 0:
            rows.append(alike * np.array([v, 1j * v]))
        rows.append(self.of_one_rig * v)
        return np.concatenate(rows)

    @property
    def of_one_rig(self) -> Complex:
        """Gain and delay that all masses of a shear pair have in common, besides each file's own.

        The same two accelerometers read them. Relative, one standard deviation each; shape (any, points).
        """
        pairs = all(m.specimen.kind == "shear-pair" for m in self.members)
        if not pairs or len({b.file for b in self.belongs}) < 2:
            return np.zeros((0, len(self.sweep)), complex)
        # The angle is one stated number of all of them.
        return alike_rows(self.members, ("gain", "delay"))

    def own_temperatures(self, law: CoreLaw, v: Complex) -> Complex:
        """What a core by `KELVIN` warmer in one file than in the others does to ln of the reading.

        Shape (files, points); none of specimens that are exactly as stated.
        """
        files = sorted({b.file for b in self.belongs})
        rows = np.zeros((len(files), len(v)), complex)
        if self.specimen.exact or len(files) < 2:
            return rows[:0]
        for k, (m, b, part) in enumerate(zip(self.members, self.belongs, self.starts_at, strict=True)):
            own, omega = law_at(law, k), m.sweep.omega
            change = np.log(own.modulus(omega * time_scale(KELVIN)) / own.modulus(omega))
            rows[files.index(b.file), part] = change * m.feels(own, v[part])
        return rows

    def own_cores(self, law: CoreLaw, v: Complex) -> Complex:
        """What a core a little stiffer in one file than in the others does to ln of the reading, by `LEVEL`.

        No two files are at one temperature. Of members that are small. Shape (members, points).
        """
        rows = np.zeros((len(self.members), len(v)), complex)
        for k, (m, part) in enumerate(zip(self.members, self.starts_at, strict=True)):
            if isinstance(m, SmallProblem):
                rows[k, part] = LEVEL * m.feels(law_at(law, k), v[part])
        return rows

    @property
    def alike(self) -> float:
        """Gain and phase that all files have in common may be off by so much: as the files' misfit is.

        The same accelerometers have read every one of them. Zero where noise explains the files, and of one
        file alone, whose law would hide it.
        """
        misfits = [m.misfit for m in self.members if isinstance(m, SmallProblem)]
        files = {b.file for b in self.belongs}
        return rms(np.array(misfits)) if len(files) > 1 and len(misfits) == len(self.members) else 0.0

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


@dataclass(frozen=True)
class SharedNuisances(Nuisances):
    """Of all files; a hammer test is of the first one's bare plate."""

    first: Nuisances = field(kw_only=True, compare=False)
    places: NDArray[np.intp] = field(kw_only=True, compare=False)
    """Of the first file's among all."""

    @property
    def masses(self) -> tuple[PlacedMass, ...]:
        """Those placed on the first file's plate."""
        return self.first.masses

    @cached_property
    def of_bare_plate(self) -> list[int]:
        """Those that a hammer test of the bare plate feels."""
        return [int(self.places[k]) for k in self.first.of_bare_plate]

    def bare_coefficients(self, z: Array) -> tuple[Array | Complex, Array]:
        """As `Nuisances.bare_coefficients`, of the first file's plate."""
        return self.first.bare_coefficients(z[self.places])


class SeveralResponse:
    """What all members read under one law: a `Response`."""

    derivatives_cost_extra: ClassVar[bool] = True

    def __init__(self, problem: SeveralProblem, effects: Sequence[Effect], *, coarse: bool = False) -> None:
        self.problem = problem
        self.effects, self.nuisances, self.plate = tuple(effects), problem.nuisances, problem.plate
        count = len(self.nuisances)
        self.parameters = (*(STATED_NUMBER,) * count, *(q for e in effects for q in e.parameters))
        self._of_member: list[tuple[SweepResponse, NDArray[np.intp]]] = []
        # One core, whatever is made of it: what softens it at a strain does so in every file.
        reference = Reference()
        for k, m in enumerate(problem.members):
            places, inner, start = [problem.places[k]], [], count
            for e in effects:
                own = own_unknowns(e, problem.belongs[k])
                if own is not None:
                    inner.append(inner_of(e))
                    places.append(start + own)
                start += len(e.parameters)
            number = problem.plates[k]
            plate = None
            if problem.plates.count(number) > 1:
                plate = problem.taken.of(number, m, spans_of(m, inner))
            response = SweepResponse(m, inner, m.coarse if coarse else None, plate, reference)
            self._of_member.append((response, np.concatenate(places)))

    def each(self, law: CoreLaw, u: Array) -> Iterator[tuple[SweepResponse, CoreLaw, Array]]:
        """Of every member the response, its own law and its own unknowns. `u` of shape (unknowns,)."""
        for k, (response, at) in enumerate(self._of_member):
            yield response, law_at(law, k), u[at]

    def _solve(self, law: CoreLaw, u: Array) -> None:
        """What several members ask of one plate, all at once."""
        plates = self.problem.plates
        for number in {k for k in plates if plates.count(k) > 1}:
            its = [
                (r, law_at(law, k), u[at]) for k, (r, at) in enumerate(self._of_member) if plates[k] == number
            ]
            asked = [(r, v, one) for r, own, v in its if (one := r.asked(own, v))]
            for (r, v, one), moved in zip(asked, motions([one for *_, one in asked]), strict=True):
                r.know(one, moved, v)

    def velocity(self, law: CoreLaw, u: Array) -> Complex:
        """Phasors in m/s, member after member. Shape (points,)."""
        self._solve(law, u)
        return np.concatenate(
            [r.velocity(law_at(law, k), u[at]) for k, (r, at) in enumerate(self._of_member)]
        )

    def with_derivatives(self, law: CoreLaw, u: Array) -> tuple[Complex, Complex]:
        """As `Response.with_derivatives`, member after member. Shapes (points,), (parameters, points)."""
        n = len(law.names)
        self._solve(law, u)
        found, rows = [], np.zeros((n + len(u), len(self.problem.sweep)), complex)
        each = zip(self._of_member, self.problem.starts_at, strict=True)
        for k, ((response, at), part) in enumerate(each):
            own = law_at(law, k)
            v, dv = response.with_derivatives(own, u[at])
            found.append(v)
            of_law = len(own.names)
            rows[:n, part] = by_all(law, k, dv[:of_law])
            rows[n + at, part] = dv[of_law:]
        return np.concatenate(found), rows

    def signatures(self, law: CoreLaw, known: Array, starts: Sequence[Array]) -> Complex:
        """As `SweepResponse.signatures`, of every member that has the last effect. Shape (starts, points)."""
        found = np.zeros((len(starts), len(self.problem.sweep)), complex)
        count = len(self.nuisances) + sum(len(e.parameters) for e in self.effects[:-1])
        each = zip(self._of_member, self.problem.starts_at, strict=True)
        for k, ((response, at), part) in enumerate(each):
            own = at[at < count]
            if len(own) < len(at):
                its = [u[at[len(own) :] - count] for u in starts]
                found[:, part] = response.signatures(law_at(law, k), known[own], its)
        return found
