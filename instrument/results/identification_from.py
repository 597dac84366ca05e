"""An identification's result, read off its fit."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.discrepancy.theory_error import TheoryError
from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.doubt import doubts_among
from fitting.identification.fit import Fit
from fitting.identification.result import Identification
from fitting.identification.uncertainty import correlations_by_name
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.facts.identification import (
    BareMode,
    BarePlateFound,
    Bend,
    IdentificationResult,
    PointFitted,
    PosteriorFound,
    TheoryErrorRow,
)
from instrument.finding.identification import Identified
from instrument.results.of_files import with_files
from instrument.results.rows_from import (
    adjusted_from,
    held_out_from,
    law_known_from,
    law_rows_from,
    points_set_aside_from,
)


def identification_from(found: Identified) -> IdentificationResult:
    """Read the result of `identify` off its fit."""
    r = found.result
    names, v = r.law.names, r.validation
    result = IdentificationResult(
        method=r.method,
        law_kind=r.law.kind,
        parameters=_named(names, r.law.values),
        standard_errors=r.standard_errors,
        correlations=correlations_by_name(names, r.uncertainty),
        points=_points(r, found.sweep),
        points_set_aside=points_set_aside_from(found.given, found.why_aside),
        rms_percent=r.rms_percent,
        max_percent=r.max_percent,
        chi2_per_dof=r.uncertainty.chi2_per_dof if r.chi2_means_something else None,
        noise=r.noise.source,
        leave_one_out_rms_percent=v.leave_one_out_rms_percent,
        held_out=held_out_from(v),
        held_out_rms_percent=v.held_out_rms_percent,
        iterations=int(r.fit.iterations),
        evaluations=int(r.fit.evaluations),
        seconds=found.seconds,
        setup_seconds=found.setup_seconds,
        validation_seconds=found.validation_seconds,
        converged=bool(r.fit.converged),
        criterion_met=r.fit.criterion_met,
        warnings=r.warnings,
        doubts=doubts_among(r.warnings),
        law=law_rows_from(r.band),
        law_known=law_known_from(r.band),
        adjusted=adjusted_from(r.fit.adjusted),
        bend=_bend(r.fit.law),
        posterior=_posterior(r.fit),
        theory_error=_theory(found.theory),
    )
    plate = found.files[0].specimen
    if found.bare is not None and isinstance(plate, PlateSpecimen):
        result = result.but(hammer=_bare_plate(found.bare, plate))
    return with_files(result, found.files, found.why_aside == "", found.aside)


def _bare_plate(bare: BarePlateFit, specimen: PlateSpecimen) -> BarePlateFound:
    young = specimen.substrate.young_pa * bare.young_scale
    return BarePlateFound(
        substrate_young_pa=young,
        substrate_young_standard_error_pa=young * bare.standard_error,
        substrate_young_over_stated=bare.young_scale,
        clamp_percent_of_mode_1=bare.clamp_percent,
        modes=tuple(
            BareMode(measured_hz=m, fitted_hz=f)
            for m, f in zip(bare.measured_hz.tolist(), bare.fitted_hz.tolist(), strict=True)
        ),
        left_out_hz=tuple(bare.left_out_hz),
        modal_ratios=tuple(bare.ratios),
    )


def _named(names: Sequence[str], values: Array) -> dict[str, float]:
    return dict(zip(names, values.tolist(), strict=True))


def _points(r: Identification, sweep: Sweep) -> tuple[PointFitted, ...]:
    columns = (sweep.frequency_hz, sweep.segment, r.measured_m_s, r.predicted_m_s, r.difference_percent)
    return tuple(
        PointFitted(
            frequency_hz=f,
            segment=segment,
            measured_m_s=measured,
            predicted_m_s=predicted,
            difference_percent=difference,
        )
        for f, segment, measured, predicted, difference in zip(*(c.tolist() for c in columns), strict=True)
    )


def _bend(law: CoreLaw) -> Bend | None:
    if not isinstance(law, BentLaw):
        return None
    return Bend(knots_hz=tuple(law.knots_hz), whitened=tuple(np.log(law.bend).tolist()))


def _posterior(fit: Fit) -> PosteriorFound | None:
    C = fit.posterior
    if C is None or not np.isfinite(C).all():
        return None
    names = (*fit.law.names, *(one.name for one in fit.adjusted))
    return PosteriorFound(names=names, rows=tuple(tuple(C[k, : k + 1].tolist()) for k in range(len(names))))


def _theory(theory: TheoryError | None) -> tuple[TheoryErrorRow, ...] | None:
    if theory is None:
        return None
    columns = (theory.frequency_hz, theory.frequency_error, theory.loss_factor_error)
    return tuple(
        TheoryErrorRow(frequency_hz=f, frequency_error=off, loss_factor_error=loss)
        for f, off, loss in zip(*(c.tolist() for c in columns), strict=True)
    )
