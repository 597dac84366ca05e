"""What is asked between two blocks, of devices that answer by a table."""

import re
from types import SimpleNamespace

import pytest

from drivers.errors import Refused
from drivers.shaker import Alarm, ShakerStatus
from instrument.errors import RigStopped
from instrument.run.beats import Beats
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


def test_a_shaker_that_the_users_own_stop_has_silenced_is_nobody_elses_deed():
    """The stop goes straight to the shaker; the run hears of it after it has seen that it stands still."""
    control = RunControl()

    def stopped():
        control.interrupt()
        return ShakerStatus(**{**WELL, "running": False})

    shaker = SimpleNamespace(beat=lambda: None, status=stopped)
    with pytest.raises(KeyboardInterrupt):
        watching(shaker, control=control).look()
    refused = watching(shaker, control=control)
    with pytest.raises(KeyboardInterrupt):
        refused.explained(Refused("busy"))


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


def slowed(asked):
    """The vibrometer took its time before now."""
    now = iter((0.0, 0.0, 2.1, 2.4))
    asked.beats = Beats(lambda: next(now, 2.4), lambda since: 0.0)
    with asked.beats.asking("vibrometer"):
        pass
    return asked


HELD_UP = r"no beat for 2\.4 s, of which the vibrometer took 2\.1 s: its answers are slow"


def test_an_alarm_of_the_heartbeat_says_what_held_the_beat_up():
    with pytest.raises(RigStopped, match=rf"alarm: heartbeat \({HELD_UP}\): remove its cause"):
        slowed(watching(shaker_that_says(alarm=Alarm.HEARTBEAT))).look()


@pytest.mark.parametrize(
    ("alarm", "said"), [(Alarm.HEARTBEAT, f"refused; {HELD_UP}"), (Alarm.NONE, "refused")]
)
def test_a_command_that_is_refused_for_a_stale_heartbeat_says_so_too(alarm, said):
    asked = slowed(watching(shaker_that_says(alarm=alarm)))
    assert re.fullmatch(said, str(asked.explained(Refused("refused"))))


def test_answers_that_the_shaker_loses_are_said_a_few_times_while_the_run_goes_on(caplog):
    asked = watching(shaker_that_says())
    for lost in (2, 3, 4, 29, 31):
        asked._rig.shaker, asked.beats = shaker_that_says(lost_answers=lost), Beats()
        asked.look()
    said = [record.getMessage() for record in caplog.records]
    assert [one.split(" answers")[0] for one in said] == ["shaker: 3", "shaker: 31"]


def test_a_range_is_asked_for_in_the_vibrometers_own_time():
    asked = watching(shaker_that_says(), Told(range=SimpleNamespace(name="fine")))
    asked._rig.vibrometer = SimpleNamespace(range=lambda: SimpleNamespace(name="coarse"))
    with pytest.raises(RigStopped, match="range is coarse, it was set to fine"):
        asked.confirm_range()
