"""The core is thinner or thicker than stated."""

from collections.abc import Callable, Mapping

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change, Effect, Span, Unknown
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.spanned import SpannedPlate
from fitting.plate import element_matrices
from fitting.tolerances import moved

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_STEP = 0.15


class Thickness(Span):
    """Motions with another core thickness; its matrices at two others."""

    name = "thickness"

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        found = {}
        for sign, scale in (("thin", 1 - _STEP), ("thick", 1 + _STEP)):
            for part in ("K_1", "M"):
                found[f"{part}_{sign}"] = _difference(full, scale, part)
        return found

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        return {
            f"load_{sign}": -(_difference(full, scale, "M") @ full.heave)
            for sign, scale in (("thin", 1 - _STEP), ("thick", 1 + _STEP))
        }

    def responses(self, full: FullPlate, at: Snapshot) -> Complex:
        found = []
        for scale in (1 - _STEP, 1 + _STEP):
            dA = at.G * _difference(full, scale, "K_1") - at.omega**2 * _difference(full, scale, "M")
            found.append(at.solve(dA @ at.both, odd=False))
        return np.hstack(found)


def _difference(full: FullPlate, scale: float, part: str) -> sp.csc_array:
    def make() -> sp.csc_array:
        mesh, specimen = full.loose.mesh, full.specimen
        other = moved(specimen, ["core_thickness"], [float(np.log(scale))])
        Ae = getattr(element_matrices(other, mesh), part) - getattr(element_matrices(specimen, mesh), part)
        return full.loose.scatter(Ae)

    return full.once(f"core {scale} {part}", make)


class CoreThickness(Effect):
    """The core's thickness times a factor: its shear stiffness, mass and the faces' distance."""

    name = "core_thickness"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) with another H_v"
    unknowns = (Unknown("scale", "1", 0.7, 1.3, 1.05, neutral=1.0, spread=0.08),)
    spans = (Thickness(),)
    chance = 0.04
    splits = "a gauge; a second specimen of another thickness"

    def change(self, plate: SpannedPlate, u: Array) -> Change:
        # Shear goes with 1/H, H and a constant; mass with H. What is left, bending of the core, is nothing.
        s = np.array([1 - _STEP, 1 + _STEP])
        columns = np.column_stack([1 / s - 1, s - 1])
        a, b = np.linalg.solve(columns.T, [1 / u[0] - 1, u[0] - 1])

        def between(part: str, get: Callable[[str], Array]) -> Array:
            return np.asarray(a * get(f"thickness.{part}_thin") + b * get(f"thickness.{part}_thick"))

        return Change(
            K_1=between("K_1", plate.matrix), M=between("M", plate.matrix), load=between("load", plate.vector)
        )

    def story(self, u: Mapping[str, float]) -> str:
        return f"the core is {100 * (u['scale'] - 1):+.1f} % off its stated thickness"
