"""A result whose numbers cannot be of one fit: edited, or put together from two units."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.errors import FittingError
from instrument.errors import BadInput
from instrument.material.formula import formula, limits

_APART = 30.0
"""Times, median over the rows, between a law and its formula. Of 1200 results, failed fits among them, the
furthest bend was one of 7; the least unit that is mistaken is one of 1000."""
_LOSSIEST = 10.0
"""Median over the rows: the largest loss factor that laws take (`fitting.laws`); fits have up to 4."""
_LOSSY = 1.0
"""Less is not asked about, however far above its formula: a bend may add that much to nearly nothing."""
_ROUNDED = 1e-6
"""Relative: a parameter at its limit, written with few digits."""
_MISTAKEN = {1e-6: "MPa", 1e-3: "kPa", 1e-9: "GPa"}
"""Times what is expected, of moduli in another unit."""
_SAME_UNIT = 1.5
"""Times, that bends leave between a law and its formula, median over the rows, but for failed fits."""
_WHOLE = "expected a result as 'viscorig identify' or 'viscorig diagnose' wrote it"


def refuse_contradictions(
    path: Path, kind: str, parameters: Mapping[str, float], rows: tuple[Array, Array, Array, Array]
) -> None:
    """Raise `BadInput` where the parameters are none of such a law, or the rows are not of this law.

    `rows`: frequency in Hz, G' in Pa, loss factor, standard error of G' in Pa, shape (frequencies,) each.
    """
    frequency_hz, storage, loss, storage_error = rows
    _check_limits(path, kind, parameters)
    if np.all(storage_error == 0):
        raise BadInput(
            f"{path}: storage_modulus_standard_error_pa is 0 in all rows, no fit knows a law exactly: "
            "expected its errors, or null where they are not known"
        )
    try:
        G = formula(kind, parameters).modulus(2 * np.pi * frequency_hz)
    except (FittingError, LookupError, TypeError, ValueError):
        # Of a kind with more than parameters, or of a package that is not there: nothing to go by.
        G = None
    typical = float(np.median(np.abs(loss)))
    most = _LOSSIEST if G is None else min(_LOSSIEST, _APART * float(np.median(np.abs(G.imag / G.real))))
    if typical > max(_LOSSY, most):
        raise BadInput(
            f"{path}: loss_factor is {typical:.3g} (median), no core has so much: is it in percent?"
        )
    if G is None:
        return
    times = float(np.median(storage / np.abs(G.real)))
    if not 1 / _APART < times < _APART:
        unit = next((u for at, u in _MISTAKEN.items() if 1 / _SAME_UNIT < times / at < _SAME_UNIT), None)
        what = f"is it in {unit}?" if unit else _WHOLE
        raise BadInput(
            f"{path}: storage_modulus_pa is {times:.2g} times (median) what the parameters of this {kind} "
            f"give: {what}"
        )


def _check_limits(path: Path, kind: str, parameters: Mapping[str, float]) -> None:
    for key, quantity in limits(kind, parameters).items():
        value = parameters[key]
        low, high = quantity.lower, quantity.upper
        if not quantity.holds(value) and not low * (1 - _ROUNDED) <= value <= high * (1 + _ROUNDED):
            raise BadInput(
                f"{path}: parameters.{key} = {value:g}, a {kind} has {low:g} to {high:g}: {_WHOLE}"
            )
