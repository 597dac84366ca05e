"""Tables and specimens under one law, as the machinery of a sweep's fit takes them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.data.readings import Readings
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.diagnosis.several.member_laws import by_all, law_at
from fitting.diagnosis.several.of_files import Place, inner_of, own_unknowns
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.identification.adjusted import Adjusted, adjusted
from fitting.laws import CoreLaw
from fitting.mode_tables.build import with_own_error
from fitting.mode_tables.member import Member
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances
from fitting.stated.tolerances import of_scope

OF_EACH_TABLE = frozenset(of_scope("specimen", "mounting")) - {"place"}
"""Kinds of stated numbers that are another one in every specimen's table, though they are stated alike.

Where a mass sits is one number of all tables, as far as it is stated alike.
"""
_STEP = 1e-4
"""Of differences, of an unknown's typical size."""


@dataclass(frozen=True)
class ModalProblem:
    """Members side by side."""

    members: tuple[Member, ...]
    each: tuple[Nuisance, ...]
    """The stated numbers, those of the same thing once."""
    places: tuple[NDArray[np.intp], ...]
    """Of every member's own among them."""

    @classmethod
    def of(cls, members: Sequence[Member], specimens: Sequence[int] | None = None) -> "ModalProblem":
        """Numbers that are stated alike, value and tolerance, are one.

        `specimens`: of every member the number of its specimen; one of its own where nothing is said.
        """
        numbers = list(range(1, len(members) + 1)) if specimens is None else list(specimens)
        each: list[Nuisance] = []
        keys: dict[tuple[object, ...], int] = {}
        places = []
        for table, (m, specimen) in enumerate(zip(members, numbers, strict=True), 1):
            at = []
            for n in m.stated.each:
                whose = None
                if n.kind in OF_EACH_TABLE and len(set(numbers)) > 1:
                    whose = specimen
                elif n.kind in of_scope("temperature") and len(members) > 1:
                    whose = table
                alike = (n.name, n.sigma, _as_stated(m, n).stated)
                key = alike if whose is None else (n.name, whose)
                if key not in keys:
                    keys[key] = len(each)
                    each.append(n if whose is None else replace(n, name=f"{n.name} [{whose}]"))
                at.append(keys[key])
            places.append(np.array(at, dtype=np.intp))
        return cls(tuple(members), tuple(each), tuple(places))

    @property
    def frequency_hz(self) -> Array:
        """Frequencies of the modes of all members, one member after another. Shape (modes,)."""
        return np.concatenate([m.table.frequency_hz for m in self.members])

    @property
    def points(self) -> Points:
        """What effects may ask of data: nothing but the frequencies."""
        omega = 2 * np.pi * self.frequency_hz
        return Points(omega, np.ones(len(omega)), np.zeros(len(omega)), False, True, "relative")

    @property
    def parts(self) -> list[slice]:
        """Where each member's modes are."""
        ends = np.cumsum([len(m.table.mode) for m in self.members])
        return [slice(int(e) - len(m.table.mode), int(e)) for e, m in zip(ends, self.members, strict=True)]

    @property
    def scale_known(self) -> bool:
        """Whether every table states how well its numbers are known."""
        return all(m.table.states_its_noise for m in self.members)

    def around(self, law: CoreLaw) -> "ModalProblem":
        """With the members' own errors at a law."""
        each = enumerate(self.members)
        return replace(self, members=tuple(with_own_error(m, law_at(law, k)) for k, m in each))

    def evidence(self, *, scale_known: bool = True) -> Evidence:
        """The readings and what each is worth, ln f + i kappa ln eta."""
        measured = np.concatenate([m.measured for m in self.members])
        sigma = np.concatenate([m.std[0] for m in self.members])
        each = [[m.together[:, k].T / m.std[k][:, None] for m in self.members] for k in (0, 1)]
        B = np.vstack([la.block_diag(*one) for one in each])
        B = np.column_stack([B, np.zeros(len(B))])
        # One lab has read all of them alike.
        read = [np.broadcast_to(m.otherwise, (2, len(m.table.mode))) / m.std for m in self.members]
        B[:, -1] = np.hstack(read).ravel()
        # The usual errors, where none are stated, may be too small; a handful of modes met well says no more.
        return Evidence(Readings(measured), sigma, sigma, B, scale_known, least_scale=1.0)

    def response(self, effects: Sequence[Effect] = ()) -> "ModalResponse":
        """What the modes are under some effects."""
        return ModalResponse(self, effects)

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """The stated numbers as a fit has them, in standard deviations. Shape (stated numbers,) each."""
        found = []
        for k, one in enumerate(self.each):
            owner = next(m for m, at in zip(self.members, self.places, strict=True) if k in at)
            plain = replace(one, name=one.name.split(" [")[0])
            (as_found,) = adjusted(owner.specimen, [plain], z[k : k + 1], errors[k : k + 1])
            found.append(replace(as_found, name=one.name))
        return tuple(found)


class ModalResponse:
    """Modes of all members in the place of phasors: a `Response`."""

    derivatives_cost_extra: ClassVar[bool] = False

    def __init__(self, problem: ModalProblem, effects: Sequence[Effect]) -> None:
        self.modal, self.effects = problem, tuple(effects)
        self.plate = problem.members[0].system([inner_of(e) for e in effects])
        self.nuisances = Nuisances(problem.members[0].stated.specimen, problem.each)
        self._unknowns = Unknowns(len(problem.each), effects)
        self.parameters = self._unknowns.parameters

    def velocity(self, law: CoreLaw, u: Array) -> Complex:
        """Ln f + i kappa ln eta, member after member. Shape (modes,)."""
        found = []
        for k, (m, at) in enumerate(zip(self.modal.members, self.modal.places, strict=True)):
            acting = [(e, u[part]) for e, part in self._acting(k)]
            found.append(m.logs(law_at(law, k), u[at], acting))
        return np.concatenate(found)

    def signatures(self, law: CoreLaw, known: Array, starts: Sequence[Array]) -> Complex:
        """What the last effect changes as it comes in. Shape (starts, modes)."""
        plain = self.modal.response(self.effects[:-1]).velocity(law, known)
        return np.array([self.velocity(law, np.concatenate([known, u])) - plain for u in starts])

    def with_derivatives(self, law: CoreLaw, u: Array) -> tuple[Complex, Complex]:
        """The same, and derivatives to the law's log parameters and to `u`. Shape (numbers, modes)."""
        n = len(law.names)
        found, rows = [], np.zeros((n + len(u), len(self.modal.frequency_hz)), complex)
        every = zip(self.modal.members, self.modal.places, self.modal.parts, strict=True)
        for k, (m, at, here) in enumerate(every):
            acting = [(e, part) for e, part in self._acting(k)]
            steps = [self._steps(part, u) for _, part in acting]
            own = law_at(law, k)
            v, dv = m.with_derivatives(own, u[at], [(e, u[part]) for e, part in acting], steps)
            found.append(v)
            where = np.concatenate([at, *(part for _, part in acting)]).astype(np.intp)
            of_law = len(own.names)
            rows[:n, here] = by_all(law, k, dv[:of_law])
            rows[n + where, here] = dv[of_law:]
        return np.concatenate(found), rows

    def _acting(self, k: int) -> list[tuple[Effect, NDArray[np.intp]]]:
        """Effects on a member that change its matrices, and the places of their unknowns."""
        found = []
        for e, its in zip(self.effects, self._unknowns.slices, strict=True):
            own, of = own_unknowns(e, Place(k + 1)), inner_of(e)
            if own is not None and not of.replaces_law:
                found.append((of, its.start + own))
        return found

    def _steps(self, part: NDArray[np.intp], u: Array) -> Array:
        q = [self.parameters[n] for n in part]
        return np.array(
            [_STEP * (abs(u[n]) if p.logarithmic else p.typical or 1.0) for n, p in zip(part, q, strict=True)]
        )


def _as_stated(member: Member, one: Nuisance) -> Adjusted:
    nothing = np.zeros(1)
    (found,) = adjusted(member.specimen, [one], nothing, nothing)
    return found
