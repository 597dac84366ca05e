"""An effect that a law was found beside, as a file says it."""

import pytest
from pydantic import ValidationError

from instrument.material.found_effect import NamedEffect


def test_it_is_said_with_its_size_where_the_file_has_one():
    mass = {
        "name": "added_mass",
        "parameters": {"mass": {"value": 0.008, "standard_error": 1e-4, "unit": "kg"}},
    }
    assert NamedEffect.model_validate(mass).words == "added_mass (mass 8.00 +- 0.10 g)"
    assert NamedEffect(name="added_mass").words == "added_mass"


def test_an_effect_without_a_name_is_refused():
    with pytest.raises(ValidationError, match="name"):
        NamedEffect.model_validate({"parameters": {}})
