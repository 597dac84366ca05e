"""What the sweep's page has read and computed beside the window: the last wish counts."""

import threading
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QObject, Signal
from sessions import configuration

from gui.background import one_command
from gui.pages.sweep import dwells as reading
from gui.pages.sweep import model as computing
from gui.pages.sweep.curve import grid
from gui.pages.sweep.dwells import Dwells
from gui.pages.sweep.model import ForeseenCurve, ModelCurve
from instrument.errors import BadInput
from instrument.facts.prediction import PredictionResult

A, B = Path("a.h5"), Path("b.h5")


# Samples of a dwell


@pytest.fixture
def dwells(qapp, monkeypatch):
    """Reads that wait for `go`; what was read, and what came of it."""
    go, read = threading.Event(), []

    @contextmanager
    def session(path):
        yield path

    def dwell_of(path, step, progress):
        read.append((path, step))
        assert go.wait(5)
        progress()
        if step < 0:
            raise BadInput(f"no step {step}")
        return f"samples of {path} {step}"

    monkeypatch.setattr(reading, "SessionFile", session)
    monkeypatch.setattr(reading, "dwell_of", dwell_of)
    parent = QObject()
    made, heard = Dwells(parent), []
    made.read.connect(lambda step, samples: heard.append((step, samples)))
    made.failed.connect(heard.append)
    yield SimpleNamespace(of=made, go=go, read=read, heard=heard)
    go.set()
    made.rest()


def test_of_wishes_meanwhile_the_last_is_read_and_the_first_not_told(qtbot, dwells):
    dwells.of.want(A, 1)
    qtbot.waitUntil(lambda: dwells.read == [(A, 1)])
    assert dwells.of.busy
    dwells.of.want(A, 2)
    dwells.of.want(B, 3)
    dwells.go.set()
    qtbot.waitUntil(lambda: bool(dwells.heard))
    assert dwells.read == [(A, 1), (B, 3)]
    assert dwells.heard == [(3, "samples of b.h5 3")]
    assert not dwells.of.busy


def test_why_there_are_no_samples_is_said_and_the_next_wish_goes_on(qtbot, dwells):
    dwells.go.set()
    dwells.of.want(A, -1)
    qtbot.waitUntil(lambda: bool(dwells.heard))
    assert dwells.heard == ["no step -1"]
    dwells.of.want(A, 2)
    qtbot.waitUntil(lambda: len(dwells.heard) == 2)
    assert dwells.heard[1] == (2, "samples of a.h5 2")


def test_without_a_file_nothing_is_read_and_a_wish_taken_back_is_not_told(qtbot, dwells):
    dwells.of.want(None, 1)
    assert not dwells.of.busy
    dwells.of.want(A, 1)
    qtbot.waitUntil(lambda: dwells.read == [(A, 1)])
    dwells.of.want(None, 0)
    dwells.go.set()
    qtbot.waitUntil(lambda: not dwells.of.busy)
    assert dwells.heard == []


def test_at_rest_nothing_more_is_told(qtbot, dwells):
    dwells.of.want(A, 1)
    qtbot.waitUntil(lambda: dwells.read == [(A, 1)])
    dwells.go.set()
    dwells.of.rest()
    assert not dwells.of.busy
    qtbot.wait(5)
    assert dwells.heard == []


# Curves


class Command(QObject):
    """In the place of a `viscorig` command: ends when it is told to."""

    done, failed, progressed = Signal(object), Signal(str), Signal(str, float)
    said = ()

    def __init__(self, begun, arguments, parent):
        super().__init__(parent)
        self.begun, self.arguments, self.closed = begun, arguments, False

    def start(self):
        self.begun.append(self)

    def close(self):
        self.closed = True


@pytest.fixture
def commands(qapp, monkeypatch):
    begun = []
    made = lambda arguments, result, parent: Command(begun, arguments, parent)  # noqa: E731
    monkeypatch.setattr(one_command, "BackgroundCommand", made)
    monkeypatch.setattr(computing, "_PAUSE_MS", 0)
    monkeypatch.setattr(computing, "specimen_toml", lambda contents: "the specimen")
    return begun


REGION = (1, 10.0, 20.0)
FITTED = SimpleNamespace(result=SimpleNamespace(as_json=lambda: {"law": 1}, hammer=None))


def state(fit=FITTED, *, damping=None, regions=(REGION,)):
    specimen = SimpleNamespace(base_acceleration_m_s2=9.81)
    contents = SimpleNamespace(fit=fit, damping=damping, segments={}, specimen=specimen)
    plan = SimpleNamespace(regions=regions)
    return SimpleNamespace(contents=contents, plan=plan, configuration=configuration())


def predicted(regions=(REGION,)):
    row = {"velocity_re_m_s": 9.81, "velocity_im_m_s": 0.0, "velocity_m_s": 9.81}
    points = [{**row, "frequency_hz": float(f)} for one in grid(list(regions)) for f in one]
    return PredictionResult.model_validate({"points": points})


def option(command, name):
    return command.arguments[command.arguments.index(name) + 1]


@pytest.fixture
def curve(commands, monkeypatch):
    """Of the latest fit, whose segments begun are those of the plan."""
    monkeypatch.setattr(computing, "regions_of", lambda segments: [REGION])
    parent = QObject()
    made = ModelCurve(parent)
    made._soon.setInterval(0)
    made.kept = parent
    yield made
    made.rest()


def test_a_fit_s_curve_is_predicted_with_its_law_at_the_frequencies_drawn(qtbot, curve, commands):
    curve.want(state())
    assert curve.busy
    qtbot.waitUntil(lambda: len(commands) == 1)
    (command,) = commands
    assert command.arguments[0] == "predict"
    assert Path(command.arguments[1]).read_text() == "the specimen"
    assert Path(option(command, "--fit")).read_text() == '{"law": 1}'
    assert "--hammer" not in command.arguments
    asked = [float(f) for f in option(command, "--frequencies").split(",")]
    assert (asked[0], asked[-1]) == pytest.approx((10.0, 20.0), rel=0.2)
    told = []
    curve.changed.connect(lambda: told.append(curve.curve))
    command.done.emit(predicted())
    assert not curve.busy
    (stretch,) = told[0].stretches
    assert stretch.segment == 1
    assert abs(stretch.over_base_s) == pytest.approx(1.0)


def test_a_fit_with_a_hammer_test_takes_it_along(qtbot, curve, commands):
    fit = SimpleNamespace(result=SimpleNamespace(as_json=dict, hammer="modes"))
    damping = SimpleNamespace(result=SimpleNamespace(as_json=lambda: {"modes": []}))
    curve.want(state(fit, damping=damping))
    qtbot.waitUntil(lambda: len(commands) == 1)
    assert Path(option(commands[0], "--hammer")).read_text() == '{"modes": []}'


def test_the_same_fit_is_predicted_once_and_another_s_curve_is_gone_at_once(qtbot, curve, commands):
    same = state()
    curve.want(same)
    qtbot.waitUntil(lambda: len(commands) == 1)
    commands[0].done.emit(predicted())
    curve.want(same)
    assert not curve.busy
    assert curve.curve is not None
    curve.want(state(SimpleNamespace(result=FITTED.result, number=2)))
    assert curve.curve is None
    qtbot.waitUntil(lambda: len(commands) == 2)


def test_a_fit_that_comes_meanwhile_ends_the_command_of_the_one_before(qtbot, curve, commands):
    curve.want(state())
    qtbot.waitUntil(lambda: len(commands) == 1)
    curve.want(state(SimpleNamespace(result=FITTED.result, number=2)))
    assert commands[0].closed
    qtbot.waitUntil(lambda: len(commands) == 2)


@pytest.mark.parametrize("fit", [None, SimpleNamespace(result=None)])
def test_without_a_law_there_is_no_curve(curve, commands, fit):
    curve.want(state(fit))
    assert not curve.busy
    curve.want(None)
    assert not curve.busy
    assert commands == []


def test_why_there_is_no_curve_is_kept_until_the_next(qtbot, curve, commands):
    curve.want(state())
    qtbot.waitUntil(lambda: len(commands) == 1)
    commands[0].failed.emit("the model has no such mode")
    assert curve.failure == "the model has no such mode"
    assert not curve.busy
    curve.want(state(SimpleNamespace(result=FITTED.result, number=2)))
    assert curve.failure == ""


def test_at_rest_a_curve_wanted_again_is_computed_again(qtbot, curve, commands):
    same = state()
    curve.want(same)
    qtbot.waitUntil(lambda: len(commands) == 1)
    curve.rest()
    assert commands[0].closed
    curve.want(same)
    qtbot.waitUntil(lambda: len(commands) == 2)


def test_what_is_foreseen_is_of_the_specimen_as_stated_over_every_segment_planned(qtbot, commands):
    parent = QObject()
    foreseen = ForeseenCurve(parent)
    foreseen._soon.setInterval(0)
    planned = state(None, regions=(REGION, (2, 50.0, 60.0)))
    foreseen.want(planned)
    qtbot.waitUntil(lambda: len(commands) == 1)
    assert "--fit" not in commands[0].arguments
    asked = [float(f) for f in option(commands[0], "--frequencies").split(",")]
    assert asked[-1] == pytest.approx(60.0, rel=0.1)
    commands[0].done.emit(predicted(planned.plan.regions))
    assert len(foreseen.curve.stretches) == 2
    foreseen.want(planned)
    assert not foreseen.busy
    foreseen.want(None)
    assert foreseen.curve is None
    assert not foreseen.busy
