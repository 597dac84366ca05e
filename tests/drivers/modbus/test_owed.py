"""A lost answer is listened for, but no longer than there is patience."""

import time

import pytest

from drivers.modbus.owed import Owed


class Line:
    """Silent, or with an answer that comes at once."""

    def __init__(self, *, silent=True):
        self._silent, self.asked_s = silent, []

    def listen(self, until_s):
        now_s = time.monotonic()
        self.asked_s.append(until_s - now_s)
        if self._silent:
            time.sleep(max(0.0, until_s - now_s))
        return not self._silent


def lose_and_settle(owed, line):
    owed.lost()
    owed.settle(line)


def test_where_nothing_was_lost_nothing_is_listened_for():
    line = Line()
    Owed(0.2).settle(line)
    assert line.asked_s == []


def test_answers_lost_in_a_row_share_the_patience_and_another_row_has_its_own():
    owed, line = Owed(0.1), Line()
    lose_and_settle(owed, line)
    lose_and_settle(owed, line)
    owed.row_ended()
    lose_and_settle(owed, line)
    assert line.asked_s[0] == pytest.approx(0.1, abs=0.02)
    assert line.asked_s[1] <= 0.0
    assert line.asked_s[2] == pytest.approx(0.1, abs=0.02)


def test_an_answer_that_was_heard_is_owed_no_more_and_leaves_patience_for_the_next():
    owed, line = Owed(0.1), Line(silent=False)
    for _ in range(2):
        owed.lost()
        time.sleep(0.06)
        owed.settle(line)
        owed.settle(line)
    assert line.asked_s == pytest.approx([0.04, 0.04], abs=0.02)
