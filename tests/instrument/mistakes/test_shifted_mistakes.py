"""Tables of several temperatures whose columns are meant otherwise than they are read."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, read

from fitting.errors import OutsideModel
from instrument.mistakes.shifted_mistakes import doubt_at_temperatures

TABLES = [read(BEAM, 5, seed) for seed in range(3)]
T = [0.0, 20.0, 40.0]
NEAR_HZ = np.concatenate([t.frequency_hz for t in TABLES])


def asked(chi2, left_of, tables=TABLES, predicted_hz=NEAR_HZ):
    """`left_of`: chi-square of each table by how many times its losses are those that were given."""

    def left_by(others):
        times = [o.loss_factor[0] / t.loss_factor[0] for o, t in zip(others, tables, strict=True)]
        return np.array([left_of(k, times[k]) for k in range(len(tables))])

    return doubt_at_temperatures(tables, T, np.array(chi2), predicted_hz, left_by)


def test_losses_that_are_damping_ratios_at_all_temperatures_are_asked_about():
    said = asked([30.0, 90.0, 50.0], lambda k, times: 5.0 if times == pytest.approx(2) else 300.0)
    assert said == (
        "a law of each temperature follows the modes far better (chi-square 15, not 170) if loss_factor "
        "holds damping ratios, half of it: is it so?"
    )


def test_at_one_temperature_that_one_is_named():
    def left(k, times):
        return (3.0 if k == 1 else 200.0) if times == pytest.approx(2) else 300.0

    said = asked([3.0, 90.0, 5.0], left)
    assert "(chi-square 11, not 98) if at 20 degC loss_factor holds damping ratios" in said


def test_decrements_are_asked_about_where_much_is_left():
    said = asked([300.0] * 3, lambda k, times: 8.0 if times == pytest.approx(1 / np.pi) else 280.0)
    assert "loss_factor holds logarithmic decrements" in said


def test_what_no_other_reading_makes_far_better_is_not_asked_about():
    assert asked([30.0, 90.0, 50.0], lambda k, times: 37.0) == ""
    assert asked([1.0, 2.0, 3.0], None) == ""


def test_a_reading_that_no_structure_has_is_none():
    def left(k, times):
        raise OutsideModel("no such modes")

    assert asked([30.0, 90.0, 50.0], left) == ""


def test_frequencies_in_khz_are_asked_about_before_any_other_reading():
    small = [replace(t, frequency_hz=1e-3 * t.frequency_hz) for t in TABLES]
    assert "in kHz" in asked([30.0, 90.0, 50.0], None, small)
