"""The limits of a step, and when a chamber's temperature counts as reached."""

from dataclasses import replace

import numpy as np
import pytest

from instrument.stepped_sine.guard import Guard
from instrument.stepped_sine.settings import Limits, SweepSettings
from instrument.stepped_sine.soak import Soak
from instrument.stream.derived import LimitExceeded, LimitWarned
from instrument.stream.raw import SoakBegan, StepBegan, TemperatureRead

LIMITS = Limits(base_m_s2=50.0, velocity_m_s=1.0, travel_m=5e-3, drive_v=5.0, warn=0.8)
SETTINGS = replace(SweepSettings(), limits=LIMITS)


def guard(frequency_hz=100.0, level_m_s2=10.0):
    began = StepBegan(7, "step", 1, 1, frequency_hz, level_m_s2, 1.0, 0.1)
    return Guard(began, SETTINGS)


def block(base_m_s2, velocity_m_s):
    """Of these amplitudes, on offsets that are no motion."""
    turn = np.linspace(0, 2 * np.pi, 1001)
    return np.stack([3 + base_m_s2 * np.sin(turn), -2 + velocity_m_s * np.cos(turn)])


def test_what_is_well_below_every_limit_is_not_spoken_of():
    assert guard().look(block(30.0, 0.5), 3.0) == []


def test_what_comes_near_its_limit_is_said_once_a_step():
    g = guard()
    (said,) = g.look(block(30.0, 0.85), 3.0)
    assert isinstance(said, LimitWarned)
    assert (said.step, said.what, said.limit, said.unit) == (7, "velocity", 1.0, "m/s")
    assert said.value == pytest.approx(0.85, rel=1e-4)
    assert g.look(block(30.0, 0.9), 3.0) == []
    assert [e.what for e in g.look(block(30.0, 0.9), 4.5)] == ["drive"]


@pytest.mark.parametrize(
    ("at_hz", "base", "velocity", "what"),
    [(100, 51, 0.5, "base acceleration"), (100, 30, 1.01, "velocity"), (10, 20, 0.5, "travel of the base")],
)
def test_what_is_over_its_limit_ends_the_run_and_says_what_helps(at_hz, base, velocity, what):
    (said,) = guard(at_hz).look(block(base, velocity), 3.0)
    assert isinstance(said, LimitExceeded)
    assert said.what == what
    assert said.value > said.limit
    assert said.remedy.startswith("lower the level")


def test_a_base_beyond_the_abort_band_of_its_level_ends_the_run_but_a_loop_check_has_no_level():
    highest = 10.0 * (1 + SETTINGS.control.abort)
    assert guard().level(0.999 * highest) == []
    (said,) = guard().level(1.001 * highest)
    assert (said.what, said.limit) == ("base acceleration over its level", highest)
    assert guard(level_m_s2=None).level(1e3) == []


def soaked(*readings):
    """After (temperature in degC, at s); 25 degC within 0.5 K for 100 s, at most 300."""
    soak = Soak(SoakBegan(25.0, 0.5, 100.0, 300.0))
    for value_c, at_s in readings:
        soak.take(TemperatureRead(value_c, 25.0, at_s))
    return soak


def test_a_soak_begins_anew_where_the_temperature_leaves_its_band():
    assert soaked((24.6, 0), (25.4, 100)).done
    left = soaked((24.6, 0), (25.6, 50), (25.4, 60), (25.0, 150))
    assert (left.near_s, left.done) == (90.0, False)
    assert soaked((25.6, 50), (25.4, 60), (25.0, 160)).done


def test_a_soak_that_is_not_done_in_its_time_is_too_late_and_one_done_then_is_not():
    assert not soaked((20.0, 299)).too_late
    assert soaked((20.0, 300)).too_late
    assert not soaked((25.0, 200), (25.0, 300)).too_late


def test_a_soak_says_where_it_stands():
    assert soaked().words == "soaking at 25 °C"
    assert soaked((24.8, 10), (25.04, 50)).words == "soaking 25.0 °C to 25 °C, 40 of 100 s"
