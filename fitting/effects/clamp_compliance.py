"""The plate's clamps yield: springs per area of the clamped faces, alike on all of them.

Those along the plate let a clamped edge turn, which is what softens it. Across the plate springs of the same
stiffness move it by nothing that shows: one stiffness serves for both.
"""

from collections.abc import Mapping
from typing import Literal

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import CLAMP, PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.plate.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.clamp_span import ClampSpan, on_a_rim
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate
from fitting.widened.released_rim import clamped_edges, on_edge, treated_along
from fitting.widened.released_root import along_root, on_root

_SPANNED = (4e12, 1e13, 3e13, 1e14, 1e15)
"""N/m^3, from softer than a clamp ought to be to nearly rigid."""
STARTS_N_M3 = (5e13, 1.5e13)
"""To begin with: of a size that matters, and a third of it, from where soft clamps are near. A choice."""


class YieldingRoot(ClampSpan):
    """Motions with yielding clamps. Along itself each is held, as between jaws."""

    name = "root"
    released, released_along_x = (U_C, U_B, W, THETA_Y), (V_C, V_B, W, THETA_X)

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        if on_a_rim(full):
            return {"x": rim_springs(full, "across"), "z": rim_springs(full, "z")}
        return {"x": root_springs(full, "x"), "z": root_springs(full, "z")}

    def springs(self, full: FullPlate) -> list[sp.csc_array]:
        S = full.once("root springs", lambda: sum(self.matrices(full).values()))
        return [k * S for k in _SPANNED]


def root_springs(full: FullPlate, axis: str) -> sp.csc_array:
    """Unit springs per area of the root face along an axis, as a stiffness. Shape (n, n)."""
    patches = full.specimen.patches
    gripped = not patches or any(p.from_x_m == 0 for p in patches)
    return on_root(full, along_root(full), face_springs(full.specimen, axis, gripped=gripped))


def rim_springs(full: FullPlate, axis: Literal["across", "z"]) -> sp.csc_array:
    """Unit springs per area of every clamped edge's face, across the edge or along z. Shape (n, n)."""
    found = []
    for edge in clamped_edges(full):
        along = edge.across if axis == "across" else "z"
        bare, whole = (face_springs(full.specimen, along, gripped=gripped) for gripped in (False, True))
        found += [on_edge(full, edge, bare), on_edge(full, edge, whole - bare, treated_along(full, edge))]
    return sp.csc_array(sum(found))


def face_springs(specimen: PlateSpecimen, axis: str, *, gripped: bool) -> Array:
    """Unit springs per area along an axis on a node's motions, through all layers. Shape (DOFS, DOFS).

    `gripped`: whether core and constraining layers reach the clamp.
    """
    H_b = specimen.substrate.thickness_m
    H_c = specimen.constraining.thickness_m if specimen.constraining and gripped else 0.0
    H_v = specimen.core.between_faces_m if specimen.core and gripped else 0.0
    sides = 2 if specimen.both_sides else 1
    local = np.zeros((DOFS, DOFS))
    if axis == "z":
        local[W, W] = H_b + sides * H_v + sides * H_c
        return local
    along_x = axis == "x"
    u_b, u_c, theta, sign = (U_B, U_C, THETA_Y, 1.0) if along_x else (V_B, V_C, THETA_X, -1.0)
    rows = np.zeros((6, DOFS))
    # Mean and turn of each layer across its thickness; u = u_b + z theta_y, v = v_b - z theta_x.
    rows[0, u_b], rows[1, theta] = np.sqrt(H_b), np.sqrt(H_b**3 / 12)
    rows[2, u_c], rows[3, theta] = np.sqrt(H_c), np.sqrt(H_c**3 / 12)
    rows[4, [u_b, u_c, theta]] = np.sqrt(H_v) * np.array([0.5, 0.5, sign * (H_b - H_c) / 4])
    rows[5, [u_b, u_c, theta]] = np.sqrt(H_v / 12) * np.array([-1.0, 1.0, -sign * (H_b + H_c) / 2])
    rows[2:] *= np.sqrt(sides)
    return np.asarray(rows.T @ rows)


class ClampComplianceEffect(Effect):
    """Springs at the clamps."""

    name = "clamp_compliance"
    enters = "stiffness"
    structures = PLATE_AND_BEAM
    source = "elastic foundation of the root face, e.g. MacBain and Genin, J. Sound Vib. 27 (1973)"
    needs = CLAMP
    parameters = (
        EffectParameter(
            "k", "N/m^3", 1e12, 1e16, STARTS_N_M3[0], logarithmic=True, neutral=float("inf"), mounting=1.0
        ),
    )
    spans = (YieldingRoot(),)
    # Springs over the whole face are not quite a solid's root on springs: of five sweeps with noise of 0.07 %
    # they leave 0.7 to 1.0 %, which a second effect would take up.
    unexplained_share = 0.01
    chance = 0.05
    discriminating_test = "the same specimen clamped anew, or its root watched by the laser"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "root" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k]) for k in STARTS_N_M3]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=springs(plate, u))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the clamp is elastic ({u['k']:.2g} N/m^3 of clamped face)"


class BesideCompliance(Effect):
    """Mixin of an effect of elastic clamps whose first unknown is their springs, and that has one more.

    The catalogue has direct subclasses of `Effect`: name that as a base, too.
    """

    extends = "clamp_compliance"
    unexplained_share = ClampComplianceEffect.unexplained_share

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        return ((ClampComplianceEffect(), u[:1]),)

    def scaled(self, u: Array, a: float) -> Array:
        return np.array([u[0] / a, u[1]])


def springs(plate: EnrichedReducedPlate, u: Array) -> Array:
    """The root's stiffness with springs of `u[0]`. Shape (k, k)."""
    return np.asarray(u[0] * (plate.matrix("root.x") + plate.matrix("root.z")))
