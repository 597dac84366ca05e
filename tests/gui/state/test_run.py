"""What a run is said to do."""

import pytest
from diagnosis_cases import diagnosis
from session_cases import configuration as configuration_of

from gui.state import SessionState
from gui.state.run import Run
from instrument.files.experiment_file import read_experiment
from instrument.simulated_case import case_file
from instrument.stream.derived import DiagnosisFound
from instrument.stream.raw import OperatorDid, SessionEnded


@pytest.fixture
def configuration():
    return configuration_of()


def test_a_run_that_only_a_person_carries_on_says_so_until_it_is_done():
    run = Run(read_experiment(case_file("experiment.toml")), state="preparing")
    assert run.word == "preparing"
    run.question = "Mount the damped plate"
    assert run.word == "waiting for you"
    run.take(OperatorDid("mounted", "damped"))
    assert run.word == "preparing"
    run.state, run.question = "sweep", "Use these hits"
    assert run.word == "sweep"


def test_a_run_on_its_way_is_not_idle_before_its_stream_says_anything(configuration):
    state = SessionState(configuration)
    state.begin()
    assert (state.run.word, state.run.next_words) == ("preparing", "starting")
    state.work("", None)
    assert (state.run.word, state.run.next_words) == ("preparing", "what comes next is made ready")


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (None, "what was found stands on Hammer"),
        (diagnosis(), "effect: added_mass"),
        (diagnosis(verdict="unknown"), "verdict unknown: no law here is to be relied on; Diagnosis says"),
    ],
)
def test_what_is_done_says_what_was_found(configuration, found, said):
    run = Run(configuration.experiment)
    if found is not None:
        run.take(DiagnosisFound(1, 1, found))
    run.take(SessionEnded("done", ""))
    assert run.next_words.startswith(said)
