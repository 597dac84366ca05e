"""In what a derived event that was computed again is another one than recorded."""

import json
import re
from dataclasses import replace
from typing import Any

from instrument.facts.diagnosis import STAGES, DiagnosisResult
from instrument.facts.result import Result
from instrument.stream.derived import DiagnosisFound, FitUpdated, LimitExceeded, LimitWarned
from instrument.stream.event import Event

_NAMES = ("files",)
"""Keys whose texts are names that a version gives."""
_REMARKS = ("warnings", "doubts", "remarks")
"""Keys of lists of sentences."""
_NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_SHOWN = 80
"""Letters of a value."""
_SAID_SINCE = ("next_measurements", "unseen", "doubts")
"""Of a fit or a diagnosis: what a recording of an older version does not have is not compared."""
_STAGES_SAID_SINCE = ("correlations",)
"""The same of a diagnosis's fits before and after."""
_ONCE_SAID = ("times the likely", "base acceleration under its level")
"""How a version before this one said why it stopped: the same stop in other words and numbers."""


def as_known_then(computed: Event, recorded: Event) -> Event:
    """What was computed, without what limits, fits and diagnoses say only since the recording's version."""
    if isinstance(recorded, LimitExceeded) and any(said in recorded.what for said in _ONCE_SAID):
        return recorded if isinstance(computed, LimitExceeded) else computed
    if isinstance(computed, LimitWarned | LimitExceeded) and getattr(recorded, "frequency_hz", None) == 0:
        return replace(computed, frequency_hz=0.0)
    if isinstance(computed, FitUpdated) and isinstance(recorded, FitUpdated):
        if computed.result is None or recorded.result is None:
            return computed
        return replace(computed, result=computed.result.without(*_said_since(recorded.result)))
    if not isinstance(computed, DiagnosisFound) or not isinstance(recorded, DiagnosisFound):
        return computed
    if computed.result is None or recorded.result is None:
        return computed
    since = _said_since(recorded.result)
    result = _stages_as_known_then(computed.result, recorded.result).without(*since)
    # What is advised follows from the ranking.
    old = "next_measurements" in since
    advised = {"next_measurement": recorded.result.next_measurement} if old else {}
    return replace(computed, result=result.but(**advised))


def _stages_as_known_then(computed: DiagnosisResult, recorded: DiagnosisResult) -> DiagnosisResult:
    """Both fits without what the recorded ones do not say."""
    stages = {}
    for name in STAGES:
        said = recorded.stage(name).model_fields_set
        unsaid = [key for key in _STAGES_SAID_SINCE if key not in said]
        stages[name] = computed.stage(name).without(*unsaid)
    return computed.but(**stages)


def _said_since(recorded: Result) -> list[str]:
    return [key for key in _SAID_SINCE if key not in recorded.model_fields_set]


def said_otherwise(computed: Event, recorded: Event) -> bool:
    """Whether both have the same numbers and verdicts, and differ in sentences or names of files alone.

    Sentences are the same but for their words where the same numbers are in them. Remarks of a list may be
    more or fewer: another version has others to make.
    """
    if type(computed) is not type(recorded):
        return False
    now, then = ({k: _opened(v) for k, v in e.facts().items()} for e in (computed, recorded))
    return _in_words_of(then, now) == then


def _in_words_of(recorded: Any, computed: Any, key: str = "") -> Any:
    """What was computed, said as it was recorded wherever that is another wording alone."""
    if isinstance(recorded, dict) and isinstance(computed, dict):
        return {k: _in_words_of(recorded.get(k), value, k) for k, value in computed.items()}
    if isinstance(recorded, list) and isinstance(computed, list):
        if key in _NAMES or (key in _REMARKS and len(recorded) != len(computed)):
            return recorded
        if len(recorded) == len(computed):
            return [_in_words_of(was, now, key) for was, now in zip(recorded, computed, strict=True)]
    if isinstance(recorded, str) and isinstance(computed, str) and _is_said(recorded) and _is_said(computed):
        same = sorted(_NUMBER.findall(recorded)) == sorted(_NUMBER.findall(computed))
        return recorded if same else computed
    return computed


def _is_said(text: str) -> bool:
    """Whether it is a sentence, and no name of a verdict, a law or an effect; or nothing."""
    return not text or " " in text


def first_difference(computed: Event, recorded: Event) -> str:
    """The innermost place in which they are not the same, and what stands there in both, in a line."""
    name = type(recorded).__name__
    if type(computed) is not type(recorded):
        return f"{name} recorded, {type(computed).__name__} computed"
    a, b = computed.facts(), recorded.facts()
    key = next((k for k in b if a.get(k) != b[k]), "?")
    place, was, now = _where(f"{name}.{key}", _opened(b.get(key)), _opened(a.get(key)))
    return f"{place}: {str(was)[:_SHOWN]} recorded, {str(now)[:_SHOWN]} computed"


def _opened(value: object) -> object:
    """What a field holds as JSON, as that."""
    try:
        return json.loads(value) if isinstance(value, str) else value
    except ValueError:
        return value


def _where(place: str, recorded: object, computed: object) -> tuple[str, object, object]:
    """The innermost place of the first difference, and both values there."""
    if isinstance(recorded, dict) and isinstance(computed, dict):
        for key in dict.fromkeys([*recorded, *computed]):
            if recorded.get(key) != computed.get(key):
                return _where(f"{place}.{key}", recorded.get(key), computed.get(key))
    if isinstance(recorded, list) and isinstance(computed, list):
        for k, (was, now) in enumerate(zip(recorded, computed, strict=False)):
            if was != now:
                return _where(f"{place}.{k}", was, now)
    return place, recorded, computed
