"""Short sentences on a diagnosis, from its facts."""

from typing import Any

Facts = dict[str, Any]

_MOST_PARAMETERS = 4
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
        others = [n for n in group if n != name]
        if others:
            parts.append(f"these data cannot tell {name} from {', '.join(others)}")
    if channels:
        parts.append(f"the channels by themselves show {' and '.join(_sized(e) for e in channels)}")
    return "; ".join(parts)


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
    spread = f" +- {error:.2g}" if error is not None and error == error else ""
    return f"{key} {p['value']:.4g}{spread}{unit}"


def law_at(law: list[Facts], frequency_hz: float) -> Facts | None:
    """The law's row at a frequency, None where there is none."""
    return next((r for r in law if abs(r["frequency_hz"] - frequency_hz) < 1e-9 * frequency_hz), None)
