"""The diagnosis the run ended with: verdict, tables and figures from the recorded facts."""

from typing import Any

from fitting.identification.result import REFERENCE_FREQUENCIES_HZ
from instrument.report.blocks import Block, Section, Sentence, Table
from instrument.report.numbers import format_number, with_error
from instrument.report.picture import picture
from instrument.results.diagnosis_figures import evidence_figure, law_figure, residual_figure
from instrument.results.diagnosis_words import (
    law_at,
    probability_words,
    resampling_words,
    some_parameters,
    verdict_line,
    with_verdict,
)
from instrument.session.contents import Contents

Facts = dict[str, Any]

_TITLE = "Diagnosis"
_MOST_CANDIDATES = 12


def diagnosis_sections(contents: Contents) -> list[Section]:
    """One section, or none where the run made no diagnosis."""
    found = contents.diagnosis
    if found is None:
        return []
    if not found.facts_json:
        return [Section(_TITLE, (Sentence(f"No diagnosis was possible: {found.message}.", "warning"),))]
    facts = found.facts_json
    verdict = verdict_line(facts)
    blocks: list[Block] = [Sentence(f"{verdict[0].upper()}{verdict[1:]}.")]
    blocks += [Sentence(text) for text in facts["explanation"]]
    if facts["set_aside_hz"]:
        listed = ", ".join(f"{f:.4g}" for f in facts["set_aside_hz"])
        blocks.append(Sentence(f"Set aside for hum: {listed} Hz.", "note"))
    if facts["next_measurement"]:
        blocks.append(Sentence(f"Next measurement: {facts['next_measurement']}", "note"))
    blocks += [Sentence(text, "note") for text in facts["warnings"]]
    resampled = resampling_words(facts)
    blocks += [Sentence(f"By resampling: {resampled}.")] if resampled else []
    blocks += [
        _before_after(facts),
        picture(residual_figure(facts), "Residual before and after: predicted over measured, less one"),
        _candidates(facts),
        picture(evidence_figure(facts), "Evidence for each candidate"),
        _law(facts),
        picture(law_figure(facts), with_verdict("The core's law before and after, with 95 % bands", facts)),
    ]
    return [Section(_TITLE, tuple(blocks))]


def _before_after(facts: Facts) -> Table:
    before, after = facts["before"], facts["after"]
    said = (
        ("rms difference in amplitude / %", "rms_percent"),
        ("largest difference / %", "max_percent"),
        ("chi² per degree of freedom", "chi2_per_dof"),
        ("predicted from the others, rms / %", "held_out_rms_percent"),
    )
    rows: list[tuple[str, ...]] = [
        (name, format_number(before[key], 3), format_number(after[key], 3), "") for name, key in said
    ]
    rows += [
        (
            f"segment {b['segment']} from the others, rms / %",
            *(format_number(h["rms_percent"], 3) for h in (b, a)),
            format_number(b["noise_percent"], 3),
        )
        for b, a in zip(before["held_out"], after["held_out"], strict=False)
    ]
    return Table("What the fit leaves", ("", "before", "after", "noise alone"), tuple(rows))


def _candidates(facts: Facts) -> Table:
    rows = tuple(
        (
            c["name"],
            probability_words(c, facts),
            format_number(c["chi2_per_dof"], 3),
            some_parameters(c["parameters"]) or "-",
        )
        for k, c in enumerate(facts["candidates"])
        if k < _MOST_CANDIDATES or c["name"] == "none"
    )
    title = f"Candidates, best first ({len(facts['candidates'])} were fitted)"
    return Table(title, ("effect", "probability", "chi² / degree", "parameters"), rows)


def _law(facts: Facts) -> Table:
    rows = []
    for f in REFERENCE_FREQUENCIES_HZ:
        pair = [law_at(facts[stage]["law"], f) for stage in ("before", "after")]
        known = [r for r in pair if r is not None]
        if len(known) < 2:
            continue
        G = (with_error(r["storage_modulus_pa"], r["storage_modulus_standard_error_pa"], 1e-6) for r in known)
        eta = (with_error(r["loss_factor"], r["loss_factor_standard_error"]) for r in known)
        rows.append((f"{f:g}", *G, *eta))
    columns = ("f / Hz", "G' / MPa before", "after", "loss factor before", "after")
    return Table(with_verdict("The core's law, ± one standard error", facts), columns, tuple(rows))
