"""The result of a law from tables of modes."""

import pytest
from beam_tables import BEAM, read
from result_cases import IDENTIFY_KEYS

from instrument.finding.modal import identify_tables
from instrument.results.modal_from import modal_from

TABLE = read(BEAM, 4)


@pytest.fixture(scope="module")
def facts():
    return modal_from(identify_tables([TABLE], [BEAM]), [TABLE], ["a.csv"]).as_json()


def test_it_has_the_keys_of_a_sweep_s_result(facts):
    assert set(facts) >= IDENTIFY_KEYS
    assert facts["doubts"] == []
    assert (facts["points"], facts["held_out"], facts["criterion_met"]) == ([], [], None)


def test_modes_stand_in_the_place_of_points(facts):
    assert [m["mode"] for m in facts["modes"]] == [1, 2, 3, 4]
    off = [abs(m["predicted_hz"] / m["frequency_hz"] - 1) for m in facts["modes"]]
    assert facts["max_percent"] == pytest.approx(100 * max(off))
