"""What a fit over temperatures asks of data, whatever they are: one temperature by itself, and all together.

A member is what was measured of one specimen at one temperature: a sweep (`sweeps.py`), or its modes
(`tables.py`).
"""

from collections.abc import Sequence
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.looks import Start
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.identification.adjusted import Adjusted
from fitting.laws import CoreLaw
from fitting.nuisances.nuisance import Nuisance
from fitting.widened.enriched_plate import EnrichedReducedPlate


class Begun(Protocol):
    """A fit without effects of one member."""

    @property
    def problem(self) -> Any:
        """Its data with its specimen."""

    @property
    def evidence(self) -> Evidence:
        """What its readings are worth."""

    @property
    def none(self) -> Refitted:
        """Law and stated numbers."""


class Alone(Protocol):
    """One member by itself."""

    @property
    def begun(self) -> Begun:
        """Its fit without effects, or with what was put beside it."""

    @property
    def frequency_hz(self) -> Array:
        """Where it was measured. Shape (points,)."""

    def leading(self, effects: Sequence[Effect], executor: Executor) -> list[Effect]:
        """Effects beside which its own law explains it best, the best first."""

    def beside(self, effect: Effect) -> "Alone":
        """Its fit with an effect, what its model gets wrong asked there."""


class Joined(Protocol):
    """All members side by side."""

    @property
    def lengths(self) -> tuple[int, ...]:
        """Points of each."""

    @property
    def bands_hz(self) -> list[tuple[float, float]]:
        """Of each, from its lowest frequency to its highest."""

    @property
    def exact(self) -> bool:
        """Whether everything that is stated is."""

    @property
    def each(self) -> tuple[Nuisance, ...]:
        """The stated numbers, those of the same thing once."""

    @property
    def places(self) -> tuple[NDArray[np.intp], ...]:
        """Of every member's own among them. Shape (its own,) each."""

    @property
    def evidence(self) -> Evidence:
        """What all readings are worth."""

    @property
    def points(self) -> Points:
        """What effects may ask of data."""

    @property
    def plate(self) -> EnrichedReducedPlate:
        """What effects may ask of the specimen."""

    def around(self, law: CoreLaw) -> Self:
        """These members, ready to answer near a law."""

    def erring_at(self, law: CoreLaw) -> Self:
        """These members, the model's error asked at a law."""

    def response(self, effects: Sequence[Effect]) -> Response:
        """What all members read under some effects."""

    def starts(self, effect: Effect, before: Refitted) -> list[Start]:
        """Of one form of an effect beside a fit, with what each promises; the best first."""

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """The stated numbers as a fit has them, in standard deviations. Shape (numbers,) each."""

    def modes(self, read: Complex) -> tuple[Array, Array]:
        """Frequencies in Hz and loss factors that a response says; none of sweeps. Shape (modes,) each."""
