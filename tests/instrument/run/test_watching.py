"""What is asked between two blocks, of devices that answer by a table."""

from types import SimpleNamespace

import pytest

from drivers.shaker import Alarm, ShakerStatus
from instrument.errors import RigStopped
from instrument.run.control import RunControl
from instrument.run.watching import Told, Watching

WELL = {"running": True, "drive_v": 1.0, "frequency_hz": 50.0, "limit_v": 5.0, "alarm": Alarm.NONE}
WELL |= {"ramping": False, "limited": False, "interlock_open": False}


def shaker_that_says(**changes):
    beats = []
    status = ShakerStatus(**{**WELL, **changes})
    return SimpleNamespace(beat=lambda: beats.append(1), status=lambda: status, beats=beats)


def watching(shaker, told=None, control=None):
    told = told or Told(50.0, 1.0)
    return Watching(SimpleNamespace(shaker=shaker), control or RunControl(), told)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"alarm": Alarm.AMPLIFIER}, "alarm: amplifier"),
        ({"interlock_open": True}, "interlock open"),
        ({"running": False}, "switched off by somebody else"),
        ({"frequency_hz": 50.2}, "runs at 50.2 Hz, it was told 50 Hz"),
    ],
)
def test_a_shaker_that_is_not_as_it_was_told_ends_the_run(changes, said):
    with pytest.raises(RigStopped, match=said):
        watching(shaker_that_says(**changes)).look()


def test_a_silent_shaker_is_not_asked_for_its_frequency():
    watching(shaker_that_says(running=False, frequency_hz=0.0), Told(50.0, 0.0)).look()


def test_the_heart_beats_at_the_first_look_and_not_again_at_once():
    shaker = shaker_that_says()
    asked = watching(shaker)
    asked.look()
    asked.look()
    assert len(shaker.beats) == 1


def test_an_abort_ends_the_run_before_the_heart_beats():
    shaker, control = shaker_that_says(), RunControl()
    control.abort("the plate came loose")
    with pytest.raises(RigStopped, match="the plate came loose"):
        watching(shaker, control=control).look()
    assert shaker.beats == []
