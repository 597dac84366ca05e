"""Rows of a batch that are no sweeps of a plate at one spot."""

import json
from dataclasses import replace

import numpy as np
import pytest

from instrument.batch import work
from instrument.batch.keys import Keys
from instrument.batch.of_modes import identified_modes
from instrument.batch.task import BatchTask
from instrument.batch.work import outcome_of
from instrument.cli.main import run

SHARED = ("law_kind", "parameters", "standard_errors", "chi2_per_dof", "converged", "warnings")
MODES = "mode,frequency_hz,loss_factor\n1,75.6,0.233\n2,377.5,0.264\n3,963.9,0.228\n4,1744.8,0.175\n"


def pair_sweep():
    """`viscorig new shear-pair`, of a rubber without mass: T = K / (K - M w^2)."""
    f = np.geomspace(60, 500, 12)
    s = (2j * np.pi * f * 0.6e-4) ** 0.55
    stiffness = (2.6e6 + 45e6 * s) / (1 + s) * 2 * np.pi / 4 * (0.03**2 - 0.01**2) / 0.006
    a = 9.81 * stiffness / (stiffness - 0.5 * (2 * np.pi * f) ** 2)
    rows = [f"{x!r},{y.real!r},{y.imag!r}" for x, y in zip(f.tolist(), a.tolist(), strict=True)]
    return "\n".join(["frequency_hz,acceleration_re_m_s2,acceleration_im_m_s2", *rows]) + "\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("structures")
    for kind in ("beam", "shear-pair"):
        file = path / f"{kind}.toml"
        assert run(["new", kind, str(file)]) == 0
        file.write_text(file.read_text() + "\n[tolerances]\nexact = true\n")
    (path / "modes.csv").write_text(MODES)
    (path / "pair.csv").write_text(pair_sweep())
    return path


@pytest.mark.parametrize(("data", "specimen", "points"), [("pair", "shear-pair", 12), ("modes", "beam", 4)])
def test_a_row_of_any_structure_says_what_identify_says(folder, capsys, data, specimen, points):
    files = [str(folder / f"{data}.csv"), str(folder / f"{specimen}.toml")]
    found = outcome_of(BatchTask(*files))
    assert (found["failed"], found["points"]) == (None, points)
    capsys.readouterr()
    assert run(["identify", files[0], "--specimen", files[1], "--json", "-"]) == 0
    alone = json.loads(capsys.readouterr().out)
    assert {key: found[key] for key in SHARED} == {key: alone[key] for key in SHARED}


@pytest.fixture
def in_kilohertz(folder):
    path = folder / "kilo.csv"
    head, *rows = [line.split(",") for line in MODES.splitlines()]
    rows = [[mode, repr(float(f) / 1e3), eta] for mode, f, eta in rows]
    path.write_text("\n".join(map(",".join, [head, *rows])) + "\n")
    return BatchTask(str(path), str(folder / "beam.toml"))


@pytest.mark.parametrize("diagnose", [False, pytest.param(True, marks=pytest.mark.long)])
def test_a_table_in_kilohertz_is_a_row_that_fails(in_kilohertz, diagnose):
    asked = "the frequencies are in kHz, expected Hz; --force to go on all the same"
    assert outcome_of(replace(in_kilohertz, diagnose=diagnose))["failed"] == asked


def test_a_table_in_kilohertz_is_a_law_where_someone_insists(in_kilohertz):
    assert outcome_of(replace(in_kilohertz, insist=True))["failed"] is None


def test_whether_someone_insists_is_part_of_what_a_row_is_known_by(folder):
    task = BatchTask(str(folder / "modes.csv"), str(folder / "beam.toml"))
    assert Keys().key(task) != Keys().key(replace(task, insist=True))


def test_a_specimen_in_another_unit_is_a_row_that_fails(folder):
    path = folder / "grams.toml"
    path.write_text((folder / "beam.toml").read_text().replace("= 2700.0", "= 2.7", 1))
    said = outcome_of(BatchTask(str(folder / "modes.csv"), str(path)))["failed"]
    assert said.startswith("grams.toml: substrate.density_kg_m3 = 2.7 ")


def test_a_hammer_test_is_refused_where_there_is_no_plate(folder):
    files = [str(folder / name) for name in ("modes.csv", "beam.toml", "hammer.json")]
    said = "hammer.json: a hammer test with a table of modes, expected a sweep"
    assert outcome_of(BatchTask(*files))["failed"] == said


@pytest.mark.parametrize(
    ("error", "begins", "ends"),
    [
        (
            np.linalg.LinAlgError("SVD did not converge"),
            "the equations of this specimen and these data have no solution: are units, edges",
            "(SVD did not converge in test_structures.py, line ",
        ),
        (
            IndexError("list index out of range"),
            "viscorig itself failed at this row, whatever its files say; the others stand: report both files",
            "(IndexError in test_structures.py, line ",
        ),
    ],
)
def test_what_fails_inside_says_what_to_do_about_it_and_warns_no_one(
    folder, monkeypatch, recwarn, error, begins, ends
):
    def broken(task):
        np.log(np.array([-1.0]))
        raise error

    monkeypatch.setattr(work, "_worked", broken)
    said = outcome_of(BatchTask(str(folder / "modes.csv"), str(folder / "beam.toml")))
    assert said["failed"].startswith(begins)
    assert ends in said["failed"]
    assert said["again"]
    assert not recwarn.list


def test_what_a_table_leaves_is_of_its_frequencies(folder):
    found, _ = identified_modes(folder / "modes.csv", folder / "beam.toml", insist=True)
    off = [100 * (mode.predicted_hz / mode.frequency_hz - 1) for mode in found.modes]
    assert found.rms_percent == pytest.approx(np.sqrt(np.mean(np.square(off))))
    assert found.max_percent == pytest.approx(np.abs(off).max())


def test_the_json_of_a_table_has_the_keys_of_a_sweep_s(folder):
    found, _ = identified_modes(folder / "modes.csv", folder / "beam.toml", insist=True)
    written = found.as_json()
    assert written["leave_one_out_rms_percent"] is None
    assert written["iterations"] > 0
    assert written["setup_seconds"] > 0
    assert list(written["correlations"]) == list(written["parameters"])
