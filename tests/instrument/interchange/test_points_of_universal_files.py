"""Universal files between several points, along negative directions, in other axes and units."""

import numpy as np
import pytest
from foreign_files import RATIO, F, frf_set, over_base, sweep_of, time_set
from uff_files import write_sets

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.files.uff58 import read_uff58
from instrument.interchange.importing import import_file
from instrument.interchange.read_uff import read_uff
from instrument.interchange.readers import read_foreign
from instrument.paper_case import case_file

VELOCITY, ACCELERATION, FORCE = 11, 12, 13


def frf(**more):
    return frf_set(RATIO, VELOCITY, ACCELERATION) | more


def units(length):
    return {
        "type": 164,
        "units_code": 1,
        "units_description": "units",
        "temp_mode": 1,
        "length": length,
        "force": 1.0,
        "temp": 1.0,
        "temp_offset": 273.15,
    }


def written(tmp_path, *sets):
    write_sets(tmp_path / "a.uff", *sets)
    return tmp_path / "a.uff"


def test_responses_at_several_nodes_are_spots_and_not_passes_of_one(tmp_path):
    path = written(
        tmp_path, frf(rsp_node=12), frf(rsp_node=7, data=2 * RATIO), frf(rsp_node=12, data=3 * RATIO)
    )
    found = read_foreign(path)
    assert [s["pickup"][0] for s in found.sweeps] == [0, 1, 0]
    assert found.said[-2:] == [
        "column pickup: 0 is node 12 Z over node 1 Z",
        "column pickup: 1 is node 7 Z over node 1 Z",
    ]
    read = sweep_of(path, tmp_path / "a.csv").columns
    np.testing.assert_array_equal(read["pickup"], [0] * 5 + [1] * 5 + [0] * 5)
    np.testing.assert_array_equal(read["sweep"], [1] * 10 + [2] * 5)


def test_several_spots_are_not_fitted_as_the_one_of_a_specimen(capsys, tmp_path):
    path = written(tmp_path, frf(rsp_node=1), frf(rsp_node=2))
    assert run(["identify", str(path), "--specimen", str(case_file("zn1.toml"))]) == 2
    assert "column pickup: 1, expected 0: the specimen is read at one spot" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("directions", "sign"),
    [({"rsp_dir": -3}, -1), ({"ref_dir": -3}, -1), ({"rsp_dir": -3, "ref_dir": -3}, 1), ({}, 1)],
)
def test_a_negative_direction_turns_the_sign_and_that_is_said(tmp_path, directions, sign):
    path = written(tmp_path, frf(**directions))
    read = sweep_of(path, tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), sign * RATIO, rtol=1e-12)
    assert ("sign turned" in read_uff(path).said[0]) == (sign < 0)


def test_a_motion_across_what_drives_it_is_passed_over(tmp_path):
    found = read_uff(written(tmp_path, frf(rsp_dir=1), frf()))
    assert len(found.sweeps) == 1
    assert found.said[0].endswith("node 1 X over node 1 Z: not along what drives it")


def test_an_frf_of_real_numbers_has_no_phase_and_is_refused(tmp_path):
    path = written(tmp_path, frf(data=np.abs(RATIO)))
    with pytest.raises(BadInput, match="set 1: an FRF of real numbers"):
        read_uff58(path)


def test_each_set_is_in_the_units_before_it(tmp_path):
    path = written(tmp_path, units(1.0), frf(), units(1000.0), frf(orddenom_axis_units_lab="m/s^2"))
    first, second = read_uff58(path).functions
    np.testing.assert_allclose(second.values, 1e-3 * first.values)


@pytest.mark.parametrize(("label", "factor"), [("kHz", 1e3), ("Hz", 1.0), ("rad/s", 1 / (2 * np.pi))])
def test_lines_are_in_hertz_whatever_their_label(tmp_path, label, factor):
    (f,) = read_uff58(written(tmp_path, frf(abscissa_axis_units_lab=label))).functions
    np.testing.assert_allclose(f.x, F * factor, rtol=1e-5)


@pytest.mark.parametrize(
    ("axis", "said"),
    [({"abscissa_axis_units_lab": "furlong"}, "'furlong'"), ({"abscissa_spec_data_type": 19}, "rpm")],
)
def test_another_abscissa_is_refused(tmp_path, axis, said):
    with pytest.raises(BadInput, match=f"set 1: abscissa in {said}, expected Hz"):
        read_uff58(written(tmp_path, frf(**axis)))


def test_times_in_milliseconds_are_no_seconds(tmp_path):
    force, response = np.eye(1, 50, 5)[0], np.arange(50.0)
    ms = {"abscissa_axis_units_lab": "ms", "abscissa_inc": 0.5, "x": 0.5 * np.arange(50)}
    import_file(
        written(tmp_path, time_set(force, FORCE, **ms), time_set(response, 12, **ms)), tmp_path / "a.csv"
    )
    assert read_impact_csv(tmp_path / "a.csv")[0].sample_rate_hz == pytest.approx(2000)


def test_a_record_at_uneven_times_is_refused(tmp_path):
    uneven = {"abscissa_spacing": 0, "x": np.arange(50.0) ** 1.1}
    with pytest.raises(BadInput, match="set 1: its times are not evenly spaced"):
        read_uff58(written(tmp_path, time_set(np.ones(50), FORCE, **uneven)))


def test_a_set_that_was_cut_off_is_refused(tmp_path):
    path = written(tmp_path, frf(binary=0, ord_data_type=6))
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:-3], *lines[-1:]]) + "\n")
    with pytest.raises(BadInput, match="set 1: 3 values, expected 5 as its head says"):
        read_uff58(path)
