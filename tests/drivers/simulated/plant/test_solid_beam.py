"""The solid beam against what is known of beams without it."""

import numpy as np
import pytest
from scipy.sparse.linalg import eigsh

from drivers.simulated.plant.solid_beam import BeamStated, Sheet, SolidBeam

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


@pytest.mark.long
def test_a_finer_mesh_says_the_same():
    core = Sheet(0.5e-3, 2 * 1.49 * 1e6, 0.49, 1000.0)
    stated = BeamStated(0.2, 0.02, "clamped-free", (METAL, core, METAL), (1,), 0.15)
    np.testing.assert_allclose(frequencies_hz(stated, 3), frequencies_hz(stated, 3, 30), rtol=5e-4)
