"""What is measured first, where something else may have to follow it."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.planning.rivalry import Forecast, outcome
from instrument.planning.order import ALWAYS_S, OPEN_S, Asked, best_courses

EVEN = np.array([0.5, 0.5])
RIVALS = SimpleNamespace(probabilities=EVEN, temper=1.0, of=[0, 1])


def asked(kind, seconds, apart):
    """Read once, in standard deviations of its noise."""
    forecasts = [Forecast(np.array([mean]), np.zeros((1, 0))) for mean in (0.0, apart)]
    measurable = SimpleNamespace(kind=kind, seconds=seconds - ALWAYS_S)
    return Asked(measurable, forecasts, outcome(forecasts, EVEN))


def kinds(courses):
    return [c.first.measurable.kind for c in courses]


def test_what_settles_little_comes_after_what_settles_all_though_it_is_shorter():
    level, spot = asked("level", 100.0, 1.0), asked("spot", 600.0, 20.0)
    spot_first, level_first = best_courses([level, spot], RIVALS)
    assert kinds([spot_first, level_first]) == ["spot", "level"]
    assert (spot_first.then, level_first.then) == (None, "spot")
    assert spot_first.expected_s == pytest.approx(600.0)


def test_a_short_one_that_may_settle_it_comes_first_and_says_what_would_follow():
    short, sure = asked("frequencies", 100.0, 4.0), asked("spot", 600.0, 20.0)
    first, second = best_courses([sure, short], RIVALS)
    assert (first.first, first.then) == (short, "spot")
    assert first.expected_s == pytest.approx(100 + (1 - short.told.resolved) * 600)
    assert (second.then, second.expected_s) == (None, pytest.approx(600.0))


def test_the_last_measurement_that_may_be_made_is_judged_by_itself():
    short, sure = asked("level", 100.0, 3.0), asked("bare_hammer", 660.0, 20.0)
    assert kinds(best_courses([short, sure], RIVALS)) == ["level", "bare_hammer"]
    last = best_courses([short, sure], RIVALS, measurements=1)
    assert kinds(last) == ["bare_hammer", "level"]
    assert [c.then for c in last] == [None, None]


def test_of_one_kind_a_longer_one_is_kept_where_what_it_settles_is_worth_its_time():
    short, long = asked("spot", 200.0, 3.0), asked("spot", 300.0, 4.0)
    (only,) = best_courses([short, long], RIVALS)
    assert only.first is long
    hardly = asked("spot", 1500.0, 3.1)
    (only,) = best_courses([short, hardly], RIVALS)
    assert only.first is short


def test_of_a_kind_the_best_alone_is_kept():
    near, far = asked("spot", 300.0, 2.0), asked("spot", 300.0, 6.0)
    (only,) = best_courses([near, far], RIVALS)
    assert only.first is far
    assert only.then is None
    assert only.expected_s == pytest.approx(300 + far.told.left * OPEN_S)


def test_two_that_settle_it_only_together_are_worth_more_than_either():
    # Neither reading knows the gain; their difference is what the rivals differ in.
    gain = np.array([[1e3]])
    one = [Forecast(np.array([m]), gain, 1) for m in (0.0, 20.0)]
    other = [Forecast(np.array([0.0]), gain, 1) for _ in range(2)]
    pair = [
        Asked(SimpleNamespace(kind=kind, seconds=100.0 - ALWAYS_S), f, outcome(f, EVEN))
        for kind, f in (("level", one), ("spot", other))
    ]
    assert all(a.told.resolved == 0 for a in pair)
    first, _ = best_courses(pair, RIVALS)
    assert first.then is not None
    assert first.expected_s == pytest.approx(200.0)


def test_of_many_explanations_what_leaves_two_comes_before_what_leaves_all():
    # Neither ends the question, and the one that tells most of them apart takes longer.
    means = {"level": (0.0, 0.0, 0.3, 0.3), "clamping": (0.0, 0.0, 20.0, 20.0)}
    four = SimpleNamespace(probabilities=np.full(4, 0.25), temper=1.0, of=[0, 1, 2, 3])
    pair = []
    for kind, mean in means.items():
        f = [Forecast(np.array([m]), np.zeros((1, 0))) for m in mean]
        seconds = 100.0 if kind == "level" else 400.0
        measurable = SimpleNamespace(kind=kind, seconds=seconds - ALWAYS_S)
        pair.append(Asked(measurable, f, outcome(f, four.probabilities)))
    assert all(a.told.resolved == 0 for a in pair)
    assert kinds(best_courses(pair, four)) == ["clamping", "level"]
