"""The substrate is a rolled sheet: stiffer along the rolling direction than across it."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.given import BarePlateModes, Points
from fitting.effects.other_plates import mixed
from fitting.effects.span import Span
from fitting.element import U_B, V_B, Shape
from fitting.parts import STIFFNESS
from fitting.specimen import Face

_RATIOS = (0.85, 1.15)
"""E_y over E_x: five times the spread of the prior, so that the basis follows any likely one."""


class Orthotropy(Span):
    """Motions with another stiffness across the plate."""

    name = "orthotropy"
    columns = 12

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return np.hstack([full.elements.forces(A, at.both) for A in _differences(full)])


def _differences(full: FullPlate) -> list[Array]:
    """What an element's stiffness differs by. Shape (28, 28) each."""

    def make() -> list[Array]:
        shape, face = full.loose.mesh.shape, full.specimen.substrate
        changes = [plane_stress(face, ratio) - plane_stress(face, 1.0) for ratio in _RATIOS]
        return [substrate_stiffness(shape, face.thickness_m, D) for D in changes]

    return full.once("orthotropy", make)


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
    K = np.zeros((4 * shape.dofs, 4 * shape.dofs))
    for tx, wx in zip(t, weight, strict=True):
        for ty, wy in zip(t, weight, strict=True):
            x, y = shape.a_m * (tx + 1) / 2, shape.b_m * (ty + 1) / 2
            B_b, B = shape.membrane(U_B, V_B, x, y), shape.bending(x, y)
            dA = shape.a_m * shape.b_m / 4 * wx * wy
            K += (thickness_m * B_b.T @ D @ B_b + thickness_m**3 / 12 * B.T @ D @ B) * dA
    return K


def substrate_coefficients(face: Face, D: Array) -> Complex:
    """Of `fitting.parts` for a substrate with this D, its loss factor as stated. Shape of `STIFFNESS`."""
    each = {"11": D[0, 0], "22": D[1, 1], "12": D[0, 1], "66": D[2, 2]}
    by_layer = {"stretch b": face.thickness_m, "bend": face.thickness_m**3 / 12}
    found = [
        size * each[part.removeprefix(f"{layer} ")[:2]] if part.startswith(layer) else 0.0
        for part in STIFFNESS
        for layer, size in by_layer.items()
    ]
    return (1 + 1j * face.loss_factor) * np.reshape(found, (len(STIFFNESS), -1)).sum(axis=1)


ALONG, MEAN, ACROSS = 0.0, 0.5, 1.0
"""Which modulus the stated one is."""


def sheet(face: Face, ratio: float, stated: float) -> Array:
    """The same of a face whose stated modulus is E_x^(1 - stated) E_y^stated. Shape (3, 3)."""
    return plane_stress(replace(face, young_pa=face.young_pa * ratio**-stated), ratio)


class OrthotropicSubstrateEffect(Effect):
    """E_y over E_x; the stated modulus is that along (`stated` 0), across (1) or the mean of both (0.5)."""

    name = "orthotropic_substrate"
    enters = "stiffness"
    needs = frozenset({"isotropic substrate"})
    source = "orthotropic plane stress with Huber's shear modulus, e.g. Szilard, Plates (2004), ch. 4"
    parameters = (
        EffectParameter("ratio", "1", 0.7, 1.4, 1.03, neutral=1.0, spread=0.03),
        EffectParameter("stated", "1", ALONG, ACROSS, 0.0, neutral=None, fixed=True),
    )
    spans = (Orthotropy(),)
    discriminating_test = (
        "torsional beside bending frequencies of the bare plate (hammer test); a strip cut across the sheet"
    )

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([1.03, stated]) for stated in (ALONG, MEAN, ACROSS)]

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        face = bare.substrate
        now, stated = (
            (bare.stiffness @ substrate_coefficients(face, D)).real
            for D in (sheet(face, float(u[0]), float(u[1])), plane_stress(face, 1.0))
        )
        return np.asarray(0.5 * np.log(now / stated))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        face = plate.specimen.substrate
        change = sheet(face, float(u[0]), float(u[1])) - plane_stress(face, 1.0)
        return Change(K=mixed(substrate_coefficients(face, change), plate.parts[: len(STIFFNESS)]))

    def story(self, u: Mapping[str, float]) -> str:
        which = {ALONG: "along", MEAN: "of both on average", ACROSS: "across"}[u["stated"]]
        return (
            f"the substrate is {100 * (u['ratio'] - 1):+.1f} % stiffer across than along, "
            f"the stated modulus the one {which}"
        )
