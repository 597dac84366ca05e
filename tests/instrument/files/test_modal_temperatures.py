"""A table of modes that holds several temperatures, whatever the order of its rows."""

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


def test_readings_half_a_kelvin_apart_are_of_one_temperature_and_a_mode_read_twice_has_their_mean(tmp_path):
    rows = ("1,41,0.1,20.1", "2,260,0.1,20.4", "1,41.2,0.2,20.2", "1,40,0.1,21.0", "3,800,0.3,20.4")
    near, far = read_modal_tables(write(tmp_path, *rows))
    assert near.mode.tolist() == [1, 2, 3]
    assert near.frequency_hz == pytest.approx([41.1, 260, 800])
    assert near.loss_factor == pytest.approx([0.15, 0.1, 0.3])
    assert near.temperature_c == pytest.approx([20.15, 20.4, 20.4])
    assert near.frequency_std_hz is None
    assert far.frequency_hz.tolist() == [40]


STATED = f"{HEAD},frequency_std_hz,loss_factor_std"


def test_what_was_measured_twice_weighs_by_what_is_said_of_it(tmp_path):
    stated = ("1,41.2,0.11,20,0.1,0.01", "2,260,0.1,20,0.3,0.02")
    (once,) = read_modal_tables(write(tmp_path, *stated, head=STATED))
    rows = ("1,41,0.1,20,0.2,0.02", "1,41.25,0.1125,20,0.1,0.01", "1,41.25,0.1125,20,0.2,0.02")
    (twice,) = read_modal_tables(write(tmp_path, *rows, "2,260,0.1,20,0.3,0.02", head=STATED))
    assert twice.frequency_hz == pytest.approx([(41 + 4 * 41.25 + 41.25) / 6, 260])
    assert twice.frequency_std_hz == pytest.approx([0.2 / 6**0.5, 0.3])
    assert twice.loss_factor_std == pytest.approx([0.02 / 6**0.5, 0.02])
    root = 2**0.5
    again = [f"1,41.{k},0.11,20,{0.1 * root},{0.01 * root}" for k in (1, 3)]
    (as_once,) = read_modal_tables(write(tmp_path, *again, "2,260,0.1,20,0.3,0.02", head=STATED))
    for name in ("mode", "frequency_hz", "loss_factor", "frequency_std_hz", "loss_factor_std"):
        assert getattr(as_once, name) == pytest.approx(getattr(once, name))


def test_a_row_copied_to_the_last_digit_counts_once(tmp_path):
    rows = ["1,41,0.1,20,0.2,0.02", "2,260,0.1,20,0.3,0.02"]
    (once,) = read_modal_tables(write(tmp_path, *rows, head=STATED))
    (copied,) = read_modal_tables(write(tmp_path, *rows, *rows, head=STATED))
    assert copied.frequency_std_hz.tolist() == once.frequency_std_hz.tolist()


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


def test_a_deviation_of_next_to_nothing_is_refused_with_its_line(tmp_path):
    path = tmp_path / "modes.csv"
    path.write_text(f"{STATED}\n1,20.0,0.1,20.0,1e-300,0.01\n")
    with pytest.raises(BadInput, match=r"line 2: frequency_std_hz = 1e-300, expected at least 1e-30"):
        read_modal_table(path)
