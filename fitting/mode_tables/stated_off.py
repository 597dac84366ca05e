"""A stated number of a beam that is off by more than its tolerance; plates have effects for it."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.structures import AnySpecimen
from fitting.structures.beam import Beam

NUMBERS = {
    "substrate_stiffness": "substrate_young",
    "constraining_stiffness": "constraining_young",
    "constraining_thickness": "constraining_thickness",
    "core_thickness": "core_thickness",
}
"""Effects by a factor on one number, and the number."""

# ruff: noqa: D102 -- the hooks are described in base.py


class StatedNumberOffEffect(Effect):
    """`inner`'s factor on a number of a beam."""

    def __init__(self, inner: Effect, beam: Beam) -> None:
        self.inner, self.beam = inner, beam
        vars(self).update(
            name=inner.name,
            enters=inner.enters,
            source=inner.source,
            chance=inner.chance,
            discriminating_test=inner.discriminating_test,
            parameters=inner.parameters,
        )

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        by = {NUMBERS[self.inner.name]: float(np.log(u[0]))}
        c = self.beam.coefficients(by) - self.beam.coefficients({})
        parts = self.beam.parts()
        n_0, n_1, n_M = len(parts.K_0), len(parts.K_1), len(parts.M)
        return Change(
            K=np.tensordot(c[:n_0], parts.K_0, axes=1),
            K_1=np.tensordot(c[n_0 : n_0 + n_1], parts.K_1, axes=1).real,
            M=np.tensordot(c[n_0 + n_1 : n_0 + n_1 + n_M], parts.M, axes=1).real,
        )

    def story(self, u: Mapping[str, float]) -> str:
        return self.inner.story(u)


def standing(specimen: AnySpecimen) -> list[Effect]:
    """The forms that effects have on a specimen, those of stated numbers of a beam among them."""
    forms = [form for e in CATALOGUE.values() if (form := e.standing_on(specimen)) is not None]
    if isinstance(specimen, Beam):
        of_beam = [n for n, number in NUMBERS.items() if number in specimen.numbers]
        forms += [StatedNumberOffEffect(CATALOGUE[n], specimen) for n in of_beam if n in CATALOGUE]
    return forms
