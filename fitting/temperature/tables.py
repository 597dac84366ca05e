"""Modes as members of a fit over temperatures: those of one specimen at one temperature."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.catalogue_search import by_cost
from fitting.diagnosis.search.looks import Start, promising
from fitting.diagnosis.thresholds import STOPPING
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.errors import OutsideModel
from fitting.identification.adjusted import Adjusted
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.diagnose import visible
from fitting.mode_tables.explaining import Explaining
from fitting.mode_tables.fit import BegunModal, begin_modal, scaled
from fitting.mode_tables.member import Member
from fitting.mode_tables.problem import ModalProblem
from fitting.nuisances.nuisance import Nuisance
from fitting.widened.enriched_plate import EnrichedReducedPlate

_SIZES_PA, _LOSS = np.geomspace(1e4, 1e10, 25), 0.3
"""Moduli that a temperature's modes are compared with, to begin near it: from a gel to a glass."""
_BESIDE = 1.2
"""Times a frequency: one mode has a band too."""


@dataclass(frozen=True)
class AloneTable:
    """The modes of one specimen at one temperature by themselves."""

    begun: BegunModal

    @property
    def frequency_hz(self) -> Array:
        """Frequencies of the table's modes. Shape (modes,)."""
        return self.begun.problem.frequency_hz

    def leading(self, effects: Sequence[Effect], executor: Executor) -> list[Effect]:
        """As `members.Alone`."""
        work, none = Explaining(self.begun), self.begun.none
        seen = [e for e in effects if visible(self.begun.problem, e)]
        scored = [work.scored(f) for e in seen for form in work.forms(e) for f in work.fits(form, none)]
        scored.sort(key=by_cost)
        near = [s for s in scored if s.cost < scored[0].cost + STOPPING.cost_near_best]
        return [s.fitted.effects[0] for s in near]

    def beside(self, effect: Effect) -> "AloneTable":
        """As `members.Alone`."""
        b = self.begun
        fits = Explaining(b).fits(effect, b.none)
        u = np.concatenate([b.none.u, effect.starts(b.problem.members[0].wide, b.problem.points)[0]])
        found = (
            min(fits, key=by_chi2) if fits else refit(b.problem.response([effect]), b.evidence, b.none.law, u)
        )
        return replace(self, begun=replace(b, none=found))


def alone(member: Member, start: CoreLaw, *, scale_known: bool = True) -> AloneTable:
    """One member by itself, from a law scaled to its modes. Raises `OutsideModel`.

    A law may have more parameters than so few modes tell: what they leave open stays where it began.
    """
    problem = ModalProblem.of([member])
    return AloneTable(begin_modal(problem, _near(problem, start), scale_known=scale_known, however_few=True))


def _near(problem: ModalProblem, start: CoreLaw) -> CoreLaw:
    """The law that a fit begins with, of the modulus that comes nearest to the modes."""
    f = problem.frequency_hz
    evidence, z = problem.evidence().blunt(), np.zeros(len(problem.each))
    off = []
    for size in _SIZES_PA:
        try:
            v = problem.response().velocity(ConstantModulus(size, _LOSS), z)
        except OutsideModel:
            off.append(np.inf)
            continue
        off.append(float(np.sum(np.real(evidence.residuals(v)[: len(f)]) ** 2)))
    size = float(_SIZES_PA[int(np.argmin(off))])
    middle = np.array([2 * np.pi * np.exp(np.mean(np.log(f)))])
    law = scaled(start.plain, size / float(start.modulus(middle).real[0]))
    if not isinstance(start, BentLaw):
        return law
    return BentLaw.over(law, np.array([f.min() / _BESIDE, f.max() * _BESIDE]))


@dataclass(frozen=True)
class Tables:
    """Modes of all members side by side."""

    problem: ModalProblem
    specimens: tuple[int, ...]
    """The number of each member's."""
    scale_known: bool = True

    @classmethod
    def of(cls, begun: Sequence[BegunModal], specimens: Sequence[int] | None = None) -> Self:
        """From the fits of each by itself; `specimens` are their numbers, one for all by default."""
        numbers = tuple([1] * len(begun) if specimens is None else specimens)
        members = [m for b in begun for m in b.problem.members]
        known = all(b.evidence.scale_known for b in begun)
        return cls(ModalProblem.of(members, numbers), numbers, known)

    @property
    def lengths(self) -> tuple[int, ...]:
        """Modes of each member."""
        return tuple(len(m.table.mode) for m in self.problem.members)

    @property
    def bands_hz(self) -> list[tuple[float, float]]:
        """Of each member, from its lowest mode to its highest."""
        f = [m.table.frequency_hz for m in self.problem.members]
        return [(float(one.min()), float(one.max())) for one in f]

    @property
    def exact(self) -> bool:
        """Whether everything stated of all specimens is exact."""
        return all(m.specimen.exact for m in self.problem.members)

    @property
    def each(self) -> tuple[Nuisance, ...]:
        """As `members.Joined`."""
        return self.problem.each

    @property
    def places(self) -> tuple[NDArray[np.intp], ...]:
        """As `members.Joined`. Shape (its own,) each."""
        return self.problem.places

    @cached_property
    def evidence(self) -> Evidence:
        """Of all modes; what a theory gets wrong of one mode it gets wrong at every temperature alike."""
        plain = self.problem.evidence(scale_known=self.scale_known)
        return replace(plain, B=self._alike(len(plain.sigma_m_s)))

    def _alike(self, count: int) -> Array:
        """One column a cause, over the standard deviations of its readings. Shape (2 modes, causes)."""
        columns: dict[tuple[object, ...], Array] = {}

        def add(key: tuple[object, ...], rows: NDArray[np.intp], values: Array) -> None:
            columns.setdefault(key, np.zeros(2 * count))[rows] += values

        each = zip(self.problem.members, self.problem.parts, self.specimens, strict=True)
        for m, part, number in each:
            f_std, eta_std = m.std
            f_error, eta_error = (np.broadcast_to(e, f_std.shape) for e in m.own_error)
            at = np.arange(part.start, part.stop)
            for k, mode in enumerate(m.table.mode.tolist()):
                add(("f", number, mode), at[k : k + 1], f_error[k : k + 1] / f_std[k])
                add(("eta", number, mode), count + at[k : k + 1], eta_error[k : k + 1] / eta_std[k])
            for k, (f_off, eta_off) in enumerate(m.together):
                add(("together", number, k), at, f_off / f_std)
                add(("together", number, k), count + at, eta_off / eta_std)
            f_read, eta_read = (np.broadcast_to(e, f_std.shape) for e in m.otherwise)
            add(("read",), at, f_read / f_std)
            add(("read",), count + at, eta_read / eta_std)
        return np.array([c for c in columns.values() if c.any()] or [np.zeros(2 * count)]).T

    @property
    def points(self) -> Points:
        """As `members.Joined`."""
        return self.problem.points

    @property
    def plate(self) -> EnrichedReducedPlate:
        """The reduced plate of the first member."""
        return self.problem.members[0].wide

    def around(self, law: CoreLaw) -> Self:
        """These members: their matrices answer under any law."""
        return self

    def erring_at(self, law: CoreLaw) -> Self:
        """Each member's own error at a law: that of few modes by themselves is no place to ask."""
        return type(self)(self.problem.around(law), self.specimens, self.scale_known)

    def response(self, effects: Sequence[Effect]) -> Response:
        """Ln f + i kappa ln eta of all modes."""
        return self.problem.response(effects)

    def starts(self, effect: Effect, before: Refitted) -> list[Start]:
        """As `members.Joined`."""
        if not visible(self.problem, effect):
            return []
        response = self.response([*before.effects, effect])
        with np.errstate(all="ignore"):
            return promising(response, self.response(before.effects), self.points, self.evidence, before)

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """As `members.Joined`."""
        return self.problem.adjusted(z, errors)

    def modes(self, read: Complex) -> tuple[Array, Array]:
        """As `members.Joined`."""
        kappa = np.concatenate([m.kappa for m in self.problem.members])
        return np.exp(read.real), np.exp(read.imag / kappa)
