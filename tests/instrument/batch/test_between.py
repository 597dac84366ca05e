"""How far the laws of a batch lie apart beyond what is not known of each."""

import pytest
from row_cases import FREQUENCIES_HZ, row, rows

from instrument.batch.between import between_rows
from instrument.batch.run import BatchRow
from instrument.batch.task import BatchTask


def test_a_spread_is_told_from_what_is_not_known_of_each_row():
    (found,) = between_rows(rows(40, 0.04))
    for at in found.result.frequencies:
        low, high = at.storage_modulus_spread.interval_95_percent
        assert low < 4.0 < high
        assert low > 2.0
        assert at.loss_factor_spread.percent < 1.0
    assert "40 rows at" in found.lines[0]


def test_rows_that_differ_as_far_as_they_are_known_have_no_spread_to_speak_of():
    (found,) = between_rows(rows(40, 0.0))
    assert found.result.frequencies
    assert all(at.storage_modulus_spread.interval_95_percent[0] == 0.0 for at in found.result.frequencies)


def test_temperatures_are_apart_and_the_unmeasured_come_last():
    some = [*rows(3, 0.0, temperature_c=40.2), *rows(4, 0.0), *rows(5, 0.0, temperature_c=19.8)]
    found = between_rows(some)
    assert [(b.temperature_c, b.result.rows) for b in found] == [(19.8, 5), (40.2, 3), (None, 4)]


DOUBTED = {"verdict": None, "warnings": ["numbers moved too far"], "doubts": ["numbers moved too far"]}


@pytest.mark.parametrize("outcome", [{"failed": "torn"}, {"verdict": "unknown"}, {"law": {}}, DOUBTED])
def test_rows_without_a_law_to_believe_take_no_part(outcome):
    some = [*rows(3, 0.0), row(9, 5.0, **outcome)]
    (found,) = between_rows(some)
    assert found.result.rows == 3
    assert found.result.frequencies[0].storage_modulus_spread.percent < 1.0


def test_two_rows_or_bands_apart_have_none():
    assert between_rows(rows(2, 0.0)) == []
    other = row(7, 1.0)
    other.outcome["law"]["frequency_hz"] = (FREQUENCIES_HZ * 100).tolist()
    assert between_rows([*rows(3, 0.0), other]) == []


def test_a_file_that_is_named_twice_is_one_specimen():
    some = rows(4, 0.02)
    (found,) = between_rows([*some, some[1], some[1]])
    assert found.result.rows == 4
    assert between_rows([some[0], some[0], some[1]]) == []


def test_a_file_that_is_named_by_two_paths_is_one_specimen(tmp_path):
    some = rows(4, 0.02)
    (tmp_path / "0.csv").touch()
    (tmp_path / "link.csv").symlink_to("0.csv")
    files = [tmp_path / name for name in ("0.csv", "link.csv", "../" + tmp_path.name + "/0.csv")]
    again = [BatchRow(BatchTask(str(path)), some[0].outcome) for path in files]
    (found,) = between_rows([*again, *some[1:]])
    assert found.result.rows == 4
