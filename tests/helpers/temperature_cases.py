"""Sweeps of the paper's plate at five temperatures, made by its own model: WLF, Arrhenius, or not simple."""

import numpy as np

from fitting.laws.fractional_zener import FractionalZener
from fitting.sweep import Sweep
from instrument.models.specimen_models import Models
from instrument.temperatures.members import AtTemperature

T = np.array([5.0, 12.0, 20.0, 28.0, 36.0])
REFERENCE = 20.0
NOISE = 0.004
LAW = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-4, alpha=0.83)


def wlf(c1=4.0, c2=60.0):
    """Ln a_T."""
    return -np.log(10) * c1 * (T - REFERENCE) / (c2 + T - REFERENCE)


def arrhenius(energy=1.2e5):
    """Ln a_T."""
    return energy / 8.314462618 * (1 / (T + 273.15) - 1 / (REFERENCE + 273.15))


class OneProcess:
    """`LAW` shifted."""

    def __init__(self, log_a):
        self.a = float(np.exp(log_a))

    def modulus(self, omega):
        return LAW.modulus(self.a * omega)


class TwoProcesses:
    """Two relaxations, each with an activation of its own."""

    def __init__(self, first, second):
        self.a, self.b = float(np.exp(first)), float(np.exp(second))

    def modulus(self, omega):
        z = (1j * omega * self.b * 3e-3) ** 0.8
        return LAW.modulus(self.a * omega) + 0.35e6 * z / (1 + z)


def sweeps(plate, laws, seed=0, points=60, noise=NOISE):
    f = np.geomspace(14.0, 300.0, points)
    model, rng, found = Models.of(plate, f), np.random.default_rng(seed), []
    for t, law in zip(T, laws, strict=True):
        v = model.predict(law, f)
        v = v + noise * np.abs(v) * (rng.standard_normal(points) + 1j * rng.standard_normal(points))
        sweep = Sweep(
            frequency_hz=f,
            velocity_m_s=v,
            commanded_m_s2=np.full(points, plate.base_acceleration_m_s2),
            segment=np.ones(points, dtype=np.intp),
            sweep=np.ones(points, dtype=np.intp),
            std_m_s=noise * np.abs(v),
        )
        found.append(AtTemperature(sweep, float(t), f"{t:g}.csv"))
    return found
