"""The predicted posterior is that of the joint fit itself."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.data.noise import Noise
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import evaluated
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.several.responses import response_of
from fitting.planning.exact_problem import exact_problem
from fitting.planning.sensitivity import ReadingNoise, bent, sensitivity
from instrument.models.set_up import set_up

F = np.array([16.0, 19.0, 19.5, 20.0, 22.0, 90.0, 98.0, 99.0, 101.0, 105.0])
REGION = np.array([1] * 5 + [2] * 5)


@pytest.fixture(scope="module")
def ready(coarse, table5):
    """The paper's plate on a coarse mesh, with a careful laboratory's tolerances."""
    specimen = replace(coarse, exact=False)
    return specimen, set_up(table5, specimen, with_effects=False)


def problem_of(ready, points):
    specimen, setup = ready
    return exact_problem(F[points], REGION[points], 9.81, specimen, setup.problem.plate, setup.reduced)


def test_the_posterior_of_a_choice_is_the_joint_fits_own(ready):
    specimen, setup = ready
    every, noise = problem_of(ready, slice(None)), ReadingNoise(1e-5, 2e-3)
    law, dwell = bent(specimen.core.law, every), np.full(len(F), 0.5)
    s = sensitivity(every, setup.reduced, law, z=every.as_stated, noise=noise, dwell_s=dwell)
    taken = np.ones(len(F))
    v = s.velocity_m_s
    sweep = replace(every.sweep, velocity_m_s=v)
    errors = model_error(every, setup.reduced, law, v)
    evidence = Evidence.of(sweep, Noise(noise.std_m_s(v, dwell), "stated"), errors, v, None)
    fitted = evaluated(response_of(every, ()), evidence, law, every.as_stated)
    n = len(law.names) + s.stated
    # Without a residual the fit scales nothing.
    np.testing.assert_allclose(
        s.covariance(taken)[:n, :n], fitted.covariance, rtol=1e-5, atol=1e-9 * np.abs(fitted.covariance).max()
    )


def test_fewer_readings_are_those_rows_alone(ready):
    specimen, setup = ready
    some = np.array([0, 2, 4, 5, 7, 9])
    every, few = problem_of(ready, slice(None)), problem_of(ready, some)
    law, noise = bent(specimen.core.law, every), ReadingNoise(1e-5, 2e-3)
    dwell = np.full(len(F), 0.5)
    whole = sensitivity(every, setup.reduced, law, z=every.as_stated, noise=noise, dwell_s=dwell)
    part = sensitivity(few, setup.reduced, law, z=few.as_stated, noise=noise, dwell_s=dwell[some])
    np.testing.assert_allclose(part.rows, whole.rows[some], rtol=1e-6, atol=1e-6 * np.abs(whole.rows).max())


def test_noise_falls_with_the_dwell_to_a_share_of_the_reading():
    noise, v = ReadingNoise(4e-6, 1e-3), np.array([1e-3, 1e-3, 1e-1])
    found = noise.std_m_s(v, np.array([1.0, 4.0, 4.0]))
    np.testing.assert_allclose(found, [np.hypot(4e-6, 1e-6), np.hypot(2e-6, 1e-6), np.hypot(2e-6, 1e-4)])


def test_another_noise_scales_the_same_readings(ready):
    specimen, setup = ready
    every = problem_of(ready, slice(None))
    law, dwell = bent(specimen.core.law, every), np.full(len(F), 0.5)
    quiet, loud = (ReadingNoise(1e-5, x) for x in (1e-3, 1e-2))
    one = sensitivity(every, setup.reduced, law, z=every.as_stated, noise=quiet, dwell_s=dwell)
    other = sensitivity(every, setup.reduced, law, z=every.as_stated, noise=loud, dwell_s=dwell)
    again = one.with_noise(loud.std_m_s(one.velocity_m_s, dwell))
    np.testing.assert_allclose(again.rows, other.rows, rtol=1e-12)
