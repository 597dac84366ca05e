"""The clamp's edge bites elsewhere than stated: the free length is another."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change, Effect, Points, Span, Unknown
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.other_plates import between, loads, matrices, responses
from fitting.effects.spanned import SpannedPlate
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LENGTHS = {"short": 0.98, "long": 1.02}
"""Over the stated one."""


class Length(Span):
    """Motions of a longer or a shorter plate, stretched to the stated one, and of its pickup."""

    name = "length"
    columns = 16

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return matrices(full, _others(full))

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        return loads(full, _others(full))

    def responses(self, full: FullPlate, at: Snapshot) -> Complex:
        if full.specimen.boundary != "cantilever":
            return super().responses(full, at)
        x, y = full.pickup_m
        length = full.specimen.length_m
        rows = np.column_stack([full.loose.observe(min(x / scale, length), y) for scale in _LENGTHS.values()])
        X = at.solve(rows, odd=False)
        X = 0.3 * X / np.sqrt(np.real(np.einsum("ij,ij->j", X.conj(), full.scale @ X)))
        return np.hstack([responses(full, at, _others(full)), X])


def _others(full: FullPlate) -> dict[str, Specimen]:
    s = full.specimen
    return {name: replace(s, length_m=scale * s.length_m) for name, scale in _LENGTHS.items()}


class ClampLine(Effect):
    """The free length is the stated one and `dlength`; the pickup stays where it is from the clamp."""

    name = "clamp_line"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) on a mesh stretched along x; the viscous damping kept"
    unknowns = (Unknown("dlength", "m", -8e-3, 8e-3, 1e-3, spread=2e-3),)
    spans = (Length(),)
    chance = 0.03
    splits = (
        "a feeler gauge or blueing paper in the clamp; the plate clamped anew, further in by a known step"
    )

    def objection(self, points: Points, plate: SpannedPlate) -> str | None:
        return None if "length" in plate.group else "the plate has no clamp"

    def change(self, plate: SpannedPlate, u: Array) -> Change:
        scale = float(1 + u[0] / plate.length_m)
        x, y = plate.pickup
        # Bending along x goes with 1 / L^3, what it is coupled with to powers between that and L.
        found = between(
            plate,
            "length",
            _LENGTHS,
            scale,
            {
                "K_0": lambda s: [s**-3 - 1, s - 1],
                "K_1": lambda s: [1 / s - 1, s - 1],
                "M": lambda s: [1 / s - 1, s - 1],
            },
        )
        return replace(found, observe=plate.row(x / scale, y) - plate.row(x, y))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the plate is free over {1e3 * u['dlength']:+.1f} mm more than its stated length"
