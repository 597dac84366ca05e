"""A diagnosis as people read it."""

import textwrap
from math import isnan

from fitting.identification.quoted import quoted_hz
from instrument.cli.output import Output
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import (
    NOT_NAMED,
    candidate_words,
    law_at,
    percent_of,
    probability_words,
    resampling_words,
    set_aside_words,
    some_parameters,
    verdict_line,
    with_verdict,
)
from instrument.results.foretelling import is_foretold, why_not_foretold
from instrument.results.next_words import (
    NEXT_COLUMNS,
    NEXT_TITLE,
    beyond_words,
    kind_words,
    may_settle,
    next_row,
    separated_words,
)
from instrument.results.numbers import with_error
from instrument.results.unseen_words import UNSEEN_COLUMNS, unseen_row, unseen_title

_MOST_CANDIDATES = 8
_WIDTH = 100
_MOST_NEXT = 3
_MOST_UNSEEN = 10


def print_diagnosis(out: Output, found: DiagnosisResult) -> None:
    """Everything."""
    print_story(out, found)
    out.say()
    _print_candidates(out, found)
    out.say()
    print_before_after(out, found)
    out.say()
    print_law(out, found)
    for text in found.warnings:
        out.say(f"note: {text}")
    if found.seconds is not None and found.setup_seconds is not None:
        counted = f"{len(found.points)} points" if found.modes is None else f"{len(found.modes)} modes"
        out.say(f"{counted}; set-up {found.setup_seconds:.2f} s, diagnosis {found.seconds:.2f} s")


def print_story(out: Output, found: DiagnosisResult) -> None:
    """The verdict, what speaks for it, and what to measure next."""
    out.say(verdict_line(found))
    if found.files is not None and len(found.files) > 1:
        out.say("; ".join(f"file {k}: {name}" for k, name in enumerate(found.files, start=1)))
    out.say()
    for text in found.explanation:
        out.say(textwrap.fill(text, _WIDTH))
    if found.set_aside_hz:
        out.say(textwrap.fill(set_aside_words(found), _WIDTH))
    if found.next_measurement:
        said = " ".join(filter(None, (found.next_measurement, beyond_words(found))))
        out.say(textwrap.fill(f"Next measurement: {said}", _WIDTH))
    _print_next(out, found)
    _print_unseen(out, found)


def _print_next(out: Output, found: DiagnosisResult) -> None:
    """The best few measurements, with what they cost and what they would tell."""
    shown = found.next_measurements[:_MOST_NEXT]
    if not shown:
        return
    out.say()
    out.table(NEXT_TITLE, list(NEXT_COLUMNS), [list(next_row(f)) for f in shown])
    # Of the first the sentence above says so already.
    for f in filter(may_settle, shown[1:]):
        out.say(
            textwrap.fill(f"{kind_words(f.kind)}: {f.why} It separates {separated_words(f.between)}.", _WIDTH)
        )


def _print_unseen(out: Output, found: DiagnosisResult) -> None:
    """The worst few of what may be there all the same."""
    shown = found.unseen[:_MOST_UNSEEN]
    if shown:
        out.say()
        more = f", {len(shown)} of {len(found.unseen)}" if len(shown) < len(found.unseen) else ""
        out.table(
            f"{unseen_title(found)}{more}", list(UNSEEN_COLUMNS), [list(unseen_row(one)) for one in shown]
        )


def print_before_after(out: Output, found: DiagnosisResult) -> None:
    """The fit without and with the effects found."""
    rows = [
        [f"rms difference in {percent_of(found)}/%", *(_two(s.rms_percent) for s in found.stages), ""],
        ["largest difference/%", *(_two(s.max_percent) for s in found.stages), ""],
        ["chi-square per degree of freedom", *(_two(s.chi2_per_dof) for s in found.stages), "1"],
    ]
    for b, a in zip(found.before.held_out, found.after.held_out, strict=False):
        rows.append(
            [
                f"segment {b.segment} from the others, rms/%",
                _two(b.rms_percent),
                _two(a.rms_percent if is_foretold(found, a.segment) else None),
                _two(b.noise_percent),
            ]
        )
    one_by_one = [s.leave_one_out_rms_percent for s in found.stages]
    if one_by_one[0] is not None:
        rows.append(["each point from the others, rms/%", *(_two(v) for v in one_by_one), ""])
    out.table("what the fit leaves", ["", "before", "after", "noise alone"], rows)
    for why in why_not_foretold(found):
        out.say(why)
    resampled = resampling_words(found)
    if resampled:
        out.say(f"by resampling: {resampled}")


def _print_candidates(out: Output, found: DiagnosisResult) -> None:
    candidates = found.likeliest_first
    shown = candidates[:_MOST_CANDIDATES]
    shown += tuple(c for c in candidates[_MOST_CANDIDATES:] if c.name in NOT_NAMED)
    rows = [
        [
            candidate_words(c.name),
            probability_words(c, found),
            _two(c.chi2_per_dof),
            some_parameters(c.parameters) or "-",
        ]
        for c in shown
    ]
    more = f", {len(shown)} of {len(candidates)}" if len(shown) < len(candidates) else ""
    columns = ["effect", "probability", "chi2/degree", "parameters, +- one standard error"]
    out.table(f"candidates, likeliest first{more}", columns, rows)


def print_law(out: Output, found: DiagnosisResult) -> None:
    """The law without and with what was found, at the frequencies that are quoted."""
    rows = []
    for f in quoted_hz(row.frequency_hz for row in found.stages[0].law):
        pair = [row for stage in found.stages if (row := law_at(stage.law, f)) is not None]
        if len(pair) < len(found.stages):
            continue
        rows.append(
            [
                f"{f:.4g}",
                *(_banded(r.storage_modulus_pa, r.storage_modulus_standard_error_pa, 1e-6) for r in pair),
                *(_banded(r.loss_factor, r.loss_factor_standard_error) for r in pair),
            ]
        )
    columns = ["f/Hz", "G'/MPa before", "after", "loss factor before", "after"]
    if rows:
        out.table(with_verdict("the core's law, +- one standard error", found), columns, rows)


def _banded(value: float, error: float, scale: float = 1.0) -> str:
    return with_error(value, error, scale, "+-")


def _two(value: float | None) -> str:
    return "-" if value is None or isnan(value) else f"{value:.2f}"
