"""A rig of formulas for engines, an engine followed to its end, and the simulated shaker looked at."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from formula_rig import SWEEP, formula_rig
from quick_engine import QUICK_ENGINE

from instrument.engine import Engine, Order
from instrument.engine.messages import Ended, Happened, Message
from instrument.stream.event import Event
from instrument.stream.raw import BlockAcquired

PATIENCE_S = 120.0
LONG = "[[sweep.segments]]\nlow_hz = 80.0\nhigh_hz = 290.0\npoints = 400\n"
_MESH = "[mesh]\nelements_x = 8\nelements_y = 5\n"


@contextmanager
def engine_rig(folder: Path, *, person: bool = False, sweep: str = SWEEP, **options):
    """A `formula_rig` whose forecast is quick; where it has a person, the client is asked."""
    with formula_rig(folder, sweep=sweep, **options) as (rig, experiment):
        with (folder / "specimen.toml").open("a") as file:
            file.write(_MESH)
        if person:
            path = folder / "rig.toml"
            path.write_text(path.read_text().replace('kind = "simulated"', 'kind = "person"'))
        yield rig, experiment.path


@contextmanager
def engine_of(order: Order, command=QUICK_ENGINE) -> Iterator[Engine]:
    engine = Engine.start(order, command)
    try:
        yield engine
    finally:
        engine.close()


def follow(engine: Engine, react: Callable[[Message], object] = lambda m: None) -> list[Message]:
    """Everything until its end."""
    messages: list[Message] = []
    deadline = time.monotonic() + PATIENCE_S
    while engine.running:
        for message in engine.poll():
            messages.append(message)
            react(message)
        assert time.monotonic() < deadline, messages[-5:]
        time.sleep(0.002)
    return messages


def ended(messages: list[Message]) -> Ended:
    (end,) = [m for m in messages if isinstance(m, Ended)]
    assert messages[-1] == end
    return end


def done(messages: list[Message]) -> Ended:
    """Its end, which is a good one."""
    end = ended(messages)
    assert end.why == "done", end.message
    return end


def told(messages: list[Message]) -> list[Event]:
    return [m.event for m in messages if isinstance(m, Happened)]


def without_samples(events: list[Event]) -> list[Event]:
    return [e for e in events if not isinstance(e, BlockAcquired)]


def wait_until(condition: Callable[[], bool], within_s: float = PATIENCE_S) -> float:
    """How long it took. Fails where it does not come true."""
    began = time.monotonic()
    while not condition():
        assert time.monotonic() - began < within_s, f"not within {within_s} s"
        time.sleep(0.002)
    return time.monotonic() - began


def drive_v(rig) -> float:
    """At the shaker's output now, as the device has it."""
    with rig.world.lock:
        return rig.device.status(rig.world.clock()[1]).drive_v


def is_silent(rig) -> bool:
    with rig.world.lock:
        status = rig.device.status(rig.world.clock()[1])
    return status.drive_v == 0 and not status.running
