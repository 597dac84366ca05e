"""Clamps on springs of plates held on other edges than one: reduced plate beside full solves."""

import numpy as np
import pytest
import scipy.sparse as sp
from solved_in_full import Full

from fitting.effects import CATALOGUE
from fitting.effects.clamp_compliance import rim_springs, root_springs
from fitting.effects.treatment_not_gripped import hold
from fitting.plate.element import THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.stated.patches import Patch
from fitting.widened.clamp_span import on_a_rim

CLAMPS = ("clamp_compliance", "treatment_not_gripped")
BOUNDARIES = (
    "clamped-free-clamped-free",
    "clamped-clamped-clamped-clamped",
    "clamped-clamped-free-free",
    "clamped-simply-supported-free-free",
)
ACROSS = {"x": (U_C, U_B, W, THETA_Y), "y": (V_C, V_B, W, THETA_X)}
LAYER = {"x": (U_C, V_C), "y": (U_C, V_C)}


class Rim(Full):
    """A plate on any edges."""

    def direct(self, **changes):
        full = self.full
        load = 0.0
        if self.loose.specimen.boundary != "free":
            # The inertia of nodes that are still held.
            load = self.loose.base_load + self.loose.M @ full.heave
        return super().direct(**{**changes, "load": load})

    def freed(self, dofs):
        """Degrees of freedom that move once the clamps let some go."""
        s, mesh = self.specimen, self.loose.mesh
        x, y = mesh.node_positions().T
        on = {("x", 0): x == 0, ("y", 0): y == 0, ("x", 1): x == s.length_m, ("y", 1): y == s.width_m}
        wanted = [
            (np.flatnonzero(where)[:, None] * mesh.dofs + np.array(dofs[axis])).ravel()
            for ((axis, _), where), edge in zip(on.items(), s.edges, strict=True)
            if edge == "clamped"
        ]
        return np.union1d(self.clamped, np.flatnonzero(np.isin(self.loose.free, np.concatenate(wanted))))


@pytest.fixture(scope="module", params=BOUNDARIES)
def rim(request):
    return Rim(CLAMPS, boundary=request.param, pickup_m=(0.13, 0.06))


def test_clamps_that_yield(rim):
    S = rim_springs(rim.full, "across") + rim_springs(rim.full, "z")
    for k in (1.2e13, 3e14):
        assert rim.error(CATALOGUE["clamp_compliance"], [k], K=k * S, free=rim.freed(ACROSS)) < 5e-4


def test_clamps_that_yield_and_rub(rim):
    S = rim_springs(rim.full, "across") + rim_springs(rim.full, "z")
    effect, K = CATALOGUE["clamp_friction"], 3e13 * (1 + 0.2j) * S
    assert rim.error(effect, [3e13, 0.2], K=K, free=rim.freed(ACROSS)) < 5e-4


def test_clamps_that_hold_the_substrate_alone(rim):
    for k in (1e6, 1e8, 1e10):
        effect, K = CATALOGUE["treatment_not_gripped"], k * hold(rim.full)
        assert rim.error(effect, [k], K=K, free=rim.freed(LAYER)) < 5e-4


def test_rigid_springs_are_the_clamps(rim):
    assert rim.error(CATALOGUE["clamp_compliance"], [1e18]) < 1e-4
    assert rim.error(CATALOGUE["treatment_not_gripped"], [1e14]) < 1e-4


@pytest.mark.parametrize("boundary", ["clamped-free-clamped-free", "cantilever"])
def test_patches_reach_the_clamps_or_do_not(boundary):
    patches = (Patch(0.0, 0.15, 0.0, 0.1), Patch(0.2, 0.3002, 0.0, 0.1999))
    rim = Rim(CLAMPS[:1], boundary=boundary, pickup_m=(0.13, 0.06), patches=patches)
    assert on_a_rim(rim.full)
    S = rim_springs(rim.full, "across") + rim_springs(rim.full, "z")
    assert rim.error(CATALOGUE["clamp_compliance"], [3e13], K=3e13 * S, free=rim.freed(ACROSS)) < 5e-4
    # A unit lift of the clamps meets springs over the area that is held.
    s = rim.specimen
    lift = np.zeros((rim.loose.mesh.nodes, rim.loose.mesh.dofs))
    lift[:, W] = 1.0
    lift = lift.ravel()[rim.loose.free]
    above, b = s.core.thickness_m + s.constraining.thickness_m, rim.loose.mesh.sides_m[1]
    treated = [0.1, s.width_m][: 1 + (boundary != "cantilever")]
    area = sum(s.substrate.thickness_m * s.width_m + above * width for width in treated)
    assert lift @ rim_springs(rim.full, "z") @ lift == pytest.approx(area, abs=above * b)


def test_a_root_of_a_plate_treated_on_both_sides_or_not_up_to_it():
    """Where the substrate does not stretch, or no treatment is, there is nothing to let go."""
    patch = (Patch(0.05, 0.2, 0.0, 0.1999),)
    for changes in ({"both_sides": True}, {"patches": patch}):
        rim = Rim(CLAMPS[:1], boundary="cantilever", pickup_m=(0.13, 0.06), **changes)
        assert not on_a_rim(rim.full)
        S = root_springs(rim.full, "x") + root_springs(rim.full, "z")
        effect, K = CATALOGUE["clamp_compliance"], 3e13 * S
        assert rim.error(effect, [3e13], K=K, free=rim.freed(ACROSS)) < 5e-4


def test_a_plate_on_its_root_alone_has_the_root_s_springs(full):
    assert not on_a_rim(full.full)
    assert sp.linalg.norm(rim_springs(full.full, "z") - root_springs(full.full, "z")) < 1e-15
