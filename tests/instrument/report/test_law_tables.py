"""A law in tables."""

import math

from instrument.report.law_tables import LawAt, band_table, correlation_table, parameter_table


def test_a_long_law_has_a_few_rows_and_its_ends_among_them():
    law = [LawAt(10.0 + k, 1e6, 1e3, 0.5, 0.001) for k in range(45)]
    rows = band_table("", law).rows
    assert 9 <= len(rows) <= 11
    assert (rows[0][0], rows[-1][0]) == ("10", "54")
    assert rows[0][1:] == ("1.0000 ± 0.0010", "0.5000 ± 0.0010")
    assert band_table("", []).rows == ()


def test_correlations_stand_beside_each_other_and_one_at_a_limit_has_none():
    correlations = {"g0_pa": {"g0_pa": 1.0, "alpha": math.nan}, "alpha": {"g0_pa": -0.5, "alpha": 1.0}}
    table = correlation_table("", correlations)
    assert table.columns == ("", "g0", "alpha")
    assert table.rows == (("g0", "+1.000", "-"), ("alpha", "-0.500", "+1.000"))


def test_a_parameter_has_its_error_and_the_bound_it_sits_at():
    values, errors = {"g0_pa": 2.5e5, "alpha": 0.5}, {"g0_pa": 1e3, "alpha": math.nan}
    one, other = parameter_table("", values, errors, {"alpha": "upper"}).rows
    assert one == ("g0 / Pa", "250000 ± 1000", "0.4", "")
    assert other == ("alpha", "0.5", "-", "at its upper bound")
