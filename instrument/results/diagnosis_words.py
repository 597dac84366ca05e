"""Short sentences on a diagnosis."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from math import isnan, nan

from fitting.diagnosis.several.of_files import ALIKE, EACH, FILE
from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.digits import two_digits
from instrument.facts.diagnosis import CandidateFitted, DiagnosisResult, EffectFound, ParameterFound
from instrument.facts.doubts import doubts_of
from instrument.facts.rows import LawRow, StretchSetAside
from instrument.results.error_words import FLOOR_PERCENT, is_below_floor
from instrument.results.numbers import with_error
from instrument.results.standing import none_is_likelier
from instrument.results.units_shown import shown_in, without_rounding

_MOST_PARAMETERS = 4
UNKNOWN = "verdict unknown"
UNRELIABLE = f"{UNKNOWN}: no law here is to be relied on"
"""Said beside a law that stands although nothing explains the data."""
DOUBTED = "in doubt"
"""Of a law that its own fit says may be biased."""
_LEAST_PROBABILITY = 1e-3
"""Probability below which, or above one less which, no digits are said."""
_OUTSIDE_GROUP = 0.05
"""Most that what is not in the group of 95 % can have."""
_RANGE = 3
"""Neighbours from which only the first and the last are said."""
_FILES = {EACH: "in each file its own", ALIKE: "in every file"}
_MEANT = {
    ("layer", 0.0): "of the substrate",
    ("layer", 1.0): "of the constraining layer",
    ("level", 0.0): "at every level",
}
"""Numbers that stand for words, by the key they have."""
NOT_NAMED = {"none": "no effect", UNLISTED: "something of its kind in no catalogue"}
"""What stands in a group without being an effect, in words."""
_SAID = {"none": "nothing beyond noise", "unknown": "structure that nothing in the catalogue explains"}


def segment_place(found: DiagnosisResult, segment: int) -> str:
    """Of which of several files and pickups a segment is, `file 3, pickup 1`; empty where there is one."""
    first = next((p for p in found.points if p.segment == segment), None)
    if first is None:
        return ""
    files = len({p.file for p in found.points}) > 1
    said = [f"file {first.file}"] if files else []
    if first.pickup is not None:
        said.append(f"pickup {first.pickup}")
    return ", ".join(said)


def verdict_line(found: DiagnosisResult) -> str:
    """Verdict, what was found with its size, what cannot be told from it, and what the channels show."""
    groups = found.equivalent
    accepted = [e for e in found.effects if e.name in groups]
    channels = [e for e in found.effects if e.name not in groups]
    said = _SAID.get(found.verdict) or " and ".join(_sized(e) for e in accepted)
    if none_is_likelier(found):
        said = f"no effect is likelier{_share_of_none(found)} than {said}"
    if found.by_hand and not accepted:
        said = "no effect accepted"
    elif found.verdict == "none":
        said += _weighed(found)
    parts = [f"verdict: {'by your word' if found.by_hand else found.verdict}: {said}"]
    for name, group in groups.items():
        others = [_other(n, found) for n in group if n != name]
        if others:
            parts.append(f"these data cannot tell {name} from {', '.join(others)}")
    if channels:
        parts.append(f"the channels by themselves show {' and '.join(_sized(e) for e in channels)}")
    return "; ".join(parts)


def _other(name: str, found: DiagnosisResult) -> str:
    """What stands beside an effect in its group; how likely, of what is in no catalogue."""
    said, p = (
        NOT_NAMED.get(name, name),
        next((c.probability for c in found.candidates if c.name == name), nan),
    )
    return f"{said} ({100 * p:.0f} %)" if name == UNLISTED and not isnan(p) else said


def set_aside_words(found: DiagnosisResult) -> str:
    """The points that took no part: stretches by their file, else neighbours of the grid as a range."""
    stretches = found.set_aside or ()
    aside = {f for f in found.set_aside_hz if not any(s.from_hz <= f <= s.to_hz for s in stretches)}
    grid = sorted(aside.union(point.frequency_hz for point in found.points))
    runs = [list(run) for out, run in groupby(grid, aside.__contains__) if out]
    listed = [
        f"{run[0]:.6g} to {run[-1]:.6g}" if len(run) >= _RANGE else ", ".join(f"{f:.6g}" for f in run)
        for run in runs
    ]
    said = [f"{', '.join(listed)} Hz"] if listed else []
    by_file = groupby(sorted(stretches, key=lambda s: (s.file, s.from_hz)), lambda s: s.name)
    said += [(f"in {name} " if name else "") + f"{_ranges(list(its))} Hz" for name, its in by_file]
    return f"Set aside: {'; '.join(said)}."


def _ranges(stretches: Sequence[StretchSetAside]) -> str:
    return ", ".join(f"{s.from_hz:.4g} to {s.to_hz:.4g}" for s in stretches)


def _weighed(found: DiagnosisResult) -> str:
    """How sure it is that there is nothing, where that was weighed."""
    p = _none(found)
    return "" if isnan(p) else f" that these data can name ({100 * p:.0f} % for no effect)"


def _share_of_none(found: DiagnosisResult) -> str:
    p = _none(found)
    return "" if isnan(p) else f" ({100 * p:.0f} %)"


def _none(found: DiagnosisResult) -> float:
    return next((c.probability for c in found.candidates if c.name == "none"), nan)


def percent_of(found: DiagnosisResult) -> str:
    """What differences in percent are of: tables of modes have frequencies."""
    return "amplitude" if found.modes is None else "frequency"


def with_verdict(title: str, found: DiagnosisResult) -> str:
    """The title of what shows a diagnosis's law: it says so where nothing explains the data."""
    if found.verdict == "unknown":
        return f"{title} ({UNKNOWN})"
    return f"{title} ({DOUBTED})" if doubts_of(found) else title


def candidate_words(name: str) -> str:
    """A candidate's name in a table: what is no effect says what it is."""
    return f"{name}: like these, in no catalogue" if name == UNLISTED else name


def probability_words(candidate: CandidateFitted, found: DiagnosisResult) -> str:
    """Of an explanation, one of those tried being right; a dash where none was weighed.

    Where nothing explains the data what is likeliest is refused, by a check or by data held out, and so is
    what fails a check: the best of the wrong is not certain.
    """
    p = candidate.probability
    fails = any(tail < VERDICT.check_level for tail in candidate.checks.values())
    refused = fails or p > _OUTSIDE_GROUP
    if found.verdict == "unknown" and refused and candidate.name != UNLISTED:
        return "refused"
    if found.by_hand or isnan(p):
        return "-"
    if p < _LEAST_PROBABILITY:
        return f"< {100 * _LEAST_PROBABILITY:g} %"
    return f"> {100 * (1 - _LEAST_PROBABILITY):g} %" if p > 1 - _LEAST_PROBABILITY else f"{100 * p:.1f} %"


def resampling_words(found: DiagnosisResult) -> str:
    """What the search makes of data without any effect, and of data it has not seen; empty if not asked."""
    p, rms = found.p_value, found.nested_held_out_rms_percent
    said = [] if p is None else [f"sweeps without any effect gain as much in {_as_often(p, found.resamples)}"]
    if rms is not None:
        said.append(f"data left out, the whole search repeated without them: {two_digits(rms)} % rms")
    return "; ".join(said)


def _as_often(p_value: float, resamples: int) -> str:
    """The data count among those that gain as much, so that no chance is nought."""
    percent = two_digits(100 * p_value)
    if not resamples:
        return f"up to {percent} % of cases"
    times = round(p_value * (1 + resamples)) - 1
    return (
        f"{times} of {resamples} (up to {percent} %)" if times else f"none of {resamples} (below {percent} %)"
    )


def log_odds(found: DiagnosisResult) -> list[float | None]:
    """Of each candidate against none, natural logarithm; None where none was not fitted."""
    none = next((c.delta_bic for c in found.candidates if c.name == "none"), None)
    return [None if none is None else (none - c.delta_bic) / 2 for c in found.candidates]


def some_parameters(parameters: Mapping[str, ParameterFound]) -> str:
    """The first few; a law at knots has a dozen."""
    said = [parameter_words(key, p) for key, p in parameters.items()]
    more = [f"{len(said) - _MOST_PARAMETERS} more"] if len(said) > _MOST_PARAMETERS else []
    return ", ".join([*said[:_MOST_PARAMETERS], *more])


def _sized(effect: EffectFound) -> str:
    said = some_parameters(effect.parameters)
    return effect.name + (f" ({said})" if said else "")


def parameter_words(key: str, p: ParameterFound) -> str:
    """Name, value, standard error where there is one, unit."""
    if key == FILE:
        return _FILES.get(round(p.value), f"in file {p.value:.0f}")
    of, _, last = key.rpartition(".")
    meant = _MEANT.get((last, p.value))
    if meant is not None:
        return f"{of} {meant}".strip()
    scale, shown = shown_in(p.unit)
    unit = f" {shown}" if shown else ""
    value = without_rounding(p.value, p.standard_error, p.unit)
    if value and is_below_floor(p.standard_error, value):
        return f"{key} {scale * value:.4g} (+- below {FLOOR_PERCENT:g} %){unit}"
    return f"{key} {with_error(value, p.standard_error, scale, '+-')}{unit}"


def law_at(law: Sequence[LawRow], frequency_hz: float) -> LawRow | None:
    """The law's row at a frequency, None where there is none."""
    return next((r for r in law if abs(r.frequency_hz - frequency_hz) < 1e-9 * frequency_hz), None)
