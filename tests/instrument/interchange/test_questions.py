"""What is asked of data beside their specimen, by every command in the same words."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from data_folder import DATA

from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.interchange.given import read_given
from instrument.interchange.questions import (
    question_data,
    question_modes,
    question_reference,
    question_temperatures,
)
from instrument.paper_case import case_file

HZ = np.array([74.3, 365.6, 922.2, 1670.0])


def tables_and_fit(measured_hz, loss_factor=0.2, std=None, temperature_c=None, frequency_std_hz=None):
    """Two tables of two modes, and a fit that knows them in Hz."""
    eta, warm = np.full(2, loss_factor), None if temperature_c is None else np.full(2, temperature_c)
    spread = None if std is None else np.array([1.0, 2.0]) * std
    known = None if frequency_std_hz is None else np.full(2, frequency_std_hz)
    tables = [
        SimpleNamespace(
            frequency_hz=part,
            loss_factor=eta,
            frequency_std_hz=known,
            loss_factor_std=spread,
            temperature_c=warm,
        )
        for part in np.split(measured_hz, 2)
    ]
    return tables, SimpleNamespace(as_stated_hz=tuple(np.split(HZ, 2)))


def test_modes_are_asked_about_with_all_their_files():
    with pytest.raises(BadInput, match=r"^a\.csv, b\.csv: the frequencies are in kHz, expected Hz; --force"):
        question_modes(*tables_and_fit(1e-3 * HZ), [Path("a.csv"), Path("b.csv")])


def test_modes_near_the_fit_are_not_asked_about():
    question_modes(*tables_and_fit(1.1 * HZ, std=0.02), [Path("a.csv")])


@pytest.mark.parametrize(
    ("stated", "asked"),
    [
        ({"loss_factor": 22.0}, "22: is it in percent"),
        ({"loss_factor": 3.0}, "3: is it in percent"),
        ({"std": 1.5}, "loss_factor_std up to 3 for loss factors up to 0.2: is it in percent"),
        ({"std": 1e-9}, "loss_factor_std of 1e-09 for 0.2: no measurement knows a mode so well"),
        ({"frequency_std_hz": 1e-6}, "frequency_std_hz of 1e-06 for 365.6: no measurement"),
        ({"temperature_c": 293.0}, "293: is it in K"),
    ],
)
def test_other_columns_of_modes_are_asked_about_in_another_unit(stated, asked):
    with pytest.raises(BadInput, match=asked):
        question_modes(*tables_and_fit(HZ, **stated), [Path("a.csv")])


def test_a_sweep_in_kilohertz_is_asked_about_and_a_session_is_not():
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    kilo = replace(given, sweep=replace(given.sweep, frequency_hz=1e-3 * given.sweep.frequency_hz))
    with pytest.raises(BadInput, match=r"sweep\.csv: .* the frequencies are in kHz"):
        question_data(kilo, Path("sweep.csv"))
    question_data(replace(kilo, session="monday"), Path("monday.h5"))


def test_a_file_that_says_otherwise_than_its_specimen_what_the_laser_sees_is_asked_about(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(f"# velocity is absolute: as exported\n{(DATA / 'practice-007.csv').read_text()}")
    with pytest.raises(BadInput, match=r'velocities are absolute: expected reads = "absolute" in \[pickup\]'):
        question_data(read_given(path, case_file("zn1.toml"), None), path)


def test_files_of_unlike_temperatures_are_asked_about_before_they_get_one_law():
    paths = [Path("a.csv"), Path("b.csv"), Path("c.csv")]
    with pytest.raises(BadInput, match=r"^c\.csv: at 0 degC, a\.csv at 20 degC: .* 'identify --shift'"):
        question_temperatures([20.0, None, 0.0], paths)
    question_temperatures([20.0, 21.5, None], paths)
    question_temperatures([None, None, None], paths)


def test_tables_of_modes_of_unlike_temperatures_are_asked_about():
    tables, fit = tables_and_fit(HZ, temperature_c=20.0)
    tables[1].temperature_c = np.full(2, 35.0)
    with pytest.raises(BadInput, match="one law is that of one temperature"):
        question_modes(tables, fit, [Path("a.csv"), Path("b.csv")])


def test_one_table_of_modes_of_many_temperatures_is_asked_about():
    tables, fit = tables_and_fit(HZ, temperature_c=20.0)
    tables[1].temperature_c = np.array([5.0, 53.0])
    asked = r"^b\.csv: temperature_c from 5 to 53 in one table: .* 'identify --shift', or a table for each"
    with pytest.raises(BadInput, match=asked):
        question_modes(tables, fit, [Path("a.csv"), Path("b.csv")])


@pytest.mark.parametrize(
    ("reference_c", "asked"),
    [
        (293.15, "measured at 10 to 30 degC: is it in K"),
        (-20.0, "measured at 10 to 30 degC, expected one of"),
    ],
)
def test_a_reference_temperature_far_from_what_was_measured_is_asked_about(reference_c, asked):
    paths = [Path("a.csv"), Path("b.csv")]
    with pytest.raises(BadInput, match=asked):
        question_reference(reference_c, [30.0, 10.0], paths)
    for near in (None, 20.0, 45.0):
        question_reference(near, [30.0, 10.0], paths)


def test_a_sweep_through_many_temperatures_is_asked_about():
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    with pytest.raises(BadInput, match="temperature_c from 20 to 60 in one sweep"):
        question_data(replace(given, temperature_range_c=(20.0, 60.0)), Path("sweep.csv"))
    question_data(replace(given, temperature_range_c=(20.0, 22.0)), Path("sweep.csv"))


@pytest.mark.parametrize(
    ("times", "asked"),
    [
        (lambda n: -30.0 * np.arange(n), r"time_s down to -\d+: expected seconds since the first point"),
        (lambda n: 6e4 * np.arange(n), r"time_s over .* days, in one sweep: is it in ms or us\?"),
        (np.zeros, r"time_s = 0 in all \d+ lines: expected seconds since"),
    ],
)
def test_times_that_no_clock_gives_are_asked_about(times, asked):
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    timed = replace(given.sweep, time_s=times(len(given.sweep)))
    with pytest.raises(BadInput, match=rf"^sweep\.csv: {asked}.*; --force"):
        question_data(replace(given, sweep=timed), Path("sweep.csv"))


def test_times_of_a_long_sweep_since_any_moment_are_not_asked_about():
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    for times in (1.7e9 + 30.0 * np.arange(len(given.sweep)), 3600.0 * np.arange(len(given.sweep))):
        question_data(replace(given, sweep=replace(given.sweep, time_s=times)), Path("sweep.csv"))


def test_a_sweep_of_very_many_lines_is_asked_about_with_its_time_and_how_to_thin_it():
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    many = given.sweep.take(np.arange(100_000) % len(given.sweep))
    asked = r"^sweep\.csv: 100000 lines .*\(some 5 minutes\).* every 50th line .*; --force"
    with pytest.raises(BadInput, match=asked):
        question_data(replace(given, sweep=many), Path("sweep.csv"))
    with pytest.raises(BadInput, match=r"100000 lines make a fit long: a resonance"):
        question_data(replace(given, specimen=None, sweep=many), Path("sweep.csv"))


def test_a_law_says_at_which_temperature_it_was_found():
    given = read_given(DATA / "practice-002.csv", case_file("zn1.toml"), None)
    facts = IdentificationResult(
        law_kind="constant",
        parameters={},
        standard_errors={},
        correlations={},
        points=(),
        rms_percent=1.0,
        max_percent=2.0,
        law=(),
    )
    assert replace(given, temperature_c=21.0).said(facts).temperature_c == 21.0
    assert replace(given, temperature_c=None).said(facts).temperature_c is None
