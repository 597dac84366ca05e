"""Files that another program writes while their forms are open: nothing begins that the forms do not show."""

import os
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtWidgets import QMessageBox

from gui.actions.controller import AppController
from gui.form.drafts import Drafts
from gui.pages.run import RunPage
from gui.pages.run.check import Check
from gui.pages.run.disk_watch import DiskWatch
from instrument.simulated_case import write_case


@pytest.fixture
def page(qtbot, made, monkeypatch, tmp_path):
    """With the simulated case in it; its dry runs and orders are noted and not made, and nothing watches."""
    checked = []
    monkeypatch.setattr(Check, "start", lambda check, path: checked.append(path))
    monkeypatch.setattr(DiskWatch, "follow", lambda watch, files: None)
    page = made(RunPage(AppController()))
    page.controller.setParent(page)
    page.dry_runs, page.orders, page.refused = checked, [], []
    monkeypatch.setattr(page.controller, "start", page.orders.append)
    page.controller.refused.connect(page.refused.append)
    path = write_case(tmp_path)
    page.controller.open(path)
    qtbot.waitUntil(lambda: page.files.path == path)
    return page


def written(path: Path, before: str, after: str) -> None:
    """By another program, a moment later."""
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after, 1))
    later_ns = path.stat().st_mtime_ns + 1_000_000
    os.utime(path, ns=(later_ns, later_ns))


def read_again(qtbot, page):
    drafts = page.files.drafts
    page.files.read_again.click()
    qtbot.waitUntil(lambda: page.files.drafts is not drafts)


def answer(page, word):
    box = page.files.findChildren(QMessageBox)[-1]
    next(button for button in box.buttons() if button.text() == word).click()


def level(page):
    return page.files.forms["experiment"].editor("sweep", "level_g").text()


@pytest.mark.parametrize("name", ["experiment.toml", "rig.toml", "specimen.toml"])
def test_nothing_begins_with_a_file_that_is_not_as_its_form_shows_it(page, tmp_path, name):
    written(tmp_path / name, "\n", "\n# another line\n")
    page.starting.start_wanted.emit()
    page.starting.check_wanted.emit()
    assert page.orders == page.dry_runs == []
    assert page.refused == [f"nothing is begun: {page.files.outdated_said}"] * 2
    assert page.files.outdated_said.startswith(f"{name}: changed by another program")
    assert not page.files.read_again.isHidden()


def test_a_file_that_is_gone_begins_nothing(page, tmp_path):
    (tmp_path / "rig.toml").unlink()
    page.starting.start_wanted.emit()
    assert page.orders == []
    assert "rig.toml" in page.refused[0]


def test_read_again_form_drawing_and_dry_run_are_as_the_files(qtbot, page, tmp_path):
    page.starting.check_wanted.emit()
    page.check.passed.emit(
        SimpleNamespace(seconds=1.0, hammer_record_s=None, modes_hz=[], segments=[], warnings=[])
    )
    before = level(page)
    written(tmp_path / "experiment.toml", f"level_g = {before}", "level_g = 3.0")
    written(tmp_path / "specimen.toml", "length_mm = 300", "length_mm = 290")
    page.starting.out.setText(str(tmp_path / "elsewhere"))
    page.starting.start_wanted.emit()
    assert "Nothing is wrong" not in page.checked.summary.text()
    said = []
    page.controller.said.connect(said.append)
    read_again(qtbot, page)
    assert said == [f"read {page.files.path}"]
    assert level(page) == "3.0" != before
    assert page.plate.size_mm[0] == pytest.approx(290.2)
    assert page.files.outdated_said == ""
    assert page.files.read_again.isHidden()
    assert len(page.dry_runs) == 2
    # Where the session goes was not asked for anew.
    assert page.starting.folder == tmp_path / "elsewhere"
    page.starting.start_wanted.emit()
    assert len(page.orders) == 1


def test_of_changes_here_and_there_a_person_chooses(qtbot, page, tmp_path):
    page.files.forms["experiment"].type_into(("title",), "typed here")
    written(tmp_path / "experiment.toml", "level_g = ", "level_g = 1")
    page.starting.start_wanted.emit()
    assert page.orders == []
    there = (tmp_path / "experiment.toml").read_text()
    page.files.read_again.click()
    answer(page, "Save")
    qtbot.waitUntil(lambda: len(page.refused) == 2)
    assert "was changed by another program since it was read" in page.refused[1]
    assert (tmp_path / "experiment.toml").read_text() == there
    page.files.read_again.click()
    drafts = page.files.drafts
    answer(page, "Discard")
    qtbot.waitUntil(lambda: page.files.drafts is not drafts)
    assert not page.files.changed
    assert page.files.outdated_said == ""


def test_what_is_saved_here_is_no_news(qtbot, page):
    page.files.forms["experiment"].type_into(("title",), "typed here")
    page.starting.start_wanted.emit()
    qtbot.waitUntil(lambda: len(page.orders) == 1)
    assert page.refused == []
    page.starting.start_wanted.emit()
    assert len(page.orders) == 2


def test_a_table_that_the_specimen_names_counts_too(tmp_path):
    path = write_case(tmp_path)
    specimen = tmp_path / "specimen.toml"
    text = specimen.read_text()
    head, _, rest = text.partition("[core.law]")
    kept = rest.partition("\n[")[2]
    specimen.write_text(f'{head}[core.law]\nkind = "table"\npath = "law.csv"\n\n[{kept}')
    table = tmp_path / "law.csv"
    table.write_text("frequency_hz,storage_mpa,loss_factor\n10,1,0.5\n1000,2,0.5\n")
    drafts = Drafts.of(path)
    assert drafts.changed_elsewhere == []
    written(table, "10,1", "10,3")
    assert drafts.changed_elsewhere == [table]


def test_a_rig_that_was_missing_and_is_there_now_is_news(tmp_path):
    path = write_case(tmp_path)
    rig = tmp_path / "rig.toml"
    text = rig.read_text()
    rig.unlink()
    drafts = Drafts.of(path)
    assert drafts.rig is None
    assert drafts.changed_elsewhere == []
    rig.write_text(text)
    assert drafts.changed_elsewhere == [rig]


@pytest.mark.parametrize("how", ["in place", "by a new file in its place"])
def test_a_file_written_is_noticed_while_nobody_asks(qtbot, made, tmp_path, how):
    page = made(RunPage(AppController()))
    page.controller.setParent(page)
    path = write_case(tmp_path)
    page.controller.open(path)
    qtbot.waitUntil(lambda: page.files.path == path)
    for turn in range(2):
        if how == "in place":
            written(path, "\n", f"\n# {turn}\n")
        else:
            new = tmp_path / "experiment.toml~"
            new.write_text(f"# {turn}\n" + path.read_text())
            new.replace(path)
        qtbot.waitUntil(lambda: bool(page.files.outdated_said))
        read_again(qtbot, page)
        assert page.files.outdated_said == ""
