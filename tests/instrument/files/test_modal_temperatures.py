"""A table of modes that holds several temperatures, whatever the order of its rows."""

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.files.modal_table import read_modal_table, read_modal_tables

HEAD = "mode,frequency_hz,loss_factor,temperature_c"


def write(tmp_path, *rows, head=HEAD):
    path = tmp_path / "modes.csv"
    path.write_text("\n".join([head, *rows, ""]))
    return path


def test_rows_sorted_by_mode_are_put_together_by_temperature_the_coldest_first(tmp_path):
    path = write(tmp_path, "1,41,0.1,20", "1,45,0.2,-5", "2,260,0.1,20", "2,280,0.2,-5", "3,800,0.3,-5")
    cold, warm = read_modal_tables(path)
    assert cold.mode.tolist() == [1, 2, 3]
    assert cold.frequency_hz.tolist() == [45, 280, 800]
    assert warm.mode.tolist() == [1, 2]
    assert warm.temperature_c.tolist() == [20, 20]


def test_readings_half_a_kelvin_apart_are_of_one_temperature_and_a_mode_read_twice_is_two(tmp_path):
    rows = ("1,41,0.1,20.1", "2,260,0.1,20.4", "1,41.1,0.1,20.2", "2,261,0.1,20.3", "1,40,0.1,21.0")
    tables = read_modal_tables(write(tmp_path, *rows))
    assert [t.mode.tolist() for t in tables] == [[1, 2], [1, 2], [1]]
    assert np.concatenate([t.frequency_hz for t in tables]).tolist() == [41, 261, 41.1, 260, 40]


def test_without_a_temperature_and_with_a_mode_below_another_it_is_refused_where_that_is(tmp_path):
    plain = write(tmp_path, "1,41,0.1", head="mode,frequency_hz,loss_factor")
    with pytest.raises(BadInput, match="no temperature, expected a column temperature_c"):
        read_modal_tables(plain)
    with pytest.raises(BadInput, match="mode 2 at 20 degC lies below an earlier one"):
        read_modal_tables(write(tmp_path, "1,41,0.1,20", "2,40,0.1,20"))
    with pytest.raises(BadInput, match="line 2: temperature_c = '20 C', expected a number"):
        read_modal_tables(write(tmp_path, "1,41,0.1,20 C"))


def test_read_as_one_temperature_it_says_where_several_belong(tmp_path):
    path = write(tmp_path, "1,41,0.1,20", "1,45,0.2,-5")
    with pytest.raises(
        BadInput, match="mode 1 stands twice, expected each once; rows of several temperatures"
    ):
        read_modal_table(path)
