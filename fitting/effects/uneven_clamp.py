"""The clamp holds one side better than the other: springs at the root that vary along the width."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import ROOT, Effect, EffectParameter, Points
from fitting.effects.change import Change
from fitting.effects.clamp_compliance import ClampComplianceEffect, root_springs
from fitting.effects.clamp_span import RootSpan
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.full_plate import FullPlate
from fitting.effects.released_root import along_root
from fitting.element import THETA_Y, U_B, U_C, W

_MOST = 0.95
"""Below one: at one the springs of an edge vanish, beyond it they would push."""
_SPANNED = ((6e12, 0.7), (2e13, 0.9), (6e13, 0.9), (4e14, 0.9))
"""N/m^3 and slopes, from softer than a clamp ought to be to nearly rigid."""


class UnevenRoot(RootSpan):
    """Motions with a root that yields more on one side. Along y it is held, as between jaws."""

    name = "uneven"
    released = (U_C, U_B, W, THETA_Y)
    odd = True
    columns = 14

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return dict(zip(("mean", "slope"), uneven_springs(full), strict=True))

    def springs(self, full: FullPlate) -> list[sp.csc_array]:
        mean, slope = uneven_springs(full)
        return [k * (mean + s * slope) for k, s in _SPANNED]


def uneven_springs(full: FullPlate) -> tuple[sp.csc_array, sp.csc_array]:
    """Unit springs per area of the root, along x and z; and times 2 y / width - 1. Shape (n, n) each."""

    def make() -> tuple[sp.csc_array, sp.csc_array]:
        even = along_root(full).toarray()
        odd = along_root(full, np.linspace(-1, 1, len(even))).toarray()
        mean = (root_springs(full, "x") + root_springs(full, "z")).tocoo()
        i, j = (full.loose.free[place] // full.loose.mesh.dofs for place in mean.coords)
        slope = sp.coo_array((mean.data * odd[i, j] / even[i, j], mean.coords), mean.shape)
        return sp.csc_array(mean), sp.csc_array(slope)

    return full.once("uneven springs", make)


class UnevenClampEffect(Effect):
    """Springs k (1 + slope (2 y / width - 1)) per area of the root face."""

    name = "uneven_clamp"
    enters = "stiffness"
    source = "elastic foundation of the root face, stiffness linear along the width"
    needs = ROOT
    parameters = (
        *ClampComplianceEffect.parameters,
        EffectParameter("slope", "1", -_MOST, _MOST, 0.3, spread=0.4, mounting=0.3),
    )
    spans = (UnevenRoot(),)
    extends = "clamp_compliance"
    unexplained_share = 0.003
    chance = 0.015
    discriminating_test = (
        "two spots at the same x, one on either side of the axis; the screws tightened by torque"
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "uneven" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k, slope]) for k in (5e13, 1.5e13) for slope in (0.6, -0.6)]

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        return ((ClampComplianceEffect(), u[:1]),)

    def scaled(self, u: Array, a: float) -> Array:
        return np.array([u[0] / a, u[1]])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=u[0] * (plate.matrix("uneven.mean") + u[1] * plate.matrix("uneven.slope")))

    def story(self, u: Mapping[str, float]) -> str:
        side = "the far" if u["slope"] > 0 else "the near"
        return (
            f"the clamp yields ({u['k']:.2g} N/m^3 of root face on average) and is stiffer on {side} side, "
            f"by {100 * abs(u['slope']):.0f} %"
        )
