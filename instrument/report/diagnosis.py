"""The diagnosis the run ended with: verdict, tables and figures from the recorded result."""

from dataclasses import replace

from fitting.identification.quoted import quoted_hz
from fitting.structures import AnySpecimen
from instrument.facts.diagnosis import DiagnosisResult
from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.law_to_use import found_with_effect
from instrument.results.diagnosis_figures import evidence_figure, law_figure, residual_figure
from instrument.results.diagnosis_words import (
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
from instrument.results.followed import followed_of, measured_words
from instrument.results.foretelling import is_foretold, why_not_foretold
from instrument.results.next_words import NEXT_COLUMNS, NEXT_TITLE, beyond_words, next_row, separated_words
from instrument.results.numbers import format_number, with_error
from instrument.results.offer_sketch import offer_view
from instrument.results.sketch_figure import sketch_figure
from instrument.results.standing import laws_apart, one_fit_words, stage_before
from instrument.results.typeset import capitalised, heading, note
from instrument.results.unseen_words import UNSEEN_COLUMNS, unseen_row, unseen_title
from instrument.session.contents import Contents

_TITLE = "Diagnosis"
_MOST_CANDIDATES = 12


def diagnosis_sections(contents: Contents) -> list[ReportSection]:
    """One section, or none where the run made no diagnosis."""
    if contents.diagnosis is None:
        return []
    found = contents.diagnosis.result
    if found is None:
        why = contents.diagnosis.message
        return [ReportSection(_TITLE, (Sentence(f"No diagnosis was possible: {why}.", "warning"),))]
    verdict, changed = verdict_line(found), stage_before(found) is not None
    when = "before and after" if changed else f"without any effect: {one_fit_words(found)}"
    blocks: list[Block] = [Sentence(f"{capitalised(verdict)}.")]
    blocks += [Sentence(text) for text in found.explanation]
    blocks += _followed(contents)
    if found.set_aside_hz:
        blocks.append(Sentence(set_aside_words(found), "note"))
    if found.next_measurement:
        said = " ".join(filter(None, (found.next_measurement, beyond_words(found))))
        blocks.append(Sentence(f"Next measurement: {said}", "note"))
    blocks += _next(found, contents.specimen)
    blocks += _unseen(found)
    blocks += [Sentence(note(text), "note") for text in found.warnings]
    resampled = resampling_words(found)
    blocks += [Sentence(f"By resampling: {resampled}.")] if resampled else []
    blocks += [
        _before_after(found),
        *(Sentence(f"{capitalised(why)}.", "note") for why in why_not_foretold(found)),
        FigureBlock(residual_figure(found), f"Residual {when}; predicted over measured, less one"),
        _candidates(found),
        FigureBlock(evidence_figure(found), "Evidence for each candidate"),
        _law(found),
    ]
    if found_with_effect(contents) is None:
        drawn = with_verdict(f"The core's law {when}; with 95 % bands", found)
        blocks.append(FigureBlock(law_figure(found), drawn))
    return [ReportSection(_TITLE, tuple(blocks))]


def _followed(contents: Contents) -> list[Block]:
    """What was measured because a diagnosis ended in a group."""
    followed = followed_of(contents.following)
    rows = tuple((f.verdict_before, measured_words(f.measured), f.verdict_after or "-") for f in followed)
    if not rows:
        return []
    columns = ("before", "measurement", "after")
    return [TableBlock("Measured to tell explanations apart", columns, rows, words=columns)]


def _next(found: DiagnosisResult, specimen: AnySpecimen) -> list[Block]:
    """What would tell the explanations left apart, and where on the plate the first is that says it."""
    rows = tuple((*next_row(f), separated_words(f.between), f.why) for f in found.next_measurements)
    title = f"{NEXT_TITLE[0].upper()}{NEXT_TITLE[1:]}"
    words = (NEXT_COLUMNS[0], "separates", "why")
    if not rows:
        return []
    table = TableBlock(title, (*NEXT_COLUMNS, *words[1:]), rows, words=words)
    view = offer_view(specimen, found.next_measurements)
    if view is None:
        return [table]
    return [table, FigureBlock(sketch_figure([replace(view, title="")]), view.title)]


def _unseen(found: DiagnosisResult) -> list[Block]:
    """What may be there all the same."""
    title = capitalised(unseen_title(found))
    rows = tuple(unseen_row(one) for one in found.unseen)
    columns = tuple(map(heading, UNSEEN_COLUMNS))
    return [TableBlock(title, columns, rows, words=UNSEEN_COLUMNS[:2])] if rows else []


def _before_after(found: DiagnosisResult) -> TableBlock:
    before, after = found.stages
    said: tuple[tuple[str, float | None, float | None], ...] = (
        (f"rms difference in {percent_of(found)} / %", before.rms_percent, after.rms_percent),
        ("largest difference / %", before.max_percent, after.max_percent),
        ("chi² per degree of freedom", before.chi2_per_dof, after.chi2_per_dof),
        ("predicted from the others, rms / %", before.held_out_rms_percent, after.held_out_rms_percent),
    )
    if before.held_out_rms_percent is None and after.held_out_rms_percent is None:
        said = said[:-1]
    rows: list[tuple[str, ...]] = [
        (name, format_number(one, 3), format_number(other, 3), "") for name, one, other in said
    ]
    rows += [
        (
            f"segment {b.segment} from the others, rms / %",
            format_number(b.rms_percent, 3),
            format_number(a.rms_percent if is_foretold(found, a.segment) else None, 3),
            format_number(b.noise_percent, 3),
        )
        for b, a in zip(before.held_out, after.held_out, strict=False)
    ]
    if stage_before(found) is None:
        one = tuple((row[0], row[1], row[3]) for row in rows)
        return TableBlock("What the fit leaves", ("", "without any effect", "noise alone"), one)
    return TableBlock("What the fit leaves", ("", "before", "after", "noise alone"), tuple(rows))


def _candidates(found: DiagnosisResult) -> TableBlock:
    rows = tuple(
        (
            candidate_words(c.name),
            probability_words(c, found),
            format_number(c.chi2_per_dof, 3),
            some_parameters(c.parameters) or "-",
        )
        for k, c in enumerate(found.likeliest_first)
        if k < _MOST_CANDIDATES or c.name == "none"
    )
    title = f"Candidates, likeliest first ({len(found.candidates)} were fitted)"
    return TableBlock(title, ("effect", "probability", "chi² / degree", "parameters"), rows)


def _law(found: DiagnosisResult) -> TableBlock:
    rows, stages = [], [found.stage(name) for name in laws_apart(found)]
    for f in quoted_hz(row.frequency_hz for row in stages[0].law):
        pair = [law_at(stage.law, f) for stage in stages]
        known = [r for r in pair if r is not None]
        if len(known) < len(stages):
            continue
        G = (with_error(r.storage_modulus_pa, r.storage_modulus_standard_error_pa, 1e-6) for r in known)
        eta = (with_error(r.loss_factor, r.loss_factor_standard_error) for r in known)
        rows.append((f"{f:.4g}", *G, *eta))
    columns: tuple[str, ...] = ("f / Hz", "G' / MPa before", "after", "loss factor before", "after")
    if len(stages) == 1:
        columns = ("f / Hz", "G' / MPa", "loss factor")
    return TableBlock(with_verdict("The core's law, ± one standard error", found), columns, tuple(rows))
