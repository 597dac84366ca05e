"""A bare beam under a hammer, as a solid: bending alone, its middle a plane of symmetry."""

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant.bare import OTHER_RATIO
from drivers.simulated.plant.basis import basis_of, motions
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.law import even_loss
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.solid_beam import BeamStated, SolidBeam
from drivers.simulated.plant.structure import Branch, Structure, modal_damping

_MODES = 12
"""The last of them far above what a hammer's blow stirs."""


@one_thread
def struck_beam(
    stated: BeamStated, effects: Effects, hit_m: float, response_m: float, sensor_kg: float
) -> Structure:
    """The substrate alone, its one sheet, struck and read on its middle line. Effects heeded: its stiffness.

    Its loss factor, and `OTHER_RATIO` of critical of every mode: what joints and air take. Raises
    `ValueError` for a place off the beam, and for one driven in its centre: a blow moves its halves apart.
    """
    if stated.ends == "centre-driven":
        raise ValueError("a beam driven in its centre is not struck, expected a clamped one")
    for x in (hit_m, response_m):
        if not 0 <= x <= stated.span_m:
            raise ValueError(f"{1e3 * x:.1f} mm is off the beam, expected 0 to {1e3 * stated.span_m:.1f}")
    (face,) = stated.sheets
    solid = SolidBeam(stated)
    free = solid.free
    scale = effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0
    K, M = scale * solid.stiffness(0)[free][:, free], solid.M[free][:, free]
    V = basis_of(motions(K, M, (solid.M @ solid.rigid)[free], _MODES), M)
    stiff, mass = V.T @ (K @ V), V.T @ (M @ V)
    hit, response = (_row(solid, x) @ V for x in (hit_m, response_m))
    C = modal_damping(mass, stiff, np.full(len(mass), OTHER_RATIO))
    lossy: tuple[Branch, ...] = ()
    if face.loss_factor:
        lossy, stiff = (Branch(stiff, even_loss(face.loss_factor)),), np.zeros_like(stiff)
    mass = mass + sensor_kg * np.outer(response, response)
    return Structure(mass, C, stiff, lossy, hit[:, None], response[None])


def _row(solid: SolidBeam, x_m: float) -> Array:
    return solid.deflection(x_m)[solid.free]
