"""Which rows count once: told by what their data say, not by what they are called."""

from dataclasses import replace

from row_cases import row, rows

from instrument.batch.between import between_rows, marks_of
from instrument.batch.taking_part import groups_of, law_of, repeats_among


def of(material, some):
    return [replace(one, task=replace(one.task, material=material)) for one in some]


def holding(contents, one):
    return replace(one, contents=contents)


def test_equal_contents_under_two_names_are_one_specimen():
    some = [holding(str(k), one) for k, one in enumerate(rows(4, 0.02))]
    copy = holding("1", row(9, 1.0))
    repeats = repeats_among([*some, copy])
    assert repeats == {4: "1.csv"}
    (found,) = between_rows([*some, copy])
    assert found.result.rows == 4
    assert marks_of([found], repeats)[4] == {"repeat_of": "1.csv"}


def test_a_file_saved_again_with_fewer_digits_is_one_specimen():
    some = [holding(str(k), one) for k, one in enumerate(rows(4, 0.02))]
    again, another = holding("x", row(9, 1.5)), holding("y", row(10, 1.5 * (1 + 3e-5)))
    assert repeats_among([*some, again, another]) == {5: "9.csv"}
    assert repeats_among([*some, again, holding("y", row(10, 1.5 * (1 + 3e-4)))]) == {}


def test_a_row_that_failed_is_repeated_by_none():
    some = [holding("a", row(1, 1.0, failed="no such file")), holding("a", row(2, 1.0))]
    assert repeats_among(some) == {}
    assert law_of(some[0]) is None
    assert law_of(some[1]) is not None


def test_a_row_in_doubt_is_named_as_a_repeat_and_takes_none_s_part():
    doubted = {"verdict": None, "warnings": ["odd"], "doubts": ["odd"]}
    some = [holding("a", row(k, 1.0 + k / 10, **doubted)) for k in range(2)]
    assert repeats_among(some) == {1: "0.csv"}
    believed = holding("a", row(2, 1.0))
    assert repeats_among([*some, believed]) == {1: "0.csv"}
    assert repeats_among([believed, *some]) == {1: "2.csv", 2: "2.csv"}


def test_one_file_at_two_temperatures_repeats_nothing():
    assert repeats_among([holding("a", row(1, 1.0, 20.0)), holding("a", row(2, 1.0, 40.0))]) == {}


def test_materials_are_apart():
    some = [
        *of("felt", rows(3, 0.0)),
        *rows(5, 0.0),
        *of("butyl", [row(k, 3.0 + 0.01 * k, 20.2) for k in range(4)]),
    ]
    assert groups_of(some)[-1] == ("butyl", 20.2)
    found = between_rows(some)
    assert [(b.material, b.temperature_c, b.result.rows) for b in found] == [
        ("butyl", 20.2, 4),
        ("felt", None, 3),
        (None, None, 5),
    ]
    assert all(at.storage_modulus_spread.percent < 2.0 for b in found for at in b.result.frequencies)
    assert "4 rows of butyl at 20.2 degC at" in found[0].lines[0]


def test_a_room_that_wanders_over_half_a_degree_cuts_no_group():
    warm = [21.2, 21.4, 21.5, 21.6, 21.9, 22.2, 24.0, 24.2, 70.0]
    groups = groups_of([row(k, 1.0, t) for k, t in enumerate(warm)])
    assert [t for _, t in groups] == [21.6] * 6 + [24.1] * 2 + [70.0]
    # From its lowest to its highest no more than a rubber bears.
    drifting = groups_of([row(k, 1.0, 20.0 + 0.4 * k) for k in range(6)])
    assert [t for _, t in drifting] == [20.6] * 4 + [21.8] * 2


def test_a_row_that_is_not_like_the_others_is_named_and_the_spread_given_without_it():
    some = [*rows(5, 0.01), row(7, 1.4)]
    (found,) = between_rows(some)
    (apart,) = found.result.apart
    assert apart.name == "7.csv"
    assert 30 < apart.storage_modulus_difference_percent < 50
    assert found.lines[1].startswith("7.csv is apart from the 5 other rows: G' +")
    assert found.lines[2].startswith("without it: spread between 5 rows at")
    middle = len(found.result.frequencies) // 2
    assert found.result.frequencies[middle].storage_modulus_spread.percent > 8.0
    assert found.result.without_apart[middle].storage_modulus_spread.percent < 3.0
    marks = marks_of([found], {})
    assert marks[5]["apart_p_value"] < 0.001 < marks[0]["apart_p_value"]
