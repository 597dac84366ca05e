"""A session's points as files under one law, by the known mass on the plate and the spot."""

import pytest
from conftest import TABLE_4
from sessions import point

from fitting.specimen import PlacedMass
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.files.toml import read_document
from instrument.interchange.files_of import files_of
from instrument.paper_case import case_file
from instrument.session.points import sweep_of

SPOT = {"pickup": 1, "spot_mm": (250.0, 100.0)}
MASS = {"mass_kg": 5e-3, "mass_at_mm": (280.0, 100.0)}


@pytest.fixture(scope="module")
def plate():
    return specimen_of(read_document(case_file("zn1.toml"), SpecimenDocument)).with_law(TABLE_4)


def files(plate, *changes):
    points = [point(k, 20.0 + k, **changed) for k, changed in enumerate(changes, start=1)]
    return files_of(sweep_of(points), points, plate)


def test_an_undisturbed_plate_is_one_file_as_it_is_stated(plate):
    (only,) = files(plate, {}, {}, {})
    assert only.specimen == plate
    assert len(only.sweep) == 3
    assert only.sweep.pickup is None


def test_a_spot_is_a_part_of_the_same_file_read_elsewhere(plate):
    first, second = files(plate, {}, SPOT, {}, SPOT)
    assert (first.number, second.number) == (1, 1)
    assert first.specimen.pickup_m == plate.pickup_m
    assert second.specimen.pickup_m == pytest.approx((0.25, 0.1))
    assert second.sweep.frequency_hz.tolist() == [22.0, 24.0]


def test_a_plate_clamped_anew_is_another_file_of_the_same_plate(plate):
    first, second, with_mass = files(plate, {}, {"mounting": 1}, {"mounting": 1, **MASS})
    assert (first.number, second.number, with_mass.number) == (1, 2, 3)
    assert second.specimen == first.specimen == plate
    assert len(with_mass.specimen.masses) == 1


def test_a_known_mass_makes_another_file_of_the_same_plate(plate):
    first, second = files(plate, {}, MASS, MASS)
    assert (first.number, second.number) == (1, 2)
    assert first.specimen.masses == ()
    assert second.specimen.masses == (PlacedMass(5e-3, 0.28, 0.1),)
    assert len(second.sweep) == 2
