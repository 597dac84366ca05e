"""Which points of files take part, and what is said of what they are worth."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from fitting.data.aside import DISTURBED
from fitting.diagnosis.problem.glitch import Glitch
from fitting.effects import CATALOGUE
from fitting.identification.doubt import doubts_among
from instrument.finding.diagnosis import diagnose
from instrument.finding.files_at_work import FilesAtWork, SetAside
from instrument.models.files import File
from instrument.progress import quiet

FILES = [File(sweep(pair(m), points=30), pair(m), name) for m, name in ((0.2533, "a.csv"), (0.573, "b.csv"))]


def disturbed(specimen, points=160):
    s = sweep(specimen, points=points, noise=5e-4)
    x = np.log(s.frequency_hz / 300.0) / 0.03
    return File(replace(s, velocity_m_s=s.velocity_m_s * (1 + 0.05 * np.exp(-(x**2)))), specimen)


def test_what_is_set_aside_of_a_file_hangs_on_no_other_file_and_on_no_rounding():
    alone, beside = (
        FilesAtWork(given, quiet, with_effects=False)
        for given in ([disturbed(pair(0.2533))], [disturbed(pair(0.2533)), *FILES])
    )
    for work in (alone, beside):
        work.set_disturbances_aside()
    assert [one.file for one in beside.aside] == [1]
    assert beside.aside[0] == alone.aside[0]
    np.testing.assert_array_equal(beside.used[0], alone.used[0])
    assert set(beside.why_aside[0][~beside.used[0]]) == {DISTURBED}
    (given,) = alone.files
    moved = replace(given.sweep, velocity_m_s=given.sweep.velocity_m_s * (1 + 1e-14))
    again = FilesAtWork([File(moved, given.specimen)], quiet, with_effects=False)
    again.set_disturbances_aside()
    np.testing.assert_array_equal(again.used[0], alone.used[0])


def test_a_disturbance_is_shown_whether_or_not_its_effect_is_looked_for():
    given = [disturbed(pair(0.2533))]
    declined = {name for name in CATALOGUE if name != "gain_error"}
    found = diagnose(given, without=declined).result
    assert [one.name for one in found.channels] == ["fixture_resonance"]


def test_a_stretch_is_told_with_its_file():
    one = SetAside(1, Glitch(100.0, 130.0, 0.03, 0.01, 40))
    assert one.words(FILES).startswith("a.csv: 100 to 130 Hz is a local disturbance (up to 3 %)")
    assert one.words(FILES).endswith("40 points set aside")


def test_a_stretch_where_pads_move_most_may_be_of_pads_that_slip():
    words = SetAside(1, Glitch(100.0, 130.0, 0.03, 0.01, 40, at_peak=True)).words(FILES)
    assert (
        "resonance or of pads that slip or soften, which move most there (another level would tell): 40"
        in words
    )


def test_a_stretch_up_to_where_its_curve_ends_is_doubt():
    words = SetAside(1, Glitch(100.0, 130.0, 0.03, 0.01, 40, at_end=True)).words(FILES)
    assert "or of a sensor that is loose, up to where the curve ends" in words
    assert doubts_among([words])
    assert not doubts_among([SetAside(1, Glitch(100.0, 130.0, 0.03, 0.01, 40)).words(FILES)])


@pytest.mark.parametrize(
    ("misfit", "lawless", "said"),
    [
        ([0.004, 0.0], False, "where a fixture resonates"),
        ([0.004, 0.02], True, "follow no one law"),
        ([0.3, 0.02], True, "more than any rig is off"),
    ],
)
def test_what_readings_are_worth_is_said_by_its_reason(misfit, lawless, said):
    work = FilesAtWork(FILES, quiet, with_effects=False)
    work.misfit, work.lawless = misfit, lawless
    assert said in work.about_misfit()
    assert f"{100 * misfit[0]:.2g}" in work.about_misfit()
