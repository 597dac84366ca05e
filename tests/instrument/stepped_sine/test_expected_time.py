"""How long a step is expected to take, beside what `Settling` decides of such a transient."""

import numpy as np
import pytest

from instrument.stepped_sine.expected_time import left_at_most_s, loop_checks_s, settling_s, step_s
from instrument.stepped_sine.patience import LONGEST_S, enough_s
from instrument.stepped_sine.settings import Settle, SweepSettings
from instrument.stepped_sine.settling import Settling

SETTINGS = SweepSettings()


@pytest.mark.parametrize("decay_1_s", [0.4, 5.0, 30.0, 500.0])
@pytest.mark.parametrize("frequency_hz", [20.0, 250.0])
def test_a_transient_of_a_tenth_is_let_go_of_when_it_is_expected(decay_1_s, frequency_hz):
    block = SETTINGS.block_s(frequency_hz)
    expected = settling_s(frequency_hz, decay_1_s, SETTINGS)
    settling, blocks = Settling(decay_1_s, SETTINGS.settle.tolerance), 0
    q = np.exp(-decay_1_s * block)
    # A drift of a tenth from the first to the second block.
    while not settling.add(1.0 + 0.1 * q**blocks / (1 - q), 0.0, block):
        blocks += 1
    assert expected == pytest.approx((blocks + 1) * block, abs=2.1 * block)


def test_what_is_left_when_most_s_ends_a_wait_is_above_the_tolerance_only_where_more_is_needed():
    for decay in (0.2, 0.5, 1.0, 2.0, 8.0):
        needs_more = settling_s(50.0, decay, SETTINGS) > SETTINGS.settle.most_s
        assert (left_at_most_s(50.0, decay, SETTINGS) > SETTINGS.settle.tolerance) == needs_more


def test_a_step_is_a_ramp_a_wait_that_most_s_ends_and_a_dwell():
    assert step_s(50.0, 0.1, SETTINGS) == pytest.approx(0.05 + 8.0 + 0.4)
    patient = SweepSettings(settle=Settle(most_s=np.inf))
    assert step_s(50.0, 0.1, patient) == pytest.approx(0.05 + settling_s(50.0, 0.1, patient) + 0.4)
    # Without any damping it takes very long, and that is all.
    assert settling_s(50.0, 0.0, patient) > 1e6


def test_the_shakers_gain_is_looked_for_where_none_is_known_near_by():
    found = loop_checks_s([20.0, 20.5, 30.0, 20.2], SETTINGS, known_hz=[31.0])
    assert [x > 0 for x in found] == [True, False, False, False]
    assert found[0] == pytest.approx(0.05 + 2 * 3 / 20.0)


def test_enough_has_room_is_round_and_no_more_than_a_file_may_ask():
    assert enough_s(10.1) == 25.0
    assert enough_s(1e4) == LONGEST_S
