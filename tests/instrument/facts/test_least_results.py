"""The least that a file of each result holds: files of older versions say no more, and are read for good.

A key that is made necessary later makes all of them unreadable; one that is no longer necessary lets a result
through that says nothing.
"""

import json
from math import inf, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError
from result_cases import LAW_ROW

from instrument.facts.batch import BatchFailure, BatchResult, BatchSpread
from instrument.facts.bench import BenchResult, BenchRow
from instrument.facts.check import CheckResult, SegmentForecast, SoakForecast, ToleranceUsed
from instrument.facts.comparison import ComparedPair, CompareResult, SpreadAt
from instrument.facts.modes import ComplexModeRow, ModesResult
from instrument.facts.number import MaybeNumber, Number
from instrument.facts.pointwise import BandFound, CausalityTest
from instrument.facts.run import ReplayResult, RunResult
from instrument.facts.session_result import SessionResult
from instrument.facts.shifted import ShiftAt, ShiftedResult
from instrument.facts.written import ExportResult, ImportResult, NewResult, RecoverResult, ReportResult

SIZE = {"percent": 2.0, "interval_95_percent": [1.0, 4.0]}
SPREAD_AT = {
    "frequency_hz": 100.0,
    "storage_modulus_pa": 4e5,
    "storage_modulus_standard_error_pa": 1e3,
    "storage_modulus_spread": SIZE,
    "loss_factor": 0.9,
    "loss_factor_standard_error": 0.01,
    "loss_factor_spread": SIZE,
}
SEGMENT = {
    "segment": 1,
    "low_hz": 10.0,
    "high_hz": 20.0,
    "steps": 5,
    "range_name": "50 mm/s",
    "velocity_m_s": 0.04,
    "travel_m": 1e-3,
    "seconds": 12.0,
}
SHIFT_AT = {
    "name": "a.csv",
    "temperature_c": 5.0,
    "log10_shift": 0.6,
    "log10_shift_standard_error": 0.01,
    "vertical": 1.0,
    "vertical_standard_error": 0.0,
}
PAIR = {
    "a": "a.json",
    "b": "b.json",
    "verdicts": ["none", "effect"],
    "band_hz": [10.0, 300.0],
    "chi2": 3.0,
    "degrees_of_freedom": 2.0,
    "p_value": 0.2,
    "differs": False,
    "covariance": "posterior",
    "storage_modulus_differs_hz": [],
    "loss_factor_differs_hz": [[10.0, 12.0]],
    "frequencies": [],
}
LEAST = {
    BatchFailure: {"data": "a.csv", "reason": "no points"},
    BatchSpread: {"temperature_c": 23.0, "rows": 3, "frequencies": [SPREAD_AT]},
    BatchResult: {
        "rows": 2,
        "done": 1,
        "failed": 1,
        "verdicts": {"none": 1},
        "effects": {},
        "borrowed_models": 0,
        "failures": [{"data": "a.csv", "reason": "no points"}],
        "known_before": 0,
        "files": ["batch.csv"],
    },
    BenchRow: {"name": "full", "seconds": 1.0},
    BenchResult: {"rows": [{"name": "full", "seconds": 1.0}]},
    SegmentForecast: SEGMENT,
    ToleranceUsed: {"name": "gain", "value": 0.02, "source": "typical"},
    SoakForecast: {"set_point_c": 23.0, "within_c": 0.5, "soak_s": 600.0, "most_s": 7200.0},
    CheckResult: {"segments": [SEGMENT], "modes_hz": [17.7], "seconds": 60.0},
    ComparedPair: PAIR,
    CompareResult: {"pairs": [PAIR]},
    SpreadAt: SPREAD_AT,
    ModesResult: {"modes": [{"frequency_hz": 17.7, "loss_factor": 0.1}]},
    BandFound: {"frequency_hz": 17.7, "points": 3, "determined": False},
    CausalityTest: {"consistent": True, "bands": 9, "words": "causal"},
    RunResult: {"session": "a.h5", "points": 240},
    ReplayResult: {"equal_to_recorded": True, "derived_events": 500},
    SessionResult: {"words": "no law", "standing": "no law"},
    ShiftAt: SHIFT_AT,
    ShiftedResult: {
        "shift": "wlf",
        "reference_c": 20.0,
        "shift_parameters": {"c1": 4.0},
        "shift_standard_errors": {"c1": 0.1},
        "temperatures": [SHIFT_AT],
        "law_kind": "constant",
        "parameters": {"g_pa": 4e5},
        "standard_errors": {"g_pa": 1e3},
        "law": [LAW_ROW],
        "simple": None,
        "p_value": None,
        "chi2": 3.0,
        "chi2_each_alone": 2.0,
        "wicket_percent": 1.0,
        "words": "cannot be told",
        "warnings": [],
        "seconds": 2.0,
    },
    ExportResult: {"files": ["a.csv"]},
    ImportResult: {"files": ["a.csv"]},
    NewResult: {"kind": "beam", "path": "beam.toml"},
    ReportResult: {"report": "a.html"},
    RecoverResult: {"session": "a.h5", "parts": 3, "hits": 5, "steps": [1, 2]},
}


@pytest.mark.parametrize("of", LEAST, ids=lambda of: of.__name__)
def test_the_least_that_a_file_holds_comes_out_as_it_went_in(of):
    assert of.model_validate(LEAST[of]).as_json() == LEAST[of]


@pytest.mark.parametrize("of", LEAST, ids=lambda of: of.__name__)
def test_nothing_of_the_least_may_be_missing(of):
    for key in LEAST[of]:
        with pytest.raises(ValidationError) as refused:
            of.model_validate({k: v for k, v in LEAST[of].items() if k != key})
        assert [fault["loc"] for fault in refused.value.errors()] == [(key,)]


WRONG = [
    (BatchResult, "rows", "many"),
    (BatchSpread, "frequencies", [{**SPREAD_AT, "loss_factor_spread": {"percent": 2.0}}]),
    (ToleranceUsed, "source", "guessed"),
    (ComparedPair, "verdicts", ["none"]),
    (ComparedPair, "loss_factor_differs_hz", [[10.0]]),
    (ModesResult, "modes", [{"frequency_hz": 17.7}]),
    (SessionResult, "standing", "signed"),
    (SessionResult, "verdict", "perhaps"),
    (ShiftedResult, "shift", "vft"),
    (RecoverResult, "steps", ["first"]),
]


@pytest.mark.parametrize(("of", "key", "value"), WRONG)
def test_what_is_no_such_result_is_refused_with_its_place(of, key, value):
    with pytest.raises(ValidationError) as refused:
        of.model_validate({**LEAST[of], key: value})
    assert {fault["loc"][0] for fault in refused.value.errors()} == {key}


def test_what_older_versions_did_not_say_is_said_as_it_was_then():
    pair, band = (of.model_validate(LEAST[of]) for of in (ComparedPair, BandFound))
    assert pair.temperatures_c == (None, None)
    assert pair.repeatability_percent == 0.0
    assert isnan(band.storage_modulus_pa)
    assert isnan(band.loss_factor_standard_error)
    check = CheckResult.model_validate(LEAST[CheckResult])
    assert (check.hammer_record_s, check.temperature, check.exact, check.tolerances) == (
        None,
        None,
        False,
        (),
    )
    assert RunResult.model_validate(LEAST[RunResult]).followed == ()
    assert BatchResult.model_validate(LEAST[BatchResult]).spread == ()


@pytest.mark.parametrize(
    ("more", "complete"),
    [
        ({"points": 5, "points_measured": 9}, False),
        ({"points": 9, "points_measured": 9}, True),
        # A diagnosis sets points aside, and has looked at all of them.
        ({"points": 5, "points_measured": 9, "verdict": "none"}, True),
        ({"points": 0, "points_measured": 0, "verdict": "none"}, False),
    ],
)
def test_a_law_is_one_of_every_point_or_of_a_diagnosis(more, complete):
    assert SessionResult(words="", standing="diagnosed", **more).is_complete is complete


NUMBER, MAYBE = TypeAdapter(Number), TypeAdapter(MaybeNumber)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_comes_back_from_json_to_the_bit(value):
    for kind in (NUMBER, MAYBE):
        text = json.dumps(kind.dump_python(kind.validate_python(value), mode="json"), allow_nan=False)
        assert kind.validate_python(json.loads(text)) == value


@pytest.mark.parametrize("value", [None, nan, inf, -inf])
def test_what_is_no_number_is_null_in_json(value):
    assert isnan(NUMBER.validate_python(value))
    assert NUMBER.dump_python(NUMBER.validate_python(value), mode="json") is None
    assert MAYBE.validate_python(value) is None


def test_a_mode_without_losses_or_a_time_that_was_not_taken_is_null():
    row = ComplexModeRow(frequency_hz=17.7, loss_factor=nan)
    assert row.as_json() == {"frequency_hz": 17.7, "loss_factor": None}
    bench = BenchRow(name="full", seconds=1.0, ratio=nan, to="direct")
    assert bench.as_json() == {"name": "full", "seconds": 1.0, "ratio": None, "to": "direct"}
