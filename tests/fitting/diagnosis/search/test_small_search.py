"""The catalogue tried on a shear pair, whose every fit takes milliseconds: step by step, and the whole."""

from copy import copy
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_problem import GAIN, HIGH, LAW, MASS, PAIR, ShearPairProblem

from fitting.diagnosis import diagnose
from fitting.diagnosis.diagnose import seen_in_channels
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.search.candidate_fits import CandidateFits
from fitting.diagnosis.search.candidates import CandidateState
from fitting.diagnosis.search.singles import Singles
from fitting.diagnosis.search.tasks import ToFollow
from fitting.diagnosis.verdict.cautions import NO_DRIFT, NO_SECONDS
from fitting.effects import CATALOGUE
from fitting.effects.base import ChannelFinding, Effect
from fitting.errors import OutsideModel


@pytest.fixture(scope="module")
def high():
    """Its velocity channel reads 10 % too much, twenty times its tolerance."""
    return ShearPairProblem(HIGH)


@pytest.fixture(scope="module")
def found(high):
    """The verdict, and the shares of the way that were reported."""
    told = []
    return high.diagnosed(GAIN, MASS, report=told.append), told


def test_a_linear_step_promises_most_of_what_the_true_cause_gains(high):
    work = high.fits(GAIN, MASS)
    gained = high.begun.none.chi2 - min(
        f.chi2 for f in work.begin("gain_error", work.state("gain_error")).fits
    )
    assert work.promise("gain_error") == pytest.approx(gained, rel=0.1)
    assert work.promise("added_mass") < 0.01 * gained


def test_what_another_process_has_found_is_not_fitted_again(high):
    work = high.fits(GAIN)
    looked = work.begin("gain_error", work.state("gain_error"))
    elsewhere = high.fits(GAIN)
    elsewhere.learn("gain_error", looked.state)
    ((form, best),) = elsewhere.best_near("gain_error")
    assert form == ("gain_error", 0)
    assert best is looked.fits[0]


@pytest.mark.parametrize(("worse_by", "followed"), [(5.0, [0, 1]), (50.0, [0])])
def test_of_two_forms_that_do_alike_so_far_both_are_followed(high, worse_by, followed):
    work = high.fits(GAIN)
    (rough,) = work.begin("gain_error", work.state("gain_error")).fits
    other = replace(rough, residuals=rough.residuals * np.sqrt(1 + worse_by / rough.chi2))
    work.candidates["gain_error"] = [copy(work.candidates["gain_error"][0]) for _ in range(2)]
    work.learn("gain_error", [CandidateState(near=[rough]), CandidateState(near=[other])])
    assert [number for (_, number), _ in work.best_near("gain_error")] == followed
    # What is followed is not gone into twice.
    assert len(work.thorough("gain_error", astray=False)) == 2 - len(followed)


@pytest.mark.parametrize(("owed", "moves"), [(1.0, True), (0.01, False)])
def test_what_has_no_effect_is_followed_with_the_group_and_moves_where_it_owed(
    clean, monkeypatch, owed, moves
):
    search = clean.search(GAIN)
    none = search.none.fitted
    ended = replace(none, residuals=none.residuals * np.sqrt(1 - owed / none.chi2))
    monkeypatch.setattr(
        search.work, "follow_to_convergence", lambda fitted: ended if fitted is none else fitted
    )
    search.converged_group([], search.none)
    assert (search.none.fitted is ended) is moves


def test_only_a_fit_that_had_not_come_to_its_end_is_on_the_way(high):
    work = high.fits(GAIN)
    (rough,) = work.begin("gain_error", work.state("gain_error")).fits
    for converged, waiting in ((True, []), (False, [rough.chi2])):
        work.learn("gain_error", [CandidateState(near=[replace(rough, converged=converged)])])
        assert [f.chi2 for _, f in work.on_the_way("gain_error")] == waiting


def test_a_rough_fit_is_followed_to_the_channel_s_gain(high):
    work = high.fits(GAIN)
    (rough,) = work.begin("gain_error", work.state("gain_error")).fits
    ended = work.finish(("gain_error", 0), rough, np.inf)
    assert ended.chi2 <= rough.chi2
    error = np.sqrt(np.diag(ended.covariance))[-1]
    assert abs(ended.of(GAIN)[0] - HIGH) < 3 * error


def test_without_a_known_noise_no_rival_is_given_up(high):
    work = high.fits(GAIN)
    (best,) = work.begin("gain_error", work.state("gain_error")).fits
    assert best.chi2 < work.goal(best) < high.begun.none.chi2
    unknown = replace(high.begun.evidence, scale_known=False)
    assert CandidateFits(high.begun.problem, unknown, high.begun.none, [GAIN]).goal(best) == np.inf


def test_a_second_effect_is_fitted_beside_the_first_and_taken_away_again(high):
    work = high.fits(GAIN, MASS)
    (first,) = work.begin("gain_error", work.state("gain_error")).fits
    form = ("added_mass", 0)
    both = work.fit_second(first, form, work.look(first, [form])[0], np.inf)
    assert [e.name for e in both.effects] == ["gain_error", "added_mass"]
    assert both.chi2 <= first.chi2 + 1e-6
    alone = work.evaluate_alone(both, GAIN)
    assert alone.law == both.law
    assert alone.of(GAIN) == pytest.approx(both.of(GAIN))
    assert alone.chi2 >= both.chi2


def test_another_law_is_a_candidate_fitted_in_the_place_of_the_stated_one(high):
    (best, *_) = high.fits(LAW).fit_other_laws(LAW)
    assert best.effects == (LAW,)
    assert best.law.kind != high.begun.none.law.kind


# Singles.


def test_of_single_effects_the_true_cause_comes_first(high):
    search, told = high.search(MASS, GAIN), []
    singles = Singles(search, told.append).best()
    assert [t.names for t in singles] == [("gain_error",), ("added_mass",)]
    assert singles[0].cost < search.none.cost - 100 < singles[1].cost
    assert max(told) <= 1.0
    # What was rough at first has been followed to its end, and the better one kept.
    ((_, rough),) = search.work.best_near("gain_error")
    assert singles[0].fitted.chi2 < rough.chi2
    # The other one, at the end of what its gain may be, is not worth following.
    assert singles[0].fitted.converged


def test_a_rough_fit_that_leads_and_was_on_its_way_is_followed_to_its_end_once(high, monkeypatch):
    followed, plain = [], CandidateFits.finish

    def finished(self, form, rough, goal):
        followed.append(rough)
        return plain(self, form, rough, goal)

    def begun(self, name, state):
        found = first(self, name, state)
        short = [replace(f, converged=False) for f in found.fits]
        return replace(found, fits=short, state=[CandidateState(near=short)])

    first = CandidateFits.begin
    monkeypatch.setattr(CandidateFits, "finish", finished)
    monkeypatch.setattr(CandidateFits, "begin", begun)
    Singles(high.search(MASS, GAIN), lambda fraction: None).best()
    assert len({id(f) for f in followed}) == len(followed)
    assert (GAIN,) in {f.effects for f in followed}


def test_what_would_be_larger_than_is_plausible_settles_nothing_for_the_others(high):
    search = high.search(MASS, GAIN)
    singles = Singles(search, lambda fraction: None)
    best = singles.best()[0]
    assert singles._explains_all(best)
    assert not singles._explains_all(replace(best, too_large="gain_error"))
    # Whatever it explains, the others are gone into once more as if it explained nothing.
    for too_large, asked in (("", {"gain_error"}), ("gain_error", {"gain_error", "added_mass"})):
        again = Singles(search, lambda fraction: None)
        failing = replace(best, checks={"size": 0.0}, too_large=too_large)
        again._found = singles._found | {"gain_error": failing}
        assert set(again._worth_more()) == asked


def test_what_has_been_followed_to_a_goal_is_followed_again_only_to_an_easier_one(high, monkeypatch):
    asked, plain = [], CandidateFits.finish

    def finished(self, form, rough, goal):
        asked.append(goal)
        return plain(self, form, rough, goal)

    monkeypatch.setattr(CandidateFits, "finish", finished)
    search = high.search(GAIN)
    singles = Singles(search, lambda fraction: None)
    search.work.begin("gain_error", search.work.state("gain_error"))
    ((form, rough),) = search.work.best_near("gain_error")
    for goal in (rough.chi2, 0.9 * rough.chi2, rough.chi2, np.inf, rough.chi2):
        singles._to_the_end([ToFollow(form, rough, goal)])
    assert asked == [rough.chi2, np.inf]


def test_a_rough_fit_goes_on_where_what_is_left_to_gain_may_bring_it_near(high, monkeypatch):
    singles = Singles(high.search(MASS, GAIN), lambda fraction: None)
    monkeypatch.setattr(singles, "_goal", lambda rough: 100.0)

    def may_matter(chi2, owed, effect=GAIN, reached=True):
        rough = SimpleNamespace(chi2=chi2, owed=owed, effects=(effect,), may_reach=lambda goal: reached)
        return singles._may_matter(rough)

    assert may_matter(150.0, 26.0)
    assert not may_matter(150.0, 26.0, reached=False)
    assert not may_matter(150.0, 24.0)
    # Springs of any stiffness are in a valley that a linear step does not see the end of.
    assert may_matter(150.0, 24.0, CATALOGUE["clamp_compliance"])


def test_a_fit_says_what_it_makes_of_unseen_data_while_others_come_to_their_end(high):
    class Counting(Executor):
        def together(self, calls, report=lambda fraction: None):
            asked.append([do.__name__ for do, _ in calls])
            return super().together(calls, report)

    asked = []
    search = high.search(GAIN, executor=Counting())
    (best,) = Singles(search, lambda fraction: None).best()
    asked.clear()
    search.converged_group([best], best, [search.none])
    assert asked == [["follow_to_convergence", "predict_held_out"]]
    assert search.validation(search.none) == search.work.predict_held_out(search.none.fitted)
    search.converged_group([best], best, [search.none])
    assert asked[1:] == [[]]


def test_of_a_clean_sweep_no_single_effect_is_worth_more_than_none(clean):
    search = clean.search(MASS, GAIN)
    tried = Singles(search, lambda fraction: None).best()
    assert {t.names for t in tried} == {("added_mass",), ("gain_error",)}
    assert all(t.cost > search.none.cost for t in tried)


def test_an_effect_that_data_cannot_judge_is_not_tried(high):
    class Silent(type(GAIN)):
        def objection(self, points, plate):
            return "these data do not show it"

    assert [t.names for t in Singles(high.search(MASS, Silent()), lambda fraction: None).best()] == [
        ("added_mass",)
    ]
    with pytest.raises(OutsideModel, match="gain_error: these data do not show it"):
        high.diagnosed(Silent(), accepted_by_hand=["gain_error"])


# The whole.


def test_a_channel_that_reads_too_much_is_named_with_its_gain_beside_what_is_of_its_kind(found):
    diagnosis, told = found
    assert diagnosis.equivalent == {"gain_error": ("gain_error", "unlisted")}
    (gain,) = diagnosis.effects
    factor = gain.parameters["factor"]
    assert abs(factor.value - HIGH) < 3 * factor.standard_error < 0.03
    assert gain.probability > 0.9
    assert diagnosis.after.rms_percent < 0.3 < 1 < diagnosis.before.rms_percent
    assert told == sorted(told)


def test_candidates_are_told_best_first_none_among_them(found):
    diagnosis, _ = found
    costs = [c.delta_cost for c in diagnosis.candidates]
    assert costs[0] == 0
    assert costs == sorted(costs)
    assert sum(c.probability for c in diagnosis.candidates) == pytest.approx(1.0)
    assert "none" in [c.name for c in diagnosis.candidates]
    assert diagnosis.rivals.names == ("gain_error",)


def test_of_a_clean_sweep_nothing_is_named_and_after_is_before(clean):
    diagnosis = clean.diagnosed(GAIN, MASS)
    assert (diagnosis.verdict, diagnosis.effects) == ("none", ())
    np.testing.assert_array_equal(diagnosis.after.predicted_m_s, diagnosis.before.predicted_m_s)


def test_what_someone_has_accepted_is_fitted_and_nothing_weighed(clean):
    diagnosis = clean.diagnosed(GAIN, MASS, accepted_by_hand=["gain_error"])
    assert diagnosis.by_hand
    assert diagnosis.rivals is None
    (gain,) = diagnosis.effects
    factor = gain.parameters["factor"]
    assert abs(factor.value - 1.0) < 3 * factor.standard_error


def test_what_a_channel_shows_by_itself_is_said_and_its_points_set_aside(clean):
    aside = np.arange(len(clean.sweep)) % 10 == 3

    class Shown(Effect):
        name = "shown"

        def seen(self, sweep, noise):
            return ChannelFinding({"amplitude": (2.0, 0.1, "m/s")}, aside)

    why, (one,), noise = seen_in_channels(clean.sweep, [GAIN, Shown()])
    np.testing.assert_array_equal(why, np.where(aside, "shown", ""))
    assert (one.name, one.parameters["amplitude"].value, one.parameters["amplitude"].unit) == (
        "shown",
        2.0,
        "m/s",
    )
    assert len(noise.std_m_s) == np.sum(why == "")
    why, found, noise = seen_in_channels(clean.sweep, [GAIN])
    assert np.all(why == "")
    assert found == ()
    assert len(noise.std_m_s) == len(clean.sweep)


def test_that_a_drift_could_not_be_considered_without_times_is_said(clean):
    drift = CATALOGUE["temperature_drift"].standing_on(PAIR)
    assert NO_DRIFT in clean.diagnosed(GAIN, drift).warnings
    assert NO_DRIFT not in clean.diagnosed(GAIN).warnings


def test_nor_by_times_that_are_all_one(clean, monkeypatch):
    drift = CATALOGUE["temperature_drift"].standing_on(PAIR)
    same = replace(clean.sweep, time_s=np.full(len(clean.sweep), 5.0))
    monkeypatch.setattr(clean, "problem", SmallProblem.of_small(same, PAIR))
    assert NO_SECONDS in clean.diagnosed(GAIN, drift).warnings


@pytest.mark.parametrize(("by_hand", "to_its_end"), [(["gain_error"], True), (None, False)])
def test_only_a_search_follows_what_has_no_effect_further(clean, monkeypatch, by_hand, to_its_end):
    asked, begin = [], diagnose.begin

    def listening(*given, **how):
        asked.append(how["to_its_end"])
        return begin(*given, **how)

    monkeypatch.setattr(diagnose, "begin", listening)
    clean.diagnosed(GAIN, accepted_by_hand=by_hand)
    assert asked == [to_its_end]
