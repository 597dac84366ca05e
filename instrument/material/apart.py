"""Which specimen of a group is not like the others: each one's law against the mean of all others.

What the others' spread may be is weighed by how well it fits them and by what is usual: of three that happen
to lie together a spread of a few percent is as likely as none. The chance of lying so far off is the normal
one for each spread, averaged by these weights. It has the long tail of Student's t where others are few and
their errors small, and takes what is known of each row's own error for known. Chances at all frequencies, of
G' and of eta, are joined by their Cauchy combination (Liu and Xie, J. Am. Stat. Assoc. 115, 2020), which
holds however they go together.
"""

import numpy as np

from fitting.arrays import Array
from fitting.numerics.chances import normal_above

FEWEST_APART = 4
"""Specimens: of three any one is as far from the others as they are from it."""
LEVEL_APART = 0.02
"""Of the p-value below which a specimen is named: one honest group in fifty. A choice between crying wolf and
what four specimens can tell: one 26 % off three that are known to 3 % has 0.007."""
USUAL_SPREAD = 0.03
"""Scale of a half Cauchy distribution: half of all groups of one material are taken to spread by less than
3 %, a fifth by more than 9 %. A choice, for cut specimens of one sheet; others who scatter overrule it."""
_SPREADS = np.geomspace(1e-4, 3.0, 161)
"""Relative standard deviations averaged over: steps of 7 %, far finer than any likelihood here is narrow."""
_NO_NEWS = 0.9
"""A chance above it says no less than this one: at 1 the combination would be drowned by it."""


def p_values(curves: Array, errors: Array) -> Array:
    """Chance that any of an honest group lies so far off as this specimen does. Shape (specimens,).

    `curves` are logarithms at several frequencies with their standard errors, shape (specimens, columns)
    both. NaN for fewer than four specimens.
    """
    count = len(curves)
    if count < FEWEST_APART:
        return np.full(count, np.nan)
    each = np.array([_of_column(y, e) for y, e in zip(curves.T, errors.T, strict=True)])
    likely = np.mean(1 / np.tan(np.pi * np.clip(each, 1e-300, _NO_NEWS)), axis=0)
    return np.minimum(1.0, count * np.arctan2(1.0, likely) / np.pi)


def means_of_others(curves: Array, errors: Array, spread: Array) -> Array:
    """Of every specimen the mean of all others, by their errors and the spread. Shape (specimens, columns).

    `curves` and `errors` as above, `spread` of shape (columns,).
    """
    w = 1 / (errors**2 + spread**2)
    return np.asarray((np.sum(w * curves, axis=0) - w * curves) / (np.sum(w, axis=0) - w))


def _of_column(y: Array, error: Array) -> Array:
    """Chance of every specimen at one frequency, two-sided. Shape (specimens,) all."""
    y = y - np.median(y)
    w = 1 / (error**2 + _SPREADS[:, None] ** 2)
    others = np.sum(w, axis=1, keepdims=True) - w
    mean = (np.sum(w * y, axis=1, keepdims=True) - w * y) / others
    logs = np.sum(np.log(w), axis=1, keepdims=True) - np.log(w)
    squares = np.sum(w * y**2, axis=1, keepdims=True) - w * y**2 - others * mean**2
    # In the logarithm of the spread, in which the steps are equal.
    usual = np.log(_SPREADS) - np.log1p((_SPREADS / USUAL_SPREAD) ** 2)
    fits = usual[:, None] + 0.5 * (logs - np.log(others) - squares)
    weights = np.exp(fits - np.max(fits, axis=0))
    z = np.abs(y - mean) / np.sqrt(1 / w + 1 / others)
    return np.asarray(np.sum(weights * 2 * normal_above(z), axis=0) / np.sum(weights, axis=0))
