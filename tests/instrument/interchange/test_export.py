"""A session written for other programs, and read back."""

import json
import tomllib
from dataclasses import replace

import numpy as np
import pytest
import pyuff
from scipy.io import loadmat
from session_cases import LEVEL_G, RATE, SyntheticSession, configuration

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.files.specimen_file import SpecimenDocument
from instrument.files.sweep_file import read_sweep
from instrument.interchange.exporting import export_session
from instrument.interchange.mat_export import export_mat
from instrument.interchange.specimen_toml import specimen_toml
from instrument.interchange.uff_export import export_uff

NAME = "zn1-20260401T080000Z"


@pytest.fixture(scope="module")
def exported(contents, tmp_path_factory):
    """Folder with all three formats in it."""
    folder = tmp_path_factory.mktemp("exported")
    for to in ("csv", "uff", "mat"):
        export_session(contents, to, folder)
    return folder


def facts(capsys, *arguments):
    status = run([str(a) for a in (*arguments, "--json", "-")])
    captured = capsys.readouterr()
    assert status == 0, captured.err
    return json.loads(captured.out)


# CSV


def test_csv_identifies_to_the_same_result(capsys, session_path, exported):
    direct = facts(capsys, "identify", session_path)
    specimen, hammer = exported / f"{NAME}-specimen.toml", exported / f"{NAME}-damping.json"
    read_back = facts(
        capsys, "identify", exported / f"{NAME}.csv", "--specimen", specimen, "--hammer", hammer
    )
    for key in ("parameters", "standard_errors", "points", "law", "held_out", "chi2_per_dof", "hammer"):
        assert read_back[key] == direct[key], key


def test_level_g_times_the_specimens_acceleration_is_the_level(contents, tmp_path):
    """Also where the specimen's `[base]` is not 1 g."""
    specimen = contents.configuration.specimen.model_copy(deep=True)
    specimen.base.acceleration_m_s2 = 3.0
    contents.configuration.specimen, kept = specimen, contents.configuration.specimen
    try:
        export_session(contents, "csv", tmp_path)
    finally:
        contents.configuration.specimen = kept
    sweep = read_sweep(tmp_path / f"{NAME}.csv").sweep(3.0)
    np.testing.assert_allclose(sweep.commanded_m_s2, LEVEL_G * 9.81, rtol=1e-15)


def test_csv_says_where_it_comes_from_and_keeps_remarks(exported):
    text = (exported / f"{NAME}.csv").read_text()
    comments = [line for line in text.splitlines() if line.startswith("#")]
    assert any(NAME in line for line in comments)
    assert any('reads = "absolute"' in line for line in comments)
    unknown = read_sweep(exported / f"{NAME}.csv").unknown
    assert "weak light: signal level 0.05" in unknown["remarks"]
    assert set(unknown["purpose"]) == {"step", "sentinel"}


def test_a_title_with_line_breaks_stays_in_its_comment(contents, tmp_path):
    experiment = contents.configuration.experiment
    kept, experiment.title = experiment.title, "two\nlines"
    try:
        export_session(contents, "csv", tmp_path)
    finally:
        experiment.title = kept
    assert read_sweep(tmp_path / f"{NAME}.csv").columns["frequency_hz"].size == 31


def test_hits_as_csv_give_the_same_damping(capsys, contents, exported):
    hits = [exported / f"{NAME}-hit-{k:02d}.csv" for k in (1, 3)]
    found = facts(capsys, "damping", *hits, "--band", "10:550")["modes"]
    recorded = contents.damping.result.modes
    assert found
    for a, b in zip(found, recorded, strict=True):
        assert a["frequency_hz"] == pytest.approx(b.frequency_hz, rel=1e-12)
        assert a["damping_ratio"] == pytest.approx(b.damping_ratio, rel=1e-9)


def test_each_hit_has_a_file_and_a_rejected_one_says_so(contents, exported):
    rejected = exported / f"{NAME}-hit-02-rejected.csv"
    (hit,) = read_impact_csv(rejected)
    np.testing.assert_array_equal(hit.force_n, contents.hits[1].record.force_n)
    assert hit.sample_rate_hz == RATE
    assert "double hit" in rejected.read_text()[:400]


def test_specimen_toml_is_the_specimen_as_it_was_read(contents):
    read_back = SpecimenDocument.model_validate(tomllib.loads(specimen_toml(contents)))
    assert read_back.pickup.reads == "absolute"
    read_back.pickup.reads = contents.configuration.specimen.pickup.reads
    assert read_back == contents.configuration.specimen


# Universal files


def sets_of(path):
    return pyuff.UFF(str(path)).read_sets()


@pytest.mark.filterwarnings("ignore::ResourceWarning")
def test_uff_sweep_is_velocity_over_base_acceleration(contents, exported):
    header, units, *frfs = sets_of(exported / f"{NAME}-sweep.uff")
    assert (header["type"], units["type"], units["units_code"]) == (151, 164, 1)
    assert len(frfs) == 3
    for k, s in enumerate(frfs, start=1):
        assert (s["type"], s["func_type"], s["ord_data_type"], s["abscissa_spacing"]) == (58, 4, 6, 0)
        assert (s["ordinate_spec_data_type"], s["orddenom_spec_data_type"]) == (11, 12)
        assert s["binary"] == 1
        steps = [p for p in contents.measured if p.segment == k and p.purpose == "step"]
        np.testing.assert_array_equal(s["x"], [p.frequency_hz for p in steps])
        np.testing.assert_array_equal(s["data"], [p.velocity_m_s / p.base_m_s2 for p in steps])


@pytest.mark.filterwarnings("ignore::ResourceWarning")
def test_uff_hammer_has_an_frf_and_its_coherence(exported):
    _, _, frf, coherence = sets_of(exported / f"{NAME}-hammer-frf.uff")
    assert (frf["func_type"], frf["ordinate_spec_data_type"], frf["orddenom_spec_data_type"]) == (4, 12, 13)
    assert coherence["func_type"] == 6
    assert 0.99 < np.median(coherence["data"]) <= 1 + 1e-9


def test_uff_hits_give_the_same_damping(capsys, contents, exported):
    found = facts(capsys, "damping", exported / f"{NAME}-hits.uff", "--band", "10:550")
    assert len(found["hits"]) == 2
    for a, b in zip(found["modes"], contents.damping.result.modes, strict=True):
        # The header keeps six digits of the sampling interval.
        assert a["frequency_hz"] == pytest.approx(b.frequency_hz, rel=1e-5)
        assert a["damping_ratio"] == pytest.approx(b.damping_ratio, rel=1e-4)


def test_uff_says_what_it_leaves_out(contents, tmp_path):
    assert any("4 sentinel points" in note for note in export_session(contents, "uff", tmp_path).notes)


@pytest.mark.filterwarnings("ignore::ResourceWarning")
def test_every_set_says_its_points_its_level_and_whose_it_is(contents, exported):
    _, _, *frfs = sets_of(exported / f"{NAME}-sweep.uff")
    levels = {p.segment: p.level_m_s2 for p in contents.measured}
    for k, s in enumerate(frfs, start=1):
        assert (s["rsp_ent_name"], s["rsp_node"], s["ref_ent_name"], s["ref_node"]) == (
            "VELOCITY",
            1,
            "BASE",
            2,
        )
        assert s["z_axis_value"] == pytest.approx(levels[k], rel=1e-5)
        assert s["id2"] == f"sweep 1 segment {k}"
        assert (s["id4"], s["id5"]) == (NAME, "ZN_1 <second> & last")
    _, _, frf, coherence = sets_of(exported / f"{NAME}-hammer-frf.uff")
    ends = ("rsp_ent_name", "rsp_node", "rsp_dir", "ref_ent_name", "ref_node", "ref_dir")
    assert [frf[end] for end in ends] == [coherence[end] for end in ends]


@pytest.mark.filterwarnings("ignore::ResourceWarning")
def test_hits_that_do_not_count_have_a_universal_file_of_their_own(contents, exported):
    _, _, force, response = sets_of(exported / f"{NAME}-hits-rejected.uff")
    rejected = contents.hits[1].record
    np.testing.assert_array_equal(force["data"], rejected.force_n)
    np.testing.assert_array_equal(response["data"], rejected.responses[0].samples)
    assert force["id2"].startswith("hit 2 rejected: ")
    assert len(sets_of(exported / f"{NAME}-hits.uff")) == 2 + 2 * 2


def test_one_hit_has_no_coherence_and_none_no_frf(contents, tmp_path):
    first = contents.hits[0]
    export_uff(replace(contents, hits=[first]), tmp_path)
    assert [s.get("func_type") for s in sets_of(tmp_path / f"{NAME}-hammer-frf.uff")] == [None, None, 4]
    written, _ = export_uff(replace(contents, hits=[]), tmp_path / "..")
    assert [p.name for p in written] == [f"{NAME}-sweep.uff"]
    written[0].unlink()


def test_a_title_beyond_ascii_is_a_line_of_eighty_characters(contents, tmp_path):
    experiment = contents.configuration.experiment
    kept, experiment.title = experiment.title, f"Größe\n{'x' * 100}"
    try:
        export_uff(replace(contents, hits=[]), tmp_path)
    finally:
        experiment.title = kept
    (_, _, first, *_) = sets_of(tmp_path / f"{NAME}-sweep.uff")
    assert first["id5"] == ("Gr??e " + "x" * 100)[:80]


# MATLAB


def test_mat_has_arrays_and_a_unit_for_each(contents, exported):
    mat = loadmat(str(exported / f"{NAME}.mat"), simplify_cells=True)
    sweep = mat["sweep"]
    np.testing.assert_array_equal(sweep["velocity_m_s"], [p.velocity_m_s for p in contents.measured])
    np.testing.assert_array_equal(sweep["base_accel_m_s2"], [p.base_m_s2 for p in contents.measured])
    assert mat["hits"]["force_n"].shape == (len(contents.hits[0].record.force_n), 3)
    for part in ("sweep", "hits", "hammer_frf", "damping", "calibration"):
        assert set(mat["units"][part]) == set(mat[part])
    assert mat["units"]["sweep"]["velocity_m_s"] == "m/s"
    assert mat["units"]["hammer_frf"]["accelerance"] == "(m/s^2)/N"
    assert any(NAME in line for line in mat["about"])


def test_mat_keeps_which_hits_count_and_what_each_method_said(contents, exported):
    mat = loadmat(str(exported / f"{NAME}.mat"), simplify_cells=True)
    hits, damping = mat["hits"], mat["damping"]
    assert hits["accepted"].tolist() == [h.accepted for h in contents.hits]
    assert "double hit" in hits["why"][1]
    np.testing.assert_array_equal(hits["force_n"][:, 1], contents.hits[1].record.force_n)
    modes = contents.damping.result.modes
    assert damping["frequency_hz"].tolist() == [m.frequency_hz for m in modes]
    said = [m.by("half_power") for m in modes]
    expected = [np.nan if e is None else e.ratio for e in said]
    np.testing.assert_array_equal(damping["half_power_ratio"], expected)
    assert mat["hammer_frf"]["coherence"].shape == mat["hammer_frf"]["accelerance"].shape
    gains = [c.gain for c in contents.calibrations.values()]
    np.testing.assert_array_equal(np.atleast_1d(mat["calibration"]["gain"]), gains)


def test_mat_has_only_the_parts_that_there_are(contents, tmp_path):
    less = replace(contents, hits=contents.hits[:1], damping=None, calibrations={})
    (path,) = export_mat(less, tmp_path)
    mat = loadmat(str(path), simplify_cells=True)
    assert {name for name in mat if not name.startswith("_")} == {
        "sweep",
        "hits",
        "hammer_frf",
        "units",
        "about",
    }
    assert set(mat["units"]) == {"sweep", "hits", "hammer_frf"}
    assert "coherence" not in mat["hammer_frf"]
    (path,) = export_mat(replace(less, hits=[], points=[]), tmp_path)
    assert not any(line.startswith("result: ") for line in loadmat(str(path), simplify_cells=True)["about"])


# The command


def test_the_command_prints_every_file_it_wrote(capsys, session_path, tmp_path):
    for to in ("csv", "uff", "mat"):
        assert run(["export", str(session_path), "--to", to, "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    for path in tmp_path.iterdir():
        assert f"wrote {path}" in said


def test_an_export_is_written_over_and_nothing_else(capsys, session_path, tmp_path):
    at = {"csv": f"{NAME}.csv", "uff": f"{NAME}-sweep.uff", "mat": f"{NAME}.mat"}
    for to, name in at.items():
        folder = tmp_path / to
        command = ["export", str(session_path), "--to", to, "--out", str(folder)]
        assert run(command) == 0
        assert run(command) == 0
        whole = (folder / name).read_bytes()
        for path in folder.iterdir():
            path.unlink()
        (folder / name).write_text("frequency_hz,velocity_m_s\n20,1e-3\n")
        assert run(command) == 2
        assert f"{folder / name}: " in capsys.readouterr().err
        assert [path.read_text() for path in folder.iterdir()] == ["frequency_hz,velocity_m_s\n20,1e-3\n"]
        (folder / name).write_bytes(whole)
        assert run(command) == 0


def test_a_specimen_that_was_edited_since_is_kept_and_all_beside_it(capsys, session_path, tmp_path):
    command = ["export", str(session_path), "--to", "csv", "--out", str(tmp_path)]
    assert run(command) == 0
    edited = tmp_path / f"{NAME}-specimen.toml"
    edited.write_text(edited.read_text() + "# the pickup was moved\n")
    before = {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    assert run(command) == 2
    assert "specimen.toml: a specimen stands there and is not written over" in capsys.readouterr().err
    assert {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == before


def test_a_session_stopped_early_exports_what_there_is(capsys, tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.sweep(segments=(1,), steps=1)
    path = synthetic.save(tmp_path)
    for to, files in (("csv", {".csv", ".toml"}), ("uff", set()), ("mat", {".mat"})):
        folder = tmp_path / to
        assert run(["export", str(path), "--to", to, "--out", str(folder)]) == 0
        assert {p.suffix for p in folder.iterdir()} == files
    assert "too few for a data set" in capsys.readouterr().out


def test_nothing_to_export_is_refused(capsys, tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.end("stopped safely", "the door was open")
    assert run(["export", str(synthetic.save(tmp_path)), "--to", "csv", "--out", str(tmp_path)]) == 2
    assert "nothing to export" in capsys.readouterr().err


def test_a_folder_that_cannot_be_made_is_refused(capsys, session_path, tmp_path):
    (tmp_path / "taken").write_text("a file")
    status = run(["export", str(session_path), "--to", "mat", "--out", str(tmp_path / "taken" / "below")])
    assert status == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_universal_file_that_cannot_be_written_is_said_in_a_line(contents, tmp_path, monkeypatch):
    def fails(*_, **__):
        raise Exception("Error writing data-set #58")

    monkeypatch.setattr("pyuff.UFF.write_sets", fails)
    with pytest.raises(BadInput, match=r"\.uff: Error writing data-set #58: is the disk full"):
        export_session(contents, "uff", tmp_path)
