"""The constraining layer is thinner or thicker than stated."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change, Effect, Span, Unknown
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.other_plates import between, loads, matrices, responses
from fitting.effects.spanned import SpannedPlate
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SCALES = {"thin_layer": 0.85, "thick_layer": 1.15}


class ConstrainingLayer(Span):
    """Motions with another constraining layer; its matrices at two others."""

    name = "layer"
    columns = 12

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return matrices(full, _others(full))

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        return loads(full, _others(full))

    def responses(self, full: FullPlate, at: Snapshot) -> Complex:
        return responses(full, at, _others(full))


def _others(full: FullPlate) -> dict[str, Specimen]:
    s = full.specimen
    assert s.constraining is not None
    thickness = s.constraining.thickness_m
    return {
        name: replace(s, constraining=replace(s.constraining, thickness_m=scale * thickness))
        for name, scale in _SCALES.items()
    }


class ConstrainingThickness(Effect):
    """The constraining layer's thickness times a factor: its stiffness, mass and distance."""

    name = "constraining_thickness"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) with another H_c"
    unknowns = (Unknown("scale", "1", 0.7, 1.3, 1.03, neutral=1.0, spread=0.05),)
    spans = (ConstrainingLayer(),)
    chance = 0.015
    splits = "a micrometer at the layer's edge; the plate weighed before and after treatment"

    def change(self, plate: SpannedPlate, u: Array) -> Change:
        # Stretching goes with H, bending with H^3; the faces' distance and the core's mean bring H^2.
        return between(
            plate,
            "layer",
            _SCALES,
            float(u[0]),
            {
                "K_0": lambda s: [s - 1, s**3 - 1],
                "K_1": lambda s: [s - 1, s**2 - 1],
                "M": lambda s: [s - 1, s**2 - 1],
            },
        )

    def story(self, u: Mapping[str, float]) -> str:
        return f"the constraining layer is {100 * (u['scale'] - 1):+.1f} % off its stated thickness"
