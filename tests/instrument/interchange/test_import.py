"""Foreign files to this program's CSV, and refusals in a line."""

import json
import re
from pathlib import Path

import h5py
import numpy as np
import pytest
from foreign_files import RATIO, frf_set, lms, over_base, sweep_of, time_set
from scipy.io import savemat
from uff_files import write_sets

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.files.sweep_file import read_sweep
from instrument.interchange.base_frf import file_of_foreign
from instrument.interchange.exporting import export_session
from instrument.interchange.importing import import_file

NAME = "zn1-20260401T080000Z"


@pytest.fixture(scope="module")
def exported(contents, tmp_path_factory):
    folder = tmp_path_factory.mktemp("exported")
    for to in ("csv", "uff", "mat"):
        export_session(contents, to, folder)
    return folder


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
    reads = contents.configuration.rig.vibrometer.reads
    assert read_sweep(tmp_path / "a-sweep.csv").reads == reads
    assert any(f"velocity is {reads} as it says itself" in line for line in imported.said)
    hits = read_impact_csv(tmp_path / "a-hits.csv")
    assert len(hits) == 2
    assert any("hit 2: not accepted" in line for line in imported.said)


def test_our_own_csv_passes_unchanged(exported, tmp_path):
    read = sweep_of(exported / f"{NAME}.csv", tmp_path / "a.csv").columns
    own = read_sweep(exported / f"{NAME}.csv").columns
    for name in own:
        np.testing.assert_array_equal(read[name], own[name], err_msg=name)


# The command


def test_the_command_lists_what_it_found(capsys, exported, tmp_path):
    out = tmp_path / "a.csv"
    assert run(["import", str(exported / f"{NAME}-sweep.uff"), "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "velocity over base acceleration, 9 lines, 18 to 22 Hz" in said
    assert f"wrote {out}" in said


ROWS = {"frequency_hz": [20.0, 21.0, 22.0], "velocity_m_s": [1.0, 2.0, 3.0]}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"segment": [1.0, 1.4, 2.0]}, "row 2: segment = 1.4, expected a whole number"),
        ({"velocity_m_s": [1.0, -2.0, 3.0]}, "row 2: velocity_m_s = -2, expected more than 0"),
        ({"level_g": 0.0}, "row 1: level_g = 0, expected more than 0"),
        ({"frequency_hz": [20.0, 21.0, 20.0]}, "row 3: the same point as row 1"),
    ],
)
def test_a_row_that_is_none_is_refused_by_its_place_in_its_own_file(capsys, tmp_path, changed, said):
    savemat(tmp_path / "a.mat", {k: np.array(v) for k, v in (ROWS | changed).items()})
    assert run(["import", str(tmp_path / "a.mat"), "--out", str(tmp_path / "b.csv")]) == 2
    assert f"a.mat: {said}" in capsys.readouterr().err
    with pytest.raises(BadInput, match=re.escape(said)):
        file_of_foreign(tmp_path / "a.mat")


def test_temperatures_known_of_some_rows_are_written_as_far_as_they_are(tmp_path):
    rows = ROWS | {"temperature_c": [20.0, np.nan, 22.0]}
    savemat(tmp_path / "a.mat", {k: np.array(v) for k, v in rows.items()})
    assert file_of_foreign(tmp_path / "a.mat").temperature_c == 21.0
    import_file(tmp_path / "a.mat", tmp_path / "b.csv")
    import_file(tmp_path / "b.csv", tmp_path / "c.csv")
    assert read_sweep(tmp_path / "b.csv").temperature_c == 21.0
    assert read_sweep(tmp_path / "c.csv").temperature_c == 21.0


@pytest.mark.parametrize("said", ["absolute", "relative"])
def test_what_a_file_says_that_its_laser_sees_comes_along(tmp_path, said):
    write_sets(tmp_path / "a.uff", frf_set(RATIO, 11, 12, id1=f"{said.capitalize()} velocity over base"))
    assert file_of_foreign(tmp_path / "a.uff").reads == said
    found = import_file(tmp_path / "a.uff", tmp_path / "b.csv")
    assert found.said[-1].startswith(f"velocity is {said} as it says itself")
    assert read_sweep(tmp_path / "b.csv").reads == said
    assert file_of_foreign(tmp_path / "b.csv").reads == said


def test_two_that_say_otherwise_say_nothing(tmp_path):
    sets = [frf_set(RATIO, 11, 12, id1=f"{said} velocity") for said in ("absolute", "relative")]
    write_sets(tmp_path / "a.uff", *sets)
    assert file_of_foreign(tmp_path / "a.uff").reads is None


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
        (folder / "new.mat", "nothing to import"),
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


@pytest.fixture(scope="module")
def refused(tmp_path_factory):
    return refusals(tmp_path_factory.mktemp("refused"))


@pytest.mark.parametrize("k", range(22))
def test_what_cannot_be_imported_is_refused_in_a_line(capsys, tmp_path, refused, k):
    path, word = refused[k]
    assert run(["import", str(path), "--out", str(tmp_path / "out.csv")]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert word in err
    assert not (tmp_path / "out.csv").exists()


def test_every_refusal_is_tried(refused):
    assert len(refused) == 22


def test_a_file_is_never_written_over_itself(capsys, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("frequency_hz,velocity_m_s\n1,2\n2,3\n")
    assert run(["import", str(path), "--out", str(path)]) == 2
    assert "read by this command, expected another name" in capsys.readouterr().err
    assert path.read_text().startswith("frequency_hz")


def test_a_file_that_nobody_named_is_not_written_over(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    savemat("a.mat", {k: np.array(v) for k, v in ROWS.items()})
    Path("a.csv").write_text("somebody's own")
    assert run(["import", "a.mat"]) == 2
    err = capsys.readouterr().err
    assert (
        err == "viscorig: a.csv: there is a file already, expected --out: another, or this one if imported\n"
    )
    assert (Path("a.csv").read_text(), sorted(p.name for p in tmp_path.iterdir())) == (
        "somebody's own",
        ["a.csv", "a.mat"],
    )
    assert run(["import", "a.mat", "--out", "a.csv"]) == 2
    assert "a.csv: a table stands there and is not written over, expected" in capsys.readouterr().err
    assert Path("a.csv").read_text() == "somebody's own"
    Path("a.csv").unlink()
    assert run(["import", "a.mat", "--out", "a.csv"]) == 0
    assert run(["import", "a.mat"]) == 0
    assert run(["import", "a.mat", "--out", "a.csv"]) == 0
    Path("a.txt").write_text("frequency_hz,velocity_m_s\n1,2\n2,3\n")
    assert run(["import", "a.txt"]) == 2
    assert Path("a.csv").read_text().startswith("# imported from a.mat")
