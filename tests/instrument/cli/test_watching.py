"""The bar of a run on a terminal."""

import io

from rich.console import Console
from sessions import point

from instrument.cli import watching
from instrument.cli.watching import Watcher


def test_nothing_is_written_over_other_bars_before_something_happens(monkeypatch):
    written = io.StringIO()

    def console(**_):
        return Console(file=written, force_terminal=True)

    monkeypatch.setattr(watching, "Screen", console)
    with Watcher() as watch:
        assert written.getvalue() == ""
        watch([point(1, 20.0, remarks=("weak light",))])
        assert written.getvalue() != ""


def test_a_run_of_which_nothing_was_seen_ends_quietly(monkeypatch):
    written = io.StringIO()
    monkeypatch.setattr(watching, "Screen", lambda **_: Console(file=written, force_terminal=True))
    with Watcher():
        pass
    assert written.getvalue() == ""
