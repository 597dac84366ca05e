"""How well a law's curve is known as a whole, and what of it another measurement would be off by too.

With y = (ln G' at the frequencies, then eta), C the covariance of all that was fitted and J what y does when
that moves, y has the covariance J C J^T. A stated number enters the fit as a reading of unit width, of slope
1 to its own unknown z: what a stated number is wrong by reaches y by J C e_z. Two laws of one specimen have
that in common. A bend's whitened values enter likewise, by a prior towards none.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, log

import numpy as np
from scipy.interpolate import CubicSpline

from fitting.arrays import Array
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw

_FEWEST = 9
"""Frequencies of a curve."""
_APART = 0.5
"""In ln f between two of them, at most: half of what a law's bend goes on over, so that a spline through them
is near enough."""


@dataclass(frozen=True)
class KnownCurve:
    """Of ln G' at the frequencies, then of eta: the rows of every array, 2 frequencies of them."""

    frequency_hz: Array
    """Ascending. Shape (frequencies,)."""
    covariance: Array
    """Shape (2 frequencies, 2 frequencies)."""
    of_another_measurement: Array
    """How far curves scatter that are measured of one law: the same, less what its bend's prior leaves.

    A fit draws its bend towards none, in two measurements of one law by as much. With F what data say and L
    what is known beforehand C = (F + L)^-1, and estimates scatter by C F C = C - C L C. Shape of
    `covariance`.
    """
    by_stated: Array
    """What a stated number's tolerance passes on, signed. Shape (2 frequencies, stated numbers)."""
    stated: tuple[str, ...] = ()
    """Names of the stated numbers."""

    def at(self, frequency_hz: Array) -> "KnownCurve":
        """At frequencies inside the range, in any order. Shape (frequencies,)."""
        x = np.log(self.frequency_hz)
        # A band's own edge may round to just outside it.
        at = np.clip(np.log(frequency_hz), x[0], x[-1])
        W = np.kron(np.eye(2), CubicSpline(x, np.eye(len(x)))(at))
        return replace(
            self,
            frequency_hz=frequency_hz,
            covariance=W @ self.covariance @ W.T,
            of_another_measurement=W @ self.of_another_measurement @ W.T,
            by_stated=W @ self.by_stated,
        )

    def wider_by(self, more: Array) -> "KnownCurve":
        """Known so much worse. `more` of the shape of `covariance`."""
        return replace(
            self,
            covariance=self.covariance + more,
            of_another_measurement=self.of_another_measurement + more,
        )

    def passed_on(self, names: Sequence[str]) -> Array:
        """By these of its stated numbers. Shape (2 frequencies, names)."""
        return self.by_stated[:, [self.stated.index(name) for name in names]]

    @property
    def stated_part(self) -> Array:
        """The part of each error that stated numbers make. Shape (2 frequencies,)."""
        return np.asarray(np.linalg.norm(self.by_stated, axis=1))


def known_curve(
    law: CoreLaw, covariance: Array, stated: Sequence[str], low_hz: float, high_hz: float
) -> KnownCurve | None:
    """From low to high, logarithmic in frequency; None where the covariance is not known.

    `covariance` is of the law's log parameters, then of the stated numbers in their tolerances, and of
    whatever else comes after these. Shape (at least those, the same).
    """
    n, count = len(law.names), len(stated)
    C = covariance[: n + count, : n + count]
    if not np.isfinite(C).all() or not low_hz < high_hz:
        return None
    reached = limits_reached(law)
    # What sits at an upper limit has no first-order error of its own.
    free = np.array([reached.get(name) != "upper" for name in law.names])
    f = np.geomspace(low_hz, high_hz, max(_FEWEST, 1 + ceil(log(high_hz / low_hz) / _APART)))
    J = _slopes(law, f) * free
    whole, by_bend = J @ C[:n, :n] @ J.T, J @ C[:n, n - law.bend_count : n]
    return KnownCurve(f, whole, whole - by_bend @ by_bend.T, J @ C[:n, n:], tuple(stated))


def known_of_mixture(curves: Sequence[Array], known: Sequence[KnownCurve], shares: Array) -> KnownCurve:
    """Over several explanations of the same stated numbers; `shares` of shape (explanations,).

    `curves` are each one's ln G', then eta. Where they disagree the curve is known so much worse, and so may
    be another measurement's.
    """
    off = (np.array(curves) - shares @ np.array(curves)) * np.sqrt(shares)[:, None]
    apart = off.T @ off

    def mean(name: str) -> Array:
        return np.tensordot(shares, np.array([getattr(one, name) for one in known]), 1)

    return replace(
        known[0],
        covariance=mean("covariance") + apart,
        of_another_measurement=mean("of_another_measurement") + apart,
        by_stated=mean("by_stated"),
    )


def _slopes(law: CoreLaw, frequency_hz: Array) -> Array:
    """Of ln G', then of eta, to the logarithms. Shape (2 frequencies, law's numbers)."""
    omega = 2 * np.pi * frequency_hz
    storage, eta = law.storage_and_loss(omega)
    by = law.jacobian(omega) * law.values[:, None]
    return np.concatenate([by.real / storage, (by.imag - eta * by.real) / storage], axis=1).T
