"""What a fit asks of a response, whatever is read: one sweep, several, or modes."""

from collections.abc import Sequence
from typing import ClassVar, Protocol, runtime_checkable

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.laws import CoreLaw
from fitting.nuisances.nuisances import Nuisances
from fitting.widened.enriched_plate import EnrichedReducedPlate


@runtime_checkable
class Response(Protocol):
    """Readings under a law and effects.

    `u` holds the stated numbers in standard deviations, then the effects' unknowns, one after the other.
    """

    derivatives_cost_extra: ClassVar[bool]
    """Whether readings come for less without derivatives, and these then for the rest."""
    effects: tuple[Effect, ...]
    parameters: tuple[EffectParameter, ...]
    """Of every entry of `u`."""
    nuisances: Nuisances
    plate: EnrichedReducedPlate
    """That limits of effects are asked of."""

    def velocity(self, law: CoreLaw, u: Array) -> Complex:
        """Phasors in m/s, or what stands for them. Shape (points,)."""
        ...

    def with_derivatives(self, law: CoreLaw, u: Array) -> tuple[Complex, Complex]:
        """The same, and derivatives to log parameters and then to `u`. Shape (parameters, points)."""
        ...

    def signatures(self, law: CoreLaw, known: Array, starts: Sequence[Array]) -> Complex:
        """What the last effect changes as it comes in; `known` are the unknowns of the others.

        Shape (starts, points).
        """
        ...
