"""What several files read under one law, each with its own matrices and channels."""

from collections.abc import Iterator, Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import spans_of
from fitting.diagnosis.problem.plate_answer import motions
from fitting.diagnosis.response.strains import Reference
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.diagnosis.several.member_laws import by_all, law_at
from fitting.diagnosis.several.of_files import inner_of, own_unknowns
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.effects.base import Effect
from fitting.laws import CoreLaw


class SeveralResponse:
    """What all members read under one law: a `Response`."""

    derivatives_cost_extra: ClassVar[bool] = True

    def __init__(self, problem: SeveralProblem, effects: Sequence[Effect], *, coarse: bool = False) -> None:
        self.problem = problem
        self.effects, self.nuisances, self.plate = tuple(effects), problem.nuisances, problem.plate
        unknowns = Unknowns(len(self.nuisances), effects)
        self.parameters = unknowns.parameters
        self._of_member: list[tuple[SweepResponse, NDArray[np.intp]]] = []
        # One core, whatever is made of it: what softens it at a strain does so in every file.
        reference = Reference()
        for k, m in enumerate(problem.members):
            places, inner = [problem.places[k]], []
            for e, part in zip(unknowns.effects, unknowns.slices, strict=True):
                own = own_unknowns(e, problem.belongs[k])
                if own is not None:
                    inner.append(inner_of(e))
                    places.append(part.start + own)
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
