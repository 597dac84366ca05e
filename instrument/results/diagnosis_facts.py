"""A diagnosis as JSON holds it; tables and figures are made of nothing else."""

from typing import Any

import numpy as np

from fitting.diagnosis.result import Candidate, FoundEffect, Stage
from fitting.noise import noise_of
from fitting.sweep import Sweep
from instrument.models.diagnosis import Diagnosed
from instrument.results.identification_facts import adjusted_facts, held_out_facts, law_facts


def diagnosis_facts(found: Diagnosed, sweep: Sweep) -> dict[str, Any]:
    """The JSON of `diagnose`; `sweep` is the whole one that was diagnosed."""
    r = found.result
    return {
        "verdict": r.verdict,
        "effects": [
            {"name": e.name, "parameters": _parameters(e), "probability": e.probability}
            # One that is both seen in a channel and fitted is listed once, as fitted.
            for e in (*r.effects, *(c for c in r.channels if c.name not in {a.name for a in r.effects}))
        ],
        "equivalent": {name: list(group) for name, group in r.equivalent.items()},
        "candidates": [
            {
                "name": c.name,
                "delta_bic": c.delta_cost,
                "probability": c.probability,
                "chi2_per_dof": c.chi2_per_dof,
                "parameters": _all_parameters(c),
                "law": law_facts(c.law) if c.law is not None else [],
                "checks": dict(c.checks),
            }
            for c in r.candidates
        ],
        "before": _stage(r.before),
        "after": _stage(r.after),
        "adjusted": adjusted_facts(r.after.adjusted),
        "p_value": r.p_value,
        "nested_held_out_rms_percent": r.nested_held_out_rms_percent,
        "next_measurement": r.next_measurement,
        "explanation": list(r.explanation),
        "warnings": list(r.warnings),
        "by_hand": r.by_hand,
        "points": _points(sweep.take(r.used), r.before, r.after),
        "set_aside_hz": sweep.frequency_hz[~r.used].tolist(),
        "seconds": found.seconds,
        "setup_seconds": found.setup_seconds,
    }


def _parameters(effect: FoundEffect) -> dict[str, dict[str, Any]]:
    return {
        key: {"value": p.value, "standard_error": p.standard_error, "unit": p.unit}
        for key, p in effect.parameters.items()
    }


def _all_parameters(candidate: Candidate) -> dict[str, dict[str, Any]]:
    """Of two effects together, each key with its effect's name before it: both may have a `scale`."""
    if len(candidate.effects) == 1:
        return _parameters(candidate.effects[0])
    return {f"{e.name}.{key}": p for e in candidate.effects for key, p in _parameters(e).items()}


def _stage(s: Stage) -> dict[str, Any]:
    v = s.validation
    one_by_one = v.leave_one_out_rms_percent
    return {
        "rms_percent": s.rms_percent,
        "max_percent": s.max_percent,
        "chi2_per_dof": s.chi2_per_dof,
        "held_out": held_out_facts(v),
        # The error on data not seen, whichever way it was found.
        "held_out_rms_percent": v.held_out_rms_percent if one_by_one is None else one_by_one,
        "leave_one_out_rms_percent": one_by_one,
        "law_kind": s.law.kind,
        "parameters": dict(zip(s.law.names, s.law.values.tolist(), strict=True)),
        "standard_errors": dict(s.standard_errors),
        "law": law_facts(s.band),
        "structure": list(s.structure),
        "adjusted": adjusted_facts(s.adjusted),
    }


def _points(sweep: Sweep, before: Stage, after: Stage) -> list[dict[str, Any]]:
    """What either fit leaves of every point in use."""
    noise = noise_of(sweep)
    size = np.abs(sweep.response_m_s)
    noise_percent = 100 * noise.std_m_s / size if noise.is_known else np.full(len(sweep), np.nan)
    rows = zip(
        sweep.frequency_hz,
        sweep.segment,
        sweep.sweep,
        sweep.commanded_m_s2,
        noise_percent,
        _residuals(sweep, before),
        _residuals(sweep, after),
        strict=True,
    )
    keys = ("frequency_hz", "segment", "sweep", "level_m_s2", "noise_percent", "before", "after")
    return [dict(zip(keys, row, strict=True)) for row in rows]


def _residuals(sweep: Sweep, stage: Stage) -> list[dict[str, Any]]:
    """100 (predicted / measured - 1): its real part is amplitude, its imaginary part phase to first order."""
    whitened = stage.whitened.reshape(-1, len(sweep)).T.tolist()
    if not sweep.has_phase:
        return [
            {"amplitude_percent": d, "whitened": z}
            for d, z in zip(stage.difference_percent, whitened, strict=True)
        ]
    rest = 100 * (stage.predicted_m_s / sweep.response_m_s - 1)
    return [
        {"amplitude_percent": d, "re_percent": e.real, "im_percent": e.imag, "whitened": z}
        for d, e, z in zip(stage.difference_percent, rest, whitened, strict=True)
    ]
