"""Rows that do not go with the others: a sentence for each, or one for a mode that is odd at several."""

from dataclasses import replace

import numpy as np
from beam_tables import BEAM, read

from fitting.mode_tables.misread import Misread
from instrument.temperatures.odd_rows import OddRow, words_of

TABLE = read(BEAM, 4)


def row(temperature_c, place, off=0.9):
    f = TABLE.frequency_hz.copy()
    odd = Misread(place, float(f[place]), 0.1, None)
    f[place] *= off
    return OddRow(temperature_c, replace(TABLE, frequency_hz=f, temperature_c=np.full(4, temperature_c)), odd)


def test_a_row_by_itself_is_told_with_its_temperature():
    (said,) = words_of([row(20.0, 2)], 3)
    assert said.startswith("at 20 degC mode 3 does not go with the others, which one law explains")
    assert "is it misread" in said


def test_a_mode_that_is_odd_at_every_temperature_is_told_once_and_something_acts_on_it():
    (said,) = words_of([row(T, 0, off) for T, off in ((0.0, 0.9), (20.0, 0.95), (40.0, 0.98))], 3)
    assert "mode 1 does not go with the others at any temperature" in said
    assert "-10 to -2 %" in said
    assert "something acts on it (a mass, a magnet, a cable)" in said


def test_one_that_is_odd_at_some_names_them_beside_a_row_of_another_mode():
    said = words_of([row(0.0, 0), row(20.0, 3), row(40.0, 0)], 4)
    assert "mode 1 does not go with the others at 0, 40 degC" in said[0]
    assert said[1].startswith("at 20 degC mode 4")
