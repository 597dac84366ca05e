"""The longest time without a beat, and whose it was."""

from contextlib import suppress

import pytest

from drivers.errors import TimedOut
from instrument.run.beats import Beats


class Clock:
    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def beats(clock):
    return Beats(clock, lambda since: 0.0)


def test_a_beat_is_due_at_first_and_then_after_its_time(beats, clock):
    assert beats.due(0.2)
    beats.beaten()
    assert not beats.due(0.2)
    clock.now_s += 0.25
    assert beats.due(0.2)


def test_the_longest_pause_is_said_with_the_device_that_took_most_of_it(beats, clock):
    for slow_s, other_s in ((0.1, 0.1), (2.1, 0.3), (0.2, 0.1)):
        with beats.asking("vibrometer"):
            clock.now_s += slow_s
        with beats.asking("front-end"):
            clock.now_s += other_s
        beats.beaten()
    assert beats.said == "no beat for 2.4 s, of which the vibrometer took 2.1 s: its answers are slow"


def test_a_pause_that_goes_on_counts_from_the_start(beats, clock):
    beats.restart()
    with suppress(TimedOut), beats.asking("chamber"):
        clock.now_s += 3.0
        raise TimedOut("no line")
    assert beats.said == "no beat for 3.0 s, of which the chamber took 3.0 s: its answers are slow"


def test_a_pause_that_no_device_took_names_none(beats, clock):
    with beats.asking("vibrometer"):
        clock.now_s += 0.5
    clock.now_s += 2.0
    assert beats.said == "no beat for 2.5 s"


def test_what_was_before_a_start_is_forgotten(beats, clock):
    with beats.asking("vibrometer"):
        clock.now_s += 9.0
    beats.restart()
    clock.now_s += 0.3
    assert beats.said == "no beat for 0.3 s"


def test_a_shaker_that_loses_answers_is_not_called_slow(beats, clock):
    beats.lost_answers = 4
    with beats.asking("shaker"):
        clock.now_s += 2.1
    assert "took 2.1 s: 4 of its answers were lost or damaged so far: check cable" in beats.said
    beats.restart()
    with beats.asking("vibrometer"):
        clock.now_s += 2.1
    assert beats.said.endswith("its answers are slow")


def test_no_device_is_blamed_for_the_time_that_the_program_itself_stood_still(clock):
    beats = Beats(clock, lambda since: min(4.1, clock.now_s - since))
    with beats.asking("front-end"):
        clock.now_s += 4.2
    beats.beaten()
    assert beats.said == (
        "no beat for 4.2 s, for 4.1 s of which this program itself stood still: "
        "was it stopped, or the computer too busy?"
    )
