"""Noise of resonances that a sweep has few points of: by what a fit leaves, where their scatter is more."""

import numpy as np
import pytest

from fitting.data.noise import Noise, noise_of
from fitting.diagnosis.checks.overstated_noise import is_overstated, share_left, with_own_noise
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.laws import LAWS
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import system_of
from fitting.structures.small_sum import rational_of
from fitting.sweep import Sweep

LAW = LAWS["fractional-zener"](1e8, 1.5e9, 1e-4, 0.5)
FACE = Face(2e-3, 70e9, 0.3, 2700.0)
OBERST = Beam(0.2, 0.01, "clamped-free", FACE, core=Core(1e-3, 0.49, 1000.0, LAW), pickup_m=0.15)
NOISE, FLOOR = 2e-3, 1e-4


def begun(points, noise=None):
    """A fit of some readings by their local scatter, that noise, and the true one."""
    f = np.geomspace(25, 1500, points)
    w = 2 * np.pi * f
    v = (
        1j
        * w
        * rational_of(system_of(OBERST, OBERST.parts()), w, 3e8).with_derivative(LAW.modulus(w))[0]
        * 9.81
    )
    rng, true = np.random.default_rng(8), NOISE * np.abs(v) + FLOOR * np.abs(v).max()
    v = v + true * (rng.normal(size=points) + 1j * rng.normal(size=points))
    ones = np.ones(points, dtype=int)
    sweep = Sweep(f, v, 9.81 * ones, ones, ones, base_m_s2=9.81 * ones + 0j)
    noise = noise or noise_of(sweep)
    return begin(SmallProblem.of_small(sweep, OBERST), None, noise, None, LAW), noise, true


def test_what_scatters_for_having_few_points_is_no_noise():
    coarse, noise, true = begun(50)
    assert noise.source == "local scatter"
    assert np.median(noise.std_m_s / true) > 2
    assert coarse.none.chi2_per_dof < 0.3
    own = with_own_noise(coarse, noise)
    assert np.median(own.evidence.noise_m_s / true) == pytest.approx(1.0, abs=0.2)
    assert own.none.chi2_per_dof == pytest.approx(1.0, abs=0.2)
    assert not is_overstated(own.problem.sweep, noise, own.evidence, own.none)
    # The law is better known by so much.
    n = len(LAW.names)
    errors = [np.sqrt(np.diag(one.none.covariance)[:n]) for one in (own, coarse)]
    assert np.median(errors[0] / errors[1]) < 0.8


def test_noise_as_it_scatters_is_kept_and_so_is_what_is_stated():
    dense, noise, _ = begun(400)
    assert share_left(dense.problem.sweep, dense.evidence, dense.none) == pytest.approx(1.0, abs=0.25)
    assert with_own_noise(dense, noise) is dense
    stated, noise, _ = begun(70, Noise(3 * begun(70)[2], "stated"))
    assert stated.none.chi2_per_dof < 0.3
    assert with_own_noise(stated, noise) is stated
