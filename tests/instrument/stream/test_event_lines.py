"""Events as lines: what a session of any version holds, and what is refused."""

import json
import lzma

import h5py
import pytest
from diagnosis_cases import diagnosis
from kept_numbers import KEPT
from result_cases import identification

from instrument.stream.derived import DampingFound, DiagnosisFound, FitUpdated, PointMeasured
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import BlockAcquired, StepBegan

SINCE = {"pickup": 0, "spot_mm": None, "mass_kg": 0.0, "mass_at_mm": None, "mounting": 0}
STEP = StepBegan(1, "step", 1, 1, 100.0, None, 0.5, 8.0)


@pytest.fixture(scope="module")
def lines(tmp_path_factory):
    """Of a session that an earlier version recorded."""
    path = tmp_path_factory.mktemp("session") / "small.h5"
    path.write_bytes(lzma.decompress((KEPT / "small.h5.xz").read_bytes()))
    with h5py.File(path) as file:
        return [line.decode() for part in file["parts"].values() for line in part["events"][()]]


def test_a_recorded_line_comes_out_as_it_went_in(lines):
    assert {type(from_line(line)) for line in lines} >= {
        *(BlockAcquired, PointMeasured, DampingFound, FitUpdated, DiagnosisFound)
    }
    for line in lines:
        before, now = json.loads(line), json.loads(to_line(from_line(line)))
        assert {key: now.get(key) for key in before} == before
        # What later versions say beside it was so then: the first spot and clamping, no known mass.
        assert {key: now[key] for key in now.keys() - before.keys()} in ({}, SINCE)


@pytest.mark.parametrize(
    "event",
    [FitUpdated(1, 7, identification()), DiagnosisFound(1, 7, diagnosis()), FitUpdated(1, 7, None, "why")],
    ids=["a fit", "a diagnosis", "no fit"],
)
def test_a_result_is_in_the_line_as_its_command_would_write_it(event):
    told = json.loads(to_line(event))
    assert told["facts_json"] == (event.result.as_json() if event.result is not None else {})
    assert to_line(from_line(to_line(event))) == to_line(event)


def test_what_a_later_version_adds_to_an_event_is_dropped():
    assert from_line(to_line(STEP)[:-1] + ', "mood": "good"}') == STEP


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"step": 1', '"step": "one"'),
        ('"step": 1', '"step": 1.5'),
        ('"step": 1, ', ""),
        ('"frequency_hz": 100.0', '"frequency_hz": null'),
        ('"purpose": "step"', '"purpose": "dance"'),
        ("}", ""),
        ("StepBegan", "Step"),
        ('{"event"', '["event"'),
    ],
)
def test_a_damaged_line_is_refused(old, new):
    line = to_line(STEP)
    assert old in line
    with pytest.raises(ValueError, match=r"."):
        from_line(line.replace(old, new, 1))


@pytest.mark.parametrize("facts", ['{"points": 1}', "[]", "5", '{"law": [{}]}'])
def test_a_line_whose_result_is_damaged_is_refused(facts):
    line = to_line(FitUpdated(1, 7, None, "why")).replace("{}", facts)
    with pytest.raises(ValueError, match="FitUpdated"):
        from_line(line)


def test_a_line_nested_without_end_is_refused():
    with pytest.raises(ValueError, match=r"."):
        from_line('{"event": "StepBegan", "step": ' + "[" * 100_000)
