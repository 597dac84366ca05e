"""The core's true laws: fractional Zener as the model has it, and others that it cannot follow."""

import numpy as np
from scipy.optimize import least_squares

from campaign.law import TrueLaw
from fitting.arrays import Array, Complex

_LEAST_RMS = 0.015
"""Relative deviation of a strange law from the nearest fractional Zener over the measured frequencies."""
_MOST_RMS = 0.08
_PLAIN_PA = (0.15e6, 3e6)
"""Storage modulus that a core has between 14 and 310 Hz."""
_PLAIN_LOSS = (0.1, 1.6)


def draw_material(rng: np.random.Generator) -> TrueLaw:
    """A fractional Zener core."""
    g0, ginf = rng.uniform(0.16e6, 0.36e6), rng.uniform(2.4e6, 5.4e6)
    tau, alpha = rng.uniform(0.8e-4, 1.7e-4), rng.uniform(0.62, 0.96)
    return TrueLaw("fractional-zener", (float(g0), float(ginf), float(tau), float(alpha)))


def draw_strange_material(rng: np.random.Generator, frequency_hz: Array) -> TrueLaw:
    """A core whose law no fractional Zener follows over the measured frequencies. Shape (points,)."""
    omega = 2 * np.pi * frequency_hz
    while True:
        law = _draw_maxwell(rng) if rng.random() < 0.5 else _draw_ghm(rng)
        G = law.modulus(omega)
        eta = G.imag / G.real
        plain = _PLAIN_PA[0] < G.real.min() and G.real.max() < _PLAIN_PA[1]
        plain = plain and _PLAIN_LOSS[0] < eta.min() and eta.max() < _PLAIN_LOSS[1]
        if plain and _LEAST_RMS < deviation(law, omega) < _MOST_RMS:
            return law


def _draw_maxwell(rng: np.random.Generator) -> TrueLaw:
    slow, fast = 10 ** rng.uniform(-3.0, -2.0), 10 ** rng.uniform(-4.3, -3.6)
    g_inf = rng.uniform(0.16e6, 0.3e6)
    weak, strong = rng.uniform(0.1e6, 0.4e6), rng.uniform(0.8e6, 4e6)
    return TrueLaw("maxwell", tuple(float(v) for v in (g_inf, weak, slow, strong, fast)))


def _draw_ghm(rng: np.random.Generator) -> TrueLaw:
    g_inf = rng.uniform(0.16e6, 0.3e6)
    slow = (rng.uniform(0.3, 2.0), rng.uniform(1.5, 6.0), 10 ** rng.uniform(2.6, 3.6))
    fast = (rng.uniform(3.0, 12.0), rng.uniform(1.5, 6.0), 10 ** rng.uniform(3.9, 4.8))
    return TrueLaw("ghm", tuple(float(v) for v in (g_inf, *slow, *fast)))


def deviation(law: TrueLaw, omega: Array) -> float:
    """Rms of the relative deviation from the nearest fractional Zener at `omega`. Shape (points,)."""
    return float(np.sqrt(np.mean(np.abs(_misfit(nearest_zener(law, omega), law, omega)) ** 2)))


def nearest_zener(law: TrueLaw, omega: Array) -> TrueLaw:
    """The fractional Zener nearest to a law in relative error at `omega`. Shape (points,)."""
    G = law.modulus(omega)

    def residuals(p: Array) -> Array:
        left = _misfit(_zener(p), law, omega)
        return np.concatenate([left.real, left.imag])

    start = np.array([np.log(0.8 * G.real.min()), np.log(8 * G.real.max()), np.log(1.2e-4), 0.8])
    lower = [np.log(1e3), np.log(1e5), np.log(1e-7), 0.2]
    found = least_squares(residuals, start, bounds=(lower, [np.log(1e8), np.log(1e9), np.log(1e-1), 1.0]))
    return _zener(found.x)


def _zener(p: Array) -> TrueLaw:
    return TrueLaw("fractional-zener", (*(float(v) for v in np.exp(p[:3])), float(p[3])))


def _misfit(zener: TrueLaw, law: TrueLaw, omega: Array) -> Complex:
    return np.asarray(zener.modulus(omega) / law.modulus(omega) - 1)
