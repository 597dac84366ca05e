"""What a diagnosis advises first as the [sweep] of an experiment file, and what is said beside it."""

import tomllib

import pytest
from following_cases import BACKWARDS, CLAMPING, MASS, SPOT, STRUCK

from instrument.facts.follow_up import FollowUp
from instrument.files.new_file import write_new
from instrument.planning.into_experiment import begun, without_sweep
from instrument.planning.next_sweep import next_sweep_toml, write_next


def offer(of, **changes):
    return FollowUp.model_validate({**of, **changes})


@pytest.fixture
def path(tmp_path):
    write_new("experiment", tmp_path / "experiment.toml")
    return tmp_path / "experiment.toml"


def written(path, *offers):
    return write_next(path, begun(path, path.with_name("specimen.toml")), offers)


def test_steps_stay_in_their_order_and_a_region_taken_up_again_is_another_segment():
    there_and_back = offer(BACKWARDS, frequencies_hz=[96.5, 186.0, 187.5, 104.0], segments=[1, 2, 2, 1])
    assert tomllib.loads(next_sweep_toml(there_and_back))["sweep"] == {
        "level_g": 1.0,
        "segments": [{"frequencies_hz": f} for f in ([96.5], [186.0, 187.5], [104.0])],
    }


@pytest.mark.parametrize(
    ("of", "said"),
    [
        (SPOT, "; its specimen file has to say [pickup] x_mm = 250, y_mm = 100"),
        (MASS, "; its specimen file has to say [[mass]] mass_kg = 0.005, x_mm = 280, y_mm = 100"),
        (CLAMPING, ""),
    ],
)
def test_the_first_takes_the_place_of_the_sweep_and_what_else_it_needs_is_said(path, of, said):
    before = path.read_text()
    assert written(path, offer(of), offer(STRUCK)).endswith(f"[sweep] of {path}{said}")
    after = path.read_text()
    assert without_sweep(after).rstrip() == without_sweep(before).rstrip()
    assert tomllib.loads(after)["sweep"]["segments"] == [{"frequencies_hz": of["frequencies_hz"]}]


@pytest.mark.parametrize(
    ("offers", "why"),
    [((), "nothing is ranked"), ((STRUCK, SPOT), "what comes first is no sweep. Do it.")],
)
def test_a_file_stays_as_it_is_where_no_sweep_comes_first(path, offers, why):
    before = path.read_text()
    assert why in written(path, *map(offer, offers))
    assert path.read_text() == before
