"""A diagnosis's result, read off what it found."""

import numpy as np

from fitting.data.noise import noise_of
from fitting.diagnosis.verdict.result import Candidate, FoundEffect, Stage
from fitting.identification.doubt import doubts_among
from fitting.sweep import Sweep
from instrument.facts.diagnosis import (
    CandidateFitted,
    DiagnosisResult,
    EffectFound,
    ParameterFound,
    PointLeft,
    Residual,
    StageFitted,
)
from instrument.finding.diagnosis import Diagnosed
from instrument.results.of_files import with_files
from instrument.results.rows_from import (
    adjusted_from,
    held_out_from,
    law_known_from,
    law_rows_from,
    points_set_aside_from,
)


def diagnosis_from(found: Diagnosed) -> DiagnosisResult:
    """Read the result of `diagnose` off what it found."""
    r, sweep = found.result, found.sweep
    fitted = {effect.name for effect in r.effects}
    result = DiagnosisResult(
        verdict=r.verdict,
        effects=tuple(
            EffectFound(name=e.name, parameters=parameters_from(e), probability=e.probability)
            # One that is both seen in a channel and fitted is listed once, as fitted.
            for e in (*r.effects, *(c for c in r.channels if c.name not in fitted))
        ),
        equivalent=dict(r.equivalent),
        candidates=tuple(candidate_from(c) for c in r.candidates),
        before=_stage(r.before),
        after=_stage(r.after),
        adjusted=adjusted_from(r.after.adjusted),
        p_value=r.p_value,
        resamples=r.resamples,
        nested_held_out_rms_percent=r.nested_held_out_rms_percent,
        next_measurement=r.next_measurement,
        explanation=r.explanation,
        warnings=r.warnings,
        doubts=doubts_among(r.warnings),
        by_hand=r.by_hand,
        points=_points(sweep.take(r.used), r.before, r.after),
        points_set_aside=points_set_aside_from(sweep, r.why_aside),
        set_aside_hz=tuple(sweep.frequency_hz[~r.used].tolist()),
        seconds=found.seconds,
        setup_seconds=found.setup_seconds,
    )
    return with_files(result, found.files, r.used, found.aside)


def candidate_from(c: Candidate) -> CandidateFitted:
    """One row of the ranking."""
    return CandidateFitted(
        name=c.name,
        delta_bic=c.delta_cost,
        probability=c.probability,
        chi2_per_dof=c.chi2_per_dof,
        parameters=_all_parameters(c),
        law=law_rows_from(c.law) if c.law is not None else (),
        checks=dict(c.checks),
    )


def parameters_from(effect: FoundEffect) -> dict[str, ParameterFound]:
    """Of an effect, by key."""
    return {
        key: ParameterFound(value=p.value, standard_error=p.standard_error, unit=p.unit)
        for key, p in effect.parameters.items()
    }


def _all_parameters(candidate: Candidate) -> dict[str, ParameterFound]:
    """Of two effects together, each key with its effect's name before it: both may have a `scale`."""
    if len(candidate.effects) == 1:
        return parameters_from(candidate.effects[0])
    return {f"{e.name}.{key}": p for e in candidate.effects for key, p in parameters_from(e).items()}


def _stage(s: Stage) -> StageFitted:
    v = s.validation
    one_by_one = v.leave_one_out_rms_percent
    return StageFitted(
        rms_percent=s.rms_percent,
        max_percent=s.max_percent,
        chi2_per_dof=s.chi2_per_dof,
        held_out=held_out_from(v),
        held_out_rms_percent=v.held_out_rms_percent if one_by_one is None else one_by_one,
        leave_one_out_rms_percent=one_by_one,
        law_kind=s.law.kind,
        parameters=dict(zip(s.law.names, s.law.values.tolist(), strict=True)),
        standard_errors=dict(s.standard_errors),
        correlations=s.correlations,
        law=law_rows_from(s.band),
        law_known=law_known_from(s.band),
        structure=s.structure,
        adjusted=adjusted_from(s.adjusted),
    )


def _points(sweep: Sweep, before: Stage, after: Stage) -> tuple[PointLeft, ...]:
    """What either fit leaves of every point in use."""
    noise = noise_of(sweep)
    size = np.abs(sweep.response_m_s)
    noise_percent = 100 * noise.std_m_s / size if noise.is_known else np.full(len(sweep), np.nan)
    columns = (sweep.frequency_hz, sweep.segment, sweep.sweep, sweep.commanded_m_s2, noise_percent)
    rows = zip(
        *(column.tolist() for column in columns),
        _residuals(sweep, before),
        _residuals(sweep, after),
        strict=True,
    )
    return tuple(
        PointLeft(
            frequency_hz=f,
            segment=segment,
            sweep=number,
            level_m_s2=level,
            noise_percent=percent,
            before=one,
            after=other,
        )
        for f, segment, number, level, percent, one, other in rows
    )


def _residuals(sweep: Sweep, stage: Stage) -> list[Residual]:
    """100 (predicted / measured - 1): its real part is amplitude, its imaginary part phase to first order."""
    whitened = [tuple(parts) for parts in stage.whitened.reshape(-1, len(sweep)).T.tolist()]
    differences = stage.difference_percent.tolist()
    if not sweep.has_phase:
        return [Residual(amplitude_percent=d, whitened=z) for d, z in zip(differences, whitened, strict=True)]
    rest = (100 * (stage.predicted_m_s / sweep.response_m_s - 1)).tolist()
    return [
        Residual(amplitude_percent=d, re_percent=e.real, im_percent=e.imag, whitened=z)
        for d, e, z in zip(differences, rest, whitened, strict=True)
    ]
