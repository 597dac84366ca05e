"""How long an answer on a serial line is waited for."""

import pytest

from drivers.modbus.answer_time import answer_time_s, patience_s


@pytest.mark.parametrize("baud", [9600, 19200, 115200])
def test_three_attempts_at_an_answer_take_less_than_the_usual_heartbeat(baud):
    pauses_s = 0.05 + 0.1
    assert 3 * answer_time_s(baud, 2.0) + pauses_s < 2.0


def test_a_slow_line_is_given_the_time_of_its_frames():
    assert answer_time_s(1200, 2.0) - answer_time_s(2400, 2.0) == pytest.approx(2 * 64 * 11 / 2400)


def test_a_device_that_waits_longer_for_a_beat_may_answer_later_and_none_has_less_than_its_cycle():
    assert answer_time_s(115200, 0.1) > 0.1
    assert answer_time_s(115200, 5.0) > 1.0 > answer_time_s(115200, 2.0)


@pytest.mark.parametrize(
    ("baud", "heartbeat_s", "lost"),
    [(115200, 0.7, 2), (115200, 2.0, 2), (9600, 1.9, 2), (9600, 2.0, 2), (115200, 0.5, 1), (9600, 0.8, 1)],
)
def test_lost_answers_and_what_they_are_listened_for_leave_the_beat_in_time(baud, heartbeat_s, lost):
    pause_s = 0.1 * (lost - 1)
    at_once_s = answer_time_s(baud, 0.5)
    lost_s = lost * answer_time_s(baud, heartbeat_s) + patience_s(heartbeat_s)
    assert lost_s + pause_s + at_once_s < heartbeat_s
