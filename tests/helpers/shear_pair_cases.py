"""Shear pairs and their sweeps by the wave in the pad: a closed form of its own, no matrices."""

import numpy as np

from fitting.laws import LAWS
from fitting.stated.layers import Core
from fitting.structures.shear_pair import ShearPair, disc
from fitting.sweep import Sweep

LAW = LAWS["fractional-zener"](4e6, 30e6, 1e-4, 0.6)
MASSES_KG = (0.1178, 0.2533, 0.573, 1.196)
TOLERANCES = {"mass": 0.002, "core_thickness": 0.02, "area": 0.02, "gain": 0.005}
G_0 = 9.81


def pair(mass_kg, **more):
    area, gyration = disc(33.5e-3, 11.8e-3)
    given = {"gyration_m": gyration, "tolerances": TOLERANCES} | more
    return ShearPair(mass_kg, 2, area, Core(6e-3, 0.49, 1100.0, LAW), **given)


def transmissibility(specimen, frequency_hz, G, more_kg=0.0, cord_n_m=0.0):
    """a_mass / a_base = 1 / (cos kt - (m w^2 - c)/(G A k) sin kt), k = w sqrt(rho/G); a cord c."""
    w = 2 * np.pi * np.asarray(frequency_hz)
    t, area = specimen.core.thickness_m, specimen.discs * specimen.area_m2
    k = w * np.sqrt(specimen.core.density_kg_m3 / G)
    inertia = ((specimen.mass_kg + more_kg) * w**2 - cord_n_m) / (G * area * k)
    return 1 / (np.cos(k * t) - inertia * np.sin(k * t))


def sweep(
    specimen,
    *,
    more_kg=0.0,
    cord_n_m=0.0,
    softening=0.0,
    level=G_0,
    noise=2e-3,
    points=160,
    seed=0,
    factor=1.0,
    wander=0.0,
):
    """From a third of the resonance to twice it; `softening` is the modulus lost per unit strain.

    `wander`: gain and phase go up and down slowly by so much, and there is a floor.
    """
    about = np.sqrt(8e6 * specimen.discs * specimen.area_m2 / specimen.core.thickness_m / specimen.mass_kg)
    f = np.geomspace(0.3, 2.0, points) * about / (2 * np.pi)
    w = 2 * np.pi * f
    G = specimen.core.law.modulus(w)
    T = transmissibility(specimen, f, G, more_kg, cord_n_m)
    for _ in range(60 if softening else 0):
        strain = np.abs(T - 1) * level / w**2 / specimen.core.thickness_m
        T = transmissibility(specimen, f, G * (1 - softening * strain), more_kg)
    rng = np.random.default_rng(seed)
    scatter = 1 + noise * (rng.normal(size=points) + 1j * rng.normal(size=points))
    one = np.ones(points, dtype=np.intp)
    v = factor * T * level / (1j * w) * scatter
    if wander:
        v = v * (1 + wander * _slow(rng, points))
        v = v + 3e-4 * np.abs(v).max() * (rng.normal(size=points) + 1j * rng.normal(size=points))
    return Sweep(f, v, np.full(points, level), one, one, base_m_s2=np.full(points, level + 0j))


def _slow(rng, points):
    """Of unit size, a few half waves over the sweep: no noise that jumps from point to point."""
    t, every = np.linspace(0, 1, points), range(1, 7)
    waves = [
        (rng.normal() + 1j * rng.normal()) * np.cos(np.pi * k * t + rng.uniform(0, 2 * np.pi)) for k in every
    ]
    return np.sum(waves, axis=0) / np.sqrt(len(waves))


HEAVIER_KG = MASSES_KG[1:]


def fixture_factor(f):
    """Gain low by 3 %, a degree of phase, and a mode of the fixture at 240 Hz."""
    r = f / 240.0
    return 0.97 * np.exp(0.02j) * (1 + 0.02 * r**2 / (1 - r**2 + 0.1j * r))


def sweeps_of_masses(points, *, alike, first_seed=0):
    """A sweep of each mass: behind one fixture, or each wandering by itself."""
    given = []
    for k, m in enumerate(HEAVIER_KG, start=first_seed):
        s = sweep(pair(m), seed=k, noise=5e-4, points=points, wander=0.0 if alike else 0.01)
        v = s.velocity_m_s * (fixture_factor(s.frequency_hz) if alike else 1.0)
        given.append(Sweep(**{**vars(s), "velocity_m_s": v}))
    return given
