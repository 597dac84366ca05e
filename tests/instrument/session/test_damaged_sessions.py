"""A damaged session is one line and exit 2 for every command that reads one."""

import hashlib
import shutil

import h5py
import numpy as np
import pytest
from formula_rig import formula_rig
from quick_run import no_fit
from sessions import configuration, point

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.run.experiment import run_experiment
from instrument.session.journal import Entry, SessionJournal
from instrument.session.storage import SessionFile, checksum, write_part


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    folder = tmp_path_factory.mktemp("session")
    sweep = "[[sweep.segments]]\nlow_hz = 95.0\nhigh_hz = 107.0\npoints = 3\n"
    with formula_rig(folder, sweep=sweep) as (_, experiment):
        return run_experiment(experiment, folder, ("sweep",), fit=no_fit).session


def lines_changed(file, change):
    """Every part's events with some of their lines changed; None drops a line."""
    for part in file["parts"].values():
        lines = [line.decode() for line in part["events"][()]]
        kept = [new for line in lines if (new := change(line)) is not None]
        del part["events"]
        part.create_dataset("events", data=kept, dtype=h5py.string_dtype())


def truncated(path):
    path.write_bytes(path.read_bytes()[:3000])


def inside(change):
    def damage(path):
        with h5py.File(path, "r+") as file:
            change(file)

    return damage


def replaced(file, name, value):
    del file[name]
    file[name] = value


def grouped(file):
    del file["configuration"]
    file.create_group("configuration")


def rate_zero(line):
    return line.replace('"sample_rate_hz": 8192.0', '"sample_rate_hz": 0.0')


def samples_flat(file):
    for part in file["parts"].values():
        if "samples" in part:
            flat = part["samples"][()].ravel()
            del part["samples"]
            part["samples"] = flat


DAMAGE = {
    "truncated": truncated,
    "no layout version": inside(lambda f: f.attrs.__delitem__("layout_version")),
    "another layout version": inside(lambda f: f.attrs.__setitem__("layout_version", 99)),
    "layout version a word": inside(lambda f: f.attrs.__setitem__("layout_version", "abc")),
    "format an array": inside(lambda f: f.attrs.__setitem__("format", np.zeros(3))),
    "configuration a group": inside(
        lambda f: (f.__delitem__("configuration"), f.create_group("configuration"))
    ),
    "configuration no JSON": inside(lambda f: replaced(f, "configuration", "no")),
    "parts a data set": inside(lambda f: replaced(f, "parts", 1.0)),
    "events numbers": inside(lambda f: lines_changed(f, lambda line: "5")),
    "events nested": inside(lambda f: lines_changed(f, lambda line: "[" * 100_000)),
    "unknown events": inside(lambda f: lines_changed(f, lambda line: '{"event": "Invented"}')),
    "frequency zero": inside(
        lambda f: lines_changed(f, lambda line: line.replace('"frequency_hz": 101.0', '"frequency_hz": 0.0'))
    ),
    "samples flat": inside(samples_flat),
    "rate zero": inside(lambda f: lines_changed(f, rate_zero)),
}
UNTOUCHED = {("samples flat", "identify")}
"""The points are whole: nothing is wrong with what these read."""
COMMANDS = (["replay"], ["report"], ["export", "--to", "csv"], ["identify"])


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_session_is_refused_in_one_line(session, tmp_path, capsys, damage):
    path = tmp_path / "session.h5"
    shutil.copy(session, path)
    DAMAGE[damage](path)
    for command in COMMANDS:
        if (damage, command[0]) in UNTOUCHED:
            continue
        status = run([command[0], str(path), *command[1:]])
        error = capsys.readouterr().err
        assert status == 2, (command, error)
        assert error.startswith("viscorig: "), command
        assert error.count("\n") == 1, (command, error)


def of_a_later_version(lines):
    """An event of a kind that is not known here among them, summed up as a later version would."""
    return [*lines, '{"event": "LaterHappened", "number": 1}']


def rewritten(part, change):
    """Its events changed, and their sum with them."""
    lines = change([line.decode() for line in part["events"][()]])
    del part["events"]
    events = part.create_dataset("events", data=lines, dtype=h5py.string_dtype())
    events.attrs["sha256"] = hashlib.sha256("\n".join(lines).encode()).hexdigest()


LATER = "of a later version of viscorig (its event LaterHappened is not known here)"


@pytest.mark.parametrize("command", COMMANDS)
def test_a_session_of_a_later_version_is_said_to_be_one(session, tmp_path, capsys, command):
    path = tmp_path / "session.h5"
    shutil.copy(session, path)
    with h5py.File(path, "r+") as file:
        rewritten(next(iter(file["parts"].values())), of_a_later_version)
    assert run([command[0], str(path), *command[1:]]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"viscorig: {path}: {LATER}")
    assert "damaged" not in said
    assert said.count("\n") == 1


def test_a_folder_of_a_later_version_is_said_to_be_one(tmp_path, capsys):
    folder = tmp_path / "s.running"
    journal = SessionJournal(folder)
    journal.begin(configuration())
    part = folder / "part-000001.h5"
    write_part(part, [point(1)])
    with h5py.File(part, "r+") as file:
        rewritten(file, of_a_later_version)
    journal.add(Entry(1, part.name, checksum(part), 2, (1,)))
    assert run(["recover", str(folder)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"viscorig: {part}: {LATER}")
    assert list(tmp_path.iterdir()) == [folder]


@pytest.mark.parametrize("how", ["stored", "linked", "virtual"])
def test_samples_that_lie_in_another_file_are_not_read(session, tmp_path, how):
    path, other = tmp_path / "session.h5", tmp_path / "other.h5"
    shutil.copy(session, path)
    with h5py.File(path, "r+") as file, h5py.File(other, "w") as beside:
        part = next(p for p in file["parts"].values() if "samples" in p)
        samples = part["samples"][()]
        beside["samples"] = samples
        del part["samples"]
        if how == "linked":
            part["samples"] = h5py.ExternalLink(str(other), "/samples")
        elif how == "stored":
            outside = [(str(other), 0, samples.nbytes)]
            part.create_dataset("samples", samples.shape, samples.dtype, external=outside)
        else:
            layout = h5py.VirtualLayout(samples.shape, samples.dtype)
            layout[:] = h5py.VirtualSource(str(other), "samples", samples.shape)
            part.create_virtual_dataset("samples", layout)
    with SessionFile(path) as opened, pytest.raises(BadInput, match="samples: lies in another file"):
        list(opened.events())


def test_what_cannot_be_opened_is_said_for_people(session, tmp_path):
    cut, folder, other = (tmp_path / name for name in ("cut.h5", "folder.h5", "other.h5"))
    shutil.copy(session, cut)
    truncated(cut)
    folder.mkdir()
    other.write_bytes(b"no" * 2000)
    whole = f"it ends after 3,000 of {session.stat().st_size:,} bytes, expected all of it: copy it again"
    for path, why in ((cut, whole), (folder, "a folder"), (other, "what is in it is no HDF5")):
        with pytest.raises(BadInput) as refused:
            SessionFile(path)
        assert str(refused.value) == f"{path}: not a session file: {why}"


@pytest.mark.parametrize("dropped", ["AcquisitionBegan", "RangeSet", "StepBegan"])
def test_events_that_do_not_follow_are_refused_or_told_as_differences(session, tmp_path, capsys, dropped):
    path = tmp_path / "session.h5"
    shutil.copy(session, path)
    with h5py.File(path, "r+") as file:
        lines_changed(file, lambda line: None if f'"{dropped}"' in line else line)
    status = run(["replay", str(path)])
    out = capsys.readouterr()
    assert (status == 2 and out.err.count("\n") == 1) or "NOT all equal" in out.out
