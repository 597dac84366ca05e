"""The folder of a running session: begun, taken up again, put together whatever the end was."""

import errno
import shlex
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from types import SimpleNamespace
from typing import get_args

import pytest
from sessions import configuration, point

from instrument.engine.messages import Order
from instrument.errors import BadInput
from instrument.files.experiment_file import ExperimentDocument
from instrument.run import keeping
from instrument.run.keeping import finish_session, kept, open_journal
from instrument.run.part import Part
from instrument.session.configuration import Configuration
from instrument.session.contents import contents_of
from instrument.session.journal import JOURNAL, Entry, SessionJournal
from instrument.session.storage import SessionFile, write_part
from instrument.stream.derived import HitJudged
from instrument.stream.raw import Held

HIT = HitJudged(1, 0, 100, 50.0, True, "")


@dataclass(frozen=True)
class Experiment:
    """Of a file of some name; its documents are those of a small session."""

    path: Path
    made: Configuration = field(default_factory=configuration)

    def configuration(self, name, created_utc):
        return self.made.model_copy(update={"name": name, "created_utc": created_utc})


@pytest.fixture
def begin(tmp_path):
    """A journal of its own, in the test's folder; its lock is let go of afterwards."""
    opened = []

    def open_one(name="a first try.toml", resume=None, made=None):
        experiment = Experiment(tmp_path / name, made or configuration())
        journal, session = open_journal(experiment, tmp_path, resume)
        opened.append(journal)
        return journal, session

    yield open_one
    for journal in opened:
        journal.unlock()


def add(journal, *events):
    """A sealed part more."""
    number = len(journal.entries()) + 1
    name = f"part-{number:06d}.h5"
    digest = write_part(journal.folder / name, list(events))
    steps = tuple(e.step for e in events if hasattr(e, "step"))
    journal.add(Entry(number, name, digest, len(events), steps))


def test_a_new_session_is_called_by_its_experiment_and_the_time(begin, tmp_path):
    journal, name = begin()
    assert name.startswith("a-first-try-20")
    assert journal.folder == tmp_path / f"{name}.running"
    assert journal.configuration().name == name
    assert journal.configuration().command == "run"
    assert journal.entries() == []
    _, other = begin("§§.toml")
    assert other.startswith("session-")


def test_a_clock_that_was_put_back_costs_no_session(begin, tmp_path, monkeypatch):
    class Frozen(datetime):
        @classmethod
        def now(cls, tz=None):
            return cls(2026, 11, 30, 12, 0, 0, tzinfo=tz)

    monkeypatch.setattr(keeping, "datetime", Frozen)
    names = []
    for _ in range(3):
        journal, name = begin()
        add(journal, point(len(names) + 1))
        finish_session(journal, tmp_path / f"{name}.h5")
        names.append(name)
    first = "a-first-try-20261130T120000Z"
    assert names == [first, f"{first}-2", f"{first}-3"]
    for k, name in enumerate(names):
        with SessionFile(tmp_path / f"{name}.h5") as file:
            assert file.configuration.name == name
            assert [p.step for p in contents_of(file).measured] == [k + 1]


def test_a_run_is_carried_on_in_its_own_folder_under_its_own_name_with_what_is_whole(begin, caplog):
    journal, name = begin()
    add(journal, point(1), point(2))
    (journal.folder / "part-000002.h5").write_bytes(b"torn")
    journal.unlock()
    again, same = begin(resume=journal.folder)
    assert same == name
    assert not caplog.text
    assert [e.steps for e in again.entries()] == [(1, 2)]
    assert not (journal.folder / "part-000002.h5").exists()


def test_what_is_measured_again_because_a_part_is_damaged_is_said(begin, caplog):
    journal, _ = begin()
    for k in range(3):
        add(journal, point(k + 1))
    (journal.folder / "part-000002.h5").write_bytes(b"damaged")
    journal.unlock()
    again, _ = begin(resume=journal.folder)
    said = "part 2 (part-000002.h5 is damaged) and 1 part after it, with 2 completed steps: measured again"
    assert said in caplog.text
    assert [e.steps for e in again.entries()] == [(1,)]


def test_two_runs_do_not_go_on_in_one_folder(begin):
    journal, _ = begin()
    with pytest.raises(BadInput, match="another run goes on in it"):
        begin(resume=journal.folder)


@pytest.mark.parametrize("part", ["experiment", "specimen", "rig"])
def test_a_session_is_of_one_experiment(begin, part):
    journal, name = begin()
    journal.unlock()
    made = configuration()
    changes = {
        "experiment": {"title": "another"},
        "specimen": {"plate": made.specimen.plate.model_copy(update={"length_mm": 200.0})},
        "rig": {"limits": made.rig.limits.model_copy(update={"base_m_s2": 7.0})},
    }
    changed = getattr(made, part).model_copy(update=changes[part])
    with pytest.raises(BadInput, match=f"{name}: the {part} file is not the one this run was begun with"):
        begin(resume=journal.folder, made=made.model_copy(update={part: changed}))


def test_only_where_the_instruments_answer_may_differ(begin):
    journal, name = begin()
    journal.unlock()
    made = configuration()
    shaker = made.rig.shaker.model_copy(update={"address": "10.0.0.7:502"})
    moved = made.model_copy(update={"rig": made.rig.model_copy(update={"shaker": shaker})})
    assert begin(resume=journal.folder, made=moved)[1] == name


def test_a_session_is_put_together_of_all_its_parts_and_its_folder_goes(begin, tmp_path):
    journal, _ = begin()
    with pytest.raises(BadInput, match="nothing was completed"):
        finish_session(journal, tmp_path / "a.h5")
    add(journal, point(1), point(2))
    add(journal, point(3))
    assert finish_session(journal, tmp_path / "a.h5") == 2
    assert not journal.folder.exists()
    with SessionFile(tmp_path / "a.h5") as file:
        assert [p.step for p in contents_of(file).measured] == [1, 2, 3]


def test_the_folder_of_a_session_with_a_damaged_part_stays(begin, tmp_path, caplog):
    journal, _ = begin()
    add(journal, point(1), point(2))
    add(journal, point(3))
    (journal.folder / "part-000002.h5").write_bytes(b"damaged")
    assert finish_session(journal, tmp_path / "a.h5") == 1
    assert (journal.folder / "part-000002.h5").exists()
    assert "part-000002.h5 is damaged" in caplog.text


@pytest.mark.parametrize("error", [KeyboardInterrupt(), OSError(errno.ENOSPC, "full")])
def test_a_folder_with_a_blank_in_its_name_is_named_as_a_terminal_takes_it(tmp_path, monkeypatch, error):
    journal = SessionJournal(tmp_path / "of a run.running")
    journal.begin(configuration())
    add(journal, point(1))

    def fails(*_):
        raise error

    monkeypatch.setattr(keeping, "write_session", fails)
    said = kept(journal, tmp_path / "of a run.h5")
    command = said[said.index("viscorig recover") :]
    assert shlex.split(command) == ["viscorig", "recover", str(journal.folder)]


def test_what_is_complete_is_kept_and_can_be_carried_on(begin, tmp_path):
    journal, _ = begin()
    add(journal, HIT, HIT)
    add(journal, point(1), point(2), point(3))
    path = tmp_path / "a.h5"
    said = kept(journal, path, ("sweep", "my plate.toml"))
    again = f"viscorig sweep 'my plate.toml' --resume {journal.folder}"
    assert said == f"2 hits and 3 steps kept in {path}; to go on: {again}"
    assert path.is_file()
    assert len(journal.entries()) == 2


def test_a_run_in_which_nothing_was_measured_leaves_nothing(begin, tmp_path):
    journal, _ = begin()
    add(journal, Held())
    assert kept(journal, tmp_path / "a.h5") == "nothing was measured"
    assert list(tmp_path.iterdir()) == []


def test_where_the_session_cannot_be_written_the_folder_says_what_to_do(begin, tmp_path):
    journal, _ = begin()
    add(journal, point(1))
    said = kept(journal, tmp_path / "no folder" / "a.h5")
    assert said.startswith(f"what is complete is in {journal.folder}, as no session could be written of it (")
    assert "No such file or directory" in said
    assert said.endswith(f"): viscorig recover {journal.folder}")
    assert journal.entries()


def test_where_the_journal_cannot_be_read_the_folder_says_what_to_do_too(begin, tmp_path):
    journal, _ = begin()
    (journal.folder / JOURNAL).mkdir()
    said = kept(journal, tmp_path / "a.h5")
    assert said.startswith(f"what is complete is in {journal.folder}, as no session could be written of it (")
    assert said.endswith(f"Is a directory): viscorig recover {journal.folder}")


def test_every_part_of_a_run_is_a_table_of_its_experiment_and_an_order_is_for_all():
    parts = get_args(Part)
    assert set(parts) <= set(ExperimentDocument.model_fields)
    assert Order(Path("a.toml"), Path("out")).parts == parts


def test_where_the_disk_is_full_the_folder_goes_elsewhere_first(begin, tmp_path, monkeypatch):
    journal, _ = begin()
    add(journal, point(1, 20.0))
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=0))
    said = kept(journal, tmp_path / "a.h5")
    assert "(disk full" in said
    assert "make room, or copy that folder to another disk; then viscorig recover" in said


def test_a_new_folder_knows_the_name_of_its_experiment_s_file(begin):
    journal, _ = begin("a first try.toml")
    again = journal.configuration().resumed("run", "a.running")
    assert again == "viscorig run 'a first try.toml' --resume a.running"


def test_a_run_carried_on_on_a_full_disk_names_its_folder(begin, monkeypatch):
    journal, _ = begin()
    add(journal, point(1))
    journal.unlock()

    def full(self, *_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_text", full)
        with pytest.raises(BadInput) as refused:
            begin(resume=journal.folder)
    assert str(refused.value) == f"{journal.folder}: disk full"
    again, _ = begin(resume=journal.folder)
    assert [e.steps for e in again.entries()] == [(1,)]
