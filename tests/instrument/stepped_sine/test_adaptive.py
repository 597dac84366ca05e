"""The order of a sweep that chooses its own steps, walked with made-up choices and points."""

from dataclasses import replace

import pytest
from sessions import point

from instrument.stepped_sine.adaptive import AdaptivePlanner
from instrument.stepped_sine.plan import ChoiceWanted, Done, WordWanted
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import LoopChecked, StepsChosen
from instrument.stream.raw import (
    ChoiceStarted,
    PlanOverruled,
    SegmentBegan,
    SegmentEnded,
    StepBegan,
    StepDeclined,
)

SCRIPT = {
    1: ((20.0, 21.0, 100.0), (1, 1, 2)),
    2: ((22.0,), (1,)),
    3: ((101.0,), (2,)),
    4: ((), ()),
    5: ((102.0,), (2,)),
}
"""Frequencies and segments by number; 4 has none while the step before is measured, and 6 ends."""


def choice(started):
    f, segments = SCRIPT.get(started.number, ((), ()))
    ended = started.number not in SCRIPT
    return StepsChosen(started.number, started.last_step, f, segments, "law", ended, "", None, None)


def planner(**options):
    return AdaptivePlanner(SweepSettings(), lambda f: 10.0, level_m_s2=9.81, **options)


def walk(plan, stop_after=None, words=(), declines=()):
    """Actions, points and choices; broken off after so many points.

    `words` are said in this order, each as soon as its choice is there; `declines` are frequencies.
    """
    words = list(words)
    actions, points, choices, started, result = [], [], {}, None, None
    while True:
        try:
            action = plan.send(result)
        except StopIteration:
            return actions, points, choices
        actions.append(action)
        result = None
        match action:
            case ChoiceStarted():
                started = action
            case ChoiceWanted():
                result = choices[action.number] = choice(started)
            case WordWanted() if words and words[0].number == action.number:
                result = words.pop(0)
                actions.append(result)
            case StepBegan(purpose="step") if action.frequency_hz in declines:
                result = StepDeclined(action.step, action.segment, action.sweep, action.frequency_hz)
                actions.append(result)
            case StepBegan(purpose="loop-check"):
                result = LoopChecked(action.step, action.frequency_hz, 5.0, 100.0)
            case StepBegan():
                result = point(action.step, action.frequency_hz, segment=action.segment, sweep=action.sweep)
                points.append(result)
                if len(points) == stop_after:
                    return actions, points, choices


def steps(actions):
    return [a.frequency_hz for a in actions if isinstance(a, StepBegan) and a.purpose == "step"]


def test_steps_come_as_they_are_chosen():
    actions, _, choices = walk(planner().adaptive())
    assert steps(actions) == [20.0, 21.0, 100.0, 22.0, 101.0, 102.0]
    assert sorted(choices) == [1, 2, 3, 4, 5, 6]


def test_a_choice_is_begun_before_the_last_step_and_taken_after_it():
    actions, _, _ = walk(planner().adaptive())
    at = {
        (type(a), getattr(a, "number", None)): k
        for k, a in enumerate(actions)
        if isinstance(a, ChoiceStarted | ChoiceWanted)
    }
    step = {a.frequency_hz: k for k, a in enumerate(actions) if isinstance(a, StepBegan)}
    assert at[ChoiceStarted, 2] < step[100.0] < at[ChoiceWanted, 2] < step[22.0]
    assert at[ChoiceStarted, 3] < step[22.0] < at[ChoiceWanted, 3] < step[101.0]


def test_what_is_measured_meanwhile_is_said_and_no_later_point_counts():
    actions, points, _ = walk(planner().adaptive())
    begun = {a.number: a for a in actions if isinstance(a, ChoiceStarted)}
    number = {p.frequency_hz: p.step for p in points}
    assert (begun[1].last_step, begun[1].pending_hz) == (0, None)
    assert (begun[2].last_step, begun[2].pending_hz) == (number[21.0], 100.0)
    assert (begun[3].last_step, begun[3].pending_hz) == (number[100.0], 22.0)
    # Nothing was chosen while 101 Hz was measured: asked again with all points.
    assert (begun[5].last_step, begun[5].pending_hz) == (number[101.0], None)


def test_steps_are_of_their_region_and_of_the_pass_they_are_made_in():
    actions, points, _ = walk(planner().adaptive())
    assert [(p.segment, p.sweep) for p in points] == [(1, 1), (1, 1), (2, 1), (1, 2), (2, 2), (2, 2)]
    began = [a for a in actions if isinstance(a, SegmentBegan)]
    ended = [a for a in actions if isinstance(a, SegmentEnded)]
    assert [(a.segment, a.sweep) for a in began] == [(a.segment, a.sweep) for a in ended]


@pytest.mark.parametrize("after", range(1, 7))
@pytest.mark.parametrize("lost", [0, 1, 2])
def test_broken_off_anywhere_it_goes_on_as_if_never_stopped(after, lost):
    """`lost` choices had not reached the disk."""
    whole, all_points, _ = walk(planner().adaptive())
    _, points, choices = walk(planner().adaptive(), stop_after=after)
    known = {n: c for n, c in choices.items() if n <= max(choices) - lost}
    again = planner(chosen=known, done=Done(tuple(points)), next_step=points[-1].step + 1)
    actions, further, _ = walk(again.adaptive())
    assert [p.frequency_hz for p in points + further] == [p.frequency_hz for p in all_points]
    # And every choice is made of the same points, named by the frequency they were measured at.
    frequency = {p.step: p.frequency_hz for p in points + further} | {0: 0.0}
    before = {p.step: p.frequency_hz for p in all_points} | {0: 0.0}
    asked = {a.number: (before[a.last_step], a.pending_hz) for a in whole if isinstance(a, ChoiceStarted)}
    for a in actions:
        if isinstance(a, ChoiceStarted):
            assert (frequency[a.last_step], a.pending_hz) == asked[a.number]


def test_a_sweep_that_is_whole_measures_nothing_more():
    _, points, choices = walk(planner().adaptive())
    actions, further, _ = walk(planner(chosen=choices, done=Done(tuple(points))).adaptive())
    assert actions == further == []


def test_a_point_of_another_pass_is_not_taken_for_a_step():
    _, points, choices = walk(planner().adaptive())
    moved = [replace(p, sweep=9) if p.frequency_hz == 22.0 else p for p in points]
    actions, _, _ = walk(planner(chosen=choices, done=Done(tuple(moved))).adaptive())
    assert steps(actions) == [22.0]


ADD, END = PlanOverruled(2, "add", 50.0), PlanOverruled(3, "end")


def measured(points):
    return [p.frequency_hz for p in points]


def test_a_step_of_a_persons_own_comes_before_the_one_chosen_and_the_next_choice_knows_it():
    actions, points, _ = walk(planner(region_of=lambda f: 7).adaptive(), words=[ADD])
    assert measured(points) == [20.0, 21.0, 100.0, 50.0, 22.0, 101.0, 102.0]
    assert points[3].segment == 7
    third = next(a for a in actions if isinstance(a, ChoiceStarted) and a.number == 3)
    assert third.last_step == points[3].step


def test_a_person_ends_it():
    _, points, _ = walk(planner().adaptive(), words=[END])
    assert measured(points) == [20.0, 21.0, 100.0, 22.0]


def test_a_step_added_at_the_end_is_followed_by_a_choice_more():
    actions, points, _ = walk(planner().adaptive(), words=[PlanOverruled(6, "add", 50.0)])
    assert measured(points)[-1] == 50.0
    assert max(a.number for a in actions if isinstance(a, ChoiceStarted)) == 7


@pytest.mark.parametrize("frequency", [21.0, 22.0])
def test_a_step_declined_is_said_to_every_later_choice(frequency):
    actions, points, _ = walk(planner().adaptive(), declines=[frequency])
    assert frequency not in measured(points)
    after = next(k for k, a in enumerate(actions) if isinstance(a, StepDeclined))
    later = [a for a in actions[after:] if isinstance(a, ChoiceStarted)]
    assert later
    assert all(a.declined_hz == (frequency,) for a in later)


@pytest.mark.parametrize("after", range(1, 6))
def test_overruled_and_broken_off_it_goes_on_as_if_never_stopped(after):
    _, all_points, _ = walk(planner().adaptive(), words=[ADD], declines=[21.0])
    actions, points, choices = walk(planner().adaptive(), after, [ADD], [21.0])
    again = planner(
        chosen=choices,
        overruled=[a for a in actions if isinstance(a, PlanOverruled)],
        done=Done(tuple(points), tuple(a for a in actions if isinstance(a, StepDeclined))),
        next_step=points[-1].step + 1,
    )
    unsaid = [] if ADD in actions else [ADD]
    _, further, _ = walk(again.adaptive(), words=unsaid, declines=[21.0])
    assert measured(points + further) == measured(all_points)
