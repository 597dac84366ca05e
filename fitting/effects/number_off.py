"""A stated number of a small structure far off: what a factor on it changes. No effect by itself.

A plate's effects of this kind are solved for with the matrices of another plate (`other_plates.py`); a small
structure knows its matrices by what is stated.
"""

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect
from fitting.effects.form import taken_over
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span


@runtime_checkable
class KnowsItsNumbers(Protocol):
    """A structure whose matrices follow from coefficients of what is stated."""

    def moved(self, by: Mapping[str, float]) -> Change:
        """What it becomes with some numbers moved, relative ones in the logarithm."""


def changed_by_numbers(plate: EnrichedReducedPlate, by: Mapping[str, float]) -> Change:
    """What a structure becomes with some stated numbers moved."""
    assert isinstance(plate, KnowsItsNumbers)
    return plate.moved(by)


class FacesApart(Span):
    """Faces of a beam whose stiffness is in another proportion."""

    name = "faces"


class NumberOffEffect(Effect):
    """`inner` as a factor on one stated number of a beam."""

    def __init__(self, inner: Effect, number: str, needs: frozenset[str] = frozenset()) -> None:
        """`needs` as `Effect.needs`."""
        self.inner, self.number = inner, number
        vars(self).update(
            taken_over(inner),
            parameters=inner.parameters,
            needs=needs,
            spans=() if number.startswith("core") or number.endswith("density") else (FacesApart(),),
        )

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_by_numbers(plate, {self.number: float(np.log(u[0]))})

    def story(self, u: Mapping[str, float]) -> str:
        return self.inner.story(u)
