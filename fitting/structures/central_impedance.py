"""A beam driven at its centre by a force: driving-point impedance, bending stiffness and loss factor by mode.

The method of ISO 16940 for laminated glass, from the beam's equation and not from the standard's text. Each
half, of length l and free at its end, does what a cantilever does whose root moves; with B k^4 = mu omega^2,
B complex and per beam, mu its mass per length,

    Z = F/v = i omega 2 mu l S(kl),   S(x) = (sin x cosh x + cos x sinh x) / (x (1 + cos x cosh x))

|Z| is largest where 1 + cos kl cosh kl = 0: at the modes of the clamped halves, kl = lambda_i. So of each

    B_i = mu l^4 omega_i^2 / lambda_i^4,   eta_i that of the mode.
"""

import numpy as np

from fitting.structures.beam import Beam

_FIRST = (1.875104069, 4.694091133, 7.854757438, 10.99554073, 14.13716839)
"""Roots of 1 + cos x cosh x; beyond them the cosine's zeros, to 1e-7."""


def half_beam_root(mode: int) -> float:
    """lambda_i: root of 1 + cos x cosh x, counted from 1."""
    return _FIRST[mode - 1] if mode <= len(_FIRST) else float(np.pi * (mode - 0.5))


def bending_stiffness(mode: int, frequency_hz: float, mass_kg_m: float, length_m: float) -> float:
    """B_i in N m^2 of a beam of the whole length, from a mode's frequency."""
    half = length_m / 2
    return mass_kg_m * half**4 * (2 * np.pi * frequency_hz) ** 2 / half_beam_root(mode) ** 4


def mass_per_length(beam: Beam) -> float:
    """Mass per length of all layers of a beam, kg/m."""
    sides = 2 if beam.both_sides else 1
    core = sides * beam.core.thickness_m * beam.core.density_kg_m3 if beam.core is not None else 0.0
    faces = sum(
        (sides if f is beam.constraining else 1) * f.thickness_m * f.density_kg_m3
        for f in (beam.substrate, beam.constraining)
        if f is not None
    )
    return beam.width_m * (core + faces)
