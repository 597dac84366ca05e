"""Sweeps with fewer frequencies than the law to be found has parameters."""

from types import SimpleNamespace

import pytest

from instrument.check.dry_run import dry_run
from instrument.check.few_frequencies import few_frequencies_remark
from instrument.simulated_case import write_case
from instrument.stepped_sine.plan import PlannedSegment

LAW = SimpleNamespace(kind="fractional-zener", names=("a", "b", "c", "d"))


def segment(*frequencies_hz):
    return PlannedSegment(1, 1, frequencies_hz, (9.81,) * len(frequencies_hz), "")


def test_one_frequency_finds_neither_law_nor_cause():
    assert few_frequencies_remark(LAW, [segment(20.0), segment(20.0, 20.0)]) == (
        "1 frequency for the 4 parameters of core law fractional-zener: too few to find "
        "the law or a cause by: measure more"
    )


def test_frequencies_of_all_segments_count():
    assert few_frequencies_remark(LAW, [segment(20.0, 21.0), segment(21.0, 22.0)]).startswith(
        "3 frequencies for the 4 parameters"
    )
    assert few_frequencies_remark(LAW, [segment(20.0, 21.0), segment(22.0, 23.0)]) == ""


def test_a_specimen_without_a_core_has_no_law_to_find():
    assert few_frequencies_remark(None, [segment(20.0)]) == ""


@pytest.mark.usefixtures("warm")
def test_check_says_it(tmp_path):
    path = write_case(tmp_path)
    text = path.read_text()
    path.write_text(
        text[: text.index("[[sweep.segments]]")] + "[[sweep.segments]]\nfrequencies_hz = [20.0]\n"
    )
    assert any("1 frequency for the" in warning for warning in dry_run(path).warnings)
