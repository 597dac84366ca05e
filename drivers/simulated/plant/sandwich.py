"""The treated plate on a moving base, with its effects: matrices of its motion relative to the base."""

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant import grid, specimen
from drivers.simulated.plant.effects import LOOSE, AddedMass, ByHand, ClampCompliance, Effects
from drivers.simulated.plant.law import ZN1, MaxwellLaw, even_loss
from drivers.simulated.plant.model import ReducedModel, shipped
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.strips import debonded
from drivers.simulated.plant.structure import Branch, Structure, modal_damping

CORE_VOLUME_M3 = specimen.LENGTH_M * specimen.WIDTH_M * specimen.CORE.thickness_m
STIFF_CLAMP = ClampCompliance(1e14, 1e14)
"""What friction acts in where no compliance is given."""


@one_thread
def sandwich(
    effects: Effects | None = None,
    model: ReducedModel | None = None,
    by_hand: ByHand | None = None,
) -> Mounted:
    """The plate with its effects. A point off the plate or a value that makes no sense raises ValueError.

    `by_hand` is what somebody has changed since.
    """
    effects, by_hand = effects or Effects(), by_hand or ByHand()
    model = model or shipped("sandwich")
    thickness = effects.core_thickness.scale if effects.core_thickness else 1.0
    K, M, loads = elastic(effects, model), *inertia(effects, model, thickness, by_hand.mass)
    clamped = clamp(effects, model)
    n = len(M) if clamped else model.rigid_count
    core = core_stiffness(effects, model, thickness)[:n, :n]
    law = effects.core_law.law if effects.core_law else ZN1
    K, M = K[:n, :n], M[:n, :n]
    springs = sum((b.law.modulus(0.0).real * b.K for b in clamped), np.zeros((n, n)))
    C = modal_damping(M, K + springs + specimen.REFERENCE_MODULUS_PA * core, damping_ratios(effects))
    spot, tip = seen_m(effects, by_hand.spot_m), (specimen.LENGTH_M, specimen.WIDTH_M / 2)
    readings = np.array([grid.on_plate(*at) @ model["w_top"] for at in (spot, tip)])
    structure = Structure(M, C, K, (Branch(core, law), *clamped), -loads[:n], readings[:, :n])
    return Mounted(structure, spot[0], thickness * CORE_VOLUME_M3)


def elastic(effects: Effects, model: ReducedModel) -> Array:
    """Stiffness of both faces. Shape (n, n)."""
    scale = effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0
    return scale * model["K_substrate"] + model["K_constraining"]


def core_stiffness(effects: Effects, model: ReducedModel, thickness: float) -> Array:
    """Of the core for unit modulus. What a loose strip lacks is shear across it, as 1 / thickness.

    Shape (n, n).
    """
    K = thickness * model["K_core_in_plane"] + model["K_core_mixed"] + model["K_core_normal"] / thickness
    debond = effects.partial_debond
    if debond is None:
        return np.asarray(K)
    loose = debonded(debond, len(model["K_core_strips_x"]))
    strips = model[f"K_core_strips_{debond.along}"]
    return np.asarray(K - (1 - LOOSE) / thickness * np.tensordot(loose, strips, axes=1))


def inertia(
    effects: Effects, model: ReducedModel, thickness: float, known: AddedMass | None = None
) -> tuple[Array, Array]:
    """M, and M times heave and pitch; `known` is a mass beside the hidden one. Shapes (n, n) and (n, 2)."""
    scales = {"substrate": 1.0, "core": thickness, "constraining": 1.0}
    if effects.air_added_mass:
        scales["air"] = effects.air_added_mass.density_kg_m3
    M = sum(s * model[f"M_{name}"] for name, s in scales.items())
    loads = sum(s * model[f"load_{name}"] for name, s in scales.items())
    for added in (effects.added_mass, known):
        if added is None:
            continue
        w = grid.on_plate(added.x_m, added.y_m) @ model["w_top"]
        M = M + added.mass_kg * np.outer(w, w)
        loads = loads + added.mass_kg * np.outer(w, [1.0, added.x_m])
    return np.asarray(M), np.asarray(loads)


def clamp(effects: Effects, model: ReducedModel) -> tuple[Branch, ...]:
    """The root's springs; none where it is rigid."""
    friction = effects.clamp_friction.loss_factor if effects.clamp_friction else 0.0
    springs = effects.clamp_compliance or (STIFF_CLAMP if friction else None)
    if springs is None:
        return ()
    K = springs.along_x_n_m3 * model["S_x"] + springs.along_z_n_m3 * model["S_z"]
    return (Branch(K, even_loss(friction) if friction else MaxwellLaw(1.0, (), ())),)


def damping_ratios(effects: Effects) -> Array:
    """Of the first eight modes. Shape (8,)."""
    scale = effects.viscous_damping.scale if effects.viscous_damping else 1.0
    return scale * np.array(specimen.BARE_MODAL_RATIOS)


def seen_m(effects: Effects, meant_m: tuple[float, float] | None = None) -> tuple[float, float]:
    """Where the laser really points; `meant_m` None for the specimen's spot."""
    x, y = meant_m or specimen.SPOT_M
    offset = effects.spot_offset
    return (x + offset.dx_m, y + offset.dy_m) if offset else (x, y)
