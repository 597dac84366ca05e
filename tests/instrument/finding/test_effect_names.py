"""Effects by the names that people write."""

import pytest

from instrument.errors import BadInput
from instrument.finding.effect_names import refuse_unknown_effects


def test_names_of_the_catalogue_pass():
    refuse_unknown_effects(["added_mass", "channel_delay"])


def test_a_name_with_a_slip_is_refused_with_the_one_that_was_meant():
    with pytest.raises(BadInput, match=r"^effect 'addedmass', expected added_mass$"):
        refuse_unknown_effects(["added_mass", "addedmass"])


def test_a_name_like_no_other_is_refused_with_all_of_them():
    with pytest.raises(BadInput, match=r"^effect 'gremlins', expected one of absolute_velocity, "):
        refuse_unknown_effects(["gremlins"])
