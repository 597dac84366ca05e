"""What a reduced plate keeps of its specimen: every number that its coefficients ask for comes back."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.laws.constant import ConstantModulus
from fitting.plate.layers_array import layers_of, specimen_of
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, Glue, Orthotropy
from fitting.stated.patches import Patch

SIZES, SHARES = st.floats(1e-5, 0.3), st.floats(0.0, 0.5)
MODULI, DENSITIES = st.floats(1e6, 3e11), st.floats(1.0, 1e4)
STRESSES = st.none() | st.floats(-1e7, 1e7)
AXES = {"young_y_pa": MODULI, "shear_pa": MODULI, "angle_rad": st.floats(-1.6, 1.6)}
FACE = {
    "thickness_m": SIZES,
    "young_pa": MODULI,
    "poisson": SHARES,
    "density_kg_m3": DENSITIES,
    "loss_factor": SHARES,
    "rolled": st.none() | st.builds(Orthotropy, **AXES),
}
GLUE = {"thickness_m": SIZES, "shear_pa": MODULI, "density_kg_m3": DENSITIES, "loss_factor": SHARES}
CORE = {
    "thickness_m": SIZES,
    "poisson": SHARES,
    "density_kg_m3": DENSITIES,
    "glue": st.lists(st.builds(Glue, **GLUE), max_size=2).map(tuple),
}
PATCH = dict.fromkeys(("from_x_m", "to_x_m", "from_y_m", "to_y_m"), SIZES)
LAW = ConstantModulus(1e6, 0.0)
PLATE = {
    "length_m": SIZES,
    "width_m": SIZES,
    "substrate": st.builds(Face, **FACE),
    "constraining": st.builds(Face, **FACE),
    "core": st.builds(Core, law=st.just(LAW), **CORE),
    "elements": st.tuples(st.integers(2, 90), st.integers(2, 90)),
    "patches": st.lists(st.builds(Patch, **PATCH), max_size=3).map(tuple),
    "both_sides": st.booleans(),
    "axial_pa": st.tuples(STRESSES, STRESSES),
    "faces_shear": st.booleans(),
}
NOT_ASKED = {
    PlateSpecimen: {
        "boundary",
        "modal_ratios",
        "pickup_m",
        "further_pickups_m",
        "masses",
        "force_m",
        "reads",
        "base_acceleration_m_s2",
        "tolerances",
        "exact",
    },
    Face: {"loss_is_stated", "young_per_k", "young_at_c"},
    Core: {"law"},
}
"""Fields that no coefficient depends on."""


def kept(specimen):
    size = np.array([specimen.length_m, specimen.width_m, *specimen.mesh])
    return specimen_of(size, layers_of(specimen))


@pytest.mark.parametrize(
    ("of", "drawn"),
    [(PlateSpecimen, PLATE), (Face, FACE), (Orthotropy, AXES), (Core, CORE), (Glue, GLUE), (Patch, PATCH)],
)
def test_a_field_is_kept_or_known_not_to_be_asked_for(of, drawn):
    assert {f.name for f in fields(of)} == set(drawn) | NOT_ASKED.get(of, set())


@given(st.builds(PlateSpecimen, boundary=st.just("free"), **PLATE))
def test_every_number_that_coefficients_ask_for_comes_back(specimen):
    assert kept(specimen) == specimen


@given(st.builds(PlateSpecimen, boundary=st.just("free"), **PLATE))
def test_a_bare_plate_comes_back_without_a_treatment(specimen):
    assert kept(specimen.bare) == specimen.bare


def test_the_order_of_the_numbers_is_that_of_cached_files():
    glue = Glue(31.0, 32.0, 33.0, 34.0), Glue(41.0, 42.0, 43.0, 44.0)
    plate = PlateSpecimen(
        1.0,
        1.0,
        "free",
        Face(1.0, 2.0, 0.3, 4.0, 5.0, rolled=Orthotropy(6.0, 7.0, 8.0)),
        Face(11.0, 12.0, 0.13, 14.0, 15.0),
        Core(21.0, 0.23, 24.0, LAW, glue),
    )
    assert layers_of(plate)[:, :5].tolist()[:3] == [
        [1.0, 2.0, 0.3, 4.0, 5.0],
        [11.0, 12.0, 0.13, 14.0, 15.0],
        [21.0, 0.0, 0.23, 24.0, 0.0],
    ]
    many = replace(
        plate,
        both_sides=True,
        axial_pa=(None, 52.0),
        faces_shear=True,
        patches=(Patch(61.0, 62.0, 63.0, 64.0),),
    )
    assert layers_of(many)[0, 5:].tolist() == [6.0, 7.0, 8.0]
    assert layers_of(many)[3:, :6].tolist() == [
        [31.0, 32.0, 33.0, 34.0, 0.0, 0.0],
        [41.0, 42.0, 43.0, 44.0, 0.0, 0.0],
        [1.0, 0.0, 1.0, 0.0, 52.0, 1.0],
        [61.0, 62.0, 63.0, 64.0, 0.0, 0.0],
    ]
