"""A shaker that does not obey its stop: told again, and told of where it does not come to rest."""

import os
import signal
import threading
from contextlib import contextmanager

import pytest
from formula_rig import formula_rig
from quick_run import run
from run_at_point import RunAtPoint

from drivers.errors import Refused, TimedOut, Unreachable
from drivers.shaker import Alarm, ShakerStatus
from instrument.cli.stopping import safe_stop
from instrument.errors import NOT_SILENT, SWITCH_OFF, RigStopped, ShakerNotSilent
from instrument.run import at_rest, runner
from instrument.run.at_rest import bring_to_rest, came_to_rest, silenced
from instrument.run.control import RunControl
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


class Deaf:
    """Runs on; obeys the stop of a number alone, before it does what `before` says."""

    def __init__(self, obeys: int, before=lambda: None):
        self.stops, self._obeys, self._before = 0, obeys, before

    def stop(self):
        self.stops += 1
        if self.stops < self._obeys:
            self._before()

    def status(self):
        runs = self.stops < self._obeys
        return ShakerStatus(runs, False, False, False, Alarm.NONE, 2.0 if runs else 0.0, 50.0, 5.0)


def refuse():
    raise Refused("busy")


def be_away():
    raise Unreachable("no connection")


def test_a_stop_that_is_acknowledged_and_not_carried_out_is_said_again():
    shaker = Deaf(4)
    bring_to_rest(shaker)
    assert shaker.stops == 4


def test_a_busy_device_is_told_again():
    shaker = Deaf(3, refuse)
    assert came_to_rest(shaker) == ""
    assert shaker.stops == 3


def test_one_that_refuses_and_is_silent_by_its_watchdog_is_at_rest():
    class Silenced(Deaf):
        def status(self):
            self._obeys = 0
            return super().status()

    assert came_to_rest(Silenced(10**9, refuse), 0.05) == ""


def test_one_that_never_obeys_is_told_of():
    with pytest.raises(TimedOut, match="still 2 V"):
        bring_to_rest(Deaf(10**9), 0.05)
    with pytest.raises(Refused):
        bring_to_rest(Deaf(10**9, refuse), 0.05)


def test_silencing_goes_on_where_the_line_comes_back():
    shaker = Deaf(3, be_away)
    assert silenced(shaker, 5.0) == ""
    assert "no connection" in silenced(Deaf(10**9, be_away), 0.05)


@pytest.mark.parametrize("error", [RuntimeError("can't start new thread"), MemoryError()])
def test_without_a_thread_to_spare_it_is_told_to_stop_all_the_same(monkeypatch, error):
    def none_to_spare(*_):
        raise error

    monkeypatch.setattr(at_rest._thread, "start_new_thread", none_to_spare)
    shaker = Deaf(3)
    assert silenced(shaker, 5.0) == ""
    assert shaker.stops == 3


def test_a_ctrl_c_does_not_break_it_off():
    heard = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: (heard.set(), _raise())[0])

    def interrupt_once():
        # One that comes just before the main thread waits is heard at the next.
        tries = 0
        while not heard.is_set() and tries < 100:
            os.kill(os.getpid(), signal.SIGINT)
            heard.wait(0.05)
            tries += 1

    shaker = Deaf(5, interrupt_once)
    with pytest.raises(KeyboardInterrupt):
        silenced(shaker, 5.0)
    signal.signal(signal.SIGINT, before)
    assert shaker.stops == 5


def _raise():
    raise KeyboardInterrupt


def test_what_keeps_a_shaker_from_silence_is_told_though_a_ctrl_c_came_meanwhile():
    def interrupted():
        os.kill(os.getpid(), signal.SIGINT)
        be_away()

    before = signal.signal(signal.SIGINT, lambda *_: _raise())
    try:
        assert "no connection" in silenced(Deaf(10**9, interrupted), 0.3)
    finally:
        signal.signal(signal.SIGINT, before)


def deafen(rig):
    """The stop is acknowledged, and nothing happens; no watchdog either."""
    device = rig.device
    device.stop = lambda *_: None
    device.check_heartbeat = lambda *_: None


@pytest.fixture
def quick_watchdog(monkeypatch):
    monkeypatch.setattr(runner, "_MARGIN_S", -1.8)


def test_a_run_whose_shaker_runs_on_at_its_end_does_not_end_well(tmp_path, quick_watchdog):
    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.stop
        with pytest.raises(ShakerNotSilent, match=r"^SWITCH THE AMPLIFIER OFF.*15 steps kept"):
            run(experiment, tmp_path, companion=RunAtPoint(3, lambda: deafen(rig)))
        rig.device.stop = honest
        honest(rig.world.clock()[1])
    (session,) = tmp_path.glob("*.h5")
    with SessionFile(session) as file:
        ended = contents_of(file).ended
    assert ended.why == NOT_SILENT
    assert ended.message.startswith(SWITCH_OFF)


class LooksAtTheEnd(RunAtPoint):
    """Whether the shaker is known to be loud as the rig is let go of."""

    def __init__(self, number, do, control):
        super().__init__(number, do)
        self._control, self.loud = control, None

    @contextmanager
    def with_rig(self, rig):
        try:
            yield rig
        finally:
            self.loud = self._control.ended_loud


def test_who_goes_along_knows_that_a_shaker_is_not_silent_as_the_rig_is_let_go_of(tmp_path, quick_watchdog):
    control = RunControl()
    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.stop
        looks = LooksAtTheEnd(3, lambda: (deafen(rig), control.abort("enough")), control)
        with pytest.raises(ShakerNotSilent):
            run(experiment, tmp_path, control=control, companion=looks)
        rig.device.stop = honest
        honest(rig.world.clock()[1])
    assert looks.loud


def test_what_ended_the_run_is_told_too(tmp_path, quick_watchdog):
    control = RunControl()

    def end(rig):
        deafen(rig)
        control.abort("enough")

    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.stop
        with pytest.raises(RigStopped, match=r"^SWITCH THE AMPLIFIER OFF: .*; what came before: enough"):
            run(experiment, tmp_path, control=control, companion=RunAtPoint(3, lambda: end(rig)))
        rig.device.stop = honest
        honest(rig.world.clock()[1])


@pytest.mark.parametrize("insists_s", [10.0, 0.0])
@pytest.mark.parametrize("ended_by", ["itself", "Ctrl-C"])
def test_no_ctrl_c_hides_that_a_shaker_is_not_silent(
    tmp_path, quick_watchdog, monkeypatch, ended_by, insists_s
):
    monkeypatch.setattr("instrument.cli.stopping._INSISTS_S", insists_s)
    control, left = RunControl(), [None] * 3

    def interrupt():
        os.kill(os.getpid(), signal.SIGINT)

    def end(rig):
        deafen(rig)
        honest = rig.device.status

        def asked(*now):
            # Of a shaker that is being silenced.
            if control.ending and left:
                left.pop()
                interrupt()
            return honest(*now)

        rig.device.status = asked
        interrupt() if ended_by == "Ctrl-C" else control.abort("enough")

    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.stop, rig.device.status
        with (
            pytest.raises(ShakerNotSilent, match=r"^SWITCH THE AMPLIFIER OFF.*3 steps kept"),
            safe_stop(control),
        ):
            run(experiment, tmp_path, control=control, companion=RunAtPoint(3, lambda: end(rig)))
        rig.device.stop, rig.device.status = honest
        rig.device.stop(rig.world.clock()[1])
    (session,) = tmp_path.glob("*.h5")
    with SessionFile(session) as file:
        assert contents_of(file).ended.why == NOT_SILENT


def test_a_hold_that_is_not_obeyed_ends_the_run(tmp_path, quick_watchdog):
    control = RunControl()

    def hold(rig):
        deafen(rig)
        control.hold()

    with formula_rig(tmp_path) as (rig, experiment):
        honest = rig.device.stop
        with pytest.raises(RigStopped, match="AMPLIFIER OFF"):
            run(experiment, tmp_path, control=control, companion=RunAtPoint(3, lambda: hold(rig)))
        rig.device.stop = honest
        honest(rig.world.clock()[1])
