"""Short sentences on a diagnosis, from its facts."""

from typing import Any

from instrument.results.error_words import FLOOR_PERCENT, is_below_floor

Facts = dict[str, Any]

_MOST_PARAMETERS = 4
UNKNOWN = "verdict unknown"
_LEAST = 1e-3
"""Probability below which, or above one less which, no digits are said."""
_SAID = {"none": "nothing beyond noise", "unknown": "structure that nothing in the catalogue explains"}


def verdict_line(facts: Facts) -> str:
    """Verdict, what was found with its size, what cannot be told from it, and what the channels show."""
    groups = facts["equivalent"]
    accepted = [e for e in facts["effects"] if e["name"] in groups]
    channels = [e for e in facts["effects"] if e["name"] not in groups]
    said = _SAID.get(facts["verdict"]) or " and ".join(_sized(e) for e in accepted)
    if facts.get("by_hand") and not accepted:
        said = "no effect accepted"
    parts = [f"verdict: {'by your word' if facts.get('by_hand') else facts['verdict']}: {said}"]
    for name, group in groups.items():
        others = ["no effect" if n == "none" else n for n in group if n != name]
        if others:
            parts.append(f"these data cannot tell {name} from {', '.join(others)}")
    if channels:
        parts.append(f"the channels by themselves show {' and '.join(_sized(e) for e in channels)}")
    return "; ".join(parts)


def with_verdict(title: str, facts: Facts) -> str:
    """The title of what shows a diagnosis's law: it says so where nothing explains the data."""
    return f"{title} ({UNKNOWN})" if facts["verdict"] == "unknown" else title


def probability_words(candidate: Facts, facts: Facts) -> str:
    """Of an explanation, one of those tried being right; a dash where none was weighed."""
    p = candidate.get("probability")
    if facts.get("by_hand") or p is None or p != p:
        return "-"
    if p < _LEAST:
        return f"< {100 * _LEAST:g} %"
    return f"> {100 * (1 - _LEAST):g} %" if p > 1 - _LEAST else f"{100 * p:.1f} %"


def resampling_words(facts: Facts) -> str:
    """What the search makes of data without any effect, and of data it has not seen; empty if not asked."""
    p, rms = facts.get("p_value"), facts.get("nested_held_out_rms_percent")
    said = [] if p is None else [f"sweeps without any effect gain as much in {100 * p:.2g} % of cases"]
    if rms is not None:
        said.append(f"data left out, the whole search repeated without them: {rms:.2g} % rms")
    return "; ".join(said)


def log_odds(facts: Facts) -> list[float | None]:
    """Of each candidate against none, natural logarithm; None where none was not fitted."""
    none = next((c["delta_bic"] for c in facts["candidates"] if c["name"] == "none"), None)
    return [None if none is None else (none - c["delta_bic"]) / 2 for c in facts["candidates"]]


def some_parameters(parameters: Facts) -> str:
    """The first few; a law at knots has a dozen."""
    said = [parameter_words(key, p) for key, p in parameters.items()]
    more = [f"{len(said) - _MOST_PARAMETERS} more"] if len(said) > _MOST_PARAMETERS else []
    return ", ".join([*said[:_MOST_PARAMETERS], *more])


def _sized(effect: Facts) -> str:
    said = some_parameters(effect["parameters"])
    return effect["name"] + (f" ({said})" if said else "")


def parameter_words(key: str, p: Facts) -> str:
    """Name, value, standard error where there is one, unit."""
    error = p["standard_error"]
    unit = "" if p["unit"] == "1" else f" {p['unit']}"
    spread = ""
    if error is not None and error == error:
        below = p["value"] and is_below_floor(error, p["value"])
        spread = f" (+- below {FLOOR_PERCENT:g} %)" if below else f" +- {error:.2g}"
    return f"{key} {p['value']:.4g}{spread}{unit}"


def law_at(law: list[Facts], frequency_hz: float) -> Facts | None:
    """The law's row at a frequency, None where there is none."""
    return next((r for r in law if abs(r["frequency_hz"] - frequency_hz) < 1e-9 * frequency_hz), None)
