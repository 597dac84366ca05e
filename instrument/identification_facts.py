"""An identification as JSON holds it."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from fitting.identification.adjusted import Adjusted
from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.result import LawBand
from fitting.identification.validation import Validation
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.identification import Identified


def identification_facts(found: Identified, sweep: Sweep) -> dict[str, Any]:
    """The JSON of `identify`."""
    r = found.result
    names, v = r.law.names, r.validation
    return {
        "method": r.method,
        "law_kind": r.law.kind,
        "parameters": dict(zip(names, r.law.values, strict=True)),
        "standard_errors": r.standard_errors,
        "correlations": {
            a: dict(zip(names, row, strict=True))
            for a, row in zip(names, r.uncertainty.correlations, strict=True)
        },
        "points": [
            {
                "frequency_hz": f,
                "segment": segment,
                "measured_m_s": measured,
                "predicted_m_s": predicted,
                "difference_percent": difference,
            }
            for f, segment, measured, predicted, difference in zip(
                sweep.frequency_hz,
                sweep.segment,
                r.measured_m_s,
                r.predicted_m_s,
                r.difference_percent,
                strict=True,
            )
        ],
        "rms_percent": r.rms_percent,
        "max_percent": r.max_percent,
        "chi2_per_dof": r.uncertainty.chi2_per_dof if r.chi2_means_something else None,
        "noise": r.noise.source,
        "leave_one_out_rms_percent": v.leave_one_out_rms_percent,
        "held_out": held_out_facts(v),
        "held_out_rms_percent": v.held_out_rms_percent,
        "iterations": r.fit.iterations,
        "evaluations": r.fit.evaluations,
        "seconds": found.seconds,
        "setup_seconds": found.setup_seconds,
        "validation_seconds": found.validation_seconds,
        "converged": r.fit.converged,
        "criterion_met": r.fit.criterion_met,
        "warnings": list(r.warnings),
        "law": law_facts(r.band),
        "adjusted": adjusted_facts(r.fit.adjusted),
    }


def adjusted_facts(found: Sequence[Adjusted]) -> list[dict[str, Any]]:
    """The stated numbers beside what the fit found them to be."""
    return [asdict(one) for one in found]


def bare_plate_facts(bare: BarePlateFit, specimen: Specimen) -> dict[str, Any]:
    """What the hammer test gives by itself; `specimen` as stated."""
    young = specimen.substrate.young_pa * bare.young_scale
    return {
        "substrate_young_pa": young,
        "substrate_young_standard_error_pa": young * bare.standard_error,
        "substrate_young_over_stated": bare.young_scale,
        "clamp_percent_of_mode_1": bare.clamp_percent,
        "modes": [
            {"measured_hz": m, "fitted_hz": f} for m, f in zip(bare.measured_hz, bare.fitted_hz, strict=True)
        ],
        "left_out_hz": list(bare.left_out_hz),
        "modal_ratios": list(bare.ratios),
    }


def held_out_facts(v: Validation) -> list[dict[str, Any]]:
    """Each segment predicted from the others."""
    return [
        {"segment": h.segment, "rms_percent": h.rms_percent, "noise_percent": h.noise_percent}
        for h in v.held_out
    ]


def law_facts(b: LawBand) -> list[dict[str, Any]]:
    """G' and eta over the measured band with their standard errors, a row a frequency."""
    keys = (
        "frequency_hz",
        "storage_modulus_pa",
        "loss_factor",
        "storage_modulus_standard_error_pa",
        "loss_factor_standard_error",
    )
    return [dict(zip(keys, row, strict=True)) for row in zip(*(getattr(b, k) for k in keys), strict=True)]
