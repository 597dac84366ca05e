"""Another spot is one that a laser is aimed at, not a file that is a little off."""

from dataclasses import replace

from fitting.specimen import PlateSpecimen
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file
from instrument.simulated_case.spot import spot_elsewhere


def _stated(x_m: float, y_m: float) -> PlateSpecimen:
    return replace(read_specimen(case_file("specimen.toml")), pickup_m=(x_m, y_m))


def test_a_spot_a_little_off_is_the_published_one() -> None:
    assert spot_elsewhere(_stated(0.0605, 0.0595)) is None


def test_another_spot_is_where_it_is_stated() -> None:
    assert spot_elsewhere(_stated(0.15, 0.06)) == (0.15, 0.06)
