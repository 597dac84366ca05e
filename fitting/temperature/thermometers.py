"""Whether the stated temperatures go with what the sweeps say: a wrong one is no fault of the material.

Each sweep may be given a factor of its own. Where one law then serves, the material is simple, and the form
or a temperature is not as stated; the form through the other sweeps says which one, and what it should be.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq, least_squares

from fitting.arrays import Array
from fitting.numerics.chances import chi2_above
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.shifts import Shift

_APART_K = 1e-6
"""Between sweeps of one stated temperature, so that each has a factor of its own; nothing measures it."""
_REFUSED, _AGREED = 1e-3, 1e-2
"""Tail probabilities: below the first temperatures do not go together, above the second they do."""
_NEAR = 6.0
"""In chi-square, a ratio of twenty: what leaves so nearly as little may be the wrong one as well."""
_LEAST_K = 0.1
"""Below this a factor is not read finer than a thermometer: what exact temperatures are taken for here."""
_FAR_K = 150.0
"""How far from the stated one a temperature is looked for."""


@dataclass(frozen=True)
class Misread:
    """A sweep whose temperature is not that of the others."""

    sweep: int
    stated_c: float
    read_c: float
    """Where the form through the other sweeps has its factor; NaN where it has it nowhere."""
    further: int = 0
    """How many more were stated at that temperature, and were not at it either."""
    rivals: tuple["Misread", ...] = ()
    """Others, any one of which may be the wrong one instead; the likeliest first."""


def each_its_own(shift: Shift) -> Shift:
    """Free factors, one for every sweep even where two are stated at one temperature."""
    T = shift.temperature_c
    return Shift("free", T + _APART_K * np.arange(len(T)), shift.reference_c, shift.error_k)


def misread(form: Shift, own: ShiftedFit) -> Misread | None:
    """The one sweep without which all others follow the form, or few; else those of one temperature.

    `own` is of `each_its_own`. None where leaving out any of most of them would do.
    """
    log_a, errors = own.log_shift, own.sweeps_log_shift_errors
    if form.kind == "free" or _chance(form, log_a, errors, range(len(log_a)))[0] >= _REFUSED:
        return None
    T = form.temperature_c
    alone = [[k] for k in range(len(T))]
    alike = [its for t in np.unique(T) if len(its := np.flatnonzero(t == T).tolist()) > 1]
    for groups in (alone, alike):
        each = [(*_chance(form, log_a, errors, _without(T, its)), its) for its in groups]
        agreed = sorted((chi2, its) for chance, chi2, its in each if chance >= _AGREED)
        found = [its for chi2, its in agreed if chi2 < agreed[0][0] + _NEAR]
        if found and (len(found) == 1 or len(found) <= len(groups) / 2):
            first, *others = (_misread(form, log_a, errors, its) for its in found)
            return replace(first, rivals=tuple(others))
    return None


def off_any_curve(free: ShiftedFit) -> Misread | None:
    """Of free factors the one without which all others lie on a WLF curve; None where all do, or none.

    No form was asked for: this is how a wrong temperature, the reference's among them, shows all the same.
    """
    shift = free.shift
    if shift.kind != "free":
        return None
    return misread(Shift("wlf", shift.temperature_c, shift.reference_c, shift.error_k), free)


def _misread(form: Shift, log_a: Array, errors: Array, its: list[int]) -> Misread:
    """Sweeps of one stated temperature, and where the form through the others has them."""
    T = form.temperature_c
    read = np.mean([_read(form, log_a, errors, _without(T, its), k) for k in its])
    return Misread(its[0], float(T[its[0]]), float(read), len(its) - 1)


def _without(temperature_c: Array, its: list[int]) -> list[int]:
    return [k for k in range(len(temperature_c)) if k not in its]


def rising(shift: Shift, log_a: Array, errors: Array | float = 0.0) -> tuple[float, float] | None:
    """Two neighbouring temperatures of which the warmer one has the larger factor, by more than both errors.

    `log_a` and `errors` of shape (sweeps,).
    """
    order, by = np.argsort(shift.temperature_c, kind="stable"), np.broadcast_to(errors, log_a.shape)
    for one, two in pairwise(order):
        apart = np.hypot(by[one], by[two])
        if shift.temperature_c[one] < shift.temperature_c[two] and log_a[two] - log_a[one] > apart:
            return float(shift.temperature_c[one]), float(shift.temperature_c[two])
    return None


def _chance(form: Shift, log_a: Array, errors: Array, sweeps: Sequence[int]) -> tuple[float, float]:
    """That the form scatters so about factors of some sweeps, and chi-square; NaN where it fits any."""
    at = list(sweeps)
    dof = len(at) - len(form.names) - 1
    if dof < 1:
        return float("nan"), float("nan")
    _, _, chi2 = _through(form, log_a, errors, at)
    return float(chi2_above(chi2, dof)), chi2


def _through(form: Shift, log_a: Array, errors: Array, at: list[int]) -> tuple[Array, float, float]:
    """The form nearest to the factors of some sweeps: parameters, a common offset, chi-square."""
    T, s, low, high = form.temperature_c[at], form.scales, form.lowest, form.highest
    few = Shift(form.kind, T, form.reference_c)

    def residuals(q: Array, sigma: Array) -> Array:
        return np.asarray((few.log_shift(q[:-1] * s, T) + q[-1] - log_a[at]) / sigma)

    q = np.append(np.clip(few.near(log_a[at]), low, high) / s, 0.0)
    limits = np.append(low / s, -np.inf), np.append(high / s, np.inf)
    sigma = np.ones(len(at))
    for _ in range(2):
        fit = least_squares(residuals, np.clip(q, *limits), bounds=limits, args=(sigma,))
        q = fit.x
        by_k = few.by_temperature(q[:-1] * s, T)
        sigma = np.hypot(errors[at], by_k * max(form.error_k, _LEAST_K))
    fit = least_squares(residuals, q, bounds=limits, args=(sigma,))
    return fit.x[:-1] * s, float(fit.x[-1]), 2 * float(fit.cost)


def _read(form: Shift, log_a: Array, errors: Array, others: list[int], k: int) -> float:
    p, offset, _ = _through(form, log_a, errors, others)

    def off(t: float) -> float:
        return float(form.log_shift(p, np.array([t]))[0] + offset - log_a[k])

    stated = float(form.temperature_c[k])
    low = stated - _FAR_K
    if form.kind == "wlf":
        low = max(low, form.reference_c - float(p[1]) + 1.0)
    high = stated + _FAR_K
    if off(low) * off(high) > 0:
        return float("nan")
    return float(brentq(off, low, high, xtol=1e-3))
