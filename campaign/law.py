"""A core's true law, G* over frequency. Every kind is causal and passive."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from fitting.arrays import Complex

LAWS = ("fractional-zener", "maxwell", "ghm", "havriliak-negami", "table")
"""Kinds that a campaign hides; the first is the one that every specimen states."""


@dataclass(frozen=True)
class TrueLaw:
    """G*(omega) by its kind and numbers, in SI units.

    fractional-zener: g0, ginf, tau, alpha. maxwell: g_inf, then pairs g, tau. ghm (Golla, Hughes 1985):
    g_inf, then triples a, zeta, w; s = i omega, with which
    G* = g_inf (1 + sum a (s^2 + 2 zeta w s) / (s^2 + 2 zeta w s + w^2)). havriliak-negami: g0, ginf, tau,
    alpha, beta of G* = ginf + (g0 - ginf) / (1 + (i omega tau)^alpha)^beta. table: frequencies in Hz, then
    G' and eta there; natural cubic splines of their logarithms over that of the frequency.
    """

    kind: str
    values: tuple[float, ...]

    def modulus(self, omega: ArrayLike) -> Complex:
        """In Pa, of the shape of `omega` (rad/s). Raises `ValueError` for an unknown kind."""
        w = np.asarray(omega, dtype=float)
        if self.kind == "fractional-zener":
            g0, ginf, tau, alpha = self.values
            z = (1j * w * tau) ** alpha
            return np.asarray((g0 + ginf * z) / (1 + z))
        if self.kind == "maxwell":
            s = 1j * np.multiply.outer(w, np.array(self.values[2::2]))
            return np.asarray(self.values[0] + (s / (1 + s)) @ np.array(self.values[1::2]))
        if self.kind == "ghm":
            s = 1j * w
            G = np.ones(w.shape, dtype=complex)
            first, *rest = self.values
            for a, zeta, wk in zip(rest[0::3], rest[1::3], rest[2::3], strict=True):
                G += a * (s**2 + 2 * zeta * wk * s) / (s**2 + 2 * zeta * wk * s + wk**2)
            return np.asarray(first * G)
        if self.kind == "havriliak-negami":
            g0, ginf, tau, alpha, beta = self.values
            return np.asarray(ginf + (g0 - ginf) / (1 + (1j * w * tau) ** alpha) ** beta)
        if self.kind == "table":
            ln_g, ln_eta = (curve(np.log(w / (2 * np.pi))) for curve in _splines(self.values))
            return np.asarray(np.exp(ln_g) * (1 + 1j * np.exp(ln_eta)))
        raise ValueError(f"law kind {self.kind!r}, expected one of {', '.join(LAWS)}")

    def beside(self, omega: float, per_s: float) -> complex:
        """At s = i omega + per_s, where that is near i omega: by the first two terms of Taylor's series."""
        h = 1e-3 * omega
        below, G, above = self.modulus(omega + h * np.array([-1.0, 0.0, 1.0]))
        step = -1j * per_s
        return complex(G + step * (above - below) / (2 * h) + step**2 / 2 * (above - 2 * G + below) / h**2)

    @property
    def is_usual(self) -> bool:
        """Whether a fractional Zener, the law that every specimen states, can follow it exactly."""
        return self.kind == "fractional-zener"


@lru_cache(maxsize=64)
def _splines(values: tuple[float, ...]) -> tuple[CubicSpline, CubicSpline]:
    f, g, eta = np.array(values).reshape(3, -1)
    x = np.log(f)
    return CubicSpline(x, np.log(g), bc_type="natural"), CubicSpline(x, np.log(eta), bc_type="natural")
