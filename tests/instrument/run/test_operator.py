"""What is typed during a hammer test, and what the simulated rig's person does."""

import os
import pty
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from instrument.errors import RigStopped
from instrument.run.control import RunControl
from instrument.run.operator import Person, SimulatedOperator, decision, overruling
from instrument.stream.raw import OperatorDid


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("r\n", OperatorDid("rejected", "", 0)),
        ("a 3\n", OperatorDid("accepted", "", 3)),
        ("u 12\n", OperatorDid("undone", "", 12)),
    ],
)
def test_a_letter_and_a_number_decide_about_a_hit(typed, meant):
    assert decision(typed) == meant


@pytest.mark.parametrize("typed", ["", "\n", "x", "r r", "r 1 2", "r -1", "r 1.5", "reject"])
def test_anything_else_means_nothing(typed):
    assert decision(typed) is None


def test_nobody_at_the_terminal_ends_the_run_with_what_was_asked(monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    with pytest.raises(RigStopped, match="nobody answered: Mount the bare specimen"):
        Person().mount("bare")
    assert Person().decided() == []
    assert Person().content(3)


def test_typed_words_overrule_a_sweep():
    control = RunControl()
    control.chooses_steps = True
    assert not any(overruling(typed, control) for typed in ("s\n", "+ 45.2\n", "e\n"))
    assert control.declined()
    assert not control.declined()
    assert [control.word(), control.word(), control.word()] == [("add", 45.2), ("end", None), None]


@pytest.mark.parametrize("typed", ["", "x", "+", "+ -3", "+ nan", "+ 1 2", "s 3"])
def test_other_words_overrule_nothing(typed):
    control = RunControl()
    control.chooses_steps = True
    assert overruling(typed, control) == "expected s (leave this step out), + 45.2 (add a step) or e (end)"
    assert control.word() is None


@pytest.mark.parametrize(("typed", "said"), [("e", "e is for"), ("+ 45", "+ is for"), ("x", "expected s (")])
def test_a_sweep_of_fixed_steps_hints_at_nothing_that_it_does_not_do(typed, said):
    control = RunControl()
    answer = overruling(typed, control)
    assert answer.startswith(said)
    assert "(end)" not in answer
    assert control.word() is None
    assert not overruling("s", control)
    assert control.declined()


@pytest.mark.parametrize("operator", [Person(), SimulatedOperator("", (0.0, 0.0), (0.0, 0.0))])
def test_a_step_is_left_out_from_the_terminal_whoever_operates(operator, monkeypatch):
    master, terminal = pty.openpty()
    control = RunControl()
    with os.fdopen(terminal) as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        monkeypatch.setattr("os.tcgetpgrp", lambda _: os.getpgrp())
        os.write(master, b"s\n")
        operator.overrule(control)
        assert control.declined()
        # What is typed while the job is in the background is for another.
        monkeypatch.setattr("os.tcgetpgrp", lambda _: os.getpgrp() + 1)
        os.write(master, b"s\n")
        operator.overrule(control)
        assert not control.declined()
    os.close(master)


def test_the_simulated_rig_is_reached_past_a_proxy_of_the_environment(monkeypatch):
    asked = []

    class Rig(BaseHTTPRequestHandler):
        def do_PUT(self):
            asked.append(self.path)
            self.send_response(200)
            self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *said):
            pass

    monkeypatch.setenv("HTTP_PROXY", "http://127.0.0.1:9")
    monkeypatch.setenv("http_proxy", "http://127.0.0.1:9")
    monkeypatch.setenv("NO_PROXY", "")
    monkeypatch.setenv("no_proxy", "")
    with HTTPServer(("127.0.0.1", 0), Rig) as server:
        server.timeout = 10.0
        thread = threading.Thread(target=server.handle_request, daemon=True)
        thread.start()
        person = SimulatedOperator(f"http://127.0.0.1:{server.server_port}", (0.0, 0.0), (0.0, 0.0))
        person.hit(0, 1)
        thread.join()
    assert asked == ["/simulated/hit"]
