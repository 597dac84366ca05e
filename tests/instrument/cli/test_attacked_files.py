"""Spoiled files of every format: a command does its work or refuses in one line, and leaves nothing."""

import json
import lzma
import random
import shutil

import h5py
import numpy as np
import pytest
from attacked_files import COMMANDS, SLOW, lab_variables, mat_variables, write_files
from attacks import faults_of, spoil
from data_folder import DATA
from scipy.io import savemat

from instrument.cli.main import run

QUICK = [
    n
    for n in COMMANDS
    if n not in ("sweep.csv", "dma.csv", "modes.csv", "hammer.json", "shear-pair.toml", "coarse.toml")
]
"""Whose commands take well below a second."""


@pytest.fixture(scope="module")
def valid(tmp_path_factory):
    folder = tmp_path_factory.mktemp("valid")
    session = folder / "recorded.h5"
    session.write_bytes(lzma.decompress((DATA / "numbers" / "small.h5.xz").read_bytes()))
    write_files(folder, session)
    session.unlink()
    return folder


@pytest.fixture
def here(valid, tmp_path, monkeypatch):
    folder = tmp_path / "here"
    shutil.copytree(valid, folder)
    monkeypatch.chdir(folder)
    return folder


def attacked(capsys, folder, line):
    """Faults of a command, its status and what it said; warnings are errors in tests."""
    before = {p.name for p in folder.rglob("*")}
    status = run(line.split())
    said = capsys.readouterr()
    left = sorted({p.name for p in folder.rglob("*")} - before)
    faults = faults_of(status, said.out, said.err, left, said_at_once=line.startswith("check"))
    return [f"{line}: {fault}: {said.err[-300:]}" for fault in faults], status, said.err


def fuzzed(capsys, here, valid, names, commands, seed):
    rng = random.Random(seed)
    name = rng.choice(names)
    line = rng.choice(commands[name])
    try:
        spoil(here / name, rng)
    except (ValueError, IndexError, TypeError, OSError, KeyError, NotImplementedError):
        pytest.skip("this way to spoil it makes no file")
    faults, _, _ = attacked(capsys, here, line.format(name))
    assert faults == []


@pytest.mark.parametrize("seed", range(40))
def test_a_spoiled_file_is_worked_on_or_refused(capsys, here, valid, seed):
    fuzzed(capsys, here, valid, QUICK, COMMANDS, f"quick {seed}")


@pytest.mark.long
@pytest.mark.parametrize("seed", range(300))
def test_a_spoiled_file_of_any_kind_is_worked_on_or_refused(capsys, here, valid, seed):
    every = {name: (*lines, *SLOW.get(name, ())) for name, lines in COMMANDS.items()}
    fuzzed(capsys, here, valid, list(every), every, f"long {seed}")


def refused(capsys, here, line, said):
    faults, status, err = attacked(capsys, here, line)
    assert faults == []
    assert status == 2
    assert said in err


@pytest.mark.parametrize("name", ["dma.csv", "sensors.toml"])
def test_a_valid_table_has_its_work_done(capsys, here, name):
    faults, status, _ = attacked(capsys, here, COMMANDS[name][0].format(name))
    assert (faults, status) == ([], 0)


MAT = {
    "empty": {"force_n": np.zeros((0, 0))},
    "complex": {"acceleration_m_s2": np.ones(64) * 1j},
    "three dimensions": {"force_n": np.ones((4, 4, 2))},
    "not a number": {"force_n": np.full(64, np.nan)},
    "too large": {"acceleration_m_s2": np.full(64, 1e300)},
    "a rate that is none": {"sample_rate_hz": -1.0},
    "a rate in words": {"sample_rate_hz": "fast"},
}


@pytest.mark.parametrize("changed", MAT.values(), ids=MAT)
@pytest.mark.parametrize("command", ["damping hits.mat", "import hits.mat --out out.csv"])
def test_matlab_variables_of_another_shape_are_refused(capsys, here, changed, command):
    t = np.arange(64) / 1024
    savemat(here / "hits.mat", mat_variables(np.sin(40 * t), np.cos(30 * t)) | changed, oned_as="column")
    faults, status, _ = attacked(capsys, here, command)
    assert (faults, status) == ([], 2)


@pytest.mark.parametrize("field", ["x_values", "y_values"])
@pytest.mark.parametrize("value", [5.0, "text", {}, np.zeros((0, 0)), {"values": np.zeros((2, 2, 2))}])
def test_a_struct_of_another_make_is_refused(capsys, here, field, value):
    t = np.arange(64) / 1024
    variables = lab_variables(np.sin(40 * t), np.cos(30 * t))
    variables["Force"][field] = value
    savemat(here / "lab.mat", variables, oned_as="column")
    faults, status, _ = attacked(capsys, here, "import lab.mat --out out.csv")
    assert (faults, status) == ([], 2)


@pytest.mark.parametrize("number", ["0.", "-1.0", "nan", "1e300"])
def test_labview_steps_that_are_none_are_refused(capsys, here, number):
    text = (here / "hits.lvm").read_text()
    (here / "hits.lvm").write_text(text.replace("Delta_X\t0.0009765625", f"Delta_X\t{number}"))
    faults, status, _ = attacked(capsys, here, "damping hits.lvm")
    assert (faults, status) == ([], 2)


@pytest.mark.parametrize("count", ["0", "-3", "99999999999", "x"])
def test_labview_channels_beyond_the_names_are_refused(capsys, here, count):
    text = (here / "hits.lvm").read_text()
    (here / "hits.lvm").write_text(text.replace("Channels\t2", f"Channels\t{count}"))
    faults, status, _ = attacked(capsys, here, "damping hits.lvm")
    assert (faults, status) == ([], 2)


def test_a_universal_file_cut_short_is_refused(capsys, here):
    lines = (here / "hits.uff").read_text().splitlines()
    del lines[40:60]
    (here / "hits.uff").write_text("\n".join(lines) + "\n")
    faults, _, _ = attacked(capsys, here, "damping hits.uff")
    assert faults == []


@pytest.mark.parametrize(
    ("values", "said"), [((1e301, 1e308), "beyond"), ((0.0, 0.0), "zero everywhere")], ids=["large", "zero"]
)
def test_an_frf_without_sizes_is_refused(capsys, here, values, said):
    rows = [f"{f},{values[0]},{values[1]}" for f in range(1, 40)]
    (here / "frf.csv").write_text("frequency_hz,receptance_re,receptance_im\n" + "\n".join(rows) + "\n")
    refused(capsys, here, "damping frf.csv", said)


def test_escape_sequences_do_not_reach_the_terminal(capsys, here):
    (here / "frf.csv").write_text("\x1b]0;title\x07\x1b[2Jx,velocity_m_s\n2,3\n")
    (here / "coarse.toml").write_text('["\\u001b]0;title\\u0007"]\na = 1\n')
    refused(capsys, here, "damping frf.csv", "x1b")
    refused(capsys, here, "modes coarse.toml", "coarse.toml")


def configured(here, **changes):
    with h5py.File(here / "small.h5", "r+") as file:
        known = json.loads(file["configuration"][()])
        del file["configuration"]
        file["configuration"] = json.dumps(known | changes)


@pytest.mark.parametrize("name", ["../../away", "/tmp/away", "..", "a/b", "C:\\away", "x\x1b[2J"])
@pytest.mark.parametrize("to", ["csv", "mat"])
def test_a_session_s_name_is_no_path(capsys, here, name, to):
    configured(here, name=name)
    refused(capsys, here, f"export small.h5 --to {to} --out out", "configuration")
    assert not list(here.parent.glob("away*"))


def test_no_memory_is_taken_for_samples_that_are_not_there(capsys, here):
    with h5py.File(here / "small.h5", "r+") as file:
        part = file["parts"][min(file["parts"])]
        if "samples" in part:
            del part["samples"]
        part.create_dataset("samples", shape=(4, 10**10), dtype=np.int32, chunks=(4, 1024))
    refused(capsys, here, "report small.h5 --out out.html", "claims")


@pytest.mark.parametrize("number", ["inf", "1e400", "1e308"])
@pytest.mark.parametrize(
    "names", ["velocity_mm_s", "velocity_re_mm_s,velocity_im_mm_s", "velocity_mm_s,Base [g]", "FRF (g/N)"]
)
def test_a_number_too_large_to_compute_with_is_refused_in_one_line(capsys, here, names, number):
    before = "1," * names.count(",")
    rows = [f"{f},{before}{number}" for f in range(10, 14)]
    (here / "new.csv").write_text("\n".join([f"frequency_hz,{names}", *rows]) + "\n")
    refused(capsys, here, "import new.csv --out out.csv", "new.csv: ")


def test_an_endless_phase_is_refused_in_one_line(capsys, here):
    rows = [f"{f},1,inf" for f in range(10, 14)]
    (here / "new.csv").write_text("\n".join(["frequency_hz,velocity_mm_s,velocity_phase_deg", *rows]) + "\n")
    refused(capsys, here, "import new.csv --out out.csv", "new.csv: line 2: velocity_phase_deg = inf")


def test_a_refused_import_leaves_nothing(capsys, here):
    lines = (here / "sweep.csv").read_text().splitlines()
    (here / "sweep.csv").write_text("\n".join([*lines, lines[-1]]) + "\n")
    refused(capsys, here, "import sweep.csv --out out.csv", "the same point")
