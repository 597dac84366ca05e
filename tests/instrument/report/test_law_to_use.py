"""Which law a report puts first."""

from types import SimpleNamespace

from diagnosis_cases import diagnosis

from instrument.report.law_to_use import TITLE, found_with_effect, law_to_use_sections


def contents(found):
    return SimpleNamespace(diagnosis=None if found is None else SimpleNamespace(result=found))


def test_a_law_found_with_an_effect_comes_first_with_its_errors():
    found = diagnosis()
    (section,) = law_to_use_sections(contents(found))
    assert section.title == TITLE
    said, drawn, band, parameters, correlations = section.blocks
    assert drawn.title == "The core's law before and after the diagnosis; with 95 % bands"
    assert said.text.endswith("This is the law to use.")
    assert len(band.rows) >= min(9, len(found.after.law))
    assert len(parameters.rows) == len(found.after.parameters)
    assert correlations.title == "Correlations of the logarithms of the parameters after the diagnosis"
    assert [row[1 + k] for k, row in enumerate(correlations.rows)] == ["+1.000"] * len(parameters.rows)


def test_where_several_are_left_the_law_is_that_over_all_of_them_and_parameters_are_of_one():
    found = diagnosis(verdict="ambiguous")
    (section,) = law_to_use_sections(contents(found))
    said, _, band, parameters, correlations = section.blocks
    assert (
        "law over all explanations that these data cannot tell apart, added_mass or spot_offset:" in said.text
    )
    assert said.text.endswith("This is the law to use.")
    assert "with added_mass or spot_offset" in band.title
    assert "with added_mass alone" in parameters.title
    assert "with added_mass alone" in correlations.title


def test_a_session_that_kept_no_correlations_shows_the_parameters_alone():
    found = diagnosis()
    older = found.but(after=found.after.without("correlations"))
    (section,) = law_to_use_sections(contents(older))
    assert len(section.blocks) == 4


def test_without_an_effect_the_identifications_law_is_the_one_to_use():
    for found in (None, diagnosis(verdict="unknown")):
        assert found_with_effect(contents(found)) is None
        assert law_to_use_sections(contents(found)) == []


def test_a_session_that_kept_no_parameters_shows_the_law_alone():
    found = diagnosis()
    bare = found.after.model_copy(update={"parameters": {}, "standard_errors": {}})
    (section,) = law_to_use_sections(contents(found.model_copy(update={"after": bare})))
    assert len(section.blocks) == 3
