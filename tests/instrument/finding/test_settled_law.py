"""A clean plate whose instruments wander: the law may swing with the law that the model's error is of."""

from dataclasses import replace

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.sweep import Sweep
from instrument.files.specimen_file import read_specimen
from instrument.models.set_up import set_up

SPECIMEN = """
[plate]
length_mm = 292
width_mm = 215
boundary = "cantilever"
[substrate]
thickness_mm = 2.43
young_gpa = 70
poisson = 0.3
density_kg_m3 = 2700
[core]
thickness_mm = 0.353
poisson = 0.49
density_kg_m3 = 1000
[constraining]
thickness_mm = 0.483
young_gpa = 70
poisson = 0.33
density_kg_m3 = 2700
[core.law]
kind = "fractional-zener"
g0_mpa = 1.44
ginf_mpa = 22.2
tau_s = 0.00015
alpha = 0.7
[damping]
modal_percent = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1]
[pickup]
x_mm = 196
y_mm = 67
[base]
acceleration_m_s2 = 9.81
[tolerances]
exact = true
"""
SEGMENTS_HZ = ((29.2, 32.1, 62), (168, 197, 68), (366, 417, 42), (448, 538, 61))
JUDGED_HZ = np.array([30.0, 125.0, 520.0])
WANDERING, OVER_POINTS, WHITE = 3e-3, 10.0, 1e-3


@pytest.fixture(scope="module")
def ready(tmp_path_factory):
    path = tmp_path_factory.mktemp("plate") / "plate.toml"
    path.write_text(SPECIMEN)
    f = np.concatenate([np.linspace(*segment) for segment in SEGMENTS_HZ])
    segment = np.repeat(np.arange(len(SEGMENTS_HZ)), [count for *_, count in SEGMENTS_HZ])
    sweep = Sweep(f, np.ones(len(f), complex), np.full(len(f), 9.81), segment, np.zeros(len(f), int))
    with threadpool_limits(1, "blas"):
        yield set_up(sweep, read_specimen(path))


def wandering(seed, count):
    """Of unit size, alike over some points. Shape (count,)."""
    x = np.random.default_rng(seed).normal(size=(2, count + 60))
    kernel = np.exp(-np.arange(30) / OVER_POINTS)
    y = [np.convolve(one, kernel)[30 : 30 + count] for one in x]
    return (y[0] + 1j * y[1]) / np.linalg.norm(kernel)


@pytest.mark.parametrize("seed", [0, 3, 5, 6, 7])
def test_the_law_is_within_its_errors(ready, seed):
    problem, law = ready.problem, ready.problem.stated_law
    v, dice = SweepResponse(problem, ()).velocity(law, problem.as_stated), np.random.default_rng(seed + 99)
    white = WHITE * np.median(np.abs(v)) * (dice.normal(size=len(v)) + 1j * dice.normal(size=len(v)))
    read = v * (1 + WANDERING * wandering(seed, len(v))) + white
    problem = replace(problem, sweep=replace(problem.sweep, velocity_m_s=read))
    with threadpool_limits(1, "blas"):
        none = begin(problem, ready.reduced, noise_of(problem.sweep), None, law).none
    # There is something that noise does not leave, and no number of a plate or law.
    assert 1.1 < none.chi2_per_dof < 3
    omega, of_law = 2 * np.pi * JUDGED_HZ, slice(len(none.law.names))
    off = np.log(none.law.modulus(omega) / law.modulus(omega))
    by = none.law.jacobian(omega) * none.law.values[:, None] / none.law.modulus(omega)
    for part in (np.real, np.imag):
        variance = np.einsum("kp,kl,lp->p", part(by), none.covariance[of_law, of_law], part(by))
        assert np.max(np.abs(part(off)) / np.sqrt(variance)) < 2.5, part
