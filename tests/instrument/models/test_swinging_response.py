"""A part that swings, as a fit takes it: beside a solve at every point of a plate with its motion on it."""

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
from fitting.widened.change import Change
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up

PART, ROCKING, CLAMP, DRIFT = (
    CATALOGUE[n] for n in ("loose_part", "base_rocking", "clamp_compliance", "temperature_drift")
)
ROOT_N_M3, PITCH = 1.5e13, 0.4
PARTS = {
    "between the readings' ends": (2e-3, 21.0, 0.05, 0.26, 0.05),
    "hardly damped": (8e-4, 115.0, 0.01, 0.2, 0.13),
    "heavy": (12e-3, 320.0, 0.1, 0.3, 0.02),
    "far below what is read": (3e-3, 4.0, 0.05, 0.15, 0.1),
}
BESIDE = {"alone": [], "on a clamp that yields": [CLAMP], "on a base that rocks": [ROCKING]}


@pytest.fixture(scope="module", params=["as stated", "stated within tolerances"])
def problem(request):
    sweep = read_sweep(DATA / "practice-005.csv").sweep(9.81)
    specimen = plate_of_the_rig()
    if request.param != "as stated":
        specimen = replace(specimen, exact=False)
    with threadpool_limits(1, "blas"):
        found = set_up(sweep, specimen).problem
        law = found.stated_law
        yield found.condensed(law).around(law)


def solved_with_its_motion(problem, effects, u, *, grid=None, G=None):
    """Velocity at every point."""
    law, count = problem.stated_law, len(problem.nuisances)
    plate = problem.plate.take({s.name: s for e in effects for s in e.spans}.values())
    if grid is problem.coarse:
        plate = plate.roughly
    plate = plate.with_part
    change, pitch, start = problem.nuisances.change(plate, u[:count]) if count else Change(), 0.0, count
    for e in effects:
        own = u[start : start + len(e.parameters)]
        start += len(own)
        if e is ROCKING:
            pitch = own[0]
            continue
        change = change.and_then(e.change(plate, own))
    points = problem.points
    omega, a = points.omega, points.drive_amplitude
    found = answer(plate, omega, law.modulus(omega) if G is None else G, change, [], with_pitch=bool(pitch))
    x = found.heave.value + (pitch * found.pitch.value if pitch else 0)
    v = 1j * omega * a * x + pitch * problem.pickup_x_m * a / (1j * omega)
    if points.reads == "absolute":
        v = v + a / (1j * omega)
    return problem.nuisances.reading(v, omega, u[:count]) if count else v


def all_of(problem, beside, part):
    """Stated numbers off, and then what the effects have. Shape (unknowns,)."""
    others = {CLAMP: [ROOT_N_M3], ROCKING: [PITCH]}
    return np.concatenate([0.7 * np.ones(len(problem.nuisances)), *(others[e] for e in beside), part])


@pytest.mark.parametrize("beside", BESIDE.values(), ids=BESIDE)
@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_it_answers_as_the_plate_with_its_motion_at_every_point(problem, part, beside):
    law, u = problem.stated_law, all_of(problem, beside, part)
    without = SweepResponse(problem, beside).velocity(law, u[: -len(part)])
    for grid in (problem.fine, problem.coarse):
        v = SweepResponse(problem, [*beside, PART], grid).velocity(law, u)
        expected = solved_with_its_motion(problem, [*beside, PART], u, grid=grid)
        np.testing.assert_allclose(v, expected, rtol=1e-3)
        assert np.abs(without / expected - 1).max() > 1e-3


@pytest.mark.parametrize("beside", BESIDE.values(), ids=BESIDE)
def test_its_derivatives_are_those_of_differences(problem, beside):
    law, u = problem.stated_law, all_of(problem, beside, PARTS["hardly damped"])
    response = SweepResponse(problem, [*beside, PART])
    _, by = response.with_derivatives(law, u)
    logs = np.log(law.values)

    def velocity(x):
        return response.velocity(law.with_logs(x[: len(logs)]), x[len(logs) :])

    x = np.concatenate([logs, u])
    for n, row in enumerate(by):
        step = 1e-4 * (abs(x[n]) or 1.0) * np.eye(len(x))[n]
        slope = (velocity(x + step) - velocity(x - step)) / (2 * step[n])
        np.testing.assert_allclose(row, slope, atol=8e-3 * np.abs(slope).max(), err_msg=str(n))


def test_a_core_that_warms_under_it_is_off_to_first_order_only(problem):
    law, points = problem.stated_law, problem.points
    stated, warming, part = 0.7 * np.ones(len(problem.nuisances)), [6.0, 500.0], PARTS["hardly damped"]
    u = np.concatenate([stated, warming, part])
    v = SweepResponse(problem, [DRIFT, PART]).velocity(law, u)
    kelvin = -6.0 * np.expm1(-points.time_s / 500.0)
    G = law.modulus(points.omega * 10 ** (-C_1 * kelvin / (C_2_K + kelvin)))
    assert np.abs(G / law.modulus(points.omega) - 1).max() > 0.1
    alone = np.concatenate([stated, part])
    np.testing.assert_allclose(v, solved_with_its_motion(problem, [PART], alone, G=G), rtol=2e-3)
