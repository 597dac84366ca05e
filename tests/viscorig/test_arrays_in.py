"""Sweeps, specimens and hits from arrays and numbers."""

import numpy as np
import pytest
from data_folder import DATA
from impact_cases import RATE, clean_hit
from uff_files import ratio_set, write_sets

import viscorig as vr
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep


def refused(words):
    return pytest.raises(vr.errors.BadInput, match=words)


def test_a_sweep_of_arrays_is_that_of_the_file(sweep):
    read = read_sweep(vr.example_file("table5.csv")).sweep(9.81)
    made = vr.Sweep(list(read.frequency_hz), read.velocity_m_s.tolist())
    for one in (made, sweep):
        for name, values in one.to_numpy().items():
            assert np.array_equal(values, getattr(read, name)), name


def test_single_numbers_stand_for_all_points():
    made = vr.Sweep([10.0, 11.0, 30.0], [1e-3, 2e-3, 3e-3], 4.9, std_m_s=1e-5)
    assert made.commanded_m_s2.tolist() == [4.9] * 3
    assert made.std_m_s.tolist() == [1e-5] * 3
    assert made.segment.tolist() == [1, 1, 2]


def test_phasors_over_a_measured_base():
    made = vr.Sweep([10.0, 11.0], [1e-3j, 2e-3], base_m_s2=[9.0, 9.0j])
    assert made.has_phase
    np.testing.assert_allclose(made.response_m_s, [1e-3j * 9.81 / 9, -2e-3j * 9.81 / 9])
    assert made.as_dict()["velocity_im_m_s"] == [1e-3, 0.0]


def test_a_sweep_is_not_the_callers_own_memory():
    f = np.array([10.0, 11.0])
    made = vr.Sweep(f, [1e-3, 1e-3])
    f[0] = 99.0
    assert made.frequency_hz[0] == 10.0


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"velocity_m_s": [1.0, 1.0, 1.0]}, "velocity_m_s: 3 numbers, expected 2"),
        ({"frequency_hz": [10.0, -1.0]}, r"frequency_hz\[1\] = -1, expected more than 0"),
        ({"frequency_hz": [[10.0, 11.0]]}, "expected one dimension"),
        ({"frequency_hz": []}, "at least one point"),
        ({"velocity_m_s": [1.0, np.nan]}, r"velocity_m_s\[1\] = nan, expected finite"),
        ({"velocity_m_s": [1j, 0.0]}, "not zero"),
        ({"velocity_m_s": ["a", "b"]}, "velocity_m_s: .*expected numbers"),
        ({"commanded_m_s2": 0.0}, "commanded_m_s2"),
        ({"std_m_s": [1e-5, 0.0]}, "std_m_s"),
        ({"base_m_s2": [9.81, 0.0]}, "base_m_s2"),
    ],
)
def test_arrays_that_no_sweep_has_are_refused(given, words):
    with refused(words):
        vr.Sweep(**{"frequency_hz": [10.0, 11.0], "velocity_m_s": [1.0, 1.0], **given})


def test_a_specimen_of_numbers_is_that_of_the_file(plate):
    made = vr.Specimen(**plate.as_dict())
    assert made.model == plate.model == read_specimen(DATA / "numbers" / "coarse.toml")


def test_numbers_of_numpy_are_numbers(plate):
    tables = plate.as_dict()
    tables["damping"] = {"modal_percent": np.array([0.3, 0.2])}
    tables["plate"]["length_mm"] = np.float64(300.2)
    assert vr.Specimen(**tables).model.modal_ratios == (0.003, 0.002)


def test_the_same_specimen_but_for_a_value(plate):
    thicker = plate.but(core={"thickness_mm": 1.0}, base={"acceleration_m_s2": 4.9})
    assert thicker.model.core.thickness_m == 1e-3
    assert thicker.model.core.law == plate.model.core.law
    assert thicker.model.base_acceleration_m_s2 == 4.9
    assert plate.model.core.thickness_m == 0.5e-3


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"core": {"thickness_mm": -1.0}}, r"specimen: core\.thickness_mm: -1\.0"),
        ({"core": {"thickness": 1.0}}, r"core\.thickness: unknown key"),
        ({"core": {"law": {"kind": "rubber"}}}, "expected one of"),
        ({"pickup": {"x_mm": 400.0}}, "off the plate"),
    ],
)
def test_a_wrong_key_of_a_specimen_is_named(plate, tables, words):
    with refused(words):
        plate.but(**tables)


def test_a_missing_file_is_named(plate):
    with refused(r"nowhere\.toml"):
        vr.load_specimen("nowhere.toml")
    with refused(r"nowhere\.csv"):
        vr.load_sweep("nowhere.csv", plate)


def absolute(path):
    """Two lines of what an export of a session says is an absolute velocity."""
    f, v = np.array([10.0, 11.0]), np.array([0.1 + 0.2j, 0.1 + 0.3j])
    if path.suffix == ".uff":
        write_sets(path, ratio_set(f, v, 11, 12) | {"id1": "absolute velocity over base acceleration"})
    else:
        rows = [f"{a:g},{b.real:g},{b.imag:g}" for a, b in zip(f, v, strict=True)]
        columns = "frequency_hz,velocity_re_m_s,velocity_im_m_s"
        path.write_text("\n".join(["# velocity is absolute: as exported", columns, *rows]))
    return path


@pytest.mark.parametrize("name", ["a.csv", "a.uff"])
def test_a_file_that_says_otherwise_than_its_specimen_what_the_laser_sees_is_refused(plate, tmp_path, name):
    path = absolute(tmp_path / name)
    with refused(rf'{name}: .*velocities are absolute: expected reads = "absolute" in \[pickup\]'):
        vr.load_sweep(path, plate)
    assert len(vr.load_sweep(path, plate.but(pickup={"reads": "absolute"}))) == 2


def test_rows_of_several_mountings_are_refused_as_the_command_does(plate, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("frequency_hz,velocity_m_s,mounting\n10,0.1,0\n11,0.2,1\n")
    with refused("column mounting: the plate was clamped anew for some rows"):
        vr.load_sweep(path, plate)


def test_hits_of_arrays_give_the_poles_behind_them():
    force, response = clean_hit()
    found = vr.damping(vr.Hit(force, RATE, acceleration_m_s2=response), band_hz=(40.0, 70.0))
    assert found.frequency_hz == pytest.approx([59.845], rel=1e-4)
    assert found.damping_ratio == pytest.approx([0.0013], rel=0.02)
    assert any("one hit" in line for line in found.lines())


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "force alone"),
        ({"velocity_m_s": np.ones(7)}, "hit: velocity_m_s: 7 numbers, expected 8"),
        ({"velocity_m_s": np.full(8, np.inf)}, "finite"),
        ({"velocity_m_s": np.ones(8), "sample_rate_hz": 0.0}, "sample_rate_hz"),
    ],
)
def test_hits_without_a_motion_are_refused(given, words):
    with refused(words):
        vr.damping(vr.Hit(**{"force_n": np.arange(8.0), "sample_rate_hz": RATE, **given}))


def test_hits_that_cannot_be_averaged_are_refused():
    force, response = clean_hit()
    whole = vr.Hit(force, RATE, acceleration_m_s2=response, name="first")
    for other in (
        vr.Hit(force[:-1], RATE, acceleration_m_s2=response[:-1]),
        vr.Hit(force, 2 * RATE, acceleration_m_s2=response),
        vr.Hit(force, RATE, velocity_m_s=response),
    ):
        with refused("as in first"):
            vr.damping([whole, other])


def test_a_hammer_test_of_numbers_is_checked(sweep, plate):
    with refused("as many"):
        vr.identify(sweep, plate, hammer=([17.7, 60.0], [0.003]))
    with refused("hammer test"):
        vr.identify(sweep, plate, hammer=([17.7], [0.5]))


def test_a_sweep_wants_its_specimen(sweep):
    with refused("expected its specimen"):
        vr.identify(sweep)


@pytest.mark.parametrize("fit", [vr.identify, vr.diagnose])
def test_what_is_no_sweep_or_no_specimen_is_named_by_its_type(sweep, plate, fit):
    with refused("^data: a Specimen, expected a Sweep or a Session$"):
        fit(plate, sweep)
    with refused("^data: a str, expected a Sweep or a Session; a file is read by vr.load_session or"):
        fit("session.h5")
    with refused("^specimen: a str, expected a Specimen"):
        fit(sweep, "specimen.toml")


def test_a_bare_plate_has_no_core_to_identify(sweep, plate):
    bare = {name: table for name, table in plate.as_dict().items() if name not in ("core", "constraining")}
    with pytest.raises(vr.errors.OutsideModel, match="bare plate"):
        vr.identify(sweep, vr.Specimen(**bare))


def test_options_that_exclude_each_other_are_refused(sweep, plate, found):
    with refused("direct method"):
        vr.identify(sweep, plate, method="paper", pointwise=True)
    with refused("one of them"):
        vr.predict(plate, [20.0], fit=found, real_modes=True)
    with refused("frequency_hz"):
        vr.predict(plate, [20.0, 0.0])
