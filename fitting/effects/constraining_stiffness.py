"""The constraining layer is stiffer or softer than its data sheet."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change, Effect, Span, Unknown
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.spanned import SpannedPlate

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_TYPICAL = 0.1


class Constraining(Span):
    """Motions with a stiffer constraining layer."""

    name = "constraining"
    columns = 8

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"K": full.loose.K_constraining}

    def responses(self, full: FullPlate, at: Snapshot) -> Complex:
        return at.solve(_TYPICAL * (full.loose.K_constraining @ at.both), odd=False)


class ConstrainingStiffness(Effect):
    """Young's modulus of the constraining layer times a factor."""

    name = "constraining_stiffness"
    enters = "stiffness"
    source = "the paper's Eq. (15c)"
    unknowns = (Unknown("scale", "1", 0.7, 1.4, 1.03, neutral=1.0, spread=0.05),)
    spans = (Constraining(),)
    chance = 0.015
    splits = "a strip of the constraining layer in a tensile test, or its own bending frequencies"

    def change(self, plate: SpannedPlate, u: Array) -> Change:
        return Change(K=(u[0] - 1) * plate.matrix("constraining.K"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the constraining layer is {100 * (u['scale'] - 1):+.1f} % off its stated stiffness"
