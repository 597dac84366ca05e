"""What is said of laws that were compared."""

import json
from dataclasses import replace

import pytest
from found_law_cases import facts
from paper_law import TABLE_4

from instrument.material.comparing import compare
from instrument.material.found_law import read_law
from instrument.material.remarks import remarks_on_law, remarks_on_one_specimen, remarks_on_pair

SOFTER = TABLE_4.with_values(TABLE_4.values * [0.5, 0.5, 1.0, 1.0])


@pytest.fixture
def law_of(tmp_path):
    def made(law, name="a.json", **beside):
        path = tmp_path / name
        path.write_text(json.dumps(facts(law) | beside), encoding="utf-8")
        return read_law(path)

    return made


def test_of_a_law_that_stands_by_itself_nothing_is_said(law_of):
    assert remarks_on_law(law_of(TABLE_4), beside_spread=True) == []


@pytest.mark.parametrize(("beside_spread", "ending"), [(False, "known of it"), (True, "not in the spread")])
def test_a_law_with_an_unknown_verdict_may_be_biased(law_of, beside_spread, ending):
    unknown = replace(law_of(TABLE_4, temperature_c=294.6), verdict="unknown")
    biased, kelvin = remarks_on_law(unknown, beside_spread=beside_spread)
    assert biased.startswith("verdict unknown: this law may be biased")
    assert biased.endswith(ending)
    assert "is it in K?" in kelvin


def test_a_law_whose_fit_has_not_come_to_its_end_is_provisional(law_of):
    (said,) = remarks_on_law(law_of(TABLE_4, converged=False), beside_spread=False)
    assert said.startswith("its fit has not come to its end")


def test_laws_that_differ_do_so_at_ranges_of_frequency(law_of):
    (said,) = remarks_on_pair(compare(law_of(TABLE_4), law_of(SOFTER)))
    assert said.startswith("G' differs beyond 1.96 joint standard errors at 14 to 300 Hz")


def test_laws_not_told_apart_come_with_the_difference_that_would_have_been_seen(law_of):
    a, b = law_of(TABLE_4, temperature_c=20.0), law_of(TABLE_4, temperature_c=35.0)
    warm, seen = remarks_on_pair(compare(a, b))
    assert warm == "of 20 and 35 degC, which alone makes laws differ"
    assert seen.startswith("not told apart; at ")


def test_one_specimen_s_laws_without_stated_numbers_have_nothing_alike(law_of):
    laws = [law_of(TABLE_4), law_of(TABLE_4)]
    found = [compare(*laws)]
    assert remarks_on_one_specimen(laws, found, said=False) == []
    assert remarks_on_one_specimen(laws, found, said=True) == []
