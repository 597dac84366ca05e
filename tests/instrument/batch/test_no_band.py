"""What is said of rows without a band in common."""

from row_cases import row, rows

from instrument.batch.no_band import NO_SPREAD, without_spread


def shifted(number, factor, **how):
    found = row(number, 1.0, **how)
    found.outcome["law"]["frequency_hz"] = [factor * f for f in found.outcome["law"]["frequency_hz"]]
    return found


def test_the_row_that_has_no_band_with_the_others_is_named_and_what_to_do():
    (said,) = without_spread([*rows(4, 0.02), shifted(10, 100.0)], {}, 0)
    assert "4 have 15 to 290 Hz in common, 10.csv (1500 to 2.9e+04 Hz) has no band with all" in said
    assert "the 5 rows:" in said
    assert "`material`" in said


def test_of_two_groups_that_without_is_named():
    cold = [*rows(3, 0.02, temperature_c=20.0), shifted(7, 0.01, temperature_c=20.0)]
    (said,) = without_spread([*rows(4, 0.02), *cold], {}, 1)
    assert "the 4 rows at 20 degC" in said


def test_bands_in_common_are_not_spoken_of_and_too_few_rows_are():
    assert without_spread(rows(4, 0.02), {}, 1) == []
    assert without_spread(rows(2, 0.02), {}, 0) == [NO_SPREAD]
    apart = [shifted(k, 100.0**k) for k in range(3)]
    assert without_spread(apart, {}, 0) == [NO_SPREAD]
    assert without_spread([*rows(3, 0.02), *apart[1:]], {1: "0.csv"}, 0) == [NO_SPREAD]


def test_bands_that_only_touch_are_none_in_common():
    ends = shifted(9, 290.0 / 15.0)
    (said,) = without_spread([*rows(3, 0.02), ends], {}, 0)
    assert "9.csv" in said
