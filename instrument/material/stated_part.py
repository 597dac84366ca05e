"""The stated numbers that a law rests on, and what of its error comes of them."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from fitting.stated.number_names import kind_of
from fitting.stated.tolerances import of_scope
from instrument.material.knowledge import known_curve_of

_DIGITS = 16
"""Of the digest: enough to tell any two specimens of a batch apart."""
_SET_ANEW = of_scope("mounting", "temperature", "file", "spot", "channel", "chain")
"""Kinds of numbers that another measurement of one specimen sets anew: where clamps bite, what they
damp and how they pull, where spots and loose masses are, and the channels. All others are the specimen's own,
or of the theory of it."""


class Stated(BaseModel):
    """One number and its tolerance, in the units of results."""

    model_config = ConfigDict(frozen=True)

    name: str
    stated: float
    tolerance: float


class _Adjusted(BaseModel):
    adjusted: tuple[Stated, ...] = ()


def stated_numbers(facts: Mapping[str, Any]) -> tuple[Stated, ...]:
    """Stated numbers with a tolerance, of the JSON of a fit."""
    try:
        return _Adjusted.model_validate(facts).adjusted
    except ValidationError:
        return ()


def digest_of(stated: Sequence[Stated]) -> str | None:
    """Of every stated number and tolerance; None where none has a tolerance.

    Laws of one digest are of specimens that state the same: what is wrong with a number is wrong for all.
    """
    if not stated:
        return None
    said = json.dumps(sorted([one.name, one.stated, one.tolerance] for one in stated))
    return hashlib.sha256(said.encode()).hexdigest()[:_DIGITS]


def stays_with_the_specimen(name: str) -> bool:
    """Whether a stated number is as wrong in the next measurement of the same specimen."""
    try:
        return kind_of(name) not in _SET_ANEW
    except ValueError:
        return False


def stated_columns(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Which numbers a fit states, and what they give the errors of G' and of eta, relative, a number a row.

    Of the JSON of `identify` or of a stage of `diagnose`. `storage` and `loss` are None where the fit does
    not say how its errors are made up.
    """
    rows, known = facts["law"], known_curve_of(facts)
    f = np.array([row["frequency_hz"] for row in rows], dtype=float)
    found: dict[str, Any] = {"same": digest_of(stated_numbers(facts)), "storage": None, "loss": None}
    if known is None or not len(f):
        return found
    part = known.at(f).stated_part
    eta = np.array([row["loss_factor"] for row in rows], dtype=float)
    return {**found, "storage": part[: len(f)].tolist(), "loss": (part[len(f) :] / eta).tolist()}
