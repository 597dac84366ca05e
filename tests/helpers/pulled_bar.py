"""The exact frequencies of a bar with an axial force, both ends clamped."""

import numpy as np
from scipy.optimize import brentq

from fitting.stated.layers import Face

LENGTH_M, THICKNESS_M = 0.28, 2e-3
FACE = Face(THICKNESS_M, 70e9, 0.3, 2700.0)


def exact_hz(stress_pa, count):
    """2 a b (1 - cosh a cos b) + (a^2 - b^2) sinh a sin b = 0, both ends clamped (over cosh a here)."""
    EI, m, N = FACE.young_pa * THICKNESS_M**3 / 12, FACE.density_kg_m3 * THICKNESS_M, stress_pa * THICKNESS_M

    def left(omega):
        root = np.sqrt((N / 2 / EI) ** 2 + m * omega**2 / EI)
        a, b = (np.sqrt(root + s * N / 2 / EI) * LENGTH_M for s in (1, -1))
        return 2 * a * b * (1 / np.cosh(a) - np.cos(b)) + (a**2 - b**2) * np.tanh(a) * np.sin(b)

    omega = 2 * np.pi * np.linspace(5, 2500, 5000)
    values = np.array([left(w) for w in omega])
    at = np.flatnonzero(values[1:] * values[:-1] < 0)[:count]
    return np.array([brentq(left, omega[k], omega[k + 1]) for k in at]) / (2 * np.pi)
