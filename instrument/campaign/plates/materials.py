"""True laws of the core: fractional Zener as a fit starts with, and others.

Maxwell series, Havriliak-Negami, and a table made from a broad spectrum of relaxation times. All are
causal and passive.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from fitting.arrays import Array, Complex
from instrument.campaign.draws import log_uniform

KINDS = ("fractional-zener", "maxwell", "havriliak-negami", "table")
STORAGE_PA = (0.2e6, 5e6)
LOSS = (0.15, 1.2)
_MOST_DRAWS = 200_000


@dataclass(frozen=True)
class PlateMaterialLaw:
    """G*(omega) by its kind and numbers, in SI units.

    fractional-zener: g0, ginf, tau, alpha. maxwell: g_inf, then pairs g, tau. havriliak-negami: g0, ginf,
    tau, alpha, beta of G* = ginf + (g0 - ginf) / (1 + (i omega tau)^alpha)^beta. table: frequencies in Hz,
    then G' and eta there; natural cubic splines of their logarithms over that of the frequency.
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
        if self.kind == "havriliak-negami":
            g0, ginf, tau, alpha, beta = self.values
            return np.asarray(ginf + (g0 - ginf) / (1 + (1j * w * tau) ** alpha) ** beta)
        if self.kind == "table":
            ln_g, ln_eta = (curve(np.log(w / (2 * np.pi))) for curve in _splines(self.values))
            return np.asarray(np.exp(ln_g) * (1 + 1j * np.exp(ln_eta)))
        raise ValueError(f"law kind {self.kind!r}, expected one of {', '.join(KINDS)}")

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


def draw_law(
    rng: np.random.Generator, band_hz: tuple[float, float], kind: str | None = None
) -> PlateMaterialLaw:
    """A law whose G' and eta keep within `STORAGE_PA` and `LOSS` over a band.

    Half are fractional Zener where no kind is asked for. Raises `ArithmeticError` where it finds none.
    """
    if kind is None:
        kind = KINDS[0] if rng.random() < 0.5 else str(rng.choice(KINDS[1:]))
    f = np.geomspace(*band_hz, 25)
    for _ in range(_MOST_DRAWS):
        law = _DRAWS[kind](rng, float(np.sqrt(band_hz[0] * band_hz[1])))
        if fits(law, f):
            return law
    raise ArithmeticError(f"no {kind} keeps within the limits over {band_hz[0]:.4g} to {band_hz[1]:.4g} Hz")


def fits(law: PlateMaterialLaw, frequency_hz: Array) -> bool:
    """Whether G' and eta keep within the limits of the campaign. Shape (n,)."""
    G = law.modulus(2 * np.pi * frequency_hz)
    eta = G.imag / G.real
    storage = STORAGE_PA[0] < G.real.min() and G.real.max() < STORAGE_PA[1]
    return bool(storage and LOSS[0] < eta.min() and eta.max() < LOSS[1])


def _zener(rng: np.random.Generator, middle_hz: float) -> PlateMaterialLaw:
    g0 = log_uniform(rng, 0.1e6, 0.8e6)
    tau = 1 / (2 * np.pi * middle_hz * log_uniform(rng, 1.5, 40))
    return PlateMaterialLaw(
        "fractional-zener", (g0, g0 * log_uniform(rng, 6, 80), tau, float(rng.uniform(0.45, 0.97)))
    )


def _maxwell(rng: np.random.Generator, middle_hz: float) -> PlateMaterialLaw:
    count = int(rng.integers(3, 6))
    slow, fast = log_uniform(rng, 0.05, 0.2), log_uniform(rng, 15, 60)
    tau = 1 / (2 * np.pi * middle_hz * np.geomspace(slow, fast, count))
    tau = tau * np.exp(rng.uniform(-0.3, 0.3, count))
    # Faster elements are stiffer, as in any transition towards glass.
    g_inf = log_uniform(rng, 0.15e6, 0.8e6)
    first, last = log_uniform(rng, 0.05e6, 0.3e6), log_uniform(rng, 0.8e6, 8e6)
    g = np.geomspace(first, last, count) * np.exp(rng.uniform(-0.4, 0.4, count))
    pairs = np.column_stack([g, tau]).ravel()
    return PlateMaterialLaw("maxwell", (g_inf, *(float(v) for v in pairs)))


def _havriliak_negami(rng: np.random.Generator, middle_hz: float) -> PlateMaterialLaw:
    g0 = log_uniform(rng, 0.1e6, 0.8e6)
    tau = 1 / (2 * np.pi * middle_hz * log_uniform(rng, 0.3, 20))
    alpha, beta = float(rng.uniform(0.45, 0.95)), float(rng.uniform(0.25, 0.75))
    return PlateMaterialLaw("havriliak-negami", (g0, g0 * log_uniform(rng, 6, 80), tau, alpha, beta))


def _table(rng: np.random.Generator, middle_hz: float) -> PlateMaterialLaw:
    """From a spectrum of two broad humps of relaxation times, read at 25 frequencies."""
    rate = np.geomspace(1e-3, 1e4, 120) * 2 * np.pi * middle_hz
    x = np.log10(rate / (2 * np.pi * middle_hz))
    humps = [(rng.uniform(-1.5, 0.2), rng.uniform(0.3, 0.9), log_uniform(rng, 0.01e6, 0.2e6))]
    humps += [(rng.uniform(0.6, 2.0), rng.uniform(0.4, 1.0), log_uniform(rng, 0.2e6, 4e6))]
    spectrum = sum((size * np.exp(-(((x - at) / wide) ** 2) / 2) for at, wide, size in humps), np.zeros(120))
    f = np.geomspace(0.02, 50, 25) * middle_hz
    s = 2j * np.pi * f[:, None] / rate
    G = log_uniform(rng, 0.15e6, 0.8e6) + (s / (1 + s)) @ (spectrum * np.log(rate[1] / rate[0]))
    return PlateMaterialLaw("table", (*f.tolist(), *G.real.tolist(), *(G.imag / G.real).tolist()))


_DRAWS = {
    "fractional-zener": _zener,
    "maxwell": _maxwell,
    "havriliak-negami": _havriliak_negami,
    "table": _table,
}
