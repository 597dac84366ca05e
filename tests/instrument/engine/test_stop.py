"""The stop button's way to the shaker: past an acquisition that hangs, past an engine that is frozen."""

import os
import signal
import threading
import time

import httpx
import pytest
from engine_cases import LONG, drive_v, ended, engine_of, engine_rig, follow, is_silent, told, wait_until
from quick_engine import QUICK_ENGINE

from instrument.engine import Engine, Order, client
from instrument.engine.messages import OperatorAsked, StopPathChanged
from instrument.session.storage import SessionFile
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import BlockAcquired, SessionEnded

pytestmark = pytest.mark.timing
WITHIN_S = 0.5


def order_on(wire: str, rig, experiment, tmp_path) -> Order:
    """The sweep, the shaker on this wire, its heartbeat too slow to be what silences it."""
    path = tmp_path / "rig.toml"
    text = path.read_text().replace("[shaker]", "[shaker]\nheartbeat_timeout_s = 10.0")
    if wire == "modbus-rtu":
        host, port = rig.modbus.address
        text = text.replace('"modbus-tcp"', '"modbus-rtu"').replace(f"{host}:{port}", rig.modbus.rtu_path)
    path.write_text(text)
    return Order(experiment, tmp_path, ("sweep",))


def wait_until_driven(rig, engine) -> None:
    """And measured with, and the client's own way known to stand or not."""
    messages = []

    def ready() -> bool:
        messages.extend(engine.poll())
        points = any(isinstance(e, PointMeasured) for e in told(messages))
        return points and any(isinstance(m, StopPathChanged) for m in messages) and drive_v(rig) > 0.05

    wait_until(ready)


def hang(rig, engine) -> None:
    """The stream falls silent; until the run waits for samples."""
    httpx.put(f"{rig.front_end.url}/simulated/hang", trust_env=False).raise_for_status()
    last = [time.monotonic()]

    def quiet() -> bool:
        if any(isinstance(e, BlockAcquired) for e in told(engine.poll())):
            last[0] = time.monotonic()
        return time.monotonic() - last[0] > 0.3

    wait_until(quiet)


def freeze(_rig, engine) -> None:
    os.kill(engine.pid, signal.SIGSTOP)


def stop_timed(rig, engine):
    """What `stop` returns, and how long the drive took to zero, both from the call on."""
    assert drive_v(rig) > 0.05
    stopped = []
    thread = threading.Thread(target=lambda: stopped.append(engine.stop()))
    began = time.monotonic()
    thread.start()
    wait_until(lambda: drive_v(rig) == 0, 5)
    took = time.monotonic() - began
    thread.join(10)
    return stopped[0], took


def assert_not_driven_again(rig) -> None:
    """After the stop no start, no command, in the device's own record."""
    said = [entry.what for entry in rig.device.log]
    assert not [what for what in said[said.index("stopped") :] if what.startswith(("started", "command"))]


@pytest.mark.parametrize(("wire", "virtual"), [("modbus-tcp", False), ("modbus-rtu", True)])
def test_with_acquisition_hung_the_shaker_is_silent_at_once_and_the_session_kept(tmp_path, wire, virtual):
    with engine_rig(tmp_path, sweep=LONG, virtual=virtual) as (rig, experiment):
        with engine_of(order_on(wire, rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            hang(rig, engine)
            stopped, took = stop_timed(rig, engine)
            end = ended(follow(engine))
        assert is_silent(rig)
        assert_not_driven_again(rig)
    assert took < WITHIN_S
    assert stopped.silent, stopped.message
    assert stopped.seconds < 1.0
    assert end.why == "stopped by the user"
    with SessionFile(end.session) as file:
        events = list(file.events(with_samples=False))
    assert any(isinstance(e, PointMeasured) for e in events)
    assert events[-1] == SessionEnded("stopped by the user", "")


def test_with_the_engine_frozen_the_client_silences_the_shaker_by_its_own_way(tmp_path, monkeypatch):
    monkeypatch.setattr(client, "ENDS_S", 1.0)
    with engine_rig(tmp_path, sweep=LONG, virtual=False) as (rig, experiment):
        with engine_of(order_on("modbus-tcp", rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            freeze(rig, engine)
            stopped, took = stop_timed(rig, engine)
            end = ended(follow(engine))
        assert is_silent(rig)
        assert_not_driven_again(rig)
    assert took < WITHIN_S
    assert stopped.silent, stopped.message
    assert end.why == "died"
    assert "did not end within" in end.message
    assert f"viscorig recover {end.folder}" in end.message
    assert sum(1 for _ in end.folder.glob("part-*.h5")) >= 1


def test_with_the_engine_frozen_on_a_serial_line_its_process_is_ended_to_free_the_line(tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (rig, experiment):
        with engine_of(order_on("modbus-rtu", rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            freeze(rig, engine)
            stopped, took = stop_timed(rig, engine)
            end = ended(follow(engine))
        assert is_silent(rig)
        assert_not_driven_again(rig)
    assert stopped.silent, stopped.message
    assert "did not answer and was ended" in stopped.message
    assert took < 2.0
    assert end.why == "died"


def test_an_engine_that_wakes_up_after_a_stop_does_not_drive_again(tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (rig, experiment):
        with engine_of(order_on("modbus-tcp", rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            freeze(rig, engine)
            stop_timed(rig, engine)
            os.kill(engine.pid, signal.SIGCONT)
            end = ended(follow(engine))
        assert is_silent(rig)
        assert_not_driven_again(rig)
    assert end.why == "stopped by the user"


@pytest.mark.parametrize("wire", ["modbus-tcp", "modbus-rtu"])
def test_a_stop_of_a_run_in_order_is_quick_and_may_come_twice(tmp_path, wire):
    with engine_rig(tmp_path, sweep=LONG) as (rig, experiment):
        with engine_of(order_on(wire, rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            stopped, took = stop_timed(rig, engine)
            engine.stop()
            end = ended(follow(engine))
        assert is_silent(rig)
        assert_not_driven_again(rig)
    assert took < WITHIN_S
    assert stopped.silent, stopped.message
    assert end.why == "stopped by the user"


def test_a_stop_while_held_lasts_though_the_run_is_told_to_go_on(tmp_path):
    with engine_rig(tmp_path, sweep=LONG) as (rig, experiment):
        with engine_of(order_on("modbus-tcp", rig, experiment, tmp_path)) as engine:
            wait_until_driven(rig, engine)
            engine.hold()
            wait_until(lambda: is_silent(rig))
            said = len(rig.device.log)
            engine.stop()
            engine.resume()
            end = ended(follow(engine))
        assert is_silent(rig)
        assert not [e for e in rig.device.log[said:] if e.what.startswith("command")]
    assert end.why == "stopped by the user"


def test_a_stop_before_anything_is_driven_ends_the_run(tmp_path):
    with engine_rig(tmp_path, person=True) as (rig, experiment):
        with engine_of(Order(experiment, tmp_path, ("sweep",))) as engine:
            wait_until(lambda: any(isinstance(m, OperatorAsked) for m in engine.poll()))
            stopped = engine.stop()
            assert stopped.silent, stopped.message
            end = ended(follow(engine))
        assert not rig.device.log
    assert (end.why, end.message) == ("stopped by the user", "nothing was measured")


def test_a_shaker_that_the_run_let_go_of_and_that_is_away_by_now_is_no_alarm(tmp_path):
    with engine_rig(tmp_path) as (rig, experiment):
        engine = Engine.start(Order(experiment, tmp_path, ("sweep",)), QUICK_ENGINE)
        ended(follow(engine))
        wait_until(lambda: is_silent(rig))
    stopped = engine.stop()
    engine.close()
    assert not stopped.silent
    assert stopped.message.startswith(
        "the shaker is silent already: the run let go of it at rest; asked again: "
    )
    assert "no connection" in stopped.message


def test_where_the_shaker_takes_no_second_connection_the_client_says_so_and_the_engine_stops_it(
    tmp_path, monkeypatch
):
    monkeypatch.setattr("instrument.engine.stop_path.open_shaker", _nobody_there)
    told_why = []
    with (
        engine_rig(tmp_path, sweep=LONG, virtual=False) as (rig, experiment),
        engine_of(order_on("modbus-tcp", rig, experiment, tmp_path)) as engine,
    ):

        def said() -> bool:
            told_why.extend(m for m in engine.poll() if isinstance(m, StopPathChanged))
            return bool(told_why)

        wait_until(said)
        wait_until(lambda: drive_v(rig) > 0.05)
        stopped, took = stop_timed(rig, engine)
        end = ended(follow(engine))
    assert not told_why[0].ready
    assert "no connection" in told_why[0].message
    assert (stopped.silent, stopped.message) == (True, "the shaker is silent")
    assert took < WITHIN_S
    assert end.why == "stopped by the user"


def _nobody_there(table, **options):
    from instrument.run.rig import open_shaker

    return open_shaker(table.model_copy(update={"address": "127.0.0.1:1"}), **options)
