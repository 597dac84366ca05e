"""A session's points as files under one law, by the known mass on the plate and the spot."""

from dataclasses import replace

import pytest
from paper_law import TABLE_4
from sessions import point
from struck_cases import struck

from fitting.specimen import PlacedMass
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.files.toml import read_document
from instrument.impact.mobility import DELAY_S, GAIN
from instrument.interchange.files_of import files_of
from instrument.models.files import mounted, numbers_of, one_plate
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
    assert only.name == ""


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
    assert first.name == "sweep"
    assert second.name == "sweep, clamped anew"
    assert with_mass.name == "sweep, 5 g at 280, 100 mm, clamped anew"


def test_a_known_mass_makes_another_file_of_the_same_plate(plate):
    first, second = files(plate, {}, MASS, MASS)
    assert (first.number, second.number) == (1, 2)
    assert first.specimen.masses == ()
    assert second.specimen.masses == (PlacedMass(5e-3, 0.28, 0.1),)
    assert len(second.sweep) == 2


def with_struck(plate, changes, *found):
    points = [point(k, 20.0 + k, **changed) for k, changed in enumerate(changes, start=1)]
    return files_of(sweep_of(points), points, plate, found)


def test_a_plate_that_was_hung_and_struck_is_a_file_of_the_same_plate_as_long_as_it_is(plate):
    files = with_struck(plate, [{}, SPOT], struck())
    free = files[-1]
    assert [one.name for one in files] == ["sweep", "sweep", "struck, hung free"]
    assert one_plate(files)
    assert numbers_of(files) == [1, 1, 2]
    s = free.specimen
    assert (s.boundary, s.drive, s.modal_ratios, s.further_pickups_m) == ("free", "force", (), ())
    assert (s.length_m, *s.force_m, *s.pickup_m) == pytest.approx((0.3302, 0.285, 0.18, 0.015, 0.02))
    assert (s.tolerances["gain"], s.tolerances["delay"]) == (GAIN, DELAY_S)
    assert free.sweep.velocity_m_s.tolist() == [0.1, 0.2 + 0.1j]
    assert free.sweep.std_m_s.tolist() == [1e-3, 2e-3]
    assert free.pickup is None


def test_a_mass_that_belongs_to_the_plate_is_as_far_from_its_free_end(plate):
    (_, free) = with_struck(replace(plate, masses=(PlacedMass(0.01, 0.25, 0.1),)), [{}], struck())
    (mass,) = free.specimen.masses
    assert mass.x_m == pytest.approx(0.28)


def test_struck_in_its_clamp_it_is_of_the_mounting_it_was_in(plate):
    changes = [{}, {"mounting": 1}]
    for mounting, order, stands_like in ((0, [1, 3, 2], (1, 2, 1)), (1, [1, 2, 3], (1, 2, 2))):
        files = with_struck(plate, changes, struck("clamped", mounting))
        assert numbers_of(files) == order
        assert mounted(files, (True,) * 3) == stands_like
        (blows,) = [f for f in files if f.specimen.drive == "force"]
        assert blows.specimen.pickup_m == plate.pickup_m


def test_of_one_place_the_blows_of_the_last_time_count():
    first, again, other = struck(), struck(hits=5), struck("clamped")
    assert again.added_to([first, other]) == [other, again]
