"""A plate that decays too slowly for `most_s` is said before it is measured."""

from types import SimpleNamespace

import numpy as np
import pytest

from instrument.check.forecast import Forecast, expected_seconds
from instrument.check.unsettled import unsettled_remark
from instrument.stepped_sine.expected_time import step_s
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stepped_sine.settings import Settle, SweepSettings

STEPS = [PlannedSegment(1, 1, (20.0, 20.5, 200.0), (9.81,) * 3, "")]


def forecast(*decays_1_s):
    return Forecast(SimpleNamespace(), np.array([20.0, 60.0]), np.array(decays_1_s))


def test_a_plate_that_settles_in_time_is_not_spoken_of():
    assert unsettled_remark(forecast(5.0, 5.0), STEPS, SweepSettings()) is None


def test_what_does_not_settle_is_counted_with_what_is_left_and_what_would_do():
    said = unsettled_remark(forecast(0.42, 9.0), STEPS, SweepSettings())
    assert said is not None
    assert said.startswith(
        "3 of 3 readings (calibration and sentinel among them) do not settle within most_s"
    )
    assert "limit 0.1 %; [sweep.settle] most_s = 45 would do" in said
    patient = SweepSettings(settle=Settle(most_s=45.0))
    assert unsettled_remark(forecast(0.42, 9.0), STEPS, patient) is None


def test_what_no_file_may_wait_for_is_said_to_be_so():
    said = unsettled_remark(forecast(0.01, 9.0), STEPS, SweepSettings())
    assert said is not None
    assert said.endswith("not even most_s = 300 would do")


def test_time_is_of_steps_and_of_a_loop_check_where_the_gain_is_not_known():
    settings, one = SweepSettings(), forecast(5.0, 5.0)
    steps = sum(step_s(f, 5.0, settings) for f in (20.0, 20.5, 200.0))
    checks = 2 * 0.05 + 2 * (3 / 20.0) + 2 * 0.04
    assert expected_seconds(one, STEPS, settings) == pytest.approx(steps + checks)
