"""A law at a few frequencies as people read it."""

import numpy as np

from instrument.facts.rows import LawRow
from instrument.results.law_words import LAW_COLUMNS, a_few, aligned, law_cells, sources_words


def rows(count):
    return [
        LawRow(
            frequency_hz=f,
            storage_modulus_pa=1.5e6,
            loss_factor=0.25,
            storage_modulus_standard_error_pa=2.5e4,
            loss_factor_standard_error=0.0125,
        )
        for f in np.linspace(10.0, 100.0, count)
    ]


def test_a_few_rows_are_spread_over_the_band_and_have_its_ends():
    for count in (1, 2, 5, 6, 7, 61):
        some = a_few(rows(count))
        assert len(some) <= 12
        assert (some[0], some[-1]) == (rows(count)[0], rows(count)[-1])
    assert a_few([]) == []


def test_a_row_has_modulus_and_loss_factor_to_the_digits_of_their_errors():
    (cells,) = law_cells(rows(1))
    assert cells == ["10.0", "1.500 +- 0.025", "0.250 +- 0.013"]
    assert law_cells(rows(1), ".4g", "±")[0][:2] == ["10", "1.500 ± 0.025"]


def test_a_table_stands_in_columns_whatever_is_longest():
    lines = aligned(LAW_COLUMNS, [["1.0", "2 ± 3", "a long cell indeed"], ["10.0", "2.25 ± 0.25", "4"]])
    assert len({len(line) for line in lines}) == 1
    assert lines[1].startswith("         1.0        2 ± 3  a long")


def test_what_is_in_an_error_goes_by_whether_the_noise_is_known():
    assert sources_words("direct", "stated") == "noise, model error, tolerances"
    assert sources_words("direct", "local scatter") == "noise, model error, tolerances"
    # The model's own error is of what is known besides the noise.
    assert sources_words("direct", "unknown") == "what the fit leaves, tolerances"
    assert sources_words("direct", "misfit") == "what the fit leaves, tolerances"
    assert sources_words("paper", "stated") == "what the fit leaves"
