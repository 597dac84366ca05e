"""What a form of an effect takes over from it: everything it says of itself."""

import pytest

from fitting.diagnosis.several.of_files import OfFiles
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.effects.form import TAKEN_OVER, taken_over
from fitting.effects.number_off import NumberOffEffect

THE_FORMS = {"parameters", "spans", "needs"}
"""Said anew by every form."""
DECIDES_BEFOREHAND = {"structures", "between_files", "replaces_law", "anew", "from_afar", "extends", "twice"}
"""Asked of the effect itself, before it has forms."""


def test_every_attribute_of_an_effect_is_taken_over_or_left_to_its_forms_on_purpose():
    assert set(Effect.__annotations__) == set(TAKEN_OVER) | THE_FORMS | DECIDES_BEFOREHAND


@pytest.mark.parametrize("name", sorted(CATALOGUE))
def test_forms_of_files_and_of_other_structures_say_what_the_effect_says(name):
    effect = CATALOGUE[name]
    expected = taken_over(effect)
    assert taken_over(OfFiles(effect, 2)) == expected
    assert taken_over(NumberOffEffect(effect, "core_thickness")) == expected
