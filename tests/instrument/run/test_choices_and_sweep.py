"""An adaptive sweep's choices beside the rig, and the sweep of a run; choices and fits are made by hand."""

import threading
from types import SimpleNamespace

import numpy as np
import pytest
from sessions import configuration, point

from instrument.check.forecast import Forecast
from instrument.files.experiment_file import ExperimentDocument
from instrument.planning.choosing import Goal
from instrument.run import live_choice
from instrument.run.live_choice import Chooser, LiveChoice
from instrument.run.sweep_part import SweepPart
from instrument.session.setup import setup_of
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stream.derived import FitUpdated, StepsChosen
from instrument.stream.raw import ChoiceStarted, OperatorDid, SegmentEnded, StepBegan, StepDeclined

ADAPTIVE = {
    "specimen": "a.toml",
    "rig": "rig.toml",
    "sweep": {
        "plan": "adaptive",
        "level_g": 0.5,
        "adaptive": {
            "band_hz": [15.0, 120.0],
            "target_percent": 2.0,
            "causes_percent": 20.0,
            "most_s": 600.0,
        },
    },
}


def chosen(number, f=(20.0,), *, ended=False):
    return StepsChosen(number, number, f, (1,) * len(f), "law", ended, "why", 2.0, 1.0)


@pytest.fixture
def made(monkeypatch):
    """Choices by number, and what was asked of choosing and of grounds."""
    asked = SimpleNamespace(choices=[], grounds=[], ahead=[])

    def choose(started, points, before, ground, goal):
        asked.choices.append((started.number, [p.step for p in points], before, ground, goal))
        return chosen(started.number)

    def ground_of(specimen, settings, band, level, hammer=None):
        asked.grounds.append((band, level, hammer))
        return f"ground {len(asked.grounds)}"

    monkeypatch.setattr(live_choice, "choose_steps", choose)
    monkeypatch.setattr(live_choice, "Ground", SimpleNamespace(of=ground_of))
    monkeypatch.setattr(
        live_choice, "lay_out", lambda found, ground: asked.ahead.append((found.number, ground))
    )
    return asked


def chooser(before=()):
    table = ExperimentDocument.model_validate(ADAPTIVE).sweep
    return Chooser("specimen", table, "settings", list(before))


def test_a_choice_goes_by_the_one_before_the_goal_and_the_points(made):
    one = chooser([chosen(1)])
    found = one.choose(ChoiceStarted(2, 4, None), [point(3), point(4)], None)
    ((number, steps, before, ground, goal),) = made.choices
    assert (number, steps, before, ground) == (2, [3, 4], chosen(1), "ground 1")
    assert goal == Goal(pytest.approx(0.02), pytest.approx(0.2), 600.0)
    assert one.chosen == {1: chosen(1), 2: found}


def test_models_are_made_once_for_a_hammer_test(made, monkeypatch):
    monkeypatch.setattr(live_choice, "accepted_modes", lambda result: f"modes of {result}")
    one, damping = chooser(), SimpleNamespace(result="hits")
    assert [one.ground(None), one.ground(None), one.ground(damping), one.ground(damping)] == [
        "ground 1",
        "ground 1",
        "ground 2",
        "ground 2",
    ]
    assert [hammer for _, _, hammer in made.grounds] == [None, "modes of hits"]
    (band, level, _), _ = made.grounds
    assert band == (15.0, 120.0)
    assert level == pytest.approx(0.5 * 9.81)


def test_a_choice_is_made_beside_the_rig_and_recorded_when_it_is_taken(made):
    recorded = []
    with LiveChoice(chooser(), recorded.append) as live:
        live.start(ChoiceStarted(1, 0, None), [], None)
        assert live.take(1, 5.0) == chosen(1)
        assert recorded == [chosen(1)]
        live._worker.submit(int).result(5)
    # The next choice's candidates are laid out behind it.
    assert made.ahead == [(1, "ground 1")]


def test_a_choice_that_is_not_made_in_time_is_none_yet(made, monkeypatch):
    go = threading.Event()

    def slow(started, *_):
        assert go.wait(5)
        return chosen(started.number)

    monkeypatch.setattr(live_choice, "choose_steps", slow)
    recorded = []
    with LiveChoice(chooser(), recorded.append) as live:
        live.start(ChoiceStarted(1, 0, None), [], None)
        assert live.take(1, 0.005) is None
        assert recorded == []
        go.set()
        assert live.take(1, 5.0) == chosen(1)


def test_a_choice_that_fails_fails_where_it_is_taken_and_nothing_is_laid_out_for_it(made, monkeypatch):
    def fail(*_):
        raise ValueError("no plate")

    monkeypatch.setattr(live_choice, "choose_steps", fail)
    with LiveChoice(chooser(), print) as live:
        live.start(ChoiceStarted(1, 0, None), [], None)
        with pytest.raises(ValueError, match="no plate"):
            live.take(1, 5.0)
        live._worker.submit(int).result(5)
    assert made.ahead == []


# The sweep of a run


class Runner:
    """Walks no plan: notes what it is given, and measures the points it is told to."""

    def __init__(self, part, analysis):
        self.walked, self.begun, self.soaked = [], [], []
        self._part, self._analysis = part, analysis

    def sweep(self, purpose, plan):
        self.walked.append(purpose)
        # The first step, behind the range that it wants.
        self.begun.append(next((one for one in plan if isinstance(one, StepBegan)), None))
        if purpose == "sweep":
            self._analysis.points.append(point(len(self._analysis.points) + 1))
            self._part.happened(SegmentEnded(1, 1))

    def soak(self, table):
        self.soaked.append(table.set_point_c)


class Fits:
    """Says how many points there were."""

    def __call__(self, number, last_step, points, damping, specimen):
        return FitUpdated(number, last_step, None, f"{len(points)} points")


@pytest.fixture
def sweep(zn1, monkeypatch):
    """A sweep of one segment at a stated range, with a runner and what was recorded and said."""
    made = configuration()
    table = made.experiment.sweep.segments[0].model_copy(update={"range": "20mm/s/V"})
    document = made.experiment.model_copy(
        update={"sweep": made.experiment.sweep.model_copy(update={"segments": [table], "sentinel": None})}
    )

    def begin(earlier=(), **changes):
        experiment = SimpleNamespace(document=document.model_copy(update=changes))
        analysis = SimpleNamespace(points=[], damping=None, calibrations={})
        recorded, said = [], []
        forecast = Forecast(zn1, np.array([20.0]), np.array([3.0]))
        setup = setup_of(made)
        part = SweepPart(
            experiment,
            specimen=zn1,
            setup=setup,
            forecast=forecast,
            analysis=analysis,
            earlier=list(earlier),
            record=recorded.append,
            fit=Fits(),
        )
        return SimpleNamespace(
            part=part, runner=Runner(part, analysis), analysis=analysis, recorded=recorded, said=said
        )

    return begin


RANGES = [SimpleNamespace(name=f"{k}mm/s/V", full_scale_m_s=k * 1e-2) for k in (5, 20, 100)]


def rig():
    did = lambda what: lambda detail: OperatorDid(what, detail)  # noqa: E731
    operator = SimpleNamespace(mount=did("mounted"), aim=did("aimed"))
    return SimpleNamespace(operator=operator, vibrometer=SimpleNamespace(ranges=tuple(RANGES)))


def test_a_plate_is_mounted_the_laser_calibrated_on_the_base_and_aimed_at_the_spot(sweep):
    s = sweep()
    s.part.run(rig(), s.runner, s.said.append)
    assert [(e.what, e.detail) for e in s.said] == [
        ("mounted", "damped"),
        ("aimed", "base"),
        ("aimed", "pickup"),
    ]
    assert s.runner.walked == ["calibration", "sweep"]
    assert s.runner.soaked == []


def test_ranges_that_are_calibrated_already_are_not_calibrated_again(sweep):
    s = sweep()
    s.analysis.calibrations = {"20mm/s/V": None, "100mm/s/V": None}
    s.part.run(rig(), s.runner, s.said.append)
    assert s.runner.walked == ["sweep"]
    assert [e.detail for e in s.said] == ["damped", "pickup"]


def test_a_chamber_is_waited_for_before_the_first_step(sweep):
    s = sweep(temperature=SimpleNamespace(set_point_c=30.0))
    s.part.run(rig(), s.runner, s.said.append)
    assert s.runner.soaked == [30.0]


def test_the_last_fit_is_of_all_points_and_fits_are_numbered_on(sweep):
    s = sweep()
    s.part.run(rig(), s.runner, s.said.append)
    assert s.part.fit.message == "1 points"
    first = s.part.fit.number
    s.part.follow(s.runner, [])
    assert s.part.fit.message == "2 points"
    second = s.part.fit.number
    s.part.fit_again()
    assert first < second < s.part.fit.number
    assert [e.number for e in s.recorded if isinstance(e, FitUpdated)][-1] == s.part.fit.number


def test_steps_that_follow_are_numbered_on_from_those_before(sweep):
    s = sweep(earlier=[point(6, purpose="calibration")])
    segment = PlannedSegment(1, 1, (20.0,), (9.81,), "20mm/s/V")
    for _ in range(3):
        s.part.follow(s.runner, [segment])
    assert [begun.step for begun in s.runner.begun] == [7, 8, 9]


def test_a_run_that_is_carried_on_numbers_its_steps_on_and_knows_what_was_declined(sweep):
    declined = StepDeclined(8, 1, 1, 20.0)
    s = sweep(earlier=[point(6), point(7, purpose="calibration"), declined])
    assert s.part._planner.next_step == 9
    assert [p.step for p in s.part._planner.done.points] == [7]
    assert s.part._planner.done.declined == (declined,)
    assert s.part.passes == 1
