from dataclasses import replace

import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.central_impedance import (
    bending_stiffness,
    half_beam_root,
    mass_per_length,
)
from fitting.structures.small import displacement, system_of
from fitting.structures.small_modes import small_modes

LOSS = 0.02
GLASS = Face(8e-3, 70e9, 0.22, 2500.0, loss_factor=LOSS)
BARE = Beam(0.3, 0.025, "centre-driven", GLASS, slender=True)
B = 70e9 * 0.025 * 8e-3**3 / 12


def impedance(frequency_hz, stiffness_n_m2, mass_kg_m, length_m):
    """The closed form, in N s/m, of a uniform beam of the whole length."""
    omega, half = 2 * np.pi * frequency_hz, length_m / 2
    x = half * (mass_kg_m * omega**2 / stiffness_n_m2) ** 0.25
    # Over cosh x, which overflows.
    ratio = (np.sin(x) + np.cos(x) * np.tanh(x)) / (x * (1 / np.cosh(x) + np.cos(x)))
    return 1j * omega * 2 * mass_kg_m * half * ratio


def impedance_of(beam, frequency_hz):
    """By the full matrices: F/a is the mass less omega^2 times the integral of mass times relative motion."""
    omega = 2 * np.pi * frequency_hz
    G = beam.core.law.modulus(omega) if beam.core is not None else np.zeros(len(omega), complex)
    system = system_of(beam, beam.parts())
    # The load of a unit acceleration is minus that integral.
    moved = displacement(replace(system, observe=system.load), omega, G)
    return 1j * omega * (mass_per_length(beam) * beam.length_m + omega**2 * moved)


def test_roots_are_a_cantilever_s():
    for mode in range(1, 8):
        x = half_beam_root(mode)
        assert np.cos(x) + 1 / np.cosh(x) == pytest.approx(0, abs=1e-6)


def test_the_full_model_has_the_closed_form_s_impedance():
    # The largest difference is where |Z| is least, between two peaks.
    f = np.geomspace(20, 6000, 400)
    exact = impedance(f, B * (1 + 1j * LOSS), 2500 * 0.025 * 8e-3, 0.3)
    assert np.allclose(impedance_of(BARE, f), exact, rtol=5e-3)


def test_a_slow_beam_is_its_mass():
    f = np.array([1.0])
    mass = mass_per_length(BARE) * 0.3
    assert impedance_of(BARE, f)[0] == pytest.approx(2j * np.pi * f[0] * mass, rel=1e-4)


def test_peaks_of_the_closed_form_s_impedance_give_stiffness_and_loss_back():
    # The shaker's view: |Z| read line by line, no matrices; as exact as half power is at 2 %.
    for mode in range(1, 4):
        middle = half_beam_root(mode) ** 2 / 0.15**2 * np.sqrt(B / mass_per_length(BARE)) / (2 * np.pi)
        f = np.linspace(0.9, 1.1, 4001) * middle
        Z = impedance(f, B * (1 + 1j * LOSS), mass_per_length(BARE), 0.3)
        peak = f[np.argmax(np.abs(Z))]
        wide = f[np.abs(Z) > np.abs(Z).max() / np.sqrt(2)]
        found = bending_stiffness(mode, peak, mass_per_length(BARE), 0.3)
        assert np.sqrt(found / B) == pytest.approx(1, abs=2e-3)
        assert (wide[-1] - wide[0]) / peak == pytest.approx(LOSS, rel=1e-2)


def test_a_laminated_beam_s_modes_are_the_peaks_of_its_impedance():
    core = Core(0.76e-3, 0.49, 1070.0, ConstantModulus(5e6, 0.3))
    thin = Face(4e-3, 70e9, 0.22, 2500.0)
    beam = Beam(0.3, 0.025, "centre-driven", thin, thin, core)
    for mode in small_modes(beam, core.law, 3):
        f = np.linspace(0.8, 1.2, 4001) * mode.frequency_hz
        # A pole of Z: |Z| is largest a little off it, where the loss is large.
        peak = f[np.argmax(np.abs(impedance_of(beam, f)))]
        assert peak == pytest.approx(mode.frequency_hz, rel=mode.loss_factor**2)
