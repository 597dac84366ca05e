"""The live fit beside a run: one that fails is told of at once, and the next points are fitted anew."""

import logging
import threading

import pytest
from quick_run import no_fit
from sessions import point

from instrument.errors import RigStopped
from instrument.run import live_fit
from instrument.run.live_fit import LiveFit
from instrument.stream.derived import FitUpdated
from instrument.stream.raw import FitFailed, FitStarted


class Fits:
    """The first raises an error, the later ones do not; told of each end."""

    def __init__(self, error):
        self._error, self.ended = error, threading.Semaphore(0)

    def __call__(self, number, *asked):
        self.ended.release()
        if number == 1:
            raise self._error
        return no_fit(number, *asked)


@pytest.fixture
def heard(caplog, monkeypatch):
    """What is logged, and when something is."""
    monkeypatch.setattr(live_fit.log, "propagate", True)
    with caplog.at_level(logging.WARNING, live_fit.log.name):
        yield caplog


def words_for(heard, error):
    said = threading.Event()
    handler = logging.Handler()
    handler.emit = lambda _: said.set()
    live_fit.log.addHandler(handler)
    emitted = []
    try:
        with LiveFit(None, emitted.append, Fits(error)) as live:
            live.offer([point(1)], None)
            # Before the sweep is over.
            assert said.wait(5.0)
            live.offer([point(1), point(2)], None)
    finally:
        live_fit.log.removeHandler(handler)
    assert [type(e) for e in emitted] == [FitStarted, FitFailed, FitStarted, FitUpdated]
    (failed,) = (e for e in emitted if isinstance(e, FitFailed))
    assert f"no fit of the points up to step 1: {failed.message}" in heard.messages
    assert failed.number == 1
    assert live.latest.last_step == 2
    return heard.messages


@pytest.mark.parametrize(
    ("error", "said"),
    [(MemoryError(), "no memory left"), (KeyError("x"), "internal error, KeyError: 'x'")],
)
def test_a_fit_that_fails_is_told_of_at_once_and_the_next_points_are_fitted(heard, error, said):
    assert words_for(heard, error) == [f"no fit of the points up to step 1: {said}"]


def test_where_there_is_no_memory_to_tell_of_a_failed_fit_the_next_points_are_fitted_all_the_same(heard):
    emitted, untold = [], threading.Event()

    def emit(event):
        if isinstance(event, FitFailed):
            untold.set()
            raise MemoryError
        emitted.append(event)

    with LiveFit(None, emit, Fits(KeyError("x"))) as live:
        live.offer([point(1)], None)
        assert untold.wait(5.0)
        live.offer([point(1), point(2)], None)
    assert [type(e) for e in emitted] == [FitStarted, FitStarted, FitUpdated]
    assert live.latest.last_step == 2
    assert heard.messages[1] == "that fit 1 failed is not recorded: no memory left"


def test_where_nothing_is_recorded_any_more_that_a_fit_failed_is_not_told_either(heard):
    def emit(event):
        if isinstance(event, FitFailed):
            raise RigStopped("disk full")

    with pytest.raises(RigStopped, match="disk full"), LiveFit(None, emit, Fits(MemoryError())) as live:
        live.offer([point(1)], None)
    assert heard.messages == ["no fit of the points up to step 1: no memory left"]


def test_that_the_newest_points_have_no_fit_is_raised_in_the_end():
    with pytest.raises(MemoryError), LiveFit(None, lambda _: None, Fits(MemoryError())) as live:
        live.offer([point(1)], None)


def test_where_nothing_is_recorded_any_more_nothing_is_fitted(heard):
    def fails(_):
        raise RigStopped("disk full")

    with pytest.raises(RigStopped, match="disk full"), LiveFit(None, fails, no_fit) as live:
        live.offer([point(1)], None)
    assert not heard.messages
