"""A core found band by band, and whether it is a causal one, as JSON holds them."""

from typing import Any

import numpy as np

from fitting.kramers_kronig import KramersKronig
from fitting.pointwise import PointwiseLaw
from instrument.models.pointwise import Pointwise


def second_look_facts(found: Pointwise) -> dict[str, object]:
    """For the JSON of `identify`."""
    causal = kramers_kronig_facts(found.causal) if found.causal is not None else None
    return {"pointwise": pointwise_facts(found.law), "kramers_kronig": causal}


def pointwise_facts(found: PointwiseLaw) -> list[dict[str, Any]]:
    """A row a band: G' and eta with their standard errors, null where nothing was found, and why."""
    columns = {
        "frequency_hz": found.frequency_hz,
        "storage_modulus_pa": found.storage_modulus_pa,
        "loss_factor": found.loss_factor,
        "storage_modulus_standard_error_pa": found.storage_modulus_standard_error_pa,
        "loss_factor_standard_error": found.loss_factor_standard_error,
    }
    rows = zip(*columns.values(), found.points, found.determined, found.reasons, strict=True)
    return [
        {
            **{name: _number(value) for name, value in zip(columns, numbers, strict=True)},
            "points": int(points),
            "determined": bool(determined),
            "reason": reason or None,
        }
        for *numbers, points, determined, reason in rows
    ]


def kramers_kronig_facts(causal: KramersKronig) -> dict[str, Any]:
    """The test and its sentence."""
    return {
        "consistent": causal.consistent,
        "p_value": _number(causal.p_value),
        "chi2_per_dof": _number(causal.chi2_per_dof),
        "bands": len(causal.frequency_hz),
        "words": causal.words,
    }


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
