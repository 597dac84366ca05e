"""Sweeps as members of a fit over temperatures: of a plate, a beam or a shear pair."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.data.noise import Noise
from fitting.data.readings import Readings
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.candidates import CandidateFit
from fitting.diagnosis.search.catalogue_search import Search
from fitting.diagnosis.search.looks import Start, look
from fitting.diagnosis.search.singles import Singles
from fitting.diagnosis.several.one_rig import alike_rows
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.thresholds import STOPPING
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.identification.adjusted import Adjusted
from fitting.laws import CoreLaw
from fitting.nuisances.nuisance import Nuisance
from fitting.progress import unheard
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.widened.enriched_plate import EnrichedReducedPlate


@dataclass(frozen=True)
class AloneSweep:
    """One sweep by itself, and what its fit was made with."""

    begun: Begun
    reduced: ReducedPlate | None
    """None of what is no plate."""
    noise: Noise

    @property
    def frequency_hz(self) -> Array:
        """Frequencies of the sweep's points. Shape (points,)."""
        return self.begun.problem.sweep.frequency_hz

    def leading(self, effects: Sequence[Effect], executor: Executor) -> list[Effect]:
        """As `members.Alone`."""
        b = self.begun
        search = Search(b.problem, b.evidence, b.none, effects, executor)
        singles = Singles(search, unheard).best()
        near = [s for s in singles if s.cost < singles[0].cost + STOPPING.cost_near_best]
        return [s.fitted.effects[0] for s in near]

    def beside(self, effect: Effect) -> "AloneSweep":
        """As `members.Alone`, the model's error made for what it then predicts."""
        b = self.begun
        candidate = CandidateFit(b.problem, b.evidence, b.none, effect)
        rough = min([*candidate.fit_near()[:1], *candidate.fit_far()[:1]], key=by_chi2)
        found = candidate.finished(rough)
        problem, v = b.problem.around(found.law), found.velocity_m_s
        wrong = model_error(problem, self.reduced, found.law, v)
        evidence = Evidence.of(problem.sweep, self.noise, wrong, v, b.evidence.bare)
        none = refit(response_of(problem, [effect]), evidence, found.law, found.u)
        return replace(self, begun=replace(b, problem=problem, evidence=evidence, none=none))


@dataclass(frozen=True)
class Sweeps:
    """Sweeps side by side, each with its model's error already."""

    problem: SeveralProblem
    evidence: Evidence

    @classmethod
    def of(
        cls, begun: Sequence[Begun], specimens: Sequence[int] | None = None, *, own_spots: bool = False
    ) -> Self:
        """From the fits of each by itself; `specimens` are their numbers, one for all by default.

        With `own_spots` the laser was aimed anew at each sweep of a specimen.
        """
        numbers = [1] * len(begun) if specimens is None else list(specimens)
        stays = [numbers.index(k) for k in numbers]
        members = [b.problem for b in begun]
        problem = SeveralProblem.of_members(members, [None] * len(begun), stays=stays, own_spots=own_spots)
        return cls(problem, _alike(_side_by_side(begun), begun))

    @property
    def lengths(self) -> tuple[int, ...]:
        """Points of each sweep."""
        return tuple(len(m.sweep) for m in self.problem.members)

    @property
    def bands_hz(self) -> list[tuple[float, float]]:
        """Lowest and highest frequency of each sweep."""
        f = [m.sweep.frequency_hz for m in self.problem.members]
        return [(float(one.min()), float(one.max())) for one in f]

    @property
    def exact(self) -> bool:
        """Whether everything stated of the specimens, which are alike, is exact."""
        return self.problem.specimen.exact

    @property
    def each(self) -> tuple[Nuisance, ...]:
        """As `members.Joined`."""
        return self.problem.nuisances.each

    @property
    def places(self) -> tuple[NDArray[np.intp], ...]:
        """As `members.Joined`. Shape (its own,) each."""
        return self.problem.places

    @property
    def points(self) -> Points:
        """As `members.Joined`."""
        return self.problem.points

    @property
    def plate(self) -> EnrichedReducedPlate:
        """The reduced plate of the first sweep."""
        return self.problem.plate

    def around(self, law: CoreLaw) -> Self:
        """Grids made for a law."""
        return replace(self, problem=self.problem.around(law))

    def erring_at(self, law: CoreLaw) -> Self:
        """These members: each has its model's error from its own law, which a sweep tells well."""
        return self

    def response(self, effects: Sequence[Effect]) -> Response:
        """Phasors of all sweeps."""
        return response_of(self.problem, effects)

    def starts(self, effect: Effect, before: Refitted) -> list[Start]:
        """As `members.Joined`."""
        return look(self.problem, self.evidence, before, effect)

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """As `members.Joined`."""
        return self.problem.adjusted(z, errors)

    def modes(self, read: Complex) -> tuple[Array, Array]:
        """None."""
        return np.zeros(0), np.zeros(0)


def _alike(evidence: Evidence, begun: Sequence[Begun]) -> Evidence:
    """With a gain, a delay and a phase that all sweeps have in common besides each one's own: of one rig."""
    v = np.concatenate([b.none.velocity_m_s for b in begun])
    felt = alike_rows([b.problem for b in begun], ("gain", "delay", "phase")) * v
    if not len(felt) or not evidence.scale_known:
        return evidence
    return replace(evidence, B=np.hstack([evidence.B, evidence.over_sigma(v, felt).T]))


def _side_by_side(begun: Sequence[Begun]) -> Evidence:
    """What all readings are worth; the hammer test, which is the same for all, once."""
    each = [b.evidence for b in begun]
    parts = 2 if each[0].has_phase else 1
    points = [len(e.sigma_m_s) for e in each]
    starts = np.concatenate([[0], np.cumsum(points)])
    B = np.zeros((parts * starts[-1], sum(e.B.shape[1] for e in each)))
    column = 0
    for e, start in zip(each, starts, strict=False):
        n, m = len(e.sigma_m_s), e.B.shape[1]
        for part in range(parts):
            rows = slice(part * starts[-1] + start, part * starts[-1] + start + n)
            B[rows, column : column + m] = e.B[part * n : (part + 1) * n]
        column += m
    return Evidence(
        Readings(np.concatenate([e.measured_m_s for e in each])),
        np.concatenate([e.sigma_m_s for e in each]),
        np.concatenate([e.noise_m_s for e in each]),
        B,
        all(e.scale_known for e in each),
        each[0].bare,
    )
