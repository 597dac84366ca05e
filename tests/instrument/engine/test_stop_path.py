"""The client's own way to the shaker, past the engine."""

import threading
from types import SimpleNamespace

import pytest

from drivers.errors import DriverError
from instrument.engine import stop_path
from instrument.engine.messages import ShakerSeen, StopPathChanged
from instrument.engine.stop_path import StopPath


class Shaker:
    """Says what it is told to, in turn; the last one again and again."""

    def __init__(self, *drives):
        self.drives, self.stopped, self.closed = list(drives), 0, False
        self.looked = threading.Semaphore(0)

    def status(self):
        drive = self.drives.pop(0) if len(self.drives) > 1 else self.drives[0]
        self.looked.release()
        if isinstance(drive, str):
            raise DriverError(drive)
        return SimpleNamespace(drive_v=0.0 if self.stopped else drive, running=not self.stopped)

    def stop(self):
        self.stopped += 1

    def close(self):
        self.closed = True


@pytest.fixture
def opened(monkeypatch):
    """A way to a shaker, and what the client was told of it; `shared` as its driver says."""
    monkeypatch.setattr(stop_path, "_LOOKS_EVERY_S", 0.001)
    ways = []

    def open_way(shaker, *, shared=True, looks=1):
        told = []
        monkeypatch.setattr(stop_path, "open_shaker", lambda table, **_: shaker)
        monkeypatch.setattr(stop_path, "SHAKERS", {"any": SimpleNamespace(is_shared=shared)})
        way = StopPath(SimpleNamespace(kind="any"), told.append)
        ways.append(way)
        for _ in range(looks):
            assert shaker.looked.acquire(timeout=5)
        return way, told

    yield open_way
    for way in ways:
        way.close()


def changes(told):
    return [m for m in told if isinstance(m, StopPathChanged)]


def test_a_way_that_stands_is_said_once_and_the_drive_is_seen_again_and_again(opened):
    way, told = opened(Shaker(0.5, 0.7), looks=4)
    way.close()
    assert changes(told) == [StopPathChanged(True)]
    seen = [m for m in told if isinstance(m, ShakerSeen)]
    assert [m.drive_v for m in seen[:3]] == [0.5, 0.7, 0.7]
    assert seen[0].at_s < seen[1].at_s


def test_a_way_that_is_lost_and_found_again_is_said_each_time_with_why(opened):
    way, told = opened(Shaker(0.5, "no\nanswer", "no answer", 0.5), looks=6)
    way.close()
    assert changes(told) == [
        StopPathChanged(True),
        StopPathChanged(False, "no answer"),
        StopPathChanged(True),
    ]


def test_a_device_with_room_for_one_program_is_not_asked_beside_the_engine(opened):
    shaker = Shaker(0.5)
    way, told = opened(shaker, shared=False, looks=0)
    way.close()
    assert not way.is_shared
    (said,) = told
    assert said == StopPathChanged(False, stop_path._ALONE)
    assert not shaker.looked.acquire(blocking=False)
    assert shaker.closed


def test_a_stop_waits_until_the_shaker_is_at_rest_or_says_why_it_is_not(opened):
    shaker = Shaker(0.5)
    way, _ = opened(shaker)
    assert way.silence() == ""
    assert shaker.stopped == 1
    silent, _ = opened(Shaker("no\nanswer"))
    assert silent.silence() == "no answer"


def test_a_way_that_is_closed_has_let_go_of_its_connection(opened):
    shaker = Shaker(0.5)
    way, told = opened(shaker)
    way.close()
    assert shaker.closed
    count = len(told)
    threading.Event().wait(0.01)
    assert len(told) == count
