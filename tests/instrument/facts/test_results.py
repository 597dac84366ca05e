"""Results read back from JSON: what is null, what is missing, what is wrong."""

import json
from math import inf, isnan, nan
from typing import get_args

import pytest
from diagnosis_cases import diagnosis
from pydantic import ValidationError
from result_cases import LAW_ROW, identification

from fitting.diagnosis.verdict.result import Verdict
from instrument.facts.damping import DampingResult, ModeFound
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.diagnosis import Verdict as VerdictOfResult
from instrument.facts.identification import IdentificationResult


def test_nan_is_null_in_json_and_nan_again():
    errors = {"g0_pa": nan, "alpha": 0.1}
    found = identification(standard_errors=errors)
    assert found.as_json()["standard_errors"] == {"g0_pa": None, "alpha": 0.1}
    again = IdentificationResult.model_validate(json.loads(json.dumps(found.as_json(), allow_nan=False)))
    assert isnan(again.standard_errors["g0_pa"])


def test_what_is_infinite_is_not_a_number():
    mode = ModeFound(frequency_hz=17.7, bandwidths_to_next=inf)
    assert isnan(mode.bandwidths_to_next)
    assert mode.as_json() == {"frequency_hz": 17.7, "bandwidths_to_next": None}


@pytest.mark.parametrize("value", [None, nan, inf])
def test_what_was_not_asked_for_is_none(value):
    assert identification(chi2_per_dof=value).chi2_per_dof is None
    assert identification(chi2_per_dof=value).as_json()["chi2_per_dof"] is None


def test_a_file_of_an_older_version_comes_out_as_it_went_in():
    old = {key: value for key, value in diagnosis().as_json().items() if key not in ("by_hand", "adjusted")}
    found = DiagnosisResult.model_validate(old)
    assert found.by_hand is False
    assert found.adjusted == ()
    assert found.as_json() == old


def test_what_a_later_version_adds_is_dropped():
    later = {**identification().as_json(), "mood": "good"}
    assert IdentificationResult.model_validate(later) == identification()


@pytest.mark.parametrize(
    ("key", "value", "place"),
    [
        ("verdict", "perhaps", "verdict"),
        ("before", None, "before"),
        ("candidates", [{"name": "none"}], "candidates.0.delta_bic"),
        ("points", "many", "points"),
    ],
)
def test_what_is_no_diagnosis_is_refused_with_its_place(key, value, place):
    with pytest.raises(ValidationError) as refused:
        DiagnosisResult.model_validate({**diagnosis().as_json(), key: value})
    assert place in {".".join(map(str, fault["loc"])) for fault in refused.value.errors()}


def test_a_result_cannot_be_changed():
    with pytest.raises(ValidationError, match="frozen"):
        identification().rms_percent = 0.0


def test_another_one_can_be_made_of_it():
    found = identification(warnings=["one"])
    assert found.but(warnings=(*found.warnings, "two")).warnings == ("one", "two")
    assert found.warnings == ("one",)
    with pytest.raises(ValidationError):
        found.but(law="none")


def test_a_result_of_a_run_does_not_say_how_long_it_took():
    timed = identification(seconds=1.0, setup_seconds=2.0, validation_seconds=3.0)
    assert timed.untimed == identification()
    assert not [key for key in diagnosis().untimed.as_json() if key.endswith("seconds")]


def test_parts_without_phase_are_not_told():
    assert "re_percent" not in diagnosis(phase=False).points[0].before.as_json()
    assert not diagnosis(phase=False).points[0].before.has_phase
    assert diagnosis().points[0].before.has_phase


def test_what_is_called_with_in_json_comes_back():
    table = {"source": "dma.csv", "kind": "shear", "poisson": None, "rows": 3, "rows_in_band": 0}
    found = identification(**{"with": {**table, "temperatures": []}})
    assert found.beside.rows == 3
    assert found.but(warnings=("one",)).as_json()["with"] == {**table, "temperatures": []}
    assert IdentificationResult.model_validate(found.as_json()) == found


def test_a_hammer_test_may_be_written_by_hand():
    found = DampingResult.model_validate({"modes": [{"frequency_hz": 17.7, "damping_ratio": 0.003}]})
    assert [mode.frequency_hz for mode in found.accepted] == [17.7]
    assert found.modes[0].by("lscf") is None


def test_a_law_row_needs_all_its_numbers():
    with pytest.raises(ValidationError, match="loss_factor"):
        identification(law=[{key: LAW_ROW[key] for key in LAW_ROW if key != "loss_factor"}])


def test_the_verdicts_in_results_are_those_that_a_diagnosis_reaches():
    assert get_args(VerdictOfResult) == get_args(Verdict)
