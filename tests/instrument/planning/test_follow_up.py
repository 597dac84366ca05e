"""What tells a gain from a shifted spot: both fitted to one sweep, and asked what they expect of another."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_cases import diagnosed, diagnosis, sweep
from planning_cases import EVEN, one, read

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.refit import evaluated
from fitting.diagnosis.several.of_files import ALIKE, OfFiles
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.verdict.result import Rivals
from fitting.effects import CATALOGUE
from fitting.planning.forms import forms_of
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.rivalry import outcome
from fitting.planning.unseen import unseen
from instrument.planning import follow_up
from instrument.planning.follow_up import Possible, rank_follow_ups, with_follow_ups
from instrument.planning.measurement import HANDS_S
from instrument.planning.open_questions import with_open_questions
from instrument.planning.struck import bare_modes_expected
from instrument.planning.unseen import with_unseen
from instrument.results.next_words import advice
from instrument.stepped_sine.settings import Limits, SweepSettings

STIFFER, SCALE = CATALOGUE["substrate_stiffness"], 1.05


@pytest.fixture(scope="module")
def ranked(rivals):
    return rank_follow_ups(ambiguous(rivals))


def ambiguous(rivals):
    found = diagnosed(sweep(), verdict="ambiguous")
    return replace(found, result=replace(found.result, rivals=rivals))


def test_another_spot_tells_a_gain_from_a_shifted_spot_and_repeating_does_not(expecting, template, ranked):
    spot = of_kind(ranked, "spot")
    assert spot.separation > 3
    assert spot.probability_resolved > 0.8
    assert set(spot.between) == {"gain_error", "spot_offset"}
    assert "the same at every spot; an offset belongs to one spot" in spot.why
    repeated = read(expecting, template, one(template, "frequencies"))
    assert outcome(repeated, EVEN).between(0, 1) < 0.3 * spot.separation
    assert all(f.separation < 0.3 * spot.separation for f in ranked if f.kind == "bare_hammer")


def test_a_short_segment_between_the_others_comes_before_a_spot_that_tells_more(ranked):
    # An offset goes with the shapes of the modes, and there are others between the segments.
    first, spot = ranked[0], of_kind(ranked, "spot")
    assert (first.kind, first.needs_hands) == ("frequencies", False)
    assert set(first.segments) == {5}
    assert first.seconds < 0.2 * spot.seconds
    assert 3 < first.separation < spot.separation


def test_a_clamp_line_is_asked_with_the_spot_measured_from_it_and_not(clamps, rivals):
    (line, _), (clamp, _) = clamps.each
    forms = forms_of(clamps, line)
    assert [f.u[-1] for f, _ in forms] == [1.0, 0.0]
    assert forms[0][0] is line
    assert sum(share for _, share in forms) == pytest.approx(1.0)
    assert [f is clamp for f, _ in forms_of(clamps, clamp)] == [True]


def test_what_the_group_just_leaves_out_is_asked_too(clamps):
    first, second = clamps.each
    alone = replace(clamps, each=((first[0], 1.0),), beyond=((second[0], 0.04),))
    asked = RivalForecasts(alone, 6)
    assert asked.names == ("clamp_line", "clamp_compliance")
    assert asked.probabilities[-1] == pytest.approx(0.04 / 1.04)


def of_kind(ranked, kind):
    return next(f for f in ranked if f.kind == kind)


def test_the_treated_plate_struck_is_ranked_with_what_it_takes(ranked):
    struck = of_kind(ranked, "damped_struck")
    assert (struck.needs_hands, struck.seconds) == (True, HANDS_S["damped_struck"])
    assert struck.why.startswith("Another channel is the reference")
    assert struck.then is not None


def test_the_rigs_own_measurements_are_all_that_is_offered_where_nobody_is_there(rivals):
    alone = rank_follow_ups(ambiguous(rivals), Possible(hands=False))
    assert alone
    assert not any(f.needs_hands for f in alone)


def test_what_takes_longer_than_it_may_is_not_proposed(rivals, ranked):
    most_s = 0.9 * of_kind(ranked, "level").seconds
    short = rank_follow_ups(ambiguous(rivals), Possible(hands=False, most_s=most_s))
    assert short
    assert max(f.seconds for f in short) <= most_s


def test_what_was_just_measured_is_not_proposed_once_more(rivals):
    alone = rank_follow_ups(ambiguous(rivals), Possible(hands=False))
    again = rank_follow_ups(ambiguous(rivals), Possible(hands=False, done=alone))
    assert not {f.todo for f in alone} & {f.todo for f in again}


def test_nothing_follows_the_last_that_may_be_made(rivals, ranked):
    assert any(f.then for f in ranked if not f.needs_hands)
    last = rank_follow_ups(ambiguous(rivals), Possible(hands=False, measurements=1))
    assert last
    assert not any(f.then for f in last)


@pytest.mark.long
def test_velocities_at_a_spot_are_foreseen_and_one_that_is_too_fast_is_not_proposed(rivals, ranked):
    spot = of_kind(ranked, "spot")
    fastest = max(spot.velocities_m_s)
    assert len(spot.velocities_m_s) == len(spot.frequencies_hz)
    slow = Possible(SweepSettings(limits=Limits(velocity_m_s=fastest)))
    again = rank_follow_ups(ambiguous(rivals), slow)
    # Up to the share of a limit from which a run warns.
    assert all(max(f.velocities_m_s) <= 0.8 * fastest for f in again if f.kind == "spot")


def test_what_is_advised_is_the_first_of_the_ranking(rivals, ranked, monkeypatch):
    monkeypatch.setattr(follow_up, "rank_follow_ups", lambda *given: ranked)
    said = with_follow_ups(diagnosis(), ambiguous(rivals))
    assert said.next_measurements == ranked
    assert said.next_measurement == advice(ranked[0])


def test_what_could_not_be_seen_is_said_in_percent(rivals):
    asked = replace(ambiguous(rivals), effects=(CATALOGUE["temperature_drift"], CATALOGUE["gain_error"]))
    (said,) = with_unseen(diagnosis(), asked).unseen
    (one,) = unseen(rivals, asked.effects)
    assert (said.name, said.parameter, said.unit) == ("temperature_drift", "warming", "K")
    assert said.storage_modulus_percent == 100 * one.storage_modulus > 1
    assert said.standard_errors == one.errors
    assert said.chance == CATALOGUE["temperature_drift"].chance


def test_what_is_left_open_is_both(rivals, ranked, monkeypatch):
    monkeypatch.setattr(follow_up, "rank_follow_ups", lambda *given: ranked)
    asked = replace(ambiguous(rivals), effects=(CATALOGUE["temperature_drift"],))
    said = with_open_questions(diagnosis(), asked)
    assert said.next_measurements == ranked
    assert said.unseen == with_unseen(diagnosis(), asked).unseen != ()


def test_where_nothing_was_looked_for_nothing_is_said_of_it(rivals):
    result = diagnosis()
    assert with_unseen(result, ambiguous(rivals)) is result
    unknown = result.but(verdict="unknown")
    seen = replace(ambiguous(rivals), effects=(CATALOGUE["temperature_drift"],))
    assert with_unseen(unknown, seen) is unknown
    assert with_unseen(result, replace(diagnosed(sweep()), effects=tuple(CATALOGUE.values()))) is result


def test_a_proposal_is_a_sweep_that_can_be_made(ranked):
    spot = of_kind(ranked, "spot")
    assert spot.needs_hands
    # About the first two resonances of twist.
    assert len(spot.frequencies_hz) == len(spot.segments) == 40
    assert set(spot.segments) == {6, 7}
    assert spot.level_g == pytest.approx(1.0, rel=1e-3)
    assert f"({spot.spot_mm[0]:.0f}, {spot.spot_mm[1]:.0f}) mm" in spot.todo
    assert spot.seconds > HANDS_S["spot"]


def test_a_bare_plate_says_less_of_gain_and_spot_than_another_spot(expecting, ranked):
    # Not nothing: a wrong explanation has pulled at the metal's numbers.
    found = outcome(expecting.struck(bare_modes_expected(expecting.member)), EVEN)
    assert found.between(0, 1) < 0.5 * of_kind(ranked, "spot").separation


@pytest.fixture(scope="module")
def in_files(rivals):
    """A stiffer substrate in both files, in the first one and in the second one alone."""
    one, plate = rivals.problem, rivals.reduced
    both = SeveralProblem.of_members([one, one], [plate, plate])
    begun = begin(both, plate, noise_of(both.sweep), None, rivals.each[0][0].law)
    fits = []
    for file in (ALIKE, 1, 2):
        form = OfFiles(STIFFER, 2, file)
        response = response_of(begun.problem, [form])
        u = np.concatenate([begun.none.u, [SCALE, file]])
        fits.append(evaluated(response, begun.evidence, begun.none.law, u))
    return RivalForecasts(Rivals(begun.problem, begun.evidence, tuple((f, 1 / 3) for f in fits), plate), 6)


def test_a_hammer_test_of_the_first_plate_feels_nothing_that_is_in_another_file_alone(in_files):
    bare = bare_modes_expected(in_files.member)
    alike, first, second = in_files.struck(bare)
    np.testing.assert_allclose(first.mean, alike.mean)
    stiffer = bare.whitened_change(STIFFER.bare_shift(bare, np.array([SCALE])))
    np.testing.assert_allclose(alike.mean - second.mean, stiffer)
    assert np.abs(stiffer).max() > 1
    # Nor does it know the test's frequencies less well for not knowing that stiffness.
    assert np.linalg.norm(second.root) < np.linalg.norm(first.root)


def test_nothing_is_proposed_where_one_explanation_is_left(rivals):
    found = ambiguous(rivals)
    alone = replace(found.result, rivals=replace(rivals, each=rivals.each[:1]))
    assert rank_follow_ups(replace(found, result=alone)) == ()
    named = replace(found.result, verdict="effect")
    assert rank_follow_ups(replace(found, result=named)) == ()
    assert with_follow_ups(diagnosis(), diagnosed(sweep())) == diagnosis()
