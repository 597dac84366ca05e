"""Readings set aside are found again among a session's points, and are rows of their own in a result."""

import numpy as np
from sessions import point

from fitting.data.aside import LOST, reasons
from instrument.results.rows_from import points_set_aside_from
from instrument.results.set_aside import why_aside, words_of
from instrument.session.points import sweep_of

POINTS = [point(k, 20.0 + f, velocity_re_m_s=0.01 * (k + 1)) for k, f in enumerate([0, 1, 2, 1, 3])]
WHY = reasons(np.array([False, True, False, False, True]), LOST)


def test_a_row_says_which_reading_it_is_and_why():
    rows = points_set_aside_from(sweep_of(POINTS), WHY)
    assert [(r.frequency_hz, r.segment, r.why) for r in rows] == [(21.0, 1, LOST), (23.0, 1, LOST)]
    given = sweep_of(POINTS)
    assert [r.measured_m_s for r in rows] == list(np.abs(given.response_m_s[[1, 4]]))
    assert points_set_aside_from(given, reasons(np.zeros(5, bool), "")) == ()


def test_of_two_readings_at_one_frequency_the_one_set_aside_is_found():
    assert list(why_aside(POINTS, points_set_aside_from(sweep_of(POINTS), WHY))) == ["", LOST, "", "", LOST]
    assert not any(why_aside(POINTS, ()))
    assert list(why_aside([], points_set_aside_from(sweep_of(POINTS), WHY))) == []


def test_every_reason_has_words_and_another_package_s_effect_its_name():
    assert words_of(LOST).startswith("far off the readings beside it")
    assert words_of("somebodys_effect") == "somebodys_effect"
