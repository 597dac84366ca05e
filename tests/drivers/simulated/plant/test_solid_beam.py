"""The solid beam against what is known of beams without it."""

import numpy as np
import pytest
from scipy.sparse.linalg import eigsh

from drivers.simulated.plant.solid_beam import BeamBuild, BeamStated, RootSprings, Sheet, SolidBeam

METAL = Sheet(1e-3, 70e9, 0.0, 2700.0)


def frequencies_hz(stated: BeamStated, count: int, pieces: int = 20):
    solid = SolidBeam(stated, pieces)
    K = sum((solid.stiffness(k) for k in range(1, len(stated.sheets))), solid.stiffness(0))
    free = solid.free
    lam = eigsh(K[free][:, free], count, solid.M[free][:, free], sigma=0.0, return_eigenvectors=False)
    return np.sqrt(np.sort(lam)) / (2 * np.pi)


@pytest.mark.parametrize(
    ("ends", "roots", "span_m"),
    [
        ("clamped-free", (1.875104, 4.694091), 0.2),
        ("centre-driven", (1.875104, 4.694091), 0.1),
        ("clamped-clamped", (4.730041, 7.853205), 0.2),
    ],
)
def test_one_metal_in_two_layers_is_euler_and_bernoullis_beam(ends, roots, span_m):
    """Poisson's ratio none: nothing is held at a clamp that bends across. Thin: shear gives 0.1 %."""
    found = frequencies_hz(BeamStated(0.2, 0.01, ends, (METAL, METAL), (), 0.1), 2, 10)
    h, L = 2e-3, span_m
    exact = [b**2 / (2 * np.pi * L**2) * np.sqrt(70e9 * h**2 / (12 * 2700.0)) for b in roots]
    np.testing.assert_allclose(found, exact, rtol=5e-3)


def test_it_weighs_what_it_is_made_of_and_shakes_as_one():
    for ends in ("clamped-free", "centre-driven"):
        solid = SolidBeam(BeamStated(0.2, 0.02, ends, (METAL, METAL), (), 0.1), 4)
        heave = solid.rigid[:, 0]
        assert heave @ solid.M @ heave == pytest.approx(0.2 * 0.02 * 2e-3 * 2700.0)
        K = solid.stiffness(0) + solid.stiffness(1)
        np.testing.assert_allclose(K @ solid.rigid, 0, atol=1e-9 * abs(K).max())


def test_a_finer_mesh_says_the_same():
    core = Sheet(0.5e-3, 2 * 1.49 * 1e6, 0.49, 1000.0)
    stated = BeamStated(0.2, 0.02, "clamped-free", (METAL, core, METAL), (1,), 0.15)
    np.testing.assert_allclose(frequencies_hz(stated, 3), frequencies_hz(stated, 3, 30), rtol=5e-4)


def test_a_free_beam_is_euler_and_bernoullis_and_its_three_rigid_motions_cost_nothing():
    stated = BeamStated(0.2, 0.01, "free-free", (METAL, METAL), (), 0.1)
    solid = SolidBeam(stated, 10)
    K = solid.stiffness(0) + solid.stiffness(1)
    shift = (2 * np.pi * 50) ** 2
    stiff, M = (A[solid.free][:, solid.free] for A in (K + shift * solid.M, solid.M))
    lam = np.sort(eigsh(stiff, 5, M, sigma=0.0, return_eigenvectors=False)) - shift
    np.testing.assert_allclose(lam[:3], 0, atol=1e-5 * shift)
    exact = [b**2 / (2 * np.pi * 0.2**2) * np.sqrt(70e9 * 4e-6 / (12 * 2700.0)) for b in (4.730041, 7.853205)]
    np.testing.assert_allclose(np.sqrt(lam[3:]) / (2 * np.pi), exact, rtol=5e-3)


def test_springs_as_stiff_as_a_clamp_are_one_and_a_grip_of_one_sheet_holds_no_other():
    rigid = BeamStated(0.2, 0.01, "clamped-free", (METAL, METAL), (), 0.1)
    sprung = SolidBeam(rigid, 6, BeamBuild(springs=RootSprings(1e16, 1e16, 1e16)))
    K = sprung.stiffness(0) + sprung.stiffness(1) + sprung.root
    free = sprung.free
    lam = eigsh(K[free][:, free], 2, sprung.M[free][:, free], sigma=0.0, return_eigenvectors=False)
    np.testing.assert_allclose(np.sqrt(np.sort(lam)) / (2 * np.pi), frequencies_hz(rigid, 2, 6), rtol=1e-3)
    lower = SolidBeam(rigid, 6, BeamBuild(gripped_m=rigid.heights_m(0)))
    assert 0 < len(lower.free) - len(SolidBeam(rigid, 6).free) < 3 * lower.shape[1] * lower.shape[2]


def test_springs_weigh_the_part_of_the_face_that_they_hold():
    """Pressed along its axis the root is a spring of its area times the springs' stiffness."""
    stated = BeamStated(0.2, 0.01, "clamped-clamped", (METAL, METAL), (), 0.1)
    for upper_half, share in ((0.0, 1.0), (1e-3, 0.5)):
        solid = SolidBeam(stated, 4, BeamBuild(springs=RootSprings(3e12, 2e12, 1e12, from_m=upper_half)))
        along = np.tile([1.0, 0.0, 0.0], len(solid.rigid) // 3)
        assert along @ solid.root @ along == pytest.approx(2 * share * 3e12 * 0.01 * 2e-3)
        heave = solid.rigid[:, 0]
        assert heave @ solid.root @ heave == pytest.approx(2 * share * 1e12 * 0.01 * 2e-3)


def test_a_core_that_is_softer_on_a_strip_stores_less_there():
    core = Sheet(0.5e-3, 2 * 1.49, 0.49, 1000.0)
    stated = BeamStated(0.2, 0.02, "clamped-free", (METAL, core, METAL), (1,), 0.15)
    build = BeamBuild(core_factor=lambda x: np.where(x < 0.06, 0.25, 1.0), lines_x_m=(0.06,))
    solid, whole = SolidBeam(stated, 5, build), SolidBeam(stated, 5, BeamBuild(lines_x_m=(0.06,)))
    assert 0.06 in solid.x.ends
    x, _, z = (g.ravel() for g in np.meshgrid(solid.x.nodes, solid.y.nodes, solid.z.nodes, indexing="ij"))
    sheared = np.zeros(3 * x.size)
    sheared[0::3] = z
    # Plain shear of unit angle: the energy is the volume's.
    assert sheared @ whole.core @ sheared == pytest.approx(0.2 * 0.02 * 0.5e-3)
    assert sheared @ solid.core @ sheared == pytest.approx((0.3 * 0.25 + 0.7) * 0.2 * 0.02 * 0.5e-3)
