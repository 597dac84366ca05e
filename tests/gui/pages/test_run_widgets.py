"""The widgets of the run's page, each alone."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.form.form import Form
from gui.form.labels import LABELS
from gui.pages.run.banner import Banner
from gui.pages.run.files_panel import FilesPanel
from gui.pages.run.now import ending_words, go_on_words, path_words
from gui.pages.run.start_panel import StartPanel
from instrument.engine.messages import Ended
from instrument.files.experiment_file import ExperimentDocument
from instrument.simulated_case import case_file


def test_a_question_has_the_button_that_answers_it(made):
    banner, heard = made(Banner()), []
    banner.answered.connect(lambda: heard.append("answered"))
    banner.declined.connect(lambda: heard.append("declined"))
    banner.ask("Measure it there?", "follow-up")
    assert banner.button.text() == "Measure it"
    banner.button.click()
    banner.other.click()
    assert heard == ["answered", "declined"]
    banner.ask("Mount the plate", "mount")
    assert banner.other.isHidden()
    banner.ask("Strike the plate")
    assert banner.button.isHidden()
    banner.ask("")
    assert banner.isHidden()


def test_a_run_that_was_broken_off_says_where_it_goes_on():
    ended = Ended("stopped", session=Path("out/one.h5"), folder=Path("out/one.running"))
    assert ending_words(ended).splitlines() == [
        f"Session: {Path('out/one.h5')}",
        "Broken off: to go on, choose one.running beside Begin.",
    ]
    assert ending_words(Ended("done")) == "There is no session."
    assert ending_words(None) == ""


def test_a_recording_of_a_run_that_was_stopped_says_how_it_goes_on_and_whether_it_can(tmp_path):
    session = tmp_path / "one.h5"
    assert "cannot be carried on: one.running is not beside it" in go_on_words(session)
    assert "diagnosed on Diagnosis" in go_on_words(session)
    (tmp_path / "one.running").mkdir()
    said = go_on_words(session)
    assert f"to {tmp_path}, choose one.running beside Begin" in said


@pytest.mark.parametrize(
    ("stop_path", "said"),
    [
        (None, "no rig is open yet"),
        (SimpleNamespace(ready=True, message=""), "ready"),
        (SimpleNamespace(ready=False, message="the shaker takes one connection"), "one connection."),
    ],
)
def test_the_way_to_the_shaker_is_said_with_what_was_not_shown(stop_path, said):
    live = SimpleNamespace(ending=None, stop_path=stop_path, blocks_dropped=3, recording=None)
    assert said in path_words(live)
    assert path_words(live).endswith("3 blocks not shown; the session has them.")


def test_of_a_run_that_died_it_is_said_what_it_left_and_nothing_is_recorded_any_more():
    ended = Ended("died", folder=Path("out/one.running"))
    recording = SimpleNamespace(folder=Path("out/one.running"))
    live = SimpleNamespace(ending=ended, stop_path=None, blocks_dropped=0, recording=recording)
    assert path_words(live).splitlines() == [
        "There is no session.",
        "Broken off: to go on, choose one.running beside Begin.",
    ]


def test_a_broken_off_run_chosen_is_the_one_that_is_ordered(made, tmp_path):
    panel = made(StartPanel())
    assert not panel.start.isEnabled()
    panel.propose(tmp_path)
    panel.show_broken_off([tmp_path / "a.running"])
    assert panel.order(tmp_path / "e.toml").resume is None
    panel.resume.setCurrentIndex(1)
    order = panel.order(tmp_path / "e.toml")
    assert (order.resume, order.out) == (tmp_path / "a.running", tmp_path)


def test_while_a_run_goes_on_its_files_stay_as_they_are(made):
    files = made(FilesPanel())
    assert not files.changed
    files.drafts = Drafts(Draft.of(case_file("experiment.toml"), ExperimentDocument), None, None)
    files._show()
    assert list(files.forms) == ["experiment"]
    files.lock(True)
    assert not files.tabs.isEnabled()
    assert not files.save_as_button.isEnabled()
    files.lock(False)
    assert files.save_as_button.isEnabled()


def test_what_is_wrong_stands_beside_its_field_under_a_name_people_know(made):
    form, edited = made(Form(Draft.of(case_file("experiment.toml"), ExperimentDocument))), []
    form.edited.connect(lambda: edited.append(1))
    assert form.said == []
    assert form.item("sweep", "sweeps").text(0) == LABELS["sweeps"]
    form.type_into(("sweep", "sweeps"), "many")
    assert (len(form.said), edited) == (1, [1])
    form.type_into(("sweep", "sweeps"), "2")
    assert form.said == []
