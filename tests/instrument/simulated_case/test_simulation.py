"""`[simulation]` of RIG.toml: what it hides, what it cannot be, and the rig that it stands up."""

import numpy as np
import pytest

from drivers.simulated.plant.effects import ByHand, ClampCompliance, Effects, SpotOffset
from drivers.simulated.plant.sandwich import sandwich
from instrument.errors import BadInput
from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.simulated_case import refuse_edited, write_case
from instrument.simulated_case.simulation import published_mount, simulated_rig
from instrument.simulated_case.stated import CHANNEL_EFFECTS, effects_of


@pytest.fixture
def rig(tmp_path):
    write_case(tmp_path)
    return tmp_path / "rig.toml"


def stated(rig, **changes):
    document = read_document(rig, RigDocument)
    return document.model_copy(update={"simulation": document.simulation.model_copy(update=changes)})


def test_a_case_that_nobody_has_edited_may_be_written_over(tmp_path):
    refuse_edited(tmp_path)
    write_case(tmp_path, effect="added_mass")
    refuse_edited(tmp_path)
    write_case(tmp_path, seed=12)
    refuse_edited(tmp_path)
    rig = tmp_path / "rig.toml"
    assert "\nseed = 12\n" in rig.read_text()
    assert "effects." not in "".join(line for line in rig.read_text().splitlines() if line[:1] != "#")
    rig.write_text(rig.read_text().replace('model = "OFV-5000"', 'model = "OFV-505"'))
    edited = {path.name: path.read_text() for path in tmp_path.iterdir()}
    with pytest.raises(BadInput, match=r"rig\.toml: a rig stands there and is not written over"):
        refuse_edited(tmp_path)
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == edited


def test_effects_of_the_plate_and_of_the_channels_are_told_apart(rig):
    hidden = {"added_mass": {"mass_kg": 0.008, "x_m": 0.25, "y_m": 0.05}, "gain_error": {"factor": 1.1}}
    plate, channel = effects_of(stated(rig, effects=hidden).simulation)
    assert plate.added_mass.mass_kg == 0.008
    assert channel == {"gain_error": {"factor": 1.1}}


@pytest.mark.parametrize("name", CHANNEL_EFFECTS)
def test_an_effect_of_a_channel_has_its_numbers_and_no_others(rig, name):
    said = stated(rig, effects={name: dict.fromkeys((*CHANNEL_EFFECTS[name], "loudness"), 1.0)}).simulation
    with pytest.raises(ValueError, match=f"effects.{name}: loudness missing or unknown"):
        effects_of(said)


def test_without_its_table_no_rig_is_stood_up(rig):
    document = read_document(rig, RigDocument).model_copy(update={"simulation": None})
    with (
        pytest.raises(BadInput, match=r"rig.toml: \[simulation\] is missing"),
        simulated_rig(document, rig, virtual_time=True),
    ):
        pass


def test_the_published_plate_is_read_at_the_spot_given_and_hides_there_what_it_hides():
    hidden = Effects(clamp_compliance=ClampCompliance(1e13, 1e13), spot_offset=SpotOffset(2e-3, 0.0))
    there, aimed = (0.15, 0.024), (0.25, 0.1)
    mount = published_mount(there)
    for by_hand, at in ((ByHand(), there), (ByHand(spot_m=aimed), aimed)):
        found, expected = mount(hidden, by_hand), sandwich(hidden, by_hand=ByHand(spot_m=at))
        np.testing.assert_array_equal(found.structure.readings, expected.structure.readings)
        np.testing.assert_array_equal(found.structure.K, expected.structure.K)


def test_a_spot_off_the_published_plate_is_named(rig):
    document = read_document(rig, RigDocument)
    with (
        pytest.raises(BadInput, match=r"point \(400.0, 24.0\) mm is off the plate"),
        simulated_rig(document, rig, virtual_time=True, spot_m=(0.4, 0.024)),
    ):
        pass
