"""What a fit takes for a sweep's response, from a few frequencies, beside a solve at every point."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig
from threadpoolctl import threadpool_limits

from fitting.diagnosis.problem.plate_answer import answer
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.effects import CATALOGUE
from fitting.effects.temperature_drift import C_1, C_2_K
from fitting.planning.known_mass import KnownMass
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up

ROOT_N_M3 = 1.5e13
WARMING_K, TIME_CONSTANT_S = 6.0, 500.0


@pytest.fixture(scope="module")
def once_up():
    return read_sweep(DATA / "practice-005.csv").sweep(9.81)


def again(sweep):
    """The same sweep, every segment once more later."""
    later = sweep.time_s.max() + 10.0
    parts = (
        {"segment": sweep.segment, "sweep": sweep.sweep, "time_s": sweep.time_s},
        {"segment": sweep.segment, "sweep": sweep.sweep + 10, "time_s": sweep.time_s + later},
    )
    both = {key: np.concatenate([p[key] for p in parts]) for key in parts[0]}
    twice = {
        key: np.tile(getattr(sweep, key), 2)
        for key in ("frequency_hz", "velocity_m_s", "commanded_m_s2", "base_m_s2")
    }
    return replace(sweep, **both, **twice, **{k: None for k in ("weight", "std_m_s") if hasattr(sweep, k)})


def at_every_point(problem, law, effect, u, G):
    plate = problem.plate.take(effect.spans)
    change = effect.change(plate, np.array(u))
    omega = problem.points.omega
    x = answer(plate, omega, G, change, [], with_pitch=False).heave.value
    return 1j * omega * problem.points.drive_amplitude * x


@pytest.mark.parametrize("make", [lambda s: s, again], ids=["one pass", "two passes"])
def test_a_core_that_warms_on_a_root_that_yields(once_up, make):
    with threadpool_limits(1, "blas"):
        problem = set_up(make(once_up), plate_of_the_rig()).problem
        law = problem.stated_law
        problem = problem.condensed(law).around(law)
        clamp, drift = CATALOGUE["clamp_compliance"], CATALOGUE["temperature_drift"]
        response = SweepResponse(problem, [clamp, drift])
        u = np.array([ROOT_N_M3, WARMING_K, TIME_CONSTANT_S])
        v, by = response.with_derivatives(law, u)
        kelvin = -WARMING_K * np.expm1(-problem.points.time_s / TIME_CONSTANT_S)
        G = law.modulus(problem.points.omega * 10 ** (-C_1 * kelvin / (C_2_K + kelvin)))
        assert np.abs(G / law.modulus(problem.points.omega) - 1).max() > 0.1
        expected = at_every_point(problem, law, clamp, [ROOT_N_M3], G)
        if problem.specimen.reads == "absolute":
            expected = expected + problem.points.drive_amplitude / (1j * problem.points.omega)
        assert np.abs(v / expected - 1).max() < 3e-4
        h = 1e-3 * WARMING_K
        up, down = (response.velocity(law, u + np.array([0, s * h, 0])) for s in (1, -1))
        slope = (up - down) / (2 * h)
        assert np.abs(by[len(law.names) + 1] - slope).max() < 0.02 * np.abs(slope).max()


def test_what_a_fit_leaves_alone_has_no_derivative_unless_it_is_asked_for(once_up):
    with threadpool_limits(1, "blas"):
        problem = set_up(once_up, plate_of_the_rig()).problem
        law, mass = problem.stated_law, KnownMass(3e-3, (0.25, 0.12), 0.01, 1e-3)
        (v, by), (same, every) = (
            SweepResponse(problem, [mass], every=every).with_derivatives(law, mass.values)
            for every in (False, True)
        )
    free = len(law.names) + 1
    assert np.array_equal(v, same)
    assert by[:free] == pytest.approx(every[:free], rel=1e-9)
    assert np.all(by[free:] == 0)
    assert np.all(np.abs(every[free:]).max(axis=1) > 0)
