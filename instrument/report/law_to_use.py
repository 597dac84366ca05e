"""The law to use where a diagnosis has found an effect: the one after it, before any other law."""

from instrument.facts.diagnosis import DiagnosisResult
from instrument.report.blocks import Block, ReportSection, Sentence
from instrument.report.law_tables import LawAt, band_table, correlation_table, parameter_table
from instrument.results.diagnosis_words import with_verdict
from instrument.results.numbers import format_number
from instrument.results.standing import law_words, stage_before
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
    said = f"{kind} found with {effects}, which leaves {rms} % rms of the amplitudes. This is the law to use."
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
    blocks: list[Block] = [Sentence(said), band_table(with_verdict(in_band, found), law)]
    # Sessions of older versions have the law alone.
    if after.parameters and after.parameters.keys() <= after.standard_errors.keys():
        title = with_verdict("Parameters after the diagnosis, ± one standard error", found)
        blocks.append(parameter_table(title, after.parameters, after.standard_errors, {}))
        if after.correlations:
            title = "Correlations of the logarithms of the parameters after the diagnosis"
            blocks.append(correlation_table(with_verdict(title, found), after.correlations))
    return [ReportSection(TITLE, tuple(blocks))]
