"""A law that is only smooth: natural cubic splines of ln G' and ln eta over ln f."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import ClassVar, Self

import numpy as np
from scipy.interpolate import CubicSpline

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, fixed, quantity
from fitting.laws.vicinity import LOSS, STORAGE_PA, Vicinity

_BREACH = 0.1
"""Slope beyond its bound that is a standard deviation: splines of few knots through cores that keep the
bounds come to 0.15 with six knots, 0.2 with four and 0.4 with three, at the worst of 300."""
_PLACES = 3
"""Steps from knot to knot at which the bounds are asked: a spline turns between knots too."""


@dataclass(frozen=True)
class Smooth(CoreLaw):
    """G* = G' (1 + i eta), G' and eta through their values at knots and straight in logarithms beyond them.

    G' and eta are free of each other but for what every core that relaxes keeps. With a spectrum of
    relaxation times, G' = G_0 + sum G_k x^2 / (1 + x^2) and G'' = sum G_k x / (1 + x^2), x = omega tau_k
    and G_k >= 0 (Ferry, ch. 3), term by term

        0 <= d ln G' / d ln omega <= eta,   |d ln G'' / d ln omega| <= 1

    A fit may break these, and pays for it (`breaches`).
    """

    kind: ClassVar[str] = "smooth"
    source: ClassVar[str] = "natural cubic splines of ln G' and ln eta over ln f"

    frequency_hz: tuple[float, ...] = fixed("frequency_hz")
    """Frequencies of the knots, ascending."""
    g_pa: tuple[float, ...] = quantity("g_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    """G' there."""
    loss_factor: tuple[float, ...] = quantity("loss_factor", lower=1e-6, upper=10.0, search=(0.05, 1.5))

    def __post_init__(self) -> None:
        super().__post_init__()
        f = self.frequency_hz
        if len(f) < 2 or not f[0] > 0 or any(not a < b for a, b in pairwise(f)) or not np.isfinite(f[-1]):
            shown = ", ".join(f"{k:g}" for k in f[:8]) + (", ..." if len(f) > 8 else "")
            raise OutsideModel(
                f"core law {self.kind}: frequency_hz = [{shown}], expected two or more above 0, ascending"
            )
        if not len(f) == len(self.g_pa) == len(self.loss_factor):
            raise OutsideModel(
                f"core law {self.kind}: {len(f)} frequency_hz, {len(self.g_pa)} g_mpa and "
                f"{len(self.loss_factor)} loss_factor, expected as many of each"
            )

    @classmethod
    def alternatives(cls, near: Vicinity) -> list[CoreLaw]:
        knots = near.sextiles_hz
        return [
            cls._near(near, sorted({knots[k] for k in some}))
            for some in ((0, 3, 5), (0, 1, 3, 5), (0, 1, 2, 3, 4, 5))
        ]

    @classmethod
    def _near(cls, law: Vicinity, knots_hz: list[float]) -> Self:
        """Through a law at the knots, where that is a material."""
        G, eta = law.storage_and_loss(2 * np.pi * np.array(knots_hz))
        return cls(
            tuple(knots_hz),
            tuple(float(g) for g in np.clip(G, *STORAGE_PA)),
            tuple(float(e) for e in np.clip(eta, *LOSS)),
        )

    @classmethod
    def through(cls, law: CoreLaw, frequency_hz: Sequence[float] | Array) -> Self:
        """The smooth law that equals `law` at the knots. Raises `OutsideModel` for a lossless one.

        Shape (knots,).
        """
        knots = tuple(float(f) for f in frequency_hz)
        G, eta = law.storage_and_loss(2 * np.pi * np.array(knots))
        return cls(knots, tuple(map(float, G)), tuple(map(float, eta)))

    def modulus(self, omega: Array) -> Complex:
        W = self._weights(omega)
        G, eta = (np.exp(np.tensordot(np.log(p), W, axes=1)) for p in (self.g_pa, self.loss_factor))
        return np.asarray(G * (1 + 1j * eta))

    def jacobian(self, omega: Array) -> Complex:
        W, G = self._weights(omega), self.modulus(omega)
        g, eta = (np.array(p).reshape(-1, *(1,) * np.ndim(omega)) for p in (self.g_pa, self.loss_factor))
        return np.concatenate([W * G / g, W * 1j * G.imag / eta])

    def breaches(self) -> Array:
        """Of the three bounds at and between the knots, one after the other. Shape (rows,)."""
        by_G, by_eta, eta = self._slopes
        lost = np.abs(by_G + by_eta) - 1
        over = np.concatenate([by_G - eta, -by_G, lost])
        return np.maximum(over, 0.0) / _BREACH

    def breaches_by_logs(self) -> Array:
        """As `CoreLaw.breaches_by_logs`."""
        by_G, by_eta, eta = self._slopes
        W, D = _at_and_between(self.frequency_hz)
        none, sign = np.zeros_like(D), np.sign(by_G + by_eta)[:, None]
        J = np.vstack([np.hstack([D, -eta[:, None] * W]), np.hstack([-D, none]), np.hstack([sign * D] * 2)])
        return np.asarray(np.where(self.breaches()[:, None] > 0, J, 0.0) / _BREACH)

    @property
    def _slopes(self) -> tuple[Array, Array, Array]:
        """Of ln G' and of ln eta over ln omega, and eta. Shape (places,) each."""
        W, D = _at_and_between(self.frequency_hz)
        ln_eta = np.log(self.loss_factor)
        return D @ np.log(self.g_pa), D @ ln_eta, np.exp(W @ ln_eta)

    def _weights(self, omega: Array) -> Array:
        """What each knot's logarithm counts at each frequency. Shape (knots, ...)."""
        omega = np.asarray(omega, dtype=float)
        if np.any(omega <= 0):
            raise OutsideModel(
                f"core law {self.kind} asked at {float(np.min(omega)) / (2 * np.pi):.4g} Hz, expected above 0"
            )
        return _spline_weights(self.frequency_hz, omega.tobytes()).reshape(-1, *omega.shape)


@lru_cache(maxsize=64)
def _at_and_between(knots_hz: tuple[float, ...]) -> tuple[Array, Array]:
    """What each knot's logarithm counts in a value and in a slope over ln f. Shape (places, knots) each."""
    x = np.log(knots_hz)
    at = np.interp(np.arange(_PLACES * (len(x) - 1) + 1) / _PLACES, np.arange(len(x)), x)
    spline = CubicSpline(x, np.eye(len(x)), bc_type="natural")
    return np.asarray(spline(at)), np.asarray(spline(at, 1))


@lru_cache(maxsize=64)
def _spline_weights(knots_hz: tuple[float, ...], omega: bytes) -> Array:
    """Linear in the knots' values, so made once for a grid of frequencies. Shape (knots, frequencies)."""
    x = np.log(knots_hz)
    at = np.log(np.frombuffer(omega) / (2 * np.pi))
    spline = CubicSpline(x, np.eye(len(x)), bc_type="natural")
    inside = np.clip(at, x[0], x[-1])
    weights = spline(inside) + spline(inside, 1) * (at - inside)[:, None]
    return np.ascontiguousarray(weights.T)
