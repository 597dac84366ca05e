"""What a person tells a run, and that nobody is told where there is none."""

from types import SimpleNamespace

import pytest
from PySide6.QtCore import QObject

from gui.actions.run_commands import RunCommands


class Engine:
    """Keeps what it is told."""

    def __init__(self, *, running=True):
        self.running, self.told = running, []

    def __getattr__(self, name):
        return lambda *what: self.told.append((name, *what))


class Live:
    """A run that keeps what it is told itself."""

    def __init__(self, engine, state="sweep"):
        self.engine, self.told = engine, []
        self.state = SimpleNamespace(run=SimpleNamespace(state=state))

    def answer(self, yes=True):
        self.told.append(("answer", yes))

    def stop(self):
        self.told.append("stop")


def commands_to(live, starting=None):
    parent = QObject()
    commands = RunCommands(lambda: live, lambda: starting, parent)
    commands.kept = parent
    return commands


def everything(commands):
    for command in (commands.hold, commands.leave_out, commands.end_sweep, commands.abort, commands.stop):
        command()
    commands.add_step(50.0)


def test_each_command_reaches_the_engine_of_a_run_that_goes_on():
    live = Live(Engine())
    everything(commands_to(live))
    assert live.engine.told == [
        ("hold",),
        ("decline",),
        ("overrule", "end"),
        ("abort",),
        ("overrule", "add", 50.0),
    ]
    assert live.told == ["stop"]


@pytest.mark.parametrize(("state", "told"), [("sweep", "hold"), ("held", "resume")])
def test_hold_holds_and_goes_on(state, told):
    live = Live(Engine(), state)
    commands_to(live).hold()
    assert live.engine.told == [(told,)]


def test_a_run_that_has_ended_is_told_nothing():
    live = Live(Engine(running=False))
    commands = commands_to(live)
    everything(commands)
    assert not commands.running
    assert live.engine.told == live.told == []


def test_without_a_run_every_command_does_nothing():
    commands = commands_to(None)
    everything(commands)
    commands.answer()
    commands.decline()


def test_an_answer_and_a_refusal_reach_the_run():
    live = Live(Engine())
    commands = commands_to(live)
    commands.answer()
    commands.decline()
    assert live.told == [("answer", True), ("answer", False)]


def test_stop_cancels_a_run_that_is_about_to_begin():
    cancelled = []
    starting = SimpleNamespace(cancel=lambda: cancelled.append(1))
    commands_to(None, starting).stop()
    assert cancelled == [1]
