"""What is said of data laid beside a session: where they are, or that nothing of them can be seen."""

from pathlib import Path

import numpy as np
import pytest

from gui.actions.laid_words import laid_words, unseen_words
from instrument.interchange.found import Found

REGIONS = ((1, 15.21, 25.35), (2, 235.0, 295.0))


def found(*frequencies_hz, force=False):
    f = np.array(frequencies_hz)
    return Found(sweeps=[{"frequency_hz": f} | ({"force_re_n": f} if force else {})])


def test_a_sweep_in_kilohertz_is_not_laid_without_a_word():
    said = unseen_words(found(0.025, 0.205), REGIONS)
    assert said.startswith("0.025 to 0.205 Hz is outside all segments (15.21 to 295 Hz), no pane shows it")
    assert said.endswith("is it in kHz?")
    assert unseen_words(found(30.0, 90.0), REGIONS).endswith("no pane shows it")


@pytest.mark.parametrize(
    ("of", "regions"), [(found(1.0, 20.0), REGIONS), (found(0.02), ()), (found(0.02, force=True), REGIONS)]
)
def test_nothing_is_said_where_a_point_is_seen_or_none_was_to_be(of, regions):
    assert unseen_words(of, regions) == ""


def test_where_data_are_to_be_found_is_said():
    path = Path("a.csv")
    assert laid_words(path, found(20.0), has_session=True) == "laid beside the session"
    assert laid_words(path, found(20.0), has_session=False).startswith("read; Diagnosis takes it")
    assert "over a force" in laid_words(path, found(20.0, force=True), has_session=True)
