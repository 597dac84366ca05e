"""What a law that is read back takes along of the plate it was found on."""

import json
from dataclasses import replace

import numpy as np
import pytest
from beam_temperatures import beam

from fitting.specimen import PlacedMass
from instrument.errors import BadInput
from instrument.results.fit_file import FoundLaw, is_of_first, plain_name, read_fit

NOTHING = {"law_kind": "constant", "parameters": {}, "standard_errors": {}, "correlations": {}}


def found(names, **more):
    """A fit's JSON: numbers that were stated as 1 and are found 2 % above."""
    adjusted = [{"name": n, "stated": 1.0, "tolerance": 0.01, "found": 1.02} for n in names]
    return FoundLaw.model_validate({**NOTHING, "adjusted": adjusted, **more})


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("gain", True),
        ("gain [1]", True),
        ("gain [2]", False),
        ("length [1, 3]", True),
        ("length [2, 3]", False),
        ("pickup_x [pickup 0]", True),
        ("pickup_x [pickup 1]", False),
        ("pickup_x [1, pickup 1]", False),
        ("pickup_x [1, pickup 0]", True),
    ],
)
def test_a_number_says_whose_it_is(name, first):
    assert is_of_first(name) is first


def test_a_number_is_called_as_the_specimen_calls_it():
    names = ["gain", "pickup_x [1, pickup 0]", "length [1, 3]"]
    assert [plain_name(name) for name in names] == ["gain", "pickup_x", "length"]


def test_a_law_of_several_files_keeps_the_first_one_s_numbers_and_those_of_all():
    several = found(["substrate_young", "gain [1]", "gain [2]"])
    assert [one.name for one in several.of_specimen] == ["substrate_young", "gain"]


def test_errors_are_of_the_first_file_s_numbers_too():
    posterior = {"names": ["g_pa", "gain [2]", "gain [1]"], "rows": [[1.0], [0.2, 4.0], [0.3, 0.6, 9.0]]}
    C = found([], posterior=posterior).posterior.covariance(["g_pa", "gain", "length"])
    np.testing.assert_array_equal(C, [[1.0, 0.3, 0.0], [0.3, 9.0, 0.0], [0.0, 0.0, 0.0]])


def test_a_plate_has_the_first_file_s_damping_and_places(coarse):
    plate = found(["damping_1 [1]", "damping_1 [2]", "damping_9 [2]", "pickup_x [1]", "mass_1 [2]"]).plate(
        coarse
    )
    assert plate.specimen.modal_ratios == (0.01, *coarse.modal_ratios[1:])
    assert [n.name for n in plate.nuisances.each] == ["damping_1", "pickup_x"]
    moved = plate.moved_specimen()
    assert moved.modal_ratios[0] == pytest.approx(0.0102)
    assert moved.pickup_m[0] == pytest.approx(1.02e-3)


@pytest.mark.parametrize(
    "name", ["mass_1", "place_1_x", "force_x", "axial_z", "glue_shear", "substrate_shear"]
)
def test_a_number_that_the_plate_does_not_state_is_refused_in_a_line(coarse, name):
    with pytest.raises(BadInput, match=f"^adjusted: {name}, expected a number that the specimen states$"):
        found([name]).plate(coarse)


@pytest.mark.parametrize("name", ["damping_0", "damping_1_x"])
def test_damping_of_what_is_no_mode_is_refused_in_a_line(tmp_path, name):
    path = tmp_path / "fit.json"
    adjusted = [{"name": name, "stated": 1.0, "tolerance": 0.01, "found": 1.02}]
    path.write_text(json.dumps({**NOTHING, "adjusted": adjusted}))
    with pytest.raises(BadInput, match="expected the JSON of 'viscorig identify'"):
        read_fit(path)


@pytest.mark.parametrize(
    ("at", "mass_g", "said"),
    [
        ({"found": -0.5}, 1.0, "found = -0.5 g"),
        ({"stated": 0.0}, 1.0, "stated = 0 g"),
        ({}, 0.0, "the specimen has 0 g"),
    ],
)
def test_a_mass_of_nothing_is_refused_by_its_key_and_unit(at, mass_g, said):
    specimen = replace(beam(), masses=(PlacedMass(1e-3 * mass_g, 0.1, 0.0),))
    one = found(["mass"]).of_specimen[0].model_copy(update=at)
    with pytest.raises(BadInput, match=f"^adjusted: mass: {said}, expected more than 0$"):
        one.moved(specimen)
