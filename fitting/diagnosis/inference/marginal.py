"""What an explanation is worth: its marginal likelihood, by Laplace's approximation about the fit.

    Z = integral of p(data | law, stated numbers, unknowns) p(law) p(stated numbers) p(unknowns)
      ~ exp(-chi2 / 2) p(where the fit is) (2 pi)^(k/2) det(J^T J)^(-1/2)

So every number that is fitted is paid for by how much narrower the data made it than it was expected to be: a
law free to bend, a place chosen among many, a small gain, by one rule. `cost` is -2 ln Z, without what all
explanations share; the prior probability of the effects themselves is in it.

A number that cannot be negative, and that the data find to be nothing, has half of that integral or less:

    integral over x > 0 of exp(-(x^2 / s^2 + 2 g x) / 2) / (sqrt(2 pi) s) = exp(t^2 / 2) Phi(-t),   t = g s

where g is how fast -ln p rises from the limit and s the width with everything else free.
"""

import numpy as np
from scipy.special import log_ndtr

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.effects.base import Effect, EffectParameter
from fitting.widened.enriched_plate import EnrichedReducedPlate

_TYPICALS = 3.0
"""An unknown whose `spread` is not stated is expected to be of a few typical sizes."""
_UNIFORM = 12.0
"""Variance of a uniform density is its width squared over this."""
_DROWNED = 1e-12
"""Relative: directions that are known less well than this beside others are lost in rounding."""
_AT_A_LIMIT = 0.1
"""Standard deviations from a limit within which a fit is held by it: a bounded fit stops a little before."""


_NO_MISFIT = 1e-300
"""Lower bound of a mean square, so that its logarithm is finite."""


def cost(fitted: Refitted, plate: EnrichedReducedPlate, temper: float = 1.0) -> float:
    """-2 ln of prior times marginal likelihood. Where the noise is unknown its size is integrated too.

    `temper`: how much less the readings say than their noise has it (`predictive.temper`). What is known
    without them, of the effects and of the plate, says what it says.
    """
    law_widths = fitted.law.search_widths
    priors = _priors(fitted, plate)
    densities = np.array([*np.log(1 / (law_widths * np.sqrt(_UNIFORM))), *(density for density, _ in priors)])
    J, r = fitted.jacobian, fitted.residuals
    size = temper * (1.0 if fitted.noise_known else _mean_square(fitted))
    if size != 1.0:
        # Of the readings: what is stated is as well known as it is said.
        J, r = J.copy(), r.copy()
        J[: fitted.data] /= np.sqrt(size)
        r[: fitted.data] /= np.sqrt(size)
    H = J.T @ J
    H += np.diag(prior_precision(fitted, plate))
    k = len(densities)
    paid = log_determinant(H) - k * np.log(2 * np.pi) - 2 * float(densities.sum())
    paid -= 2 * _log_share_within(fitted, plate, H, J.T @ r)
    if temper != 1.0:
        # Readings that say less pull the stated numbers less far: one step towards where they end then.
        back = (1 - 1 / temper) * (J[fitted.data :].T @ r[fitted.data :])
        paid -= float(back @ np.linalg.solve(H, back))
    return _misfit(fitted, temper) + paid + sum(_odds(e) for e in fitted.effects)


def log_determinant(H: Array) -> float:
    """Ln det of a precision, shape (columns, columns); finite also where it is singular in floating point.

    Readings that are met to the last digit drown what priors alone say: then those are worth little.
    """
    found = float(np.linalg.slogdet(H)[1])
    if np.isfinite(found):
        return found
    d = np.sqrt(np.diag(H))
    scaled = H / np.outer(d, d) + _DROWNED * np.eye(len(H))
    return float(np.linalg.slogdet(scaled)[1] + 2 * np.log(d).sum())


def prior_precision(fitted: Refitted, plate: EnrichedReducedPlate) -> Array:
    """What is known of each fitted number without the rows of its Jacobian. Shape (columns,).

    What the data leave open, the prior still bounds: the law's ranges, the effects' expected sizes. A bend,
    the stated numbers and what is tied to another number have rows of their own.
    """
    effects = [width for _, width in _priors(fitted, plate)]
    widths = fitted.law.search_widths
    found = np.zeros(fitted.jacobian.shape[1])
    found[: len(widths)] = 1 / widths**2
    if effects:
        found[-len(effects) :] = 1 / np.array(effects) ** 2
    return found


def _log_share_within(fitted: Refitted, plate: EnrichedReducedPlate, H: Array, slope: Array) -> float:
    """Ln of the share of Laplace's integral that lies within the limits of the effects' unknowns.

    Of those that have a size; each for itself. `slope` is the derivative of -ln p to the fitted numbers.
    Shapes (columns, columns) and (columns,).
    """
    found = 0.0
    # Directions that no reading feels leave H all but singular, in units far apart.
    d = 1 / np.sqrt(np.diag(H))
    C = np.linalg.inv(H * np.outer(d, d) + _DROWNED * np.eye(len(H))) * np.outer(d, d)
    # The effects' unknowns come last among the columns.
    column = len(H) - int(fitted.free[fitted.stated :].sum())
    for effect, part in fitted.each():
        lower, upper = effect.limits(plate)
        for k, (q, value, free) in enumerate(
            zip(effect.parameters, fitted.u[part], fitted.free[part], strict=True)
        ):
            if not free:
                continue
            if q.neutral is not None and np.isfinite(q.neutral):
                s = float(np.sqrt(C[column, column]))
                least, u, most = (_as_fitted(q, x) for x in (lower[k], value, upper[k]))
                low, high = (u - least) / s, (most - u) / s
                away = float(slope[column]) * (1.0 if low < high else -1.0) * s
                # Within the limits a slope is only what the fit left undone.
                t = max(away, 0.0) if min(low, high) < _AT_A_LIMIT else 0.0
                found += t**2 / 2 + float(log_ndtr(min(low, high) - t))
            column += 1
    return found


def _as_fitted(q: EffectParameter, u: float) -> float:
    return float(np.log(u) if q.logarithmic else u)


def _misfit(fitted: Refitted, temper: float) -> float:
    r, priors = fitted.residuals[: fitted.data], fitted.residuals[fitted.data :]
    if fitted.noise_known:
        return fitted.chi2 if temper == 1.0 else float(r @ r) / temper + float(priors @ priors)
    size = _mean_square(fitted)
    # With the likeliest size of the noise r^2/size is the number of data, alike for all; not with the least.
    return (fitted.data * float(np.log(size)) + float(r @ r) / size - fitted.data) / temper + float(
        priors @ priors
    )


def _mean_square(fitted: Refitted) -> float:
    """Of what the readings leave, or the least that is supposed of them."""
    r = fitted.residuals[: fitted.data]
    return max(float(r @ r) / max(1, fitted.data), fitted.least_scale, _NO_MISFIT)


def _odds(effect: Effect) -> float:
    """-2 ln of the odds that a set-up has it."""
    return -2 * float(np.log(effect.chance / (1 - effect.chance)))


def _priors(fitted: Refitted, plate: EnrichedReducedPlate) -> list[tuple[float, float]]:
    """Ln density and width, as `_prior` has them, of every fitted unknown of the effects."""
    found = []
    for effect, part in fitted.each():
        lower, upper = effect.limits(plate)
        tied = {tie.other: tie.sigma for tie in effect.ties}
        u, free = fitted.u[part], fitted.free[part]
        for k, q in enumerate(effect.parameters):
            if free[k] and k in tied:
                # Normal about another one; how far off it is, is in its row, and so is its width.
                found.append((-float(np.log(tied[k] * np.sqrt(2 * np.pi))), np.inf))
            elif free[k]:
                found.append(_prior(q, float(lower[k]), float(upper[k]), float(u[k])))
    return found


def _prior(q: EffectParameter, lower: float, upper: float, u: float) -> tuple[float, float]:
    """Ln density where the fit is, and the prior's width, both as the unknown is fitted."""
    if q.logarithmic:
        width = np.log(upper / lower)
        return float(-np.log(width)), float(width / np.sqrt(_UNIFORM))
    if q.neutral is None:
        width = upper - lower
        return float(-np.log(width)), float(width / np.sqrt(_UNIFORM))
    # Cauchy's: most are small, some are not, and no size is ruled out.
    s = expected_size(q)
    share = q.below if u < q.neutral else 1 - q.below
    sides = 2 * share if lower < q.neutral < upper else 2
    return float(np.log(sides / (np.pi * s * (1 + ((u - q.neutral) / s) ** 2)))), s


def expected_size(q: EffectParameter) -> float:
    """How large an unknown with a neutral value is expected to be, in its unit."""
    return q.spread or _TYPICALS * q.typical


def probabilities(costs: Array) -> Array:
    """Of explanations from their costs, one of them being right. Shape of `costs`."""
    relative = np.exp(-(costs - costs.min()) / 2)
    return np.asarray(relative / relative.sum())
