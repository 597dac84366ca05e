"""The law to use where a diagnosis moves it: the one after it, before any other law."""

from instrument.facts.diagnosis import DiagnosisResult
from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence
from instrument.report.law_tables import LawAt, band_table, correlation_table, parameter_table
from instrument.results.diagnosis_figures import law_figure
from instrument.results.diagnosis_words import with_verdict
from instrument.results.numbers import format_number
from instrument.results.standing import is_one_of_several, law_words, stage_before
from instrument.session.contents import Contents

TITLE = "Law to use, after the diagnosis"


def found_with_effect(contents: Contents) -> DiagnosisResult | None:
    """The diagnosis that ended with another law than the identification's; None where there is no such.

    Of an unknown verdict no law is to be used.
    """
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    if found is None or found.verdict == "unknown" or stage_before(found) is None:
        return None
    return found


def law_to_use_sections(contents: Contents) -> list[ReportSection]:
    """One section, or none where the identification's law is the one to use."""
    found = found_with_effect(contents)
    if found is None:
        return []
    after, effects = found.after, law_words(found)
    kind = f"{after.law_kind} law" if after.law_kind else "The law"
    rms = format_number(after.rms_percent, 3)
    likeliest = " and ".join(found.equivalent)
    said = f"{kind} found with {effects}, which leaves {rms} % rms of the amplitudes."
    if is_one_of_several(found):
        said = (
            f"{kind} over all explanations that these data cannot tell apart, {effects}: where they differ, "
            f"its errors are wider. With {likeliest} the fit leaves {rms} % rms of the amplitudes."
        )
    said += " This is the law to use."
    law = [
        LawAt(
            row.frequency_hz,
            row.storage_modulus_pa,
            row.storage_modulus_standard_error_pa,
            row.loss_factor,
            row.loss_factor_standard_error,
        )
        for row in after.law
    ]
    in_band = f"The law after the diagnosis, with {effects}, in the band, ± one standard error"
    drawn = with_verdict("The core's law before and after the diagnosis; with 95 % bands", found)
    blocks: list[Block] = [
        Sentence(said),
        FigureBlock(law_figure(found), drawn),
        band_table(with_verdict(in_band, found), law),
    ]
    # Sessions of older versions have the law alone.
    if after.parameters and after.parameters.keys() <= after.standard_errors.keys():
        alone = f", with {likeliest} alone" if is_one_of_several(found) else ""
        title = with_verdict(f"Parameters after the diagnosis{alone}, ± one standard error", found)
        blocks.append(parameter_table(title, after.parameters, after.standard_errors, {}))
        if after.correlations:
            title = f"Correlations of the logarithms of the parameters after the diagnosis{alone}"
            blocks.append(correlation_table(with_verdict(title, found), after.correlations))
    return [ReportSection(TITLE, tuple(blocks))]
