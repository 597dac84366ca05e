import pytest

from fitting.diagnosis.verdict.names import NONE, joined, split
from fitting.effects import CATALOGUE


@pytest.mark.parametrize(
    ("effects", "name"),
    [((), NONE), (("added_mass",), "added_mass"), (("added_mass", "gain_error"), "added_mass + gain_error")],
)
def test_an_explanation_is_called_by_its_effects_and_they_are_told_from_its_name(effects, name):
    assert joined(effects) == name
    assert split(name) == effects


def test_no_effect_s_name_is_taken_for_two_or_for_none():
    assert "added_mass" in CATALOGUE
    assert [name for name in CATALOGUE if split(name) != (name,)] == []
