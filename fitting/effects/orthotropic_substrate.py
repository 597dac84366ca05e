"""The substrate is a rolled sheet: stiffer along the rolling direction than across it."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import BarePlateModes, Points
from fitting.plate.element import U_B, V_B, face_stiffness
from fitting.plate.part_names import STIFFNESS
from fitting.plate.parts import substrate_coefficients
from fitting.stated.layers import Face, Orthotropy
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import mixed
from fitting.widened.span import Span

_RATIOS = (0.85, 1.15)
"""E_y over E_x: five times the spread of the prior, so that the basis follows any likely one."""


class AnotherRatio(Span):
    """Motions with another stiffness across the plate."""

    name = "orthotropy"
    columns = 12

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return np.hstack([full.elements.forces(A, at.both) for A in _differences(full)])


def _differences(full: FullPlate) -> list[Array]:
    """What an element's stiffness differs by. Shape (4 dofs, 4 dofs) each."""

    def make() -> list[Array]:
        shape, face = full.loose.mesh.shape, full.specimen.substrate
        stated, *others = (face_stiffness(shape, sheet(face, r), U_B, V_B) for r in (1.0, *_RATIOS))
        return [other - stated for other in others]

    return full.once("orthotropy", make)


ALONG, MEAN, ACROSS = 0.0, 0.5, 1.0
"""Which modulus the stated one is."""


def sheet(face: Face, ratio: float, stated: float = ALONG) -> Face:
    """A face whose E_y is `ratio` times its E_x, with Huber's shear modulus sqrt(E_x E_y) / (2 (1 + nu_xy)).

    Its stated modulus is E_x^(1 - stated) E_y^stated; nu_xy is as stated.
    """
    E_x = face.young_pa * ratio**-stated
    shear = float(np.sqrt(ratio)) * E_x / (2 * (1 + face.poisson))
    return replace(face, young_pa=E_x, rolled=Orthotropy(ratio * E_x, shear))


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
    spans = (AnotherRatio(),)
    discriminating_test = (
        "torsional beside bending frequencies of the bare plate (hammer test); a strip cut across the sheet"
    )

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, stated]) for stated in (ALONG, MEAN, ACROSS)]

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        face = bare.substrate
        now, stated = (
            (bare.stiffness @ substrate_coefficients(one)).real
            for one in (sheet(face, float(u[0]), float(u[1])), sheet(face, 1.0))
        )
        return np.asarray(0.5 * np.log(now / stated))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        face = plate.specimen.substrate
        now, stated = (
            substrate_coefficients(one) for one in (sheet(face, float(u[0]), float(u[1])), sheet(face, 1.0))
        )
        return Change(K=mixed(now - stated, plate.parts[: len(STIFFNESS)]))

    def story(self, u: Mapping[str, float]) -> str:
        which = {ALONG: "along", MEAN: "of both on average", ACROSS: "across"}[u["stated"]]
        return (
            f"the substrate is {100 * (u['ratio'] - 1):+.1f} % stiffer across than along, "
            f"the stated modulus the one {which}"
        )
