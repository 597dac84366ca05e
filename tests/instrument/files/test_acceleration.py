"""Acceleration is shown in one unit at a time; what files hold is not touched."""

import click
import pytest
from click.testing import CliRunner

from instrument.cli.options import acceleration_option
from instrument.files.acceleration import (
    acceleration_unit,
    said_beside,
    show_acceleration_in,
    shown_quantity,
)

STANDARD = 9.80665
"""By definition of the General Conference on Weights and Measures, 1901."""


@pytest.fixture
def in_g():
    show_acceleration_in("g")
    yield
    show_acceleration_in("m/s2")


def test_it_is_si_unless_somebody_chooses():
    assert acceleration_unit().said(4.905) == "4.905 m/s\u00b2"
    assert shown_quantity(3.0, "m/s^2") == (3.0, "m/s^2")


def test_in_g_it_is_divided_by_the_standard_one(in_g):
    assert acceleration_unit().of(2 * STANDARD) == 2.0
    assert acceleration_unit().said(4.905) == "0.5002 g"
    assert shown_quantity(STANDARD, "m/s^2") == (1.0, "g")


def test_other_quantities_stay_as_they_are(in_g):
    assert shown_quantity(3.0, "m/s") == (3.0, "m/s")


def test_a_level_stands_in_the_file_in_g_and_is_said_in_si_beside_it():
    # A level of 1 is the published case's 9.81 m/s^2, not the standard g.
    assert said_beside("level_g", 0.5) == "= 4.905 m/s\u00b2"
    assert said_beside("base_m_s2", 98.0665) == ""


def test_a_limit_stands_in_the_file_in_si_and_is_said_in_g_beside_it(in_g):
    assert said_beside("base_m_s2", 98.0665) == "= 10 g"
    assert said_beside("level_g", 0.5) == ""


@pytest.mark.parametrize("value", ["two", None, True])
def test_what_is_no_number_is_not_converted(value):
    assert said_beside("level_g", value) == ""


def test_a_name_that_is_none_counts_as_the_usual_one():
    show_acceleration_in("furlong")
    assert acceleration_unit().symbol == "m/s\u00b2"


def test_a_command_shows_its_unit_and_leaves_the_usual_one_behind():
    @click.command()
    @acceleration_option
    def one():
        click.echo(acceleration_unit().said(STANDARD))

    assert CliRunner().invoke(one, ["--acceleration", "g"]).output == "1 g\n"
    assert CliRunner().invoke(one, []).output == "9.807 m/s\u00b2\n"
