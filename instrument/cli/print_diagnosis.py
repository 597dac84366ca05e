"""A diagnosis as people read it."""

import textwrap
from typing import Any

from fitting.identification.result import REFERENCE_FREQUENCIES_HZ
from instrument.cli.output import Output
from instrument.results.diagnosis_words import (
    law_at,
    probability_words,
    resampling_words,
    some_parameters,
    verdict_line,
    with_verdict,
)

Facts = dict[str, Any]

_MOST_CANDIDATES = 8
_WIDTH = 100


def print_diagnosis(out: Output, facts: Facts) -> None:
    """Everything; `facts` as `diagnosis_facts` gives them."""
    print_story(out, facts)
    out.say()
    _print_candidates(out, facts)
    out.say()
    print_before_after(out, facts)
    out.say()
    _print_law(out, facts)
    for text in facts["warnings"]:
        out.say(f"note: {text}")
    if "seconds" in facts:
        out.say(
            f"{len(facts['points'])} points; set-up {facts['setup_seconds']:.2f} s, "
            f"diagnosis {facts['seconds']:.2f} s"
        )


def print_story(out: Output, facts: Facts) -> None:
    """The verdict, what speaks for it, and what to measure next."""
    out.say(verdict_line(facts))
    out.say()
    for text in facts["explanation"]:
        out.say(textwrap.fill(text, _WIDTH))
    if facts["set_aside_hz"]:
        listed = ", ".join(f"{f:.4g}" for f in facts["set_aside_hz"])
        out.say(textwrap.fill(f"Set aside: {listed} Hz.", _WIDTH))
    if facts["next_measurement"]:
        out.say(textwrap.fill(f"Next measurement: {facts['next_measurement']}", _WIDTH))


def print_before_after(out: Output, facts: Facts) -> None:
    """The fit without and with the effects found."""
    before, after = facts["before"], facts["after"]
    rows = [
        ["rms difference in amplitude/%", *(_two(s["rms_percent"]) for s in (before, after)), ""],
        ["largest difference/%", *(_two(s["max_percent"]) for s in (before, after)), ""],
        ["chi-square per degree", *(_two(s["chi2_per_dof"]) for s in (before, after)), "1"],
    ]
    for b, a in zip(before["held_out"], after["held_out"], strict=False):
        rows.append(
            [
                f"segment {b['segment']} from the others, rms/%",
                *(_two(h["rms_percent"]) for h in (b, a)),
                _two(b["noise_percent"]),
            ]
        )
    one_by_one = [s["leave_one_out_rms_percent"] for s in (before, after)]
    if one_by_one[0] is not None:
        rows.append(["each point from the others, rms/%", *(_two(v) for v in one_by_one), ""])
    out.table("what the fit leaves", ["", "before", "after", "noise alone"], rows)
    resampled = resampling_words(facts)
    if resampled:
        out.say(f"by resampling: {resampled}")


def _print_candidates(out: Output, facts: Facts) -> None:
    candidates = facts["candidates"]
    shown = candidates[:_MOST_CANDIDATES]
    shown += [c for c in candidates[_MOST_CANDIDATES:] if c["name"] == "none"]
    rows = [
        [
            c["name"],
            probability_words(c, facts),
            _two(c["chi2_per_dof"]),
            some_parameters(c["parameters"]) or "-",
        ]
        for c in shown
    ]
    more = f", {len(shown)} of {len(candidates)}" if len(shown) < len(candidates) else ""
    columns = ["effect", "probability", "chi2/degree", "parameters, +- one standard error"]
    out.table(f"candidates, best first{more}", columns, rows)


def _print_law(out: Output, facts: Facts) -> None:
    rows = []
    for f in REFERENCE_FREQUENCIES_HZ:
        pair = [law_at(facts[stage]["law"], f) for stage in ("before", "after")]
        if any(row is None for row in pair):
            continue
        rows.append(
            [
                f"{f:g}",
                *(_banded(r, "storage_modulus_pa", "storage_modulus_standard_error_pa", 1e-6) for r in pair),
                *(_banded(r, "loss_factor", "loss_factor_standard_error", 1.0) for r in pair),
            ]
        )
    columns = ["f/Hz", "G'/MPa before", "after", "loss factor before", "after"]
    if rows:
        out.table(with_verdict("the core's law, +- one standard error", facts), columns, rows)


def _banded(row: Facts | None, key: str, error: str, scale: float) -> str:
    assert row is not None
    value = f"{scale * row[key]:.4f}"
    return value if _absent(row[error]) else f"{value} +- {scale * row[error]:.4f}"


def _two(value: float | None) -> str:
    return "-" if _absent(value) else f"{value:.2f}"


def _absent(value: float | None) -> bool:
    return value is None or value != value
