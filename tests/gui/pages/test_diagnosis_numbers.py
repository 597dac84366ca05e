import numpy as np
import pytest
from diagnosis_cases import AFTER, BEFORE, diagnosis

from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.effects import CATALOGUE
from gui.pages.diagnosis.ranking import Decisions, about, group_words, ranked
from gui.pages.diagnosis.residual import limit, panel, quantities, segments
from gui.pages.diagnosis.stages import compared


def standing(found):
    return {row.name: row.standing for row in ranked(found)}


def test_candidates_stand_as_the_verdict_says():
    found = standing(diagnosis(verdict="ambiguous"))
    assert found["added_mass"] == "found"
    assert found["spot_offset"] == "equal"
    assert found["none"] == "none"
    assert found["clamp_compliance"] == "not fitted"
    assert set(CATALOGUE) <= set(found)
    assert standing(diagnosis())["spot_offset"] == "other"


def test_a_group_is_named_whole():
    assert "added_mass, spot_offset" in group_words(diagnosis(verdict="ambiguous"))
    assert group_words(diagnosis()) == ""


def test_evidence_is_what_is_gained_over_no_effect():
    rows = {row.name: row for row in ranked(diagnosis())}
    assert rows["added_mass"].gain == pytest.approx(200.0)
    assert rows["added_mass"].gain_words == "over 10^86 times as likely as no effect"
    assert rows["added_mass"].probability == "82.0 %"
    assert rows["none"].probability == "< 0.1 %"
    assert rows["clamp_compliance"].probability == "–"
    assert rows["none"].gain == 0.0


@pytest.mark.parametrize("name", [*CATALOGUE, "none", UNLISTED])
def test_every_effect_is_explained(name):
    assert len(about(name)) > 20


def test_what_is_accepted_is_not_declined():
    words = Decisions()
    words.decline("added_mass")
    assert (words.accept_argument, words.declined) == (None, ("added_mass",))
    words.accept("added_mass + spot_offset")
    assert (words.accept_argument, words.declined) == (("added_mass", "spot_offset"), ())
    words.accept("none")
    assert words.accept_argument == ()
    assert words.of("none") == "accepted"
    words.accept("none")
    assert not words.any
    # What has no formula cannot be fitted, nor left out.
    words.accept(UNLISTED)
    words.decline(UNLISTED)
    assert not words.any


def test_residuals_are_those_of_the_result():
    found = diagnosis()
    assert segments(found) == (1, 2, 3)
    real, imaginary = panel(found, 1, "before", "both").series
    assert real.values == pytest.approx(np.full(10, 100 * BEFORE.real))
    assert imaginary.values == pytest.approx(np.full(10, 100 * BEFORE.imag))
    assert panel(found, 1, "after", "real").series[0].values == pytest.approx(np.full(10, 100 * AFTER.real))
    assert panel(found, 1, "before", "both").noise[0].height == pytest.approx(np.full(10, 0.2))


def test_a_panel_knows_where_readings_have_no_residual():
    found = diagnosis()
    out = found.set_aside_hz
    assert [panel(found, k, "before", "both").aside_hz for k in (1, 2, 3)] == [(), (out[0],), (out[1],)]
    assert panel(found, 2, "after", "whitened").aside_hz == (out[0],)


def test_before_and_after_have_scales_of_their_own():
    found = diagnosis()
    assert limit(found, 1, "before", "both") == pytest.approx(100 * BEFORE.real)
    assert limit(found, 1, "after", "both") < 0.5 * limit(found, 1, "before", "both")
    assert limit(found, 1, "after", "whitened") == panel(found, 1, "after", "whitened").highest


def test_amplitudes_alone_have_no_parts():
    found = diagnosis(phase=False)
    assert quantities(found) == ("amplitude", "whitened")
    (series,) = panel(found, 2, "before", "whitened").series
    assert series.name == "amplitude"


def test_held_out_segments_come_first_beside_noise_alone():
    rows = compared(diagnosis())
    assert [row.held_out for row in rows] == [True] * 3 + [False] * 3
    assert rows[0].before == pytest.approx(100 * abs(BEFORE))
    assert rows[0].noise == pytest.approx(0.1)
    assert compared(diagnosis(one_by_one=3.0))[0].after == 3.0


def test_all_points_are_inside_the_range():
    low, high = panel(diagnosis(), 1, "before", "both").range_hz
    assert (low, high) == pytest.approx((18 - 0.16, 22 + 0.16))
