"""The substrate is a rolled sheet: stiffer along the rolling direction than across it."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change, Effect, Span, Unknown
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.spanned import SpannedPlate
from fitting.element import DOFS, U_B, V_B, Shape
from fitting.specimen import Face

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_STEP = 0.15


class Orthotropy(Span):
    """Motions with another stiffness across the plate; its stiffness at two others."""

    name = "orthotropy"
    columns = 12

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"K_soft": _difference(full, 1 - _STEP), "K_stiff": _difference(full, 1 + _STEP)}

    def responses(self, full: FullPlate, at: Snapshot) -> Complex:
        changes = [_difference(full, ratio) @ at.both for ratio in (1 - _STEP, 1 + _STEP)]
        return at.solve(np.hstack(changes), odd=False)


def _difference(full: FullPlate, ratio: float) -> sp.csc_array:
    def make() -> sp.csc_array:
        shape, face = Shape(*full.loose.mesh.sides_m), full.specimen.substrate
        change = plane_stress(face, ratio) - plane_stress(face, 1.0)
        return full.loose.scatter(substrate_stiffness(shape, face.thickness_m, change))

    return full.once(f"orthotropy {ratio}", make)


def plane_stress(face: Face, ratio: float) -> Array:
    """D of a face whose E_y is `ratio` times its E_x, in Pa; nu_xy as stated. Shape (3, 3).

    Q_11 = E_x / (1 - ratio nu^2), Q_22 = ratio Q_11, Q_12 = nu Q_22, and Huber's shear modulus
    sqrt(E_x E_y) / (2 (1 + nu)).
    """
    E, nu = face.young_pa, face.poisson
    Q = E / (1 - ratio * nu**2)
    shear = np.sqrt(ratio) * E / (2 * (1 + nu))
    return np.array([[Q, ratio * nu * Q, 0], [ratio * nu * Q, ratio * Q, 0], [0, 0, shear]])


def substrate_stiffness(shape: Shape, thickness_m: float, D: Array) -> Array:
    """Stretching and bending of the substrate's element. Shape (28, 28)."""
    t, weight = np.polynomial.legendre.leggauss(4)
    K = np.zeros((4 * DOFS, 4 * DOFS))
    for tx, wx in zip(t, weight, strict=True):
        for ty, wy in zip(t, weight, strict=True):
            x, y = shape.a_m * (tx + 1) / 2, shape.b_m * (ty + 1) / 2
            B_b, B = shape.membrane(U_B, V_B, x, y), shape.bending(x, y)
            dA = shape.a_m * shape.b_m / 4 * wx * wy
            K += (thickness_m * B_b.T @ D @ B_b + thickness_m**3 / 12 * B.T @ D @ B) * dA
    return K


class OrthotropicSubstrate(Effect):
    """E_y over E_x, E_x as stated."""

    name = "orthotropic_substrate"
    enters = "stiffness"
    source = "orthotropic plane stress with Huber's shear modulus, e.g. Szilard, Plates (2004), ch. 4"
    unknowns = (Unknown("ratio", "1", 0.7, 1.4, 1.03, neutral=1.0, spread=0.03),)
    spans = (Orthotropy(),)
    splits = (
        "torsional beside bending frequencies of the bare plate (hammer test); a strip cut across the sheet"
    )

    def change(self, plate: SpannedPlate, u: Array) -> Change:
        # In the ratio the stiffness is smooth: two others give it to third order.
        r = np.array([1 - _STEP, 1 + _STEP])
        columns = np.column_stack([r - 1, np.sqrt(r) - 1])
        a, b = np.linalg.solve(columns.T, [u[0] - 1, np.sqrt(u[0]) - 1])
        return Change(K=a * plate.matrix("orthotropy.K_soft") + b * plate.matrix("orthotropy.K_stiff"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the substrate is {100 * (u['ratio'] - 1):+.1f} % stiffer across than along"
