"""What a stop came to, as the window says it."""

import pytest

from instrument.engine.client import Stopped


def told(window, stopped):
    said, refused = [], []
    window.controller.said.connect(said.append)
    window.controller.refused.connect(refused.append)
    window.controller._stopped(stopped)
    return said, refused


def test_of_a_shaker_that_the_run_left_silent_before_there_is_no_alarm(window):
    silent = "the shaker is silent already: the run let go of it at rest; asked again: no answer"
    assert told(window, Stopped(False, 1.0, silent, let_go=True)) == ([silent], [])


def test_of_one_that_nobody_knows_to_be_silent_there_is(window):
    assert told(window, Stopped(False, 1.0, "switch it off")) == ([], ["switch it off"])


@pytest.mark.parametrize("let_go", [False, True])
def test_one_that_says_that_it_is_silent_is_said_to_be(window, let_go):
    said = "the shaker is silent, 0.25 s after the stop"
    assert told(window, Stopped(True, 0.25, "the shaker is silent", let_go)) == ([said], [])
