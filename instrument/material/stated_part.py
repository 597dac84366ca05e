"""What of a law's error comes of stated numbers, and which numbers those are."""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from instrument.material.knowledge import posterior_of

_DIGITS = 16
"""Of the digest: enough to tell any two specimens of a batch apart."""


class _Stated(BaseModel):
    name: str
    stated: float
    tolerance: float


class _Adjusted(BaseModel):
    adjusted: list[_Stated] = []


def stated_numbers(facts: Mapping[str, Any]) -> str | None:
    """A digest of every stated number and tolerance in the JSON of a fit; None where none has a tolerance.

    Laws of one digest are of specimens that state the same: what is wrong with a number is wrong for all.
    """
    try:
        found = _Adjusted.model_validate(facts).adjusted
    except ValidationError:
        return None
    if not found:
        return None
    said = json.dumps(sorted([one.name, one.stated, one.tolerance] for one in found))
    return hashlib.sha256(said.encode()).hexdigest()[:_DIGITS]


def stated_columns(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Which numbers a fit states, and what they give the errors of G' and of eta, relative, a number a row.

    Of the JSON of `identify` or of a stage of `diagnose`. `storage` and `loss` are None where the fit does
    not say how its errors are made up.
    """
    rows, known = facts["law"], posterior_of(facts)
    f = np.array([row["frequency_hz"] for row in rows], dtype=float)
    part = known.stated_part(f) if known is not None and len(f) else None
    found: dict[str, Any] = {"same": stated_numbers(facts), "storage": None, "loss": None}
    if part is None:
        return found
    eta = np.array([row["loss_factor"] for row in rows], dtype=float)
    return {**found, "storage": part[: len(f)].tolist(), "loss": (part[len(f) :] / eta).tolist()}
