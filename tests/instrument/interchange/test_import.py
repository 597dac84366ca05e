"""Foreign files to this program's CSV, and refusals in a line."""

import json

import h5py
import numpy as np
import pytest
from scipy.io import savemat
from uff_files import ratio_set, write_sets

from instrument.cli.main import run
from instrument.files.impact_csv import read_impact_csv
from instrument.files.sweep_file import read_sweep
from instrument.interchange.exporting import export_session
from instrument.interchange.importing import import_file
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

NAME = "zn1-20260401T080000Z"
F = np.array([15.0, 18.5, 20.0, 21.0, 30.0])
V = np.array([0.1 + 0.02j, 0.2 - 0.1j, -0.05 - 0.3j, -0.1j, 0.02 + 0.01j])
BASE = np.full(5, 4.0 + 1.0j)


@pytest.fixture(scope="module")
def contents(session_path):
    with SessionFile(session_path) as file:
        return contents_of(file)


@pytest.fixture(scope="module")
def exported(contents, tmp_path_factory):
    folder = tmp_path_factory.mktemp("exported")
    for to in ("csv", "uff", "mat"):
        export_session(contents, to, folder)
    return folder


def sweep_of(path, out):
    import_file(path, out)
    return read_sweep(out)


def over_base(columns):
    v = columns["velocity_re_m_s"] + 1j * columns["velocity_im_m_s"]
    return v / (columns["base_accel_re_m_s2"] + 1j * columns["base_accel_im_m_s2"])


# Round trips of what this program exports


def test_the_sweep_comes_back_from_a_universal_file(contents, exported, tmp_path):
    read = sweep_of(exported / f"{NAME}-sweep.uff", tmp_path / "a.csv").columns
    steps = [p for p in contents.measured if p.purpose == "step"]
    np.testing.assert_array_equal(read["frequency_hz"], [p.frequency_hz for p in steps])
    np.testing.assert_allclose(over_base(read), [p.velocity_m_s / p.base_m_s2 for p in steps], rtol=1e-14)
    np.testing.assert_array_equal(read["segment"], [p.segment for p in steps])
    np.testing.assert_allclose(read["level_g"] * 9.81, [p.level_m_s2 for p in steps], rtol=1e-5)


def test_it_identifies_to_the_same_law(capsys, contents, exported, tmp_path):
    import_file(exported / f"{NAME}-sweep.uff", tmp_path / "a.csv")
    specimen = exported / f"{NAME}-specimen.toml"
    assert run(["identify", str(tmp_path / "a.csv"), "--specimen", str(specimen), "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    live = contents.fit.result.as_json()
    at_100 = (next(r for r in facts["law"] if r["frequency_hz"] == 100.0) for facts in (found, live))
    a, b = (r["storage_modulus_pa"] for r in at_100)
    assert a == pytest.approx(b, rel=2e-3)


def test_hits_come_back_from_a_universal_file(contents, exported, tmp_path):
    import_file(exported / f"{NAME}-hits.uff", tmp_path / "a.csv")
    hits = read_impact_csv(tmp_path / "a.csv")
    good = contents.good_hits
    assert len(hits) == len(good) == 2
    for hit, recorded in zip(hits, good, strict=True):
        np.testing.assert_array_equal(hit.force_n, recorded.record.force_n)
        np.testing.assert_array_equal(hit.responses[0].samples, recorded.record.responses[0].samples)
        assert hit.sample_rate_hz == pytest.approx(recorded.record.sample_rate_hz, rel=1e-5)


def test_the_hammers_frf_comes_back_with_its_coherence(exported, tmp_path):
    import_file(exported / f"{NAME}-hammer-frf.uff", tmp_path / "a.csv")
    assert list(read_impact_csv(tmp_path / "a.csv")) == ["accelerance"]
    assert "coherence" in (tmp_path / "a.csv").read_text()[:200]


def test_everything_comes_back_from_a_matlab_file(contents, exported, tmp_path):
    imported = import_file(exported / f"{NAME}.mat", tmp_path / "a.csv")
    assert [p.name for p in imported.files] == ["a-sweep.csv", "a-frf.csv", "a-hits.csv"]
    read = read_sweep(tmp_path / "a-sweep.csv").columns
    own = read_sweep(exported / f"{NAME}.csv").columns
    assert set(read) == set(own)
    for name in own:
        np.testing.assert_array_equal(read[name], own[name], err_msg=name)
    hits = read_impact_csv(tmp_path / "a-hits.csv")
    assert len(hits) == 2
    assert any("hit 2: not accepted" in line for line in imported.said)


def test_our_own_csv_passes_unchanged(exported, tmp_path):
    read = sweep_of(exported / f"{NAME}.csv", tmp_path / "a.csv").columns
    own = read_sweep(exported / f"{NAME}.csv").columns
    for name in own:
        np.testing.assert_array_equal(read[name], own[name], err_msg=name)


# Foreign universal files


def frf_set(data, over, under, **more):
    return ratio_set(F, data, over, under) | more


def time_set(data, code, **more):
    x = np.arange(len(data)) / 1000.0
    return frf_set(data, code, 0, x=x, func_type=1, abscissa_spacing=1, abscissa_spec_data_type=17) | more


UNITS_MM = {
    "type": 164,
    "units_code": 5,
    "units_description": "mm (milli newton)",
    "temp_mode": 1,
    "length": 1000.0,
    "force": 1000.0,
    "temp": 1.0,
    "temp_offset": 273.15,
}
RATIO = V / BASE
I_OMEGA = 2j * np.pi * F


@pytest.mark.parametrize(
    ("data", "over", "under"),
    [
        (RATIO, 11, 12),
        (RATIO * I_OMEGA, 12, 12),
        (RATIO / I_OMEGA, 8, 12),
        (RATIO * I_OMEGA, 11, 11),
        (RATIO * I_OMEGA, 8, 8),
    ],
)
def test_any_motion_over_any_motion_of_the_base_is_velocity_over_acceleration(tmp_path, data, over, under):
    write_sets(tmp_path / "a.uff", frf_set(data, over, under))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)
    assert "level_g" not in read


def test_units_are_read_from_the_set(tmp_path):
    labelled = {"ordinate_axis_units_lab": "mm/s", "orddenom_axis_units_lab": "g"}
    write_sets(tmp_path / "a.uff", frf_set(RATIO * 1e3 * 9.80665, 11, 12, **labelled))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_a_files_own_units_scale_what_has_no_label(tmp_path):
    """mm and mN: accelerance in mm/s^2/mN is m/s^2/N; one in mm/s^2 over a labelled N is not."""
    write_sets(
        tmp_path / "a.uff",
        UNITS_MM,
        frf_set(RATIO, 12, 13),
        frf_set(RATIO, 12, 13, orddenom_axis_units_lab="N"),
    )
    import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    same, scaled = (read_impact_csv(tmp_path / f"a-{k}.csv")["accelerance"].H for k in (1, 2))
    np.testing.assert_allclose(same, RATIO, rtol=1e-12)
    np.testing.assert_allclose(scaled, RATIO * 1e-3, rtol=1e-12)


def test_passes_over_one_band_become_sweeps(tmp_path):
    write_sets(tmp_path / "a.uff", frf_set(RATIO, 11, 12), frf_set(2 * RATIO, 11, 12))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_array_equal(read["sweep"], [1] * 5 + [2] * 5)


def test_a_line_at_zero_is_left_out_and_said(tmp_path):
    x = np.array([0.0, 10.0, 20.0])
    write_sets(tmp_path / "a.uff", frf_set(np.array([0, 1j, 2j]), 11, 12, x=x))
    imported = import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    assert read_sweep(tmp_path / "a.csv").columns["frequency_hz"].tolist() == [10, 20]
    assert "left out at 0 Hz or without a value: 1" in imported.said[0]


def test_a_response_before_its_force_is_found(tmp_path):
    force, response = np.zeros(50), np.arange(50.0)
    force[5] = 100.0
    write_sets(tmp_path / "a.uff", time_set(response, 12), time_set(force, 13))
    import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    (hit,) = read_impact_csv(tmp_path / "a.csv")
    np.testing.assert_array_equal(hit.responses[0].samples, response)
    assert hit.sample_rate_hz == pytest.approx(1000)


def test_two_accelerometers_get_a_file_each(tmp_path):
    force, a, b = np.eye(1, 50, 5)[0], np.arange(50.0), -np.arange(50.0)
    write_sets(tmp_path / "a.uff", time_set(force, 13), time_set(a, 12), time_set(b, 12))
    imported = import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    assert [p.name for p in imported.files] == ["a-1.csv", "a-2.csv"]
    (second,) = read_impact_csv(tmp_path / "a-2.csv")
    np.testing.assert_array_equal(second.responses[0].samples, b)


# Foreign MATLAB files


def lms(values, label, x_label="Hz", start=10.0, step=0.5):
    """A function as LMS Test.Lab exports it."""
    return {
        "x_values": {
            "start_value": start,
            "increment": step,
            "number_of_values": float(len(values)),
            "quantity": {"label": x_label},
        },
        "y_values": {"values": values, "quantity": {"label": label}},
        "function_record": {"type": "FRF"},
    }


def test_testlab_frf_over_a_base(tmp_path):
    savemat(tmp_path / "a.mat", {"FRF_1": lms(RATIO * 9.80665, "(m/s)/g")})
    read = sweep_of(tmp_path / "a.mat", tmp_path / "a.csv").columns
    np.testing.assert_allclose(read["frequency_hz"], 10 + 0.5 * np.arange(5))
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_testlab_frf_over_a_force(tmp_path):
    savemat(tmp_path / "a.mat", {"FRF": lms(RATIO, "g/N")})
    import_file(tmp_path / "a.mat", tmp_path / "a.csv")
    np.testing.assert_allclose(read_impact_csv(tmp_path / "a.csv")["accelerance"].H, RATIO * 9.80665)


def test_testlab_time_records_make_a_hit(tmp_path):
    force, response = np.eye(1, 64, 8)[0] * 50, np.sin(np.arange(64.0))
    signals = {
        "Signal_0": lms(response, "g", "s", 0.0, 1e-3),
        "Signal_1": lms(force, "N", "s", 0.0, 1e-3),
    }
    savemat(tmp_path / "a.mat", signals)
    import_file(tmp_path / "a.mat", tmp_path / "a.csv")
    (hit,) = read_impact_csv(tmp_path / "a.csv")
    np.testing.assert_allclose(hit.force_n, force)
    np.testing.assert_allclose(hit.responses[0].samples, response * 9.80665)
    assert hit.sample_rate_hz == pytest.approx(1000)


def test_named_arrays(tmp_path):
    arrays = {"freq": F, "velocity_mm_s": V * 1e3, "base_accel_g": BASE / 9.80665, "comment": "by hand"}
    savemat(tmp_path / "a.mat", arrays)
    read = sweep_of(tmp_path / "a.mat", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


# Foreign CSV


def test_semicolons_decimal_commas_and_units_in_brackets(tmp_path):
    phasors = ("Velocity real [mm/s]", "Velocity imag [mm/s]", "Base accel real [g]", "Base accel imag [g]")
    table = np.column_stack([F, 1e3 * V.real, 1e3 * V.imag, BASE.real / 9.80665, BASE.imag / 9.80665])
    head = ";".join(["Frequency [Hz]", *phasors])
    rows = [";".join(repr(float(x)).replace(".", ",") for x in row) for row in table]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]))
    read = sweep_of(tmp_path / "a.csv", tmp_path / "out.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_magnitude_and_phase_with_a_row_of_units(tmp_path):
    rows = [f"{f}\t{abs(r)}\t{np.degrees(np.angle(r))}" for f, r in zip(F, RATIO, strict=True)]
    text = "\n".join(["Frequency\tFRF magnitude\tFRF phase", "Hz\t(m/s)/(m/s²)\tdeg", *rows])
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    read = sweep_of(tmp_path / "a.txt", tmp_path / "out.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_amplitudes_alone_stay_amplitudes(tmp_path):
    rows = "\n".join(f"{f},{abs(v) * 1e3}" for f, v in zip(F, V, strict=True))
    (tmp_path / "a.csv").write_text(f"Frequency (Hz),Velocity (mm/s)\n{rows}\n")
    read = sweep_of(tmp_path / "a.csv", tmp_path / "out.csv").columns
    np.testing.assert_allclose(read["velocity_m_s"], np.abs(V), rtol=1e-12)
    assert "base_accel_re_m_s2" not in read


def test_a_record_with_times(tmp_path):
    rows = "\n".join(f"{k * 0.5},{100 * (k == 3)},{k}" for k in range(20))
    (tmp_path / "a.csv").write_text(f"Time [ms],Hammer [N],Acceleration [g]\n{rows}\n")
    import_file(tmp_path / "a.csv", tmp_path / "out.csv")
    (hit,) = read_impact_csv(tmp_path / "out.csv")
    assert hit.sample_rate_hz == pytest.approx(2000)
    assert hit.responses[0].samples[1] == pytest.approx(9.80665)


# The command


def test_the_command_lists_what_it_found(capsys, exported, tmp_path):
    out = tmp_path / "a.csv"
    assert run(["import", str(exported / f"{NAME}-sweep.uff"), "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "velocity over base acceleration, 9 lines, 18 to 22 Hz" in said
    assert f"wrote {out}" in said


def mat73(path):
    with h5py.File(path, "w", userblock_size=512) as file:
        file["x"] = [1.0]
    with path.open("r+b") as file:
        head = b"MATLAB 7.3 MAT-file".ljust(116) + b"\0" * 8 + b"\x00\x02IM"
        file.write(head)


def refusals(folder):
    """Files that cannot be imported, each with a word its line must hold."""

    def text(name, content):
        (folder / name).write_text(content)
        return folder / name

    def mat(name, content):
        savemat(folder / name, content)
        return folder / name

    def uff(name, *sets):
        write_sets(folder / name, *sets)
        return folder / name

    mat73(folder / "new.mat")
    header = {"type": 151, "model_name": "m", "description": "d", "db_app": "p", "program": "p"}
    lines = "\n1,2,3\n2,3,4\n"
    return [
        (folder / "none.uff", "no such file"),
        (text("a.doc", "x"), "unknown ending"),
        (text("a.uff", "not one"), "a.uff"),
        (uff("h.uff", header), "no data set 58, found 151"),
        (uff("v.uff", frf_set(RATIO, 11, 12, ordinate_axis_units_lab="V")), "'V'"),
        (uff("u.uff", frf_set(RATIO, 0, 12)), "data type 0"),
        (uff("c.uff", frf_set(RATIO, 11, 12, ordinate_axis_units_lab="g")), "which is it?"),
        (uff("t.uff", time_set(np.ones(9), 12)), "without a force"),
        (uff("l.uff", time_set(np.ones(9), 13), time_set(np.ones(8), 12)), "beside a force"),
        (text("garbage.mat", "not one"), "garbage.mat"),
        (folder / "new.mat", "-v7"),
        (mat("none.mat", {"x": [1.0, 2.0]}), "nothing to import"),
        (mat("unit.mat", {"FRF": lms(RATIO, "Pa/V")}), "'Pa/V'"),
        (text("empty.csv", ""), "empty"),
        (text("words.csv", "a,b\nx,y\n"), "words.csv"),
        (text("units.csv", f"frequency_hz,velocity,other{lines}"), "units in the names"),
        (text("half.csv", f"frequency_hz,velocity_re_m_s,x{lines}"), "expected re and im"),
        (text("two.csv", f"frequency_hz,velocity_m_s,acceleration_m_s2{lines}"), "which is the response?"),
        (text("ragged.csv", "frequency_hz,velocity_m_s\n1,2\n2,3,4\n"), "line 3"),
        (text("number.csv", "frequency_hz,velocity_m_s\n1,2\n2,x\n"), "line 3"),
        (text("rate.csv", f"force_n,acceleration_m_s2,x{lines}"), "no sample rate"),
        (text("uneven.csv", "time_s,force_n,acceleration_m_s2\n0,1,2\n1,1,2\n5,1,2\n"), "evenly spaced"),
    ]


@pytest.mark.parametrize("k", range(22))
def test_what_cannot_be_imported_is_refused_in_a_line(capsys, tmp_path, k):
    path, word = refusals(tmp_path)[k]
    assert run(["import", str(path), "--out", str(tmp_path / "out.csv")]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert word in err
    assert not (tmp_path / "out.csv").exists()


def test_every_refusal_is_tried(tmp_path):
    assert len(refusals(tmp_path)) == 22


def test_a_file_is_never_written_over_itself(capsys, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("frequency_hz,velocity_m_s\n1,2\n2,3\n")
    assert run(["import", str(path), "--out", str(path)]) == 2
    assert "written over" in capsys.readouterr().err
