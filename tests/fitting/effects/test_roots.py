"""Roots that hold badly: reduced plate beside full solves."""

import numpy as np
import pytest
import scipy.sparse as sp

from fitting.effects.treatment_not_gripped import TreatmentNotGrippedEffect
from fitting.effects.uneven_clamp import UnevenClampEffect
from fitting.plate.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.widened.released_root import along_root, root_dofs

FREE_TREATMENT, UNEVEN = TreatmentNotGrippedEffect(), UnevenClampEffect()


def root_of(full, *dofs):
    """Places of the root's degrees of freedom, node by node. Shape (nodes, dofs)."""
    return np.arange(full.specimen.mesh[1] + 1)[:, None] * DOFS + np.array(dofs)


def line(full, weight=lambda t: 1.0):
    """Integral of two linear shape functions along the root, by ten Gauss points an element."""
    count, b = full.specimen.mesh[1], full.loose.mesh.sides_m[1]
    t, w = np.polynomial.legendre.leggauss(10)
    found = np.zeros((count + 1, count + 1))
    for j in range(count):
        for s, p in zip((t + 1) / 2, w / 2, strict=True):
            N = np.array([1 - s, s])
            found[j : j + 2, j : j + 2] += weight((j + s) / count) * p * b * np.outer(N, N)
    return found


@pytest.mark.parametrize("weight", [lambda t: 1.0, lambda t: 2 * t - 1])
def test_springs_along_the_root_are_the_integral_of_its_shape_functions(full, weight):
    nodes = np.linspace(0, 1, full.specimen.mesh[1] + 1)
    found = along_root(full.full, np.array([weight(t) for t in nodes])).toarray()
    np.testing.assert_allclose(found, line(full, weight), atol=1e-12 * full.specimen.width_m)


def test_the_root_s_motions_are_found_among_those_of_the_loose_plate(full):
    assert np.array_equal(root_dofs(full.full, (W, U_C)), full.loose.free[root_of(full, W, U_C).ravel()])
    assert not set(root_dofs(full.full, (W, U_C))) & set(full.clamped)


@pytest.mark.parametrize("k", [1e6, 1e8, 5e8, 1e10])
def test_a_treatment_that_is_not_gripped(full, k):
    u_c, v_c = root_of(full, U_C, V_C).T
    K = sp.lil_array((full.loose.size, full.loose.size))
    for place in (u_c, v_c):
        K[np.ix_(place, place)] = k * line(full)
    free = np.union1d(full.clamped, [*u_c, *v_c])
    assert full.error(FREE_TREATMENT, [k], K=K.tocsc(), free=free) < 3e-4


def test_a_gripped_treatment_is_the_clamp(full):
    assert full.error(FREE_TREATMENT, [1e14]) < 1e-5


def face_springs(full, k, slope):
    """Along x and z at every point of the root face, through all layers."""
    s = full.specimen
    along = k * line(full, lambda t: 1 + slope * (2 * t - 1))
    found = sp.lil_array((full.loose.size, full.loose.size))
    layers = (
        (s.substrate.thickness_m, lambda z: {U_B: 1.0, THETA_Y: z * s.substrate.thickness_m / 2}),
        (s.constraining.thickness_m, lambda z: {U_C: 1.0, THETA_Y: z * s.constraining.thickness_m / 2}),
        (
            s.core.thickness_m,
            # Linear between the interfaces, z from -1 to 1.
            lambda z: {
                U_B: (1 - z) / 2,
                U_C: (1 + z) / 2,
                THETA_Y: ((1 - z) * s.substrate.thickness_m - (1 + z) * s.constraining.thickness_m) / 4,
            },
        ),
    )
    total = sum(H for H, _ in layers)
    terms = [(total, {W: 1.0})]
    for H, motion in layers:
        terms += [(H / 2 * w, motion(z)) for z, w in zip(*np.polynomial.legendre.leggauss(3), strict=True)]
    for weight, motion in terms:
        for one, a in motion.items():
            for other, b in motion.items():
                rows, columns = root_of(full, one).ravel(), root_of(full, other).ravel()
                found[np.ix_(rows, columns)] += weight * a * b * along
    return found.tocsc()


@pytest.mark.parametrize(("k", "ratio"), [(1.2e13, 4), (5e13, 1 / 19), (2e14, 2)])
def test_a_clamp_that_holds_one_side_better(full, k, ratio):
    free = np.setdiff1d(np.arange(full.loose.size), root_of(full, V_B, V_C, THETA_X).ravel())
    springs = face_springs(full, k, (ratio - 1) / (ratio + 1))
    assert full.error(UNEVEN, [k, ratio], K=springs, free=free) < 1e-3


def test_an_even_clamp_is_the_simpler_effect(full):
    assert UNEVEN.extends == "clamp_compliance"
    free = np.setdiff1d(np.arange(full.loose.size), root_of(full, V_B, V_C, THETA_X).ravel())
    assert full.error(UNEVEN, [5e13, 1.0], K=face_springs(full, 5e13, 0.0), free=free) < 5e-4
    assert full.error(UNEVEN, [1e18, 0.5]) < 1e-5


@pytest.mark.parametrize(
    ("effect", "u", "n"), [(FREE_TREATMENT, [3e8], 0), (UNEVEN, [5e13, 0.4], 0), (UNEVEN, [5e13, 1.0], 1)]
)
def test_derivatives_of_effects_at_the_root_are_those_of_differences(full, effect, u, n):
    by, difference = full.slope(effect, u, n)
    assert np.abs(by / difference - 1).max() < 1e-4
