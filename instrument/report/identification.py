"""The identification: law, parameters, residual, and what stays unexplained."""

from collections.abc import Sequence

import numpy as np

from fitting.diagnosis.checks.structure import in_words
from fitting.digits import two_digits, written_out
from fitting.identification.result import Identification
from fitting.identification.uncertainty import correlations_by_name
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.facts.session_result import SessionResult
from instrument.finding.identification import Identified
from instrument.report.blocks import Block, FactsBlock, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.fitted import ReportedFit
from instrument.report.law_figures import law_figure, residual_figures
from instrument.report.law_tables import LawAt, band_table, correlation_table, parameter_table
from instrument.report.law_to_use import TITLE, found_with_effect
from instrument.report.measured import Measured, segments_of
from instrument.results.adjusted_words import COLUMNS, adjusted_rows
from instrument.results.diagnosis_words import UNKNOWN, with_verdict
from instrument.results.foretelling import why_nothing_is_held_out
from instrument.results.law_words import sources_words
from instrument.results.numbers import format_number, with_error
from instrument.results.session_result import (
    BEFORE_DIAGNOSIS,
    Conditions,
    recorded_result,
    result_of,
)
from instrument.results.standing import is_one_of_several, law_words, none_is_likelier
from instrument.results.typeset import capitalised, note, typeset
from instrument.session.contents import Contents

_SAME = 1e-6
"""Relative difference to the run's own fit that is rounding."""
_WITHOUT = f"{capitalised(BEFORE_DIAGNOSIS)}, not to be used"
_BEFORE = (
    "This is the law before the diagnosis, which found {}. The law to use is the one after it: at the head "
    f"of the page and in the section {TITLE}."
)
_FOUND = "an effect that the model lacked"
_FOUND_ONE_OF = "that the model lacked something, and cannot tell what of several: {}"

_NOT_EXCLUDED = (
    "The diagnosis found no effect likelier than none: what it could not rule out is in its section."
)


def identification_section(contents: Contents, fitted: ReportedFit) -> ReportSection:
    """The core's law, how well it is known, and how it follows the points."""
    diagnosed = contents.diagnosis is not None and contents.diagnosis.result is not None
    title = f"Identification of the core{f', {BEFORE_DIAGNOSIS}' if diagnosed else ''}"
    if fitted.fit is None:
        return ReportSection(title, (Sentence(f"No law could be identified: {fitted.why}.", "warning"),))
    fit = fitted.fit
    r = fit.result
    blocks: list[Block] = [
        Sentence(f"{r.law.kind} law from {_points(fit)} by {r.method} least squares, {_hammer(fit)}."),
        *_doubt(contents),
        *(Sentence(note(warning), "note") for warning in r.warnings),
        *_drawn(fit, contents),
        _band(r, contents),
        _parameters(r, contents),
        _correlations(r, contents),
        *_adjusted(fit, contents),
        _live(contents, r),
    ]
    segments = segments_of(contents, fitted.points_set_aside)
    drawn = _titled(f"Residual: model less measurement, by segment{_without(segments)}", contents)
    blocks += [FigureBlock(f, drawn) for f in residual_figures(segments, fitted)]
    return ReportSection(title, tuple(blocks))


def _without(segments: Sequence[Measured]) -> str:
    """Which points are not drawn, as the model is not of how they were read; empty for none."""
    left_out = dict.fromkeys(m.elsewhere for m in segments if m.elsewhere)
    return f"; without what was measured otherwise ({'; '.join(left_out)})" if left_out else ""


def result_in_short(contents: Contents, fitted: ReportedFit) -> str:
    """The law to sign, in a line."""
    return typeset(session_result(contents, fitted).words)


def session_result(contents: Contents, fitted: ReportedFit) -> SessionResult:
    """The result as recorded; computed for the page where the run left no law of all its points."""
    recorded = recorded_result(contents)
    if recorded.is_complete or (recorded.points and fitted.result is None):
        return recorded
    return result_of(fitted.result, None, Conditions.of_points(contents.measured), fitted.why)


def unexplained_section(fitted: ReportedFit) -> ReportSection:
    """What is left, in three numbers, and by segment."""
    title = "What the fit cannot explain"
    if fitted.fit is None:
        return ReportSection(title, (Sentence("There is no fit to say it of.", "note"),))
    r = fitted.fit.result
    v = r.validation
    chi2 = (
        format_number(r.uncertainty.chi2_per_dof, 3)
        if r.chi2_means_something
        else "none: readings count by what the fit leaves of them"
        if r.noise.source == "misfit"
        else "not known: the noise is not"
    )
    rows = [
        ("rms difference in amplitude", f"{written_out(r.rms_percent, 3)} %"),
        ("largest difference in amplitude", f"{written_out(r.max_percent, 3)} %"),
        ("chi² per degree of freedom", chi2),
    ]
    if v.held_out_rms_percent is not None:
        rows.append(
            ("each segment predicted from the others", f"{written_out(v.held_out_rms_percent, 3)} % rms")
        )
    if v.leave_one_out_rms_percent is not None:
        rows.append(
            ("each point predicted from the others", f"{written_out(v.leave_one_out_rms_percent, 3)} % rms")
        )
    if v.held_out_rms_percent is None and v.leave_one_out_rms_percent is None:
        rows.append(("error on data held out", f"none: {why_nothing_is_held_out(len(r.measured_m_s))}"))
    blocks: list[Block] = [
        Sentence(f"Before: the model has no further effects than {_parts(fitted.fit.files[0].specimen)}."),
        FactsBlock("", tuple(rows)),
    ]
    if v.held_out:
        table = tuple(
            (str(h.segment), format_number(h.rms_percent, 3), format_number(h.noise_percent, 3))
            for h in v.held_out
        )
        blocks.append(TableBlock("Held out: each segment predicted from the others", _HELD_OUT, table))
    return ReportSection(title, tuple(blocks))


_HELD_OUT = ("segment", "rms / %", "its noise / %")


def _parts(specimen: AnySpecimen) -> str:
    """What a model without effects is made of."""
    if specimen.kind == "plate":
        return "the plate, its core and its viscous damping"
    return f"the {in_words(specimen.kind)} and its core"


def _points(fit: Identified) -> str:
    """How many took part, and how many did not."""
    taken, aside = len(fit.sweep), int(np.sum(fit.why_aside != ""))
    return f"{taken} points" + (f" ({aside} set aside)" if aside else "")


def _hammer(fit: Identified) -> str:
    plate = fit.files[0].specimen
    if not isinstance(plate, PlateSpecimen):
        return "stated numbers within their tolerances"
    if fit.bare is None:
        return "without a hammer test: stiffness and viscous damping as the specimen states them"
    young = plate.substrate.young_pa * fit.bare.young_scale
    said = f"{with_error(young, young * fit.bare.standard_error, 1e-9)} GPa by itself"
    return f"jointly with the hammer test: {len(fit.bare.measured_hz)} modes, substrate {said}"


def _doubt(contents: Contents) -> list[Block]:
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    if found is None or found.verdict == "none":
        return []
    if found.verdict == "unknown":
        return [Sentence(f"Diagnosis: {UNKNOWN}. The law may be far off its band.", "warning")]
    if none_is_likelier(found):
        return [Sentence(_NOT_EXCLUDED, "note")]
    what = _FOUND_ONE_OF.format(law_words(found)) if is_one_of_several(found) else _FOUND
    return [Sentence(_BEFORE.format(what), "warning")]


def _drawn(fit: Identified, contents: Contents) -> list[Block]:
    """The law; nothing where the section of the law to use draws it beside that."""
    if found_with_effect(contents) is not None:
        return []
    title = doubted(f"Shear modulus and loss factor in the measured band, {_banded(fit.result)}", contents)
    return [FigureBlock(law_figure(fit, doubted("identified", contents)), title)]


def _banded(r: Identification) -> str:
    known = np.isfinite(r.band.storage_modulus_standard_error_pa).all()
    return "with 95 % bands" if known else "without bands: these points carry no standard error"


def doubted(title: str, contents: Contents) -> str:
    """The title of what shows the law: it says so where nothing explains the data."""
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    return with_verdict(title, found) if found is not None else title


def _band(r: Identification, contents: Contents) -> TableBlock:
    b = r.band
    columns = (
        b.frequency_hz,
        b.storage_modulus_pa,
        b.storage_modulus_standard_error_pa,
        b.loss_factor,
        b.loss_factor_standard_error,
    )
    law = [LawAt(*map(float, row)) for row in zip(*columns, strict=True)]
    title = f"The law in the band, ± one standard error ({sources_words(r.method, r.noise.source)})"
    return band_table(_titled(title, contents), law)


def _parameters(r: Identification, contents: Contents) -> TableBlock:
    values = dict(zip(r.law.names, map(float, r.law.values), strict=True))
    title = _titled("Parameters, ± one standard error", contents)
    return parameter_table(title, values, r.standard_errors, r.uncertainty.at_bound)


def _titled(title: str, contents: Contents) -> str:
    """Marked where another law is the one to use."""
    if found_with_effect(contents) is not None:
        return f"{_WITHOUT}: {title[0].lower()}{title[1:]}"
    return doubted(title, contents)


def _correlations(r: Identification, contents: Contents) -> TableBlock:
    title = _titled("Correlations of the logarithms of the parameters", contents)
    return correlation_table(title, correlations_by_name(r.law.names, r.uncertainty))


def _adjusted(fit: Identified, contents: Contents) -> list[Block]:
    """The stated numbers as the fit has them; nothing where all are exact."""
    found = fit.result.fit.adjusted
    if not found:
        return []
    rows = tuple(tuple(row) for row in adjusted_rows(found, fit.files[0].specimen, len(found)))
    title = _titled("Stated numbers the data moved, most moved first", contents)
    return [TableBlock(title, COLUMNS, rows, folded=True)]


def _live(contents: Contents, r: Identification) -> Sentence:
    """The fit the run itself ended with."""
    live = contents.fit
    if live is None:
        return Sentence("The run itself made no fit; this one was made for the page.", "note")
    if live.result is None:
        return Sentence(f"The run's own last fit failed: {live.message}.", "note")
    points = len(live.result.points) + len(live.result.points_set_aside)
    if points != len(contents.points):
        return Sentence(f"The run's own last fit had {points} of {len(contents.points)} points.", "note")
    if contents.struck:
        return Sentence("The run's own last fit was without the spectra of the struck plate.", "note")
    recorded = live.result.parameters
    worst = max(abs(recorded[n] / v - 1) for n, v in zip(r.law.names, r.law.values, strict=True))
    if worst <= _SAME:
        return Sentence("The live identification of the run ended with the same parameters.")
    return Sentence(
        f"The run's own fit differs by up to {two_digits(100 * worst)} % in a parameter.", "warning"
    )
