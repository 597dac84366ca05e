"""The clamp holds one side better than the other: springs at the root that vary along the width."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import ROOT, Effect, EffectParameter
from fitting.effects.clamp_compliance import (
    STARTS_N_M3,
    BesideCompliance,
    ClampComplianceEffect,
    root_springs,
)
from fitting.effects.given import Points
from fitting.plate.element import THETA_Y, U_B, U_C, W
from fitting.widened.change import Change
from fitting.widened.clamp_span import RootSpan
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate
from fitting.widened.released_root import along_root

_MOST = 50.0
"""Springs of one edge over those of the other: where they are softer still, that edge is free."""
_RATIOS = (4.0, 0.25)
"""To begin with: either side the stiffer one. A choice."""
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


class UnevenClampEffect(BesideCompliance, Effect):
    """Springs k (1 + slope (2 y / width - 1)) per area of the root face, slope = (ratio - 1) / (ratio + 1).

    `ratio` is of the far edge's springs to the near one's: slopes end where an edge is free, and fits of
    clamps that hold little there would end with them.
    """

    name = "uneven_clamp"
    enters = "stiffness"
    source = "elastic foundation of the root face, stiffness linear along the width"
    needs = ROOT
    parameters = (
        *ClampComplianceEffect.parameters,
        EffectParameter("ratio", "1", 1 / _MOST, _MOST, 2.0, logarithmic=True, neutral=1.0, mounting=0.6),
    )
    spans = (UnevenRoot(),)
    chance = 0.015
    discriminating_test = (
        "two spots at the same x, one on either side of the axis; the screws tightened by torque"
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "uneven" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k, ratio]) for k in STARTS_N_M3 for ratio in _RATIOS]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        k, ratio = u
        slope = (ratio - 1) / (ratio + 1)
        return Change(K=k * (plate.matrix("uneven.mean") + slope * plate.matrix("uneven.slope")))

    def story(self, u: Mapping[str, float]) -> str:
        side = "the far" if u["ratio"] > 1 else "the near"
        return (
            f"the clamp yields ({u['k']:.2g} N/m^3 of root face on average) and on {side} side is "
            f"{max(u['ratio'], 1 / u['ratio']):.2g} times as stiff as on the other"
        )
