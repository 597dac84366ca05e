"""The plate's root yields: springs per area of the root face.

Those along the plate let the root turn, which is what softens it. Across the plate springs of the same
stiffness move it by nothing that shows: one stiffness serves for both.
"""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import CLAMP, PLATE_AND_BEAM, Effect, EffectParameter, Points
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.full_plate import FullPlate
from fitting.effects.released_root import RootSpan
from fitting.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W

_SPANNED = (4e12, 1e13, 3e13, 1e14, 1e15)
"""N/m^3, from softer than a clamp ought to be to nearly rigid."""


class YieldingRoot(RootSpan):
    """Motions with a yielding root. Along y it is held, as between jaws."""

    name = "root"
    released = (U_C, U_B, W, THETA_Y)

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"x": root_springs(full, "x"), "z": root_springs(full, "z")}

    def springs(self, full: FullPlate) -> list[sp.csc_array]:
        S = full.once("root springs", lambda: root_springs(full, "x") + root_springs(full, "z"))
        return [k * S for k in _SPANNED]


def root_springs(full: FullPlate, axis: str) -> sp.csc_array:
    """Unit springs per area of the root face along an axis, as a stiffness. Shape (n, n)."""
    s = full.specimen
    H_b = s.substrate.thickness_m
    gripped = not s.patches or any(p.from_x_m == 0 for p in s.patches)
    H_c = s.constraining.thickness_m if s.constraining and gripped else 0.0
    H_v = s.core.between_faces_m if s.core and gripped else 0.0
    sides = 2 if s.both_sides else 1
    local = np.zeros((DOFS, DOFS))
    if axis == "z":
        local[W, W] = H_b + sides * H_v + sides * H_c
    else:
        along_x = axis == "x"
        u_b, u_c, theta, sign = (U_B, U_C, THETA_Y, 1.0) if along_x else (V_B, V_C, THETA_X, -1.0)
        rows = np.zeros((6, DOFS))
        # Mean and turn of each layer across its thickness; u = u_b + z theta_y, v = v_b - z theta_x.
        rows[0, u_b], rows[1, theta] = np.sqrt(H_b), np.sqrt(H_b**3 / 12)
        rows[2, u_c], rows[3, theta] = np.sqrt(H_c), np.sqrt(H_c**3 / 12)
        rows[4, [u_b, u_c, theta]] = np.sqrt(H_v) * np.array([0.5, 0.5, sign * (H_b - H_c) / 4])
        rows[5, [u_b, u_c, theta]] = np.sqrt(H_v / 12) * np.array([-1.0, 1.0, -sign * (H_b + H_c) / 2])
        rows[2:] *= np.sqrt(sides)
        local = rows.T @ rows
    n_y, b = full.loose.mesh.n_y, full.loose.mesh.sides_m[1]
    along = sp.diags_array([b / 6, 2 * b / 3, b / 6], offsets=[-1, 0, 1], shape=(n_y + 1, n_y + 1)).tolil()
    along[0, 0] = along[n_y, n_y] = b / 3
    n, dofs = full.loose.mesh.size, full.loose.mesh.dofs
    block = sp.kron(along, np.pad(local, (0, dofs - DOFS))).tocoo()
    whole = sp.coo_array((block.data, (block.row, block.col)), (n, n)).tocsr()
    return sp.csc_array(whole[full.loose.free][:, full.loose.free])


class ClampComplianceEffect(Effect):
    """Springs at the root."""

    name = "clamp_compliance"
    enters = "stiffness"
    structures = PLATE_AND_BEAM
    source = "elastic foundation of the root face, e.g. MacBain and Genin, J. Sound Vib. 27 (1973)"
    needs = CLAMP
    parameters = (
        EffectParameter("k", "N/m^3", 1e12, 1e16, 5e13, logarithmic=True, neutral=float("inf"), mounting=1.0),
    )
    spans = (YieldingRoot(),)
    unexplained_share = 0.003
    chance = 0.05
    discriminating_test = "the same plate clamped anew, or its root watched by the laser"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "root" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k]) for k in (5e13, 1.5e13)]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=springs(plate, u))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the plate's root is elastic ({u['k']:.2g} N/m^3 of root face)"


def springs(plate: EnrichedReducedPlate, u: Array) -> Array:
    """The root's stiffness with springs of `u[0]`. Shape (k, k)."""
    return np.asarray(u[0] * (plate.matrix("root.x") + plate.matrix("root.z")))
