"""Modes of sandwich beams at several temperatures, made by finite elements that no fit knows.

The beams are slender, as the elements are. Every stated number is off by its tolerance, every temperature by
0.3 K, f by 0.1 % and eta by 3 %; the faces are of steel.
"""

import numpy as np
from layered_beam import Sandwich

from fitting.laws.fractional_zener import FractionalZener
from fitting.mode_tables.table import ModalTable
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from instrument.temperatures.members import AtTemperature

REFERENCE = 20.0
STEEL_PER_K = -3e-4
_BEGIN = FractionalZener(1e6, 50e6, 1e-5, 0.5)
GEOMETRIES = ((0.18, 1e-3, 0.3e-3), (0.2, 1.5e-3, 0.5e-3))
"""Length, thickness of a face and of the core."""


def beam(k=0, **stated):
    """The k-th as its file states it."""
    L, h, h_c = GEOMETRIES[k]
    face = Face(h, 200e9, 0.3, 7850.0, **stated)
    core = Core(h_c, 0.49, 1100.0, _BEGIN)
    return Beam(L, 0.01, "clamped-free", face, face, core, slender=True)


def wlf(temperature_c, c1, c2):
    """Ln a_T."""
    off = np.asarray(temperature_c) - REFERENCE
    return -np.log(10) * c1 * off / (c2 + off)


def zener(omega):
    """A fractional Zener solid."""
    z = (1j * omega * 1e-6) ** 0.6
    return (0.4e6 + 150e6 * z) / (1 + z)


def of_no_formula(omega):
    """Havriliak and Negami's with a slow process beside it."""
    slow = (1j * omega * 1e-2) ** 0.5
    return 150e6 - (150e6 - 0.4e6) / (1 + (1j * omega * 3e-6) ** 0.65) ** 0.55 + 0.12e6 * slow / (1 + slow)


def measured(law, temperatures_c, shift, *, beams=1, count=4, seed=0, off_k=0.3, per_k=STEEL_PER_K):
    """A member for each beam and temperature; `shift` gives ln a_T of the true temperature."""
    rng = np.random.default_rng(seed)

    def about(value, sigma):
        return value * np.exp(sigma * rng.standard_normal())

    young, density, core = about(200e9, 0.01), about(7850.0, 0.005), about(1100.0, 0.02)
    found = []
    for k in range(beams):
        L, h, h_c = GEOMETRIES[k]
        true = Sandwich(
            L + 3e-4 * rng.standard_normal(),
            (about(h, 0.005), about(h_c, 0.03), about(h, 0.015)),
            (young, about(200e9, 0.01)),
            (density, core, about(7850.0, 0.005)),
        )
        for T in temperatures_c:
            is_at = T + off_k * rng.standard_normal()
            a = float(np.exp(shift(is_at)))
            stiffer = 1 + per_k * (is_at - REFERENCE)
            f, eta = true.modes(lambda w, a=a: law(a * w), count, stiffer)
            f = f * (1 + 1e-3 * rng.standard_normal(count))
            eta = eta * (1 + 0.03 * rng.standard_normal(count))
            modes = np.arange(1.0, count + 1)
            table = ModalTable(modes, f, eta, 1e-3 * f, 0.03 * eta, np.full(count, float(T)))
            found.append(AtTemperature(table, float(T), f"beam {k + 1}.csv", k + 1))
    return found
