"""Chances of the normal, chi-square and F distributions, by the special functions behind `scipy.stats`.

The same numbers; but loading `scipy.stats` would be a sixth of the start of every command, engine and window.
"""

from typing import Any

import numpy as np
from scipy.special import bdtrc, chdtrc, chdtri, fdtrc, gammaincinv, gammaln, ndtr, ndtri, xlogy


def normal_above(z: Any) -> Any:
    """P(Z > z) of a standard normal Z. A number or an array of any shape."""
    return ndtr(-z)


def normal_exceeded(chance: Any) -> Any:
    """What Z exceeds with this chance: the inverse of `normal_above`."""
    return -ndtri(chance)


Z_95 = float(normal_exceeded(0.025))
"""Standard errors to either side that hold a normal value in 95 of 100."""


def chi2_above(x: Any, freedom: Any) -> Any:
    """P(X > x) of a chi-square X; NaN without a degree of freedom. Numbers or arrays that broadcast."""
    return np.where(np.asarray(freedom) > 0, chdtrc(freedom, np.maximum(x, 0.0)), np.nan)[()]


def chi2_exceeded(chance: Any, freedom: Any) -> Any:
    """What X exceeds with this chance: the inverse of `chi2_above`."""
    return chdtri(freedom, chance)


def chi2_median(freedom: Any) -> Any:
    """What half of all X exceed."""
    return 2 * gammaincinv(np.asarray(freedom) / 2, 0.5)


def chi2_density(x: Any, freedom: Any) -> Any:
    """Of a chi-square at x. Numbers or arrays that broadcast."""
    half = np.asarray(freedom) / 2
    return np.exp(xlogy(half - 1, x) - x / 2 - gammaln(half) - half * np.log(2))


def f_above(x: Any, above: Any, below: Any) -> Any:
    """P(X > x) of Fisher's F, the ratio of two variances with degrees of freedom `above` and `below`.

    Numbers or arrays that broadcast.
    """
    return fdtrc(above, below, np.maximum(x, 0.0))


def binomial_above(count: Any, tries: Any, share: Any) -> Any:
    """P(X > count) of how many of some tries succeed, each with this chance. Numbers or arrays."""
    return bdtrc(count, tries, share)
