"""The core of one file is of another material than that of the others: another batch, or aged otherwise."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.given import ModulusAt, Points
from fitting.widened.enriched_plate import EnrichedReducedPlate


class CoreDifferenceEffect(Effect):
    """G' (1 + stiffer), eta (1 + lossier) in that file: as far as batches of one material differ.

    One file alone has its own law: nothing shows there. Pads stay the same under other masses, and a pad that
    is stiffer is one under less mass.
    """

    name = "core_difference"
    enters = "core law"
    source = "definition"
    structures = PLATE_AND_BEAM
    between_files = True
    parameters = (
        EffectParameter("stiffer", "1", -0.6, 1.5, 0.1, spread=0.15),
        EffectParameter("lossier", "1", -0.6, 1.0, 0.1, spread=0.1),
    )
    chance = 0.05
    discriminating_test = "another specimen of that sheet, or the sheet's batch and age"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it lies between files, and there is one"

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        own = G()
        found = np.empty_like(own)
        found.real = (1 + u[0]) * own.real
        found.imag = (1 + u[0]) * (1 + u[1]) * own.imag
        return found

    def story(self, u: Mapping[str, float]) -> str:
        stiffer, lossier = (100 * u[key] for key in ("stiffer", "lossier"))
        return f"the core is another one: G' {stiffer:+.2g} %, loss factor {lossier:+.2g} %"
