"""A cantilever plate as it is mounted: its solid on a basis of modes, and what it hides; and bare, struck."""

from dataclasses import dataclass, replace

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant.bare import OTHER_RATIO
from drivers.simulated.plant.basis import basis_of, moduli, motions
from drivers.simulated.plant.effects import ByHand, Effects
from drivers.simulated.plant.law import MaxwellLaw, even_loss
from drivers.simulated.plant.lines import Line
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.progress import Report
from drivers.simulated.plant.solid_plate import PIECES, PlateStated, SolidPlate
from drivers.simulated.plant.structure import Branch, Structure, modal_damping

_MODES, _BARE_MODES = 14, 32
_DAMPED_AT_RAD_S = 2 * np.pi * 100.0
"""The core's modulus there makes the modes that carry the damping ratios of the treated plate."""


@dataclass(frozen=True)
class ReducedPlate:
    """Matrices on the basis."""

    M: Array
    K_1: Array
    """Of the core for unit modulus; zeros of a bare plate."""
    K_faces: Array
    """Shape (faces, n, n), the substrate first."""
    load: Array
    """M times heave and pitch. Shape (n, 2)."""
    w: Array
    """At the nodes of the upper face. Shape (nodes x times nodes y, n)."""
    x_ends: Array
    """Of the pieces along x, m. Shape (pieces + 1,)."""
    y_ends: Array
    order: int

    def row(self, x_m: float, y_m: float) -> Array:
        """Reads w at a place of the upper face. Shape (n,)."""
        x, y = (Line(tuple(ends.tolist()), int(self.order)) for ends in (self.x_ends, self.y_ends))
        return np.asarray(np.kron(x.at(x_m), y.at(y_m)) @ self.w)

    def faces(self, stated: PlateStated, effects: Effects) -> tuple[Array, list[Branch]]:
        """Stiffness of the elastic faces, shape (n, n); and those that lose. A substrate may be stiffer."""
        scale = effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0
        K, lossy = np.zeros_like(self.M), []
        faces = (stated.sheets[0], stated.sheets[-1])
        for face, part, factor in zip(faces, self.K_faces, (scale, 1.0), strict=True):
            if face.loss_factor:
                lossy.append(Branch(factor * part, even_loss(face.loss_factor)))
            else:
                K = K + factor * part
        return K, lossy


def really(stated: PlateStated, effects: Effects) -> PlateStated:
    """The plate as it is: its core's thickness."""
    if effects.core_thickness is None:
        return stated
    substrate, core, constraining = stated.sheets
    core = replace(core, thickness_m=effects.core_thickness.scale * core.thickness_m)
    return replace(stated, sheets=(substrate, core, constraining))


@one_thread
def reduced_plate(
    stated: PlateStated,
    law: MaxwellLaw | None = None,
    report: Report = lambda done: None,
    pieces: tuple[int, int] = PIECES,
) -> ReducedPlate:
    """The solid plate on its basis: treated, for a law; bare without one."""
    solid = SolidPlate(stated, pieces)
    free = solid.free
    layers = [solid.stiffness(k)[free][:, free] for k in range(len(stated.sheets))]
    M, load = solid.M[free][:, free], (solid.M @ solid.rigid)[free]
    faces, parts = layers[::2], []
    K_0 = sum(faces[1:], faces[0])
    core = layers[1] if law is not None else 0.0 * K_0
    each = moduli(law) if law is not None else np.zeros(1)
    for k, G in enumerate(each):
        parts.append(motions(K_0 + G * core, M, load, _MODES if law is not None else _BARE_MODES))
        report((k + 1) / len(each))
    V = basis_of(np.hstack(parts), M)
    whole = np.zeros((len(solid.M.indptr) - 1, V.shape[1]))
    whole[free] = V
    return ReducedPlate(
        V.T @ (M @ V), V.T @ (core @ V), np.array([V.T @ (K @ V) for K in faces]), V.T @ load,
        whole[solid.top], np.array(solid.x.ends), np.array(solid.y.ends), solid.x.order,
    )  # fmt: skip


@one_thread
def mounted_plate(
    stated: PlateStated,
    reduced: ReducedPlate,
    law: MaxwellLaw,
    ratios: tuple[float, ...],
    spot_m: tuple[float, float],
    effects: Effects,
    by_hand: ByHand,
) -> Mounted:
    """With what it hides but its geometry, and what somebody has changed. `spot_m` is the specimen's.

    Raises `ValueError` for a place off the plate.
    """
    M, load = reduced.M, reduced.load
    K, lossy = reduced.faces(stated, effects)
    for added in (effects.added_mass, by_hand.mass):
        if added is not None:
            stated.refuse_off(added.x_m, added.y_m)
            w = reduced.row(added.x_m, added.y_m)
            M = M + added.mass_kg * np.outer(w, w)
            load = load + added.mass_kg * np.outer(w, [1.0, added.x_m])
    held = K + sum((b.law.modulus(0.0).real * b.K for b in lossy), np.zeros_like(K))
    viscous = (effects.viscous_damping.scale if effects.viscous_damping else 1.0) * np.array(ratios)
    modulus = float(law.modulus(_DAMPED_AT_RAD_S).real)
    C = modal_damping(M, held + modulus * reduced.K_1, viscous) if len(ratios) else np.zeros_like(M)
    x, y = by_hand.spot_m or spot_m
    if effects.spot_offset:
        x, y = x + effects.spot_offset.dx_m, y + effects.spot_offset.dy_m
    stated.refuse_off(x, y)
    readings = np.array([reduced.row(x, y), reduced.row(stated.length_m, stated.width_m / 2)])
    structure = Structure(M, C, K, (Branch(reduced.K_1, law), *lossy), -load, readings)
    volume = stated.length_m * stated.width_m * stated.sheets[1].thickness_m
    return Mounted(structure, x, volume)


@one_thread
def struck_plate(
    stated: PlateStated,
    reduced: ReducedPlate,
    ratios: tuple[float, ...],
    effects: Effects,
    hit_m: tuple[float, float],
    response_m: tuple[float, float],
    sensor_kg: float,
) -> Structure:
    """The bare plate with a sensor. Effects heeded: substrate stiffness, viscous damping.

    Raises `ValueError` for a place off the plate.
    """
    for place in (hit_m, response_m):
        stated.refuse_off(*place)
    K = (effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0) * reduced.K_faces[0]
    each = np.full(len(K), OTHER_RATIO)
    each[: len(ratios)] = ratios
    each *= effects.viscous_damping.scale if effects.viscous_damping else 1.0
    C = modal_damping(reduced.M, K, each)
    hit, response = reduced.row(*hit_m), reduced.row(*response_m)
    M = reduced.M + sensor_kg * np.outer(response, response)
    return Structure(M, C, K, (), hit[:, None], response[None])
