"""A Prony series that has a given complex modulus over a band.

G*(omega) = G_inf + sum_k G_k i omega tau_k / (1 + i omega tau_k), every modulus zero or more: relaxation
times are evenly spaced on a logarithmic scale, moduli are found by non-negative least squares on the error
relative to |G*|. Few terms: their number grows until the error over the band is as wanted.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.optimize import nnls

from fitting.arrays import Array, Complex

MOST_TERMS = 20
"""A bound: the card says what error is left."""
_REACHES = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0)
"""How far relaxation times go beyond the band's edges: what lies outside shows inside."""
_POINTS = 200
"""Of the band, in the logarithm: the largest error is looked for at them."""
_FEW_POINTS, _FEW_TIMES, _FEW_REACH = 40, 14, 30.0
"""Of a series that is only a beginning: a grid of some three relaxation times a decade, a decade and a half
beyond the band's edges."""


@dataclass(frozen=True)
class Prony:
    """A generalised Maxwell solid and how well it stands for a law over a band."""

    g_inf_pa: float
    """Long-time modulus."""
    g_pa: Array
    tau_s: Array
    max_error: float
    """Largest |G*_series / G* - 1| over the band."""
    rms_error: float

    @property
    def g_0_pa(self) -> float:
        """Instantaneous modulus."""
        return self.g_inf_pa + float(np.sum(self.g_pa))

    @property
    def shares(self) -> Array:
        """G_k over the instantaneous modulus: their sum is below one. Shape (terms,)."""
        return np.asarray(self.g_pa / self.g_0_pa)

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa. Shape of `omega`."""
        s = 1j * np.multiply.outer(omega, self.tau_s)
        return np.asarray(self.g_inf_pa + (s / (1 + s)) @ self.g_pa)


def fit_prony(
    modulus: Callable[[Array], Complex],
    low_hz: float,
    high_hz: float,
    wanted: float = 0.01,
    at_rest_pa: float | None = None,
) -> Prony:
    """The series with the fewest terms whose largest error is at most `wanted`; else the best there is.

    Its long-time modulus is `at_rest_pa` where a series with that has the error wanted: slow terms fit a band
    as well, and leave nothing under a static load. `modulus`: rad/s to Pa, shape (n,) both.
    """
    omega = 2 * np.pi * np.geomspace(low_hz, high_hz, _POINTS)
    G = modulus(omega)
    if at_rest_pa is not None and 0 < at_rest_pa < G.real.min():
        found = _fewest(omega, G, wanted, at_rest_pa)
        if found.max_error <= wanted:
            return found
    return _fewest(omega, G, wanted, None)


def _fewest(omega: Array, G: Complex, wanted: float, at_rest: float | None) -> Prony:
    best: Prony | None = None
    for count in range(1, MOST_TERMS + 1):
        for reach in _REACHES:
            tau = np.geomspace(1 / (reach * omega[-1]), reach / omega[0], count)
            if count == 1:
                tau = np.array([reach / np.sqrt(omega[0] * omega[-1])])
            found = _fit(omega, G, tau, at_rest)
            if best is None or found.max_error < best.max_error:
                best = found
        assert best is not None
        if best.max_error <= wanted:
            break
    assert best is not None
    return best


def series_of(modulus: Callable[[Array], Complex], low_hz: float, high_hz: float, terms: int) -> Prony:
    """The nearest series of at most `terms` terms with times on a coarse grid: where a fit may begin.

    `modulus`: rad/s to Pa, shape (n,) both.
    """
    omega = 2 * np.pi * np.geomspace(low_hz, high_hz, _FEW_POINTS)
    G = modulus(omega)
    tau = np.geomspace(1 / (_FEW_REACH * omega[-1]), _FEW_REACH / omega[0], _FEW_TIMES)
    found = (_fit(omega, G, np.array(some)) for some in combinations(tau, terms))
    return min(found, key=lambda series: series.rms_error)


def _fit(omega: Array, G: Complex, tau: Array, at_rest: float | None = None) -> Prony:
    """By non-negative least squares; the long-time modulus is one of the unknowns where none is given."""
    s = 1j * np.multiply.outer(omega, tau)
    given = at_rest or 0.0
    free = np.ones((len(omega), 0 if given else 1))
    columns = np.concatenate([free, s / (1 + s)], axis=1) / np.abs(G)[:, None]
    target = (G - given) / np.abs(G)
    A = np.concatenate([columns.real, columns.imag])
    # Columns of one size: the long-time modulus may be a thousand times smaller than the others.
    size = np.linalg.norm(A, axis=0)
    x = nnls(A / size, np.concatenate([target.real, target.imag]))[0] / size
    error = np.abs(columns @ x - target)
    g_inf, g = (given, x) if given else (float(x[0]), x[1:])
    kept = np.flatnonzero(g)
    return Prony(g_inf, g[kept], tau[kept], float(error.max()), float(np.sqrt(np.mean(error**2))))
