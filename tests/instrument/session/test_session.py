"""Sealed parts, the journal, and the session put together from them."""

import errno
import json
import os
import re
import threading

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sessions import RIG, block, configuration, point

from instrument.errors import BadInput, RigStopped, system_words
from instrument.files.rig_file import RigDocument
from instrument.session.journal import JOURNAL, Damage, SessionJournal
from instrument.session.recorder import Recorder
from instrument.session.storage import SessionFile, part_events, write_part, write_session
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import AcquisitionBegan, SegmentEnded, SessionEnded

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@given(FLOATS, FLOATS)
def test_an_event_comes_back_from_its_line_to_the_bit(re, im):
    there = point(velocity_re_m_s=re, velocity_im_m_s=im, remarks=("one", "two"))
    assert from_line(to_line(there)) == there


def test_an_unknown_event_is_refused():
    with pytest.raises(ValueError, match="no event of this name"):
        from_line('{"event": "Invented"}')


def recorded(folder, events, sealed=None):
    journal = SessionJournal(folder)
    journal.begin(configuration())
    with Recorder(journal, [], sealed) as recorder:
        for event in events:
            recorder.record(event)
    recorder.check()
    return journal


EVENTS = [
    AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity")),
    block(0),
    block(8),
    point(1),
    block(16),
    point(2),
]


def test_a_session_gives_back_its_events_and_samples(tmp_path):
    journal = recorded(tmp_path / "s.running", [*EVENTS, SessionEnded("done", "")])
    write_session(
        tmp_path / "s.h5", journal.configuration(), [journal.folder / e.file for e in journal.entries()]
    )
    with SessionFile(tmp_path / "s.h5") as file:
        events = list(file.events())
        assert file.configuration == configuration()
    assert events == [*EVENTS, SessionEnded("done", "")]
    for there, back in zip(
        [e for e in EVENTS if hasattr(e, "counts")], [e for e in events if hasattr(e, "counts")], strict=True
    ):
        np.testing.assert_array_equal(there.counts, back.counts)


def test_quantities_in_a_session_carry_units(tmp_path):
    journal = recorded(tmp_path / "s.running", EVENTS)
    write_session(
        tmp_path / "s.h5", journal.configuration(), [journal.folder / e.file for e in journal.entries()]
    )
    with h5py.File(tmp_path / "s.h5") as file:
        assert file["points/velocity_re_m_s"].attrs["units"] == "m/s"
        np.testing.assert_array_equal(file["points/frequency_hz"][()], [20.0, 20.0])
        assert all("units" in data.attrs for name, data in file["points"].items() if name != "purpose")


def test_each_completed_step_is_sealed_before_it_is_told(tmp_path):
    told = []

    def sealed(events):
        steps = [
            s
            for line in (tmp_path / "s.running" / JOURNAL).read_text().splitlines()
            for s in json.loads(line)["steps"]
        ]
        told.append([e.step for e in events if hasattr(e, "step")] == steps[-1:])

    recorded(tmp_path / "s.running", EVENTS, sealed)
    assert told == [True, True]


def test_a_torn_journal_line_and_a_torn_part_do_not_count(tmp_path):
    journal = recorded(tmp_path / "s.running", EVENTS)
    with (journal.folder / JOURNAL).open("a") as file:
        file.write('{"part": 3, "file": "part-000003.h5", "sha')
    (journal.folder / "part-000003.h5").write_bytes(b"torn")
    assert [e.part for e in journal.entries()] == [1, 2]
    assert journal.damage() is None
    journal.truncate(journal.entries())
    assert not (journal.folder / "part-000003.h5").exists()


def test_a_part_changed_after_sealing_does_not_count_nor_what_follows(tmp_path):
    journal = recorded(tmp_path / "s.running", EVENTS)
    with (journal.folder / "part-000001.h5").open("ab") as file:
        file.write(b"x")
    assert journal.entries() == []
    assert journal.damage() == Damage(1, "part-000001.h5 is damaged", 2, (1, 2))
    (journal.folder / "part-000001.h5").unlink()
    said = "part 1 (part-000001.h5 is missing) and 1 part after it, with 2 completed steps"
    assert journal.damage().words == said


def test_a_line_damaged_inside_the_journal_is_named(tmp_path):
    journal = recorded(tmp_path / "s.running", EVENTS)
    lines = (journal.folder / JOURNAL).read_text().splitlines()
    (journal.folder / JOURNAL).write_text("\n".join(["{torn", *lines[1:]]) + "\n")
    assert journal.damage() == Damage(1, f"line 1 of {JOURNAL} is damaged", 2, (2,))


def test_a_journal_cannot_point_outside_its_folder(tmp_path):
    journal = recorded(tmp_path / "s.running", EVENTS)
    outside = tmp_path / "outside.h5"
    digest = write_part(outside, [point(3)])
    with (journal.folder / JOURNAL).open("a") as file:
        file.write(
            json.dumps({"part": 3, "file": "../outside.h5", "sha256": digest, "events": 1, "steps": [3]})
            + "\n"
        )
    assert [e.part for e in journal.entries()] == [1, 2]


def test_blocks_of_different_channels_never_share_a_part(tmp_path):
    hammer = [AcquisitionBegan(1, "hammer", 8192.0, ("force", "response")), block(0)]
    sweep = [AcquisitionBegan(2, "sweep", 8192.0, ("base", "velocity", "temperature"))]
    journal = recorded(tmp_path / "s.running", [*hammer, *sweep, point(1)])
    assert [len(part_events(journal.folder / e.file)) for e in journal.entries()] == [2, 2]


def record_on_and_on(recorder):
    for _ in range(100_000):
        recorder.record(block())


def test_a_disk_that_fails_stops_the_run_in_one_line(tmp_path):
    journal = SessionJournal(tmp_path / "s.running")
    journal.begin(configuration())
    with Recorder(journal, []) as recorder:
        (tmp_path / "s.running" / "part-000001.tmp").mkdir()
        recorder.record(SegmentEnded(1, 1))
        with pytest.raises(RigStopped, match="recording failed") as stopped:
            record_on_and_on(recorder)
    assert "\n" not in str(stopped.value)


def test_a_disk_that_takes_nothing_any_more_stops_the_run(tmp_path, monkeypatch):
    free = threading.Event()
    monkeypatch.setattr("instrument.session.recorder.write_part", lambda *_: free.wait(30.0))
    monkeypatch.setattr("instrument.session.recorder._QUEUE", 1)
    monkeypatch.setattr("instrument.session.recorder._PATIENCE_S", 0.05)
    journal = SessionJournal(tmp_path / "s.running")
    journal.begin(configuration())
    with Recorder(journal, []) as recorder:
        recorder.record(SegmentEnded(1, 1))
        with pytest.raises(RigStopped, match=r"s\.running: the disk took nothing for 0 s"):
            record_on_and_on(recorder)
        free.set()


def test_a_folder_that_is_there_already_is_left_alone(tmp_path):
    (tmp_path / "s.running").mkdir()
    with pytest.raises(BadInput, match="exists already"):
        SessionJournal(tmp_path / "s.running").begin(configuration())


@pytest.mark.parametrize("content", [b"", b"not hdf5", b"\x89HDF\r\n\x1a\n" + b"\0" * 100])
def test_what_is_no_session_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "x.h5"
    path.write_bytes(content)
    with pytest.raises(BadInput, match="not a session") as refused:
        SessionFile(path)
    assert "\n" not in str(refused.value)


def test_another_programs_hdf5_file_is_refused(tmp_path):
    with h5py.File(tmp_path / "x.h5", "w") as file:
        file["data"] = [1.0]
    with pytest.raises(BadInput, match="not a session of this program"):
        SessionFile(tmp_path / "x.h5")


def test_the_simulated_rigs_secrets_are_not_kept():
    simulated = {k: {**v, "address": "simulated"} if "address" in v else v for k, v in RIG.items()}
    rig = RigDocument.model_validate(
        {**simulated, "simulation": {"effects": {"added_mass": {"mass_kg": 0.01}}}}
    )
    assert "added_mass" not in rig.without_simulation().model_dump_json()


@pytest.mark.parametrize(
    ("said", "number", "words"),
    [
        (
            "Set slist enabled failed (file write failed: time = Mon, errno = 28, error",
            errno.ENOSPC,
            "disk full",
        ),
        ("Set slist enabled failed (file write failed: errno = 27, error", errno.EFBIG, "File too large"),
        ("something else", errno.EIO, "it cannot be written: is the disk full?"),
    ],
)
def test_what_the_library_says_of_its_inside_is_said_as_the_system_does(
    tmp_path, monkeypatch, said, number, words
):
    def fail(*_):
        raise RuntimeError(said)

    monkeypatch.setattr("instrument.session.storage._put_together", fail)
    by_the_system = words if number == errno.EIO else os.strerror(number)
    with pytest.raises(OSError, match=re.escape(by_the_system)) as raised:
        write_session(tmp_path / "a.h5", configuration(), [])
    assert raised.value.errno == number
    assert system_words(raised.value) == words
