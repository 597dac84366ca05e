"""Mode numbers that are all one off are asked about before any fit."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, LAW, read

from fitting.structures.beam import Beam
from instrument.mistakes.mode_numbers import numbers_doubt


def some(table, rows):
    """A table of some of its rows."""
    columns = {name: value[rows] for name, value in vars(table).items() if isinstance(value, np.ndarray)}
    return replace(table, **columns)


def with_numbers(table, by):
    return replace(table, mode=table.mode + by)


def of_core(G_pa):
    law = replace(LAW, g_pa=G_pa)
    return read(replace(BEAM, core=replace(BEAM.core, law=law)), law=law)


def test_a_table_that_leaves_the_first_mode_out_of_its_count_is_asked_about():
    table = with_numbers(some(read(BEAM), slice(1, None)), -1)
    said = numbers_doubt([table], [BEAM])
    assert said.startswith("mode numbers seem shifted by one: no core brings mode 1 to ")
    assert "with all numbers one higher a core may: is it so?" in said


def test_a_table_that_counts_a_mode_too_many_is_asked_about():
    said = numbers_doubt([with_numbers(read(BEAM), 1)], [BEAM])
    assert "no core brings mode 2 to " in said
    assert "one lower" in said


@pytest.mark.parametrize("G_pa", [1e4, 1e6, 1e8, 1e9])
@pytest.mark.parametrize("rows", [slice(None), slice(0, 1), slice(2, None), slice(5, None)])
def test_numbers_that_are_right_are_never_asked_about_whatever_the_core(G_pa, rows):
    assert numbers_doubt([some(of_core(G_pa), rows)], [BEAM]) == ""


@pytest.mark.parametrize("factor", [0.85, 0.93, 1.07, 1.15])
def test_a_clamp_that_yields_or_a_length_a_little_wrong_is_no_other_numbering(factor):
    table = of_core(3e6)
    assert numbers_doubt([replace(table, frequency_hz=factor * table.frequency_hz)], [BEAM]) == ""


def test_rows_at_several_temperatures_of_one_beam_have_to_agree():
    soft, stiff = of_core(1e5), of_core(1e8)
    assert "shifted by one" in numbers_doubt([with_numbers(t, 1) for t in (soft, stiff)], [BEAM, BEAM])
    assert numbers_doubt([with_numbers(soft, 1), stiff], [BEAM, BEAM]) == ""


def test_a_number_that_the_model_has_not_and_a_bare_beam_are_left_to_others():
    table = read(BEAM)
    assert numbers_doubt([with_numbers(table, 1000)], [BEAM]) == ""
    bare = Beam(0.4, 0.01, "clamped-free", FACE, None, None)
    assert numbers_doubt([table], [bare]) == ""
