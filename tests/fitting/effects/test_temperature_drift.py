"""A core that warms, and one whose room comes and goes."""

import numpy as np
import pytest
from shear_pair_cases import LAW

from fitting.diagnosis.search.stand_in import asks_for_more
from fitting.effects import CATALOGUE
from fitting.effects.given import ModulusAt, Points
from fitting.effects.temperature_drift import TemperatureCycleEffect, time_scale

SETTLES, STEPS, CYCLES, UNEVEN = CATALOGUE["temperature_drift"].variants()
TIME_S = np.linspace(0, 1200, 61)
OMEGA = 2 * np.pi * np.geomspace(20, 400, 61)


def points(time_s=TIME_S, *, timed=True):
    return Points(OMEGA, np.ones(61), time_s, timed, True, "absolute")


def modulus(effect, *u):
    return effect.modulus(ModulusAt(LAW, points(), None), points(), np.array(u))


def test_a_warm_core_is_as_at_lower_frequencies():
    # log10 a_T = -9 * 2 / (120 + 2), Williams, Landel and Ferry.
    assert time_scale(2.0) == pytest.approx(10 ** (-18 / 122))
    late = modulus(SETTLES, 2.0, 20.0)[-1]
    assert late == pytest.approx(LAW.modulus(OMEGA[-1:] * time_scale(2.0))[0])


def test_a_core_has_warmed_by_all_but_one_in_e_after_a_time_constant():
    times_s = np.array([0.0, 600.0, 600.0 * np.log(2), 1e6])
    kelvin = SETTLES.kelvin(times_s, np.array([2.0, 600.0]))
    assert kelvin == pytest.approx([0.0, 2.0 * (1 - np.exp(-1)), 1.0, 2.0])


@pytest.mark.parametrize("effect", [CYCLES, UNEVEN])
def test_a_cycle_is_about_the_temperature_of_the_law(effect):
    u = np.array([0.5, -0.3, 400.0, 0.1, 0.05][: len(effect.parameters)])
    kelvin = effect.kelvin(TIME_S, u)
    # Three periods of 400 s, the last point the first one again.
    assert kelvin[:-1].mean() == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(kelvin[20:], kelvin[:-20], atol=1e-12)
    np.testing.assert_allclose(modulus(effect, *u), LAW.modulus(OMEGA * time_scale(kelvin)))


def test_an_uneven_cycle_contains_the_even_one():
    np.testing.assert_array_equal(modulus(UNEVEN, 0.5, 0.2, 300.0, 0, 0), modulus(CYCLES, 0.5, 0.2, 300.0))


def test_periods_are_looked_for_half_a_cycle_apart():
    cycles = 1200 / np.array([u[2] for u in CYCLES.starts(None, points())])
    assert cycles[0] == 0.75
    np.testing.assert_allclose(np.diff(cycles), 0.5)
    assert cycles[-1] <= 12


@pytest.mark.parametrize(
    ("seen", "why"),
    [
        (points(timed=False), "too short for a room to cycle"),
        (points(TIME_S / 20), "too short for a room to cycle"),
    ],
)
def test_a_short_sweep_shows_no_cycle(seen, why):
    assert why in CYCLES.objection(seen, None)


def test_each_file_has_a_course_of_its_own():
    assert SETTLES.anew
    assert STEPS.anew
    assert CYCLES.anew
    each = [q for form in (SETTLES, STEPS, CYCLES, UNEVEN) for q in form.parameters if not q.fixed]
    assert all(q.mounting is not None for q in each)


PAUSED_S = TIME_S + np.where(TIME_S > 410, 3600.0, 0.0)


def test_a_step_is_in_a_pause():
    (u,) = STEPS.starts(None, points(PAUSED_S[::-1]))
    assert PAUSED_S[20] < u[1] < PAUSED_S[21]
    np.testing.assert_array_equal(
        STEPS.kelvin(PAUSED_S, np.array([2.0, u[1]])), np.where(TIME_S > 410, 2.0, 0.0)
    )
    assert STEPS.objection(points(PAUSED_S), None) is None


@pytest.mark.parametrize(
    "seen", [points(), points(TIME_S * 14), points(PAUSED_S, timed=False)], ids=["short", "slow", "untimed"]
)
def test_without_a_pause_it_does_not_step(seen):
    assert STEPS.objection(seen, None) == "the sweep has no pause"


def test_a_step_says_when():
    said = STEPS.story({"step": -1.53, "after": 2400.0})
    assert said == "the core is 1.5 K colder after the pause at 40 min"


def test_it_says_how_far_and_how_often():
    said = TemperatureCycleEffect().story({"swing_sine": 0.3, "swing_cosine": -0.4, "period": 900.0})
    assert said == "the core's temperature swings by 0.5 K about its mean, every 15 min"


@pytest.mark.parametrize(
    ("effect", "u", "beyond"),
    [
        (SETTLES, (-16.0, 20.0), True),
        (SETTLES, (4.0, 100.0), False),
        (STEPS, (-20.0, 20.0), False),
        (CYCLES, (1.0, 1.0, 100.0), False),
        (CYCLES, (8.0, 0.0, 100.0), True),
    ],
)
def test_no_core_warms_by_ten_kelvin_in_a_minute(effect, u, beyond):
    assert effect.is_beyond(np.array(u)) is beyond
    assert asks_for_more(effect, np.array(u), None) is beyond


def test_it_says_which_way_it_goes():
    assert SETTLES.story({"warming": -3.0, "time_constant": 600.0}).startswith("the core cools by 3 K")
