"""An identification as JSON holds it."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from fitting.bent_law import BentLaw
from fitting.identification.adjusted import Adjusted
from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.fit import Fit
from fitting.identification.result import LawBand
from fitting.identification.validation import Validation
from fitting.laws import CoreLaw
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from fitting.theory_error import TheoryError
from instrument.models.identification import Identified


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
        "bend": _bend(r.fit.law),
        "posterior": _posterior(r.fit),
        "theory_error": theory_facts(found.theory),
    }


def _bend(law: CoreLaw) -> dict[str, list[float]] | None:
    """How a law was bent, in standard deviations at its knots: storage, then loss."""
    if not isinstance(law, BentLaw):
        return None
    return {"knots_hz": list(law.knots_hz), "whitened": np.log(law.bend).tolist()}


def _posterior(fit: Fit) -> dict[str, Any] | None:
    """The lower triangle of the whole covariance: parameters in their logarithms, the rest in its sizes."""
    C = fit.posterior
    if C is None or not np.isfinite(C).all():
        return None
    names = [*fit.law.names, *(one.name for one in fit.adjusted)]
    return {"names": names, "rows": [C[k, : k + 1].tolist() for k in range(len(names))]}


def adjusted_facts(found: Sequence[Adjusted]) -> list[dict[str, Any]]:
    """The stated numbers beside what the fit found them to be."""
    return [asdict(one) for one in found]


def theory_facts(theory: TheoryError | None) -> list[dict[str, Any]] | None:
    """How far resonances and modal loss factors of the plate are off exact elasticity, relative."""
    if theory is None:
        return None
    keys = ("frequency_hz", "frequency_error", "loss_factor_error")
    rows = zip(*(getattr(theory, key).tolist() for key in keys), strict=True)
    return [dict(zip(keys, row, strict=True)) for row in rows]


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
