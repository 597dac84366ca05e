"""An impact test's result as JSON holds it."""

from typing import Any

from fitting.modal.frf import Estimate, Refusal
from instrument.impact.damping import Damping


def damping_facts(found: Damping) -> dict[str, Any]:
    """The JSON of `damping`."""
    return {
        "modes": [
            {
                "frequency_hz": m.frequency_hz,
                "damping_ratio": m.damping_ratio,
                "channel": m.channel,
                "half_power": _estimate(m.half_power),
                "rational_fit": _estimate(m.rational_fit),
                "lscf": _estimate(m.lscf),
                "lines_in_bandwidth": m.lines_in_bandwidth,
                "bandwidths_to_next": m.bandwidths_to_next,
                "accepted": m.accepted,
                "why": m.why,
            }
            for m in found.modes
        ],
        "hits": [{"source": j.hit.source, "accepted": j.accepted, "why": j.why} for j in found.hits],
        "warnings": list(found.warnings),
    }


def _estimate(e: Estimate | Refusal) -> dict[str, float] | None:
    return {"ratio": e.ratio, "standard_error": e.standard_error} if isinstance(e, Estimate) else None
