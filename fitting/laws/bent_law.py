"""A core law that a material follows only nearly: bent smoothly within a few percent.

    G' = G'_law exp(b_G(ln f)),   eta = eta_law exp(b_eta(ln f))

b is a Gaussian process in the logarithm of the frequency, here by its values at knots: no material has read
the formula. Its whitened values are unknowns with priors of unit width, fitted beside the law's parameters.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Self

import numpy as np

from fitting.arrays import Array, Complex
from fitting.laws.base import CoreLaw, Quantity

STORAGE, LOSS = 0.025, 0.045
"""Standard deviations of b_G and b_eta: how far Maxwell, Havriliak-Negami and tabulated materials lie from
the nearest fractional Zener over a decade (docs/uncertainty.md)."""
REACH = 1.0
"""Distance in ln f over which a bend goes on."""
_A_KNOT = 0.7
"""In ln f: nearer than `REACH`, so that a bend between two knots is nearly what they say; a choice."""
_MOST = 8.0
"""Standard deviations of its prior that a whitened value may go: out of the way of any fit."""
_BEND = Quantity("", 1.0, float(np.exp(-_MOST)), float(np.exp(_MOST)), (float(np.exp(-1)), float(np.exp(1))))
"""A whitened value as laws have their parameters: an exponential, searched within a standard deviation."""


@dataclass(frozen=True)
class BentLaw(CoreLaw):
    """`law` with a bend; its parameters come first, then the exponentials of the whitened bend."""

    law: CoreLaw
    knots_hz: tuple[float, ...]
    bend: tuple[float, ...]
    """Exponentials of whitened values: of b_G at the knots, then of b_eta."""
    freedom: float = 1.0
    """Times the usual standard deviations."""
    slow: float = 0.0
    """Of a further bend, times the usual standard deviations, that goes on over `slow_reach` in ln f."""
    slow_reach: float = REACH
    faint: tuple[float, ...] = ()
    """Times the usual standard deviation of b_eta at each knot, straight in logarithms between."""

    def __post_init__(self) -> None:
        # The law that is bent has looked at its own parameters.
        if not all(_BEND.holds(b) for b in self.bend):
            super().__post_init__()

    @classmethod
    def over(
        cls,
        law: CoreLaw,
        frequency_hz: Array,
        freedom: float = 1.0,
        slow: float = 0.0,
        slow_reach: float = REACH,
    ) -> "BentLaw":
        """`law` unbent, free to bend over a range of frequencies, given in any shape."""
        low, high = float(np.min(frequency_hz)), float(np.max(frequency_hz))
        count = 2 + int(np.log(high / low) / _A_KNOT)
        knots = tuple(float(f) for f in np.geomspace(low, high, count))
        return cls(law, knots, (1.0,) * (2 * count), freedom, slow, slow_reach)

    def freer(self, times: float) -> Self:
        """A law of this modulus that may bend so many times as far."""
        bend = tuple(float(b ** (1 / times)) for b in self.bend)
        return replace(self, bend=bend, freedom=self.freedom * times)

    @property
    def plain(self) -> CoreLaw:
        """The law that is bent."""
        return self.law

    @property
    def kind(self) -> str:
        """Of the law that is bent."""
        return self.law.kind

    @property
    def bend_count(self) -> int:
        """How many of the parameters, the last ones, have priors of unit width in their logarithms."""
        return len(self.bend)

    @property
    def names(self) -> list[str]:
        """Of the law's own parameters, then of the bend."""
        return [*self.law.names, *(f"bend_{k + 1}" for k in range(len(self.bend)))]

    @property
    def values(self) -> Array:
        """In the order of `names`."""
        return np.concatenate([self.law.values, self.bend])

    @property
    def limits(self) -> list[Quantity]:
        """In the order of `names`."""
        return [*self.law.limits, *(_BEND,) * len(self.bend)]

    def places_at_limit(self, at_limit: Collection[str]) -> int:
        """Knots at which the bend of G' or of eta is among these names."""
        half = len(self.knots_hz)
        return len({k % half for k in range(2 * half) if f"bend_{k + 1}" in at_limit})

    def with_values(self, values: Array) -> Self:
        """Formula and knots kept, with other parameters and another bend. Shape (names,)."""
        n = len(self.law.names)
        bend = tuple(float(v) for v in values[n:])
        return replace(self, law=self.law.with_values(values[:n]), bend=bend)

    def objections(self) -> list[str]:
        """Of the law that is bent."""
        return self.law.objections()

    def breaches(self) -> Array:
        """Of the law that is bent. Shape (rows,)."""
        return self.law.breaches()

    def breaches_by_logs(self) -> Array:
        """Derivatives as the law without a bend has them: the bend does not enter. Shape (rows, names)."""
        own = self.law.breaches_by_logs()
        return np.hstack([own, np.zeros((len(own), len(self.bend)))])

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa at `omega` in rad/s."""
        g, e = self._bent(np.asarray(omega, dtype=float))
        G = self.law.modulus(omega)
        return _times(np.exp(g), np.exp(e), G)

    def jacobian(self, omega: Array) -> Complex:
        """dG*/dp, in the order of `names`. Shape (parameters, frequencies)."""
        omega = np.asarray(omega, dtype=float)
        g, e = self._bent(omega)
        own = self.law.jacobian(omega)
        own = _times(np.exp(g), np.exp(e), own)
        W, G = self._weights(omega), _times(np.exp(g), np.exp(e), self.law.modulus(omega))
        # Times what is one over them: complex numbers divide slowly.
        per_bend = 1 / np.array(self.bend).reshape(2, -1, *(1,) * np.ndim(omega))
        by_g = self.freedom * STORAGE * W * G * per_bend[0]
        by_e = np.zeros_like(by_g)
        by_e.imag = self.freedom * LOSS * W * self._fainter(omega) * G.imag * per_bend[1]
        return np.concatenate([own, by_g, by_e])

    def moduli(self, logs: Array, omega: Array) -> Complex:
        """As `CoreLaw.moduli` has it."""
        n, half = len(self.law.names), len(self.knots_hz)
        xi = np.clip(logs[:, n:], -_MOST, _MOST)
        W = self._weights(np.asarray(omega, dtype=float))
        g, e = self.freedom * STORAGE * xi[:, :half] @ W, self.freedom * LOSS * xi[:, half:] @ W
        e = e * self._fainter(np.asarray(omega, dtype=float))
        G = self.law.moduli(logs[:, :n], omega)
        return _times(np.exp(g), np.exp(e), G)

    def _bent(self, omega: Array) -> tuple[Array, Array]:
        xi = np.log(np.array(self.bend)).reshape(2, -1)
        # A plain product of two dimensions: `tensordot` would take eight times as long for these few.
        W = self._weights(omega).reshape(xi.shape[1], -1)
        g, e = self.freedom * STORAGE * (xi[0] @ W), self.freedom * LOSS * (xi[1] @ W)
        e = e * np.ravel(self._fainter(omega)) if self.faint else e
        return g.reshape(np.shape(omega)), e.reshape(np.shape(omega))

    def _fainter(self, omega: Array) -> Array | float:
        if not self.faint:
            return 1.0
        at = np.log(np.maximum(omega, 1e-9) / (2 * np.pi))
        return np.asarray(np.exp(np.interp(at, np.log(self.knots_hz), np.log(self.faint))))

    def _weights(self, omega: Array) -> Array:
        """Of the whitened values at each frequency. Shape (knots, ...)."""
        found = _weights_at(self.knots_hz, omega.tobytes(), self.slow, self.slow_reach)
        return found.reshape(-1, *np.shape(omega))


def _times(storage: Array, loss: Array, G: Complex) -> Complex:
    """G' times `storage`, eta times `loss`. By parts: complex numbers multiply slowly."""
    found = np.empty(np.broadcast_shapes(storage.shape, G.shape), complex)
    found.real, found.imag = storage * G.real, storage * (loss * G.imag)
    return found


@lru_cache(maxsize=32)
def _weights_at(knots_hz: tuple[float, ...], omega: bytes, slow: float, slow_reach: float) -> Array:
    """k(f, knots) L^-T for frequencies in rad/s, kept: every step of a fit asks for the same ones."""
    x = np.log(np.maximum(np.frombuffer(omega), 1e-9) / (2 * np.pi))
    between = _alike(x[:, None] - np.log(np.array(knots_hz)), slow, slow_reach)
    return np.asarray(np.ascontiguousarray((between @ _whitening(knots_hz, slow, slow_reach)).T))


@lru_cache(maxsize=32)
def _whitening(knots_hz: tuple[float, ...], slow: float, slow_reach: float) -> Array:
    """L^-T of k(knots, knots) = L L^T."""
    at = np.log(np.array(knots_hz))
    K = _alike(at[:, None] - at, slow, slow_reach)
    L = np.linalg.cholesky(K + 1e-9 * (1 + slow**2) * np.eye(len(K)))
    return np.asarray(np.linalg.inv(L).T)


def _alike(apart: Array, slow: float, slow_reach: float) -> Array:
    """What knots say of each other, by their distances in ln f."""
    found = np.exp(-0.5 * (apart / REACH) ** 2)
    return found + slow**2 * np.exp(-0.5 * (apart / slow_reach) ** 2) if slow else found
