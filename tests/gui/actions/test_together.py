"""Several files in the background: by the commands, with their numbers."""

import json

import pytest
from pair_files import two_masses, write_pair
from rivals import all_but

from gui.actions.rediagnosis import DiagnosisAsked, Rediagnosis, ShownDiagnosis
from gui.actions.together import Together
from instrument.cli.main import run
from instrument.facts.identification import IdentificationResult
from instrument.facts.modal import ModalResult


@pytest.fixture(scope="module")
def masses(tmp_path_factory):
    return two_masses(tmp_path_factory.mktemp("masses"))


@pytest.fixture
def rediagnosis(qapp):
    rediagnosis = Rediagnosis()
    yield rediagnosis
    rediagnosis.close()


@pytest.fixture
def together(rediagnosis):
    """With few rivals: the whole catalogue takes seconds."""
    together = Together(rediagnosis, decline=tuple(sorted(all_but("added_mass", "gain_error"))))
    yield together
    together.close()


def identified(qtbot, together, files):
    together.add(files)
    together.identify()
    qtbot.waitUntil(lambda: together.identified is not None and not together.running)
    return together


def test_one_law_is_the_command_line_s(qtbot, together, masses, tmp_path):
    found = identified(qtbot, together, masses).identified
    specimens = [word for path in masses for word in ("--specimen", str(path.with_suffix(".toml")))]
    to = tmp_path / "identified.json"
    run(["identify", *map(str, masses), *specimens, "--json", str(to)])
    said = IdentificationResult.model_validate(json.loads(to.read_text()))
    assert found.untimed == said.untimed
    assert found.files == ("light.csv", "heavy.csv")
    assert together.leads


def test_a_table_of_modes_is_shown_as_one(qtbot, together, tmp_path):
    table = tmp_path / "modes.csv"
    table.write_text(
        "# read: model\nmode,frequency_hz,loss_factor\n1,74.3,0.221\n2,365.6,0.2228\n3,921.9,0.1788\n"
        "4,1669.7,0.1266\n"
    )
    run(["new", "beam", str(table.with_suffix(".toml"))])
    found = identified(qtbot, together, [table]).identified
    assert isinstance(found, ModalResult)
    assert [m.mode for m in found.modes] == [1, 2, 3, 4]


def test_a_diagnosis_alone_asks_for_the_law_first(qtbot, together, masses):
    told = []
    together.progressed.connect(lambda what, fraction: told.append((what, fraction)))
    together.add(masses)
    together.diagnose()
    assert together.work == "identifying"
    qtbot.waitUntil(lambda: together.diagnosed is not None and not together.running)
    assert together.identified is not None
    assert together.work == ""
    assert "tracing the residual" in {what for what, _ in told}
    assert all(0 <= fraction <= 1 for _, fraction in told)
    assert together.diagnosed.found.files == ("light.csv", "heavy.csv")
    assert {p.file for p in together.diagnosed.found.points} == {1, 2}
    assert together.diagnosed.origin.startswith("2 files")


def test_another_hammer_test_is_other_data(qtbot, together, masses, tmp_path):
    """What was found without it is not kept; both commands are told of it, and refuse it in a line."""
    identified(qtbot, together, masses)
    hammer = tmp_path / "hits.json"
    hammer.write_text('{"modes": [{"frequency_hz": 18.0, "damping_ratio": 0.003}]}')
    together.strike(hammer)
    assert together.identified is None
    assert "--hammer " + str(hammer) in " ".join(together.asked.arguments)
    with qtbot.waitSignal(together.failed) as told:
        together.identify()
    assert told.args == ["a hammer test with a shear-pair: expected a plate"]
    together.strike(None)
    assert "--hammer" not in together.asked.arguments


def test_what_is_cancelled_leaves_what_is_there(qtbot, together, masses):
    found = identified(qtbot, together, masses).identified
    together.identify()
    assert together.running
    together.cancel()
    assert not together.running
    assert together.identified is found


def test_other_files_have_no_result_yet(qtbot, together, masses):
    identified(qtbot, together, masses).remove(0)
    assert together.identified is None
    assert not together.leads


def test_a_damaged_file_is_said_in_a_line(qtbot, together, masses, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("frequency_hz,velocity_m_s\n10,x\n")
    together.add([*masses, bad])
    with qtbot.waitSignal(together.failed) as told:
        together.identify()
    assert told.args[0].startswith(f"{bad}")
    assert "\n" not in told.args[0]
    assert not together.running
    assert together.failure == told.args[0]
    # Without that file it is the reason of nothing.
    together.remove(len(masses))
    assert together.failure == ""


def test_what_is_paired_wrongly_is_refused_as_the_command_does(qtbot, together, masses, tmp_path):
    wrong = tmp_path / "experiment.toml"
    wrong.write_text("[something]\nelse = 1\n")
    together.add(masses)
    together.pair(1, wrong)
    with qtbot.waitSignal(together.failed) as told:
        together.identify()
    assert str(wrong) in told.args[0]
    assert "\n" not in told.args[0]


def test_nothing_begins_without_a_specimen(together, tmp_path):
    data = [write_pair(tmp_path, name, 0.5) for name in ("a", "b")]
    for path in data:
        path.with_suffix(".toml").unlink()
    together.add(data)
    together.identify()
    together.diagnose()
    assert not together.running


def test_a_specimen_chosen_is_remembered_for_its_data(qtbot, together, masses, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text(masses[0].with_suffix(".toml").read_text())
    together.add(masses)
    with qtbot.waitSignal(together.specimen_chosen) as told:
        together.pair(0, other)
    assert told.args == [masses[0].resolve(), other.resolve()]
    together.remove(0)
    together.add([masses[0]])
    assert together.files[1].specimen == other.resolve()


def test_files_are_put_in_another_order(together, masses):
    together.add(masses)
    together.move(1, -1)
    assert [one.data for one in together.files] == masses[::-1]
    together.move(0, -1)
    assert [one.data for one in together.files] == masses[::-1]


def test_another_diagnosis_shown_takes_the_lead_and_it_can_be_had_back(qtbot, together, rediagnosis, masses):
    identified(qtbot, together, masses)
    together.diagnose()
    qtbot.waitUntil(lambda: together.diagnosed is not None and not together.running)
    own = together.diagnosed
    other = ShownDiagnosis(own.found, "of other data", DiagnosisAsked(masses[0]))
    rediagnosis.show(other)
    assert (together.leads, together.diagnosed, together.shown) == (False, own, None)
    together.lead()
    assert together.leads
    assert rediagnosis.found is own
    rediagnosis.forget()
    assert not together.leads


def test_another_session_ends_a_diagnosis_under_way_and_says_so(qtbot, together, masses):
    identified(qtbot, together, masses)
    together.diagnose()
    assert together.running
    with qtbot.waitSignal(together.failed) as told:
        together.let_go()
    assert "another session is shown" in told.args[0]
    assert not together.running
    assert together.identified is not None
