"""Carrying on a run that broke off: with its calibration, and with nothing but its own experiment."""

import errno

import pytest
from formula_rig import formula_rig
from quick_run import no_fit, run
from run_at_point import RunAtPoint
from sessions import events_of

from instrument.errors import BadInput, RigStopped
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.journal import JOURNAL, SessionJournal
from instrument.session.storage import SessionFile, part_events
from instrument.stream.derived import CalibrationFound, PointMeasured
from instrument.stream.raw import SegmentEnded, SessionEnded

SWEEP = """
[[sweep.segments]]
low_hz = 95.0
high_hz = 107.0
points = 4
range = "10mm/s/V"
[[sweep.segments]]
low_hz = 180.0
high_hz = 190.0
points = 4
range = "5mm/s/V"
"""


def calibrated(experiment):
    """The same experiment, with a calibration of three frequencies."""
    table = "calibration = { frequencies_hz = [80.0, 120.0, 160.0] }"
    experiment.path.write_text(experiment.path.read_text().replace("calibration = false", table))
    return read_whole_experiment(experiment.path)


def broken_off(experiment, folder, after):
    """Run until so many points are measured, then abort; the folder."""
    control = RunControl()
    enough = RunAtPoint(after, lambda: control.abort("broken off"))
    with pytest.raises(RigStopped, match="broken off"):
        run(experiment, folder, control=control, companion=enough)
    (running,) = folder.glob("*.running")
    return running


@pytest.mark.parametrize(
    "after", [2, pytest.param(5, marks=pytest.mark.long), 8, pytest.param(11, marks=pytest.mark.long)]
)
def test_a_calibration_broken_off_anywhere_is_the_same_in_the_end(tmp_path, after):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        experiment = calibrated(experiment)
        finished = run(experiment, tmp_path, resume=broken_off(experiment, tmp_path, after))
    with SessionFile(finished.session) as file:
        found = [e for e in file.events(with_samples=False) if isinstance(e, CalibrationFound)]
        again = replay(file, fit=no_fit)
    assert again.differences == []
    assert sorted(e.range_name for e in found) == ["10mm/s/V", "20mm/s/V", "5mm/s/V"]
    assert all(e.points == 3 for e in found)
    assert [e.delay_s for e in found] == pytest.approx([1.1e-3] * 3, abs=2e-6)
    assert [p.remarks for p in finished.points if p.remarks] == []


def cut_before(running, kind):
    """A run as killed before the first event of a kind was on the disk; the last one that was."""
    journal = running / JOURNAL
    kept = []
    for line, entry in zip(journal.read_text().splitlines(), SessionJournal(running).entries(), strict=True):
        events = list(part_events(running / entry.file))
        if any(isinstance(e, kind) for e in events):
            break
        kept.append(line)
        last = events[-1]
    journal.write_text("".join(f"{line}\n" for line in kept))
    return last


def test_a_calibration_that_a_kill_kept_off_the_disk_is_found_again_and_by_a_replay_too(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        experiment = calibrated(experiment)
        running = broken_off(experiment, tmp_path, 5)
        assert isinstance(cut_before(running, CalibrationFound), SegmentEnded)
        finished = run(experiment, tmp_path, resume=running)
    with SessionFile(finished.session) as file:
        again = replay(file, fit=no_fit)
    assert again.differences == []
    assert [p.remarks for p in finished.points if p.remarks] == []


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("experiment.toml", "points = 4", "points = 5"),
        ("experiment.toml", "[sweep]", "[sweep]\nlevel_g = 0.5"),
        ("experiment.toml", "[sweep]", "[sweep]\nlimits = { drive_v = 0.3 }"),
        ("rig.toml", "sensitivity_mv_per_unit = 10.0", "sensitivity_mv_per_unit = 5.0"),
        ("specimen.toml", "young_gpa = 68.9", "young_gpa = 70.0"),
    ],
)
def test_a_changed_experiment_is_refused(tmp_path, name, old, new):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        running = broken_off(experiment, tmp_path, 2)
        path = tmp_path / name
        path.write_text(path.read_text().replace(old, new, 1))
        with pytest.raises(BadInput, match="not the one this run was begun with"):
            run(read_whole_experiment(experiment.path), tmp_path, resume=running)


def test_two_runs_in_one_folder_are_refused(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        running = broken_off(experiment, tmp_path, 2)
        other = SessionJournal(running)
        other.lock()
        with pytest.raises(BadInput, match="another run goes on"):
            run(experiment, tmp_path, resume=running)
        other.unlock()
        assert len(run(experiment, tmp_path, resume=running).points) == 8


def test_a_rig_left_in_a_heartbeat_alarm_is_taken_up_again(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP) as (rig, experiment):
        with rig.world.lock:
            now = rig.world.clock()[1]
            rig.device.start(now, 0.0)
            rig.device.check_heartbeat(100.0, now)
        assert rig.device.status(now).alarm.name == "HEARTBEAT"
        assert len(run(experiment, tmp_path).points) == 8


def test_a_run_that_measured_nothing_leaves_nothing(tmp_path):
    with formula_rig(tmp_path, sweep=SWEEP) as (rig, experiment):
        with rig.world.lock:
            rig.device.open_interlock(rig.world.clock()[1])
        with pytest.raises(RigStopped, match="nothing was measured"):
            run(experiment, tmp_path)
    assert list(tmp_path.glob("*.running")) == []
    assert list(tmp_path.glob("*.h5")) == []


def fails(*_):
    raise OSError(errno.EMFILE, "Too many open files")


def test_a_run_that_fails_before_its_first_event_leaves_no_folder(tmp_path, monkeypatch):
    monkeypatch.setattr("instrument.run.experiment.planned_work", fails)
    with (
        formula_rig(tmp_path, sweep=SWEEP) as (_, experiment),
        pytest.raises(RigStopped, match="Too many open files; nothing was measured"),
    ):
        run(experiment, tmp_path)
    assert list(tmp_path.glob("*.running")) == []


def test_a_run_carried_on_that_fails_before_its_first_event_says_what_is_kept_of_the_one_before(
    tmp_path, monkeypatch
):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        running = broken_off(experiment, tmp_path, 2)
        monkeypatch.setattr("instrument.run.experiment.planned_work", fails)
        with pytest.raises(RigStopped, match=f"steps kept in .*; to go on: .* --resume {running}"):
            run(experiment, tmp_path, resume=running)
        monkeypatch.undo()
        assert len(run(experiment, tmp_path, resume=running).points) == 8


def test_a_fit_that_goes_wrong_leaves_the_sweep_whole(tmp_path):
    def bad(number, last_step, points, damping, specimen):
        raise RuntimeError("no such luck")

    with (
        formula_rig(tmp_path, sweep=SWEEP) as (_, experiment),
        pytest.raises(RigStopped, match="internal error, RuntimeError: no such luck; 8 steps kept"),
    ):
        run_experiment(experiment, tmp_path, ("sweep",), fit=bad)
    (session,) = tmp_path.glob("*.h5")
    with SessionFile(session) as file:
        assert sum(isinstance(e, PointMeasured) for e in file.events(with_samples=False)) == 8


def test_a_fit_without_memory_is_told_of_as_such_and_its_session_can_be_diagnosed(tmp_path):
    def bad(number, last_step, points, damping, specimen):
        raise MemoryError

    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment), pytest.raises(RigStopped) as stopped:
        run_experiment(experiment, tmp_path, ("sweep",), fit=bad)
    (session,) = tmp_path.glob("*.h5")
    said = f"no memory left; 8 steps kept in {session}; to go on: viscorig diagnose {session}"
    assert str(stopped.value) == said
    assert events_of(session)[-1] == SessionEnded("stopped safely", "no memory left")
