"""What a client says of the shaker once the run has let go of it, and of an engine that it had to end."""

from pathlib import Path

import pytest
from engine_cases import ended, follow, wait_until

from drivers.errors import DriverError
from drivers.shaker.modbus_driver import ModbusTcpOptions
from instrument.engine import Engine, Order, client, stop_path
from instrument.engine.messages import Happened, RecordingBegan, RigClosed, RigOpened
from instrument.engine.wire import encode
from instrument.errors import NOT_SILENT, SWITCH_OFF
from instrument.stream.raw import SessionEnded

LOUD = SessionEnded(NOT_SILENT, f"{SWITCH_OFF}: it does not answer")


class Away:
    """A shaker that does not answer."""

    def stop(self):
        raise DriverError("no answer")

    def status(self):
        raise DriverError("no answer")

    def close(self):
        pass


@pytest.fixture
def says(monkeypatch, tmp_path):
    """An engine that says this and no more, and does not end; its client's way to the shaker is `Away`."""
    monkeypatch.setattr(stop_path, "open_shaker", lambda *_, **__: Away())
    monkeypatch.setattr(client, "ENDS_S", 0.3)
    started = []

    def start(*messages):
        file = tmp_path / "said"
        file.write_bytes(b"".join(encode(m) for m in messages))
        engine = Engine.start(Order(Path("a.toml"), tmp_path), ("sh", "-c", f"cat '{file}'; exec sleep 60"))
        started.append(engine)
        heard = []
        wait_until(lambda: heard.extend(engine.poll()) or all(m in heard for m in messages), 20.0)
        return engine

    yield start
    for engine in started:
        engine.close()


def opened(tmp_path):
    folder = tmp_path / "a.running"
    folder.mkdir()
    table = ModbusTcpOptions(address="127.0.0.1:1")
    return RecordingBegan(folder, tmp_path / "a.h5"), RigOpened(table)


def test_a_stop_after_a_run_that_left_the_shaker_running_says_to_switch_it_off(says, tmp_path):
    engine = says(*opened(tmp_path), RigClosed(at_rest=False))
    stopped = engine.stop()
    assert (stopped.silent, stopped.let_go) == (False, False)
    assert stopped.message == f"{SWITCH_OFF}: the run had let go of a shaker that did not stop: no answer"


def test_of_a_shaker_that_the_run_left_at_rest_there_is_no_alarm(says, tmp_path):
    stopped = says(*opened(tmp_path), RigClosed()).stop()
    assert (
        stopped.message
        == "the shaker is silent already: the run let go of it at rest; asked again: no answer"
    )
    assert stopped.let_go


def test_an_engine_ended_as_it_keeps_a_run_is_told_of_with_what_ended_that(says, tmp_path):
    engine = says(*opened(tmp_path), RigClosed(at_rest=False), Happened(LOUD))
    engine.stop()
    end = ended(follow(engine))
    assert end.why == "died"
    assert end.message.startswith(f"{SWITCH_OFF} to be sure: no answer")
    assert "did not end within 0.3 s and was ended" in end.message
    assert f"what came before: {LOUD.message}" in end.message
    assert end.message.endswith(f"what is complete is in {end.folder}: viscorig recover {end.folder}")


def test_what_a_run_that_is_resumed_had_ended_by_is_not_the_end_of_the_new_one(says, tmp_path):
    began, rig = opened(tmp_path)
    engine = says(began, Happened(LOUD), rig)
    engine.stop()
    assert "what came before" not in ended(follow(engine)).message
