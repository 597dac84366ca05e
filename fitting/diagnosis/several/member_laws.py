"""The laws of several sweeps in one: each sweep has its own, all of them have one set of parameters."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw


@dataclass(frozen=True)
class MemberLaws(CoreLaw):
    """What a `SeveralProblem` is fitted with where its members do not share one law."""

    def at(self, member: int) -> CoreLaw:
        """The law that holds for one member."""
        raise NotImplementedError

    def chain(self, member: int) -> Array:
        """Derivatives of that law's log parameters to those of this one. Shape (its names, names)."""
        raise NotImplementedError

    @property
    def lengths(self) -> tuple[int, ...]:
        """How many points each member has."""
        raise NotImplementedError

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa of every member at its own points, one after the other. Shape (all points,)."""
        parts = np.split(np.asarray(omega), np.cumsum(self.lengths)[:-1])
        return np.concatenate([self.at(k).modulus(w) for k, w in enumerate(parts)])


def law_at(law: CoreLaw, member: int) -> CoreLaw:
    """The law of one member: its own, or the one of all."""
    return law.at(member) if isinstance(law, MemberLaws) else law


def by_all(law: CoreLaw, member: int, dv: Complex) -> Complex:
    """Derivatives to a member's log parameters as those to the parameters of all. Shape (any, points)."""
    return law.chain(member).T @ dv if isinstance(law, MemberLaws) else dv
