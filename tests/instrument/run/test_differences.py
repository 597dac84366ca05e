"""What a replay says of a derived event that is another one than recorded."""

import json
from dataclasses import dataclass, replace

from diagnosis_cases import diagnosis
from result_cases import identification

from instrument.facts.diagnosis import STAGES
from instrument.run.differences import as_known_then, first_difference, said_otherwise
from instrument.stream.derived import DiagnosisFound, FitUpdated, LimitExceeded
from instrument.stream.event import Derived


@dataclass(frozen=True)
class Found(Derived):
    number: int
    facts_json: str


def found(seconds, number=1):
    return Found(number, json.dumps({"verdict": "none", "next": [{"seconds": 1.0}, {"seconds": seconds}]}))


def test_the_innermost_place_is_named_not_the_same_begin_of_both():
    said = first_difference(found(2.5), found(2.0))
    assert said == "Found.facts_json.next.1.seconds: 2.0 recorded, 2.5 computed"


def test_a_plain_field_is_named_by_itself():
    assert first_difference(found(2.0, 3), found(2.0)) == "Found.number: 1 recorded, 3 computed"


def test_a_limit_recorded_before_it_named_its_frequency_is_as_it_was():
    recorded = LimitExceeded(7, "velocity", 1.2, 1.0, "m/s", "lower the level")
    computed = replace(recorded, frequency_hz=160.0)
    assert as_known_then(computed, recorded) == recorded
    assert as_known_then(computed, computed) == computed
    assert recorded.message == "step 7: velocity 1.2 m/s, limit 1 m/s: lower the level"
    assert computed.message.startswith("at 160 Hz: velocity 1.2 m/s")


def test_a_stop_that_an_older_version_said_in_other_words_is_the_same():
    older = LimitExceeded(0, "calibration in A: gain 0.1 +- 0.001, times the likely", 3.0, 1.0, "", "why?")
    computed = LimitExceeded(0, "calibration in A: the laser's velocity is", 0.1, 0.7, "", "a factor of 10")
    assert as_known_then(computed, older) == older
    assert as_known_then(computed, replace(computed, value=0.2)) == computed
    assert as_known_then(found(1.0), older) == found(1.0)


def test_other_words_are_told_from_other_numbers_and_verdicts():
    then = diagnosis().but(warnings=("the mass is 3.2 g off",), next_measurement="Once more, at 2 g.")
    then = then.but(files=("",))
    recorded = DiagnosisFound(1, 7, then)

    def same(**changes):
        return said_otherwise(DiagnosisFound(1, 7, then.but(**changes)), recorded)

    assert same(warnings=("the mass may be off, by 3.2 g",), next_measurement="Again at 2 g.")
    assert same(warnings=("the mass is 3.2 g off", "a new remark"))
    assert same(files=("sweep",))
    assert not same(warnings=("the mass is 3.3 g off",))
    assert not same(next_measurement="Once more, at 4 g.")
    assert not same(verdict="none" if then.verdict != "none" else "unknown")
    assert not same(chi2_per_dof=2.0, points=then.points[:-1])
    assert not said_otherwise(DiagnosisFound(1, 7, None, "too few"), recorded)
    refused = DiagnosisFound(1, 7, None, "too few points")
    assert said_otherwise(replace(refused, message="fewer points than needed"), refused)
    assert not said_otherwise(found(2.5), found(2.0))


def test_correlations_that_a_recorded_diagnosis_does_not_have_are_not_compared():
    now = diagnosis()
    older = now.but(**{stage: now.stage(stage).without("correlations") for stage in STAGES})
    computed, recorded = DiagnosisFound(1, 7, now), DiagnosisFound(1, 7, older)
    assert as_known_then(computed, recorded) == recorded
    assert as_known_then(computed, computed) == computed


def test_doubts_that_a_recording_does_not_tell_apart_are_not_compared():
    older, said = (
        identification(warnings=["a doubt"]),
        identification(warnings=["a doubt"], doubts=["a doubt"]),
    )
    computed, recorded = FitUpdated(1, 7, said), FitUpdated(1, 7, older)
    assert as_known_then(computed, recorded) == recorded
    assert as_known_then(computed, computed) == computed
    assert as_known_then(computed, FitUpdated(1, 7, None, "too few points")) == computed
