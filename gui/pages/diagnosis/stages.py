"""The fit without and with the effects, in rows. No Qt."""

from dataclasses import dataclass

from fitting.identification.quoted import quoted_hz
from gui.pages.law.curve import LawCurve
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import percent_of
from instrument.results.foretelling import is_foretold, why_not_foretold


@dataclass(frozen=True)
class ComparedMeasure:
    """One measure of the fit, before and after; `noise` is what noise alone would give."""

    what: str
    unit: str
    before: float | None
    after: float | None
    noise: float | None = None
    held_out: bool = False


def compared(found: DiagnosisResult) -> list[ComparedMeasure]:
    """Held-out data first: they say what a fit is worth."""
    before, after = found.stages
    rows = [
        ComparedMeasure(
            f"segment {b.segment}, predicted from the others",
            "% rms",
            b.rms_percent,
            a.rms_percent if is_foretold(found, a.segment) else None,
            b.noise_percent,
            held_out=True,
        )
        for b, a in zip(before.held_out, after.held_out, strict=False)
    ]
    one, other = before.leave_one_out_rms_percent, after.leave_one_out_rms_percent
    if one is not None:
        rows.append(
            ComparedMeasure("each point, predicted from the others", "% rms", one, other, held_out=True)
        )
    of, all_of = percent_of(found), "points" if found.modes is None else "modes"
    whole, largest = f"difference in {of}, all {all_of} fitted", f"largest difference in {of}"
    chi2 = "chi² per degree of freedom"
    return [
        *rows,
        ComparedMeasure(whole, "% rms", before.rms_percent, after.rms_percent),
        ComparedMeasure(largest, "%", before.max_percent, after.max_percent),
        ComparedMeasure(chi2, "", before.chi2_per_dof, after.chi2_per_dof, 1.0),
    ]


def lacking(found: DiagnosisResult) -> tuple[str, ...]:
    """Why errors of them are missing, a sentence each."""
    return why_not_foretold(found)


def laws(found: DiagnosisResult) -> tuple[LawCurve, LawCurve]:
    """Before and after."""
    return LawCurve.of(found.before.law), LawCurve.of(found.after.law)


def references_hz(found: DiagnosisResult) -> list[float]:
    """Where both laws are stated in numbers."""
    curves = laws(found)
    return [f for f in quoted_hz(curves[0].frequency_hz) if all(c.at(f) is not None for c in curves)]
