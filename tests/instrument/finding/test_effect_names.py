"""Effects by the names that people write."""

import pytest
from rig_plate import plate_of_the_rig
from shear_pair_cases import pair

from instrument.errors import BadInput
from instrument.finding.effect_names import effects_among, refuse_unknown_effects


def test_names_of_the_catalogue_pass():
    refuse_unknown_effects(["added_mass", "channel_delay"])


def test_a_name_with_a_slip_is_refused_with_the_one_that_was_meant():
    with pytest.raises(BadInput, match=r"^effect 'addedmass', expected added_mass$"):
        refuse_unknown_effects(["added_mass", "addedmass"])


def test_a_name_like_no_other_is_refused_with_all_of_them():
    with pytest.raises(BadInput, match=r"^effect 'gremlins', expected one of absolute_velocity, "):
        refuse_unknown_effects(["gremlins"])


def test_what_contains_one_that_is_left_out_cannot_be_accepted():
    plate = plate_of_the_rig()
    said = r"^effect 'uneven_clamp' both accepted and left out with 'clamp_compliance', expected one of them$"
    with pytest.raises(BadInput, match=said):
        effects_among([plate], ("clamp_compliance",), ["uneven_clamp"])


def test_what_stands_on_no_such_specimen_takes_nothing_along():
    mounted = pair(0.25)
    assert "fixture_resonance" in {e.name for e, _ in effects_among([mounted], ("base_rocking",))}


def test_what_contains_an_effect_is_left_out_with_it():
    plate = plate_of_the_rig()
    every, left = (
        {e.name for e, _ in effects_among([plate], without)} for without in ((), ("clamp_compliance",))
    )
    assert every - left == {"clamp_compliance", "clamp_friction", "uneven_clamp"}
    assert every - {e.name for e, _ in effects_among([plate], ("uneven_clamp",))} == {"uneven_clamp"}
