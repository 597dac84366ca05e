"""A beam over temperatures that loses little where it is cold: its resonances are narrow there."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.responses import response_of
from fitting.laws import LAWS
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.small_modes import small_modes
from fitting.sweep import Sweep
from instrument.temperatures.shifted import AtTemperature, identify_shifted

T, REFERENCE, C_1, C_2 = np.array([-10.0, 10.0, 30.0]), 10.0, 12.0, 120.0
LOG_SHIFT = -C_1 * (T - REFERENCE) / (C_2 + T - REFERENCE) * np.log(10)
METAL = (70e9, 0.3, 2700.0)
BEAM = Beam(
    0.2,
    0.012,
    "clamped-free",
    Face(2e-3, *METAL, loss_factor=0.0),
    constraining=Face(1e-3, *METAL, loss_factor=0.0),
    core=Core(0.3e-3, 0.49, 1000.0, LAWS["fractional-zener"](1e6, 600e6, 2e-4, 0.55)),
    exact=True,
    pickup_m=0.166,
)
NOISE = 0.003


def sweeps(off):
    """One a temperature, the beam's resonances `off` in standard deviations of what is counted."""
    rng = np.random.default_rng(1)
    made = []
    for t, shift in zip(T, LOG_SHIFT, strict=True):
        g0, ginf, tau, alpha = BEAM.core.law.values
        law = LAWS["fractional-zener"](g0, ginf, tau * np.exp(shift), alpha)
        there = replace(BEAM, core=replace(BEAM.core, law=law))
        modes = small_modes(there, law, 3)
        f = np.concatenate(
            [np.linspace(1 - h, 1 + h, 30) * m.frequency_hz for m in modes for h in [_half(m.loss_factor)]]
        )
        one = np.ones(len(f), np.intp)
        drive, segment = np.full(len(f), BEAM.base_acceleration_m_s2), np.repeat([1, 2, 3], 30)
        moving = SmallProblem.of_small(Sweep(f, one + 0j, drive, segment, one, std_m_s=0.1 * one), there)
        moving = moving.with_narrow(law)
        names = [n.name for n in moving.nuisances.each]
        z = moving.as_stated.copy()
        for k, by in enumerate(off):
            if f"resonance_{k + 1}" in names:
                z[names.index(f"resonance_{k + 1}")] = by
        v = response_of(moving, ()).velocity(law, z)
        std = NOISE * np.abs(v)
        v = v + std * (rng.standard_normal(len(f)) + 1j * rng.standard_normal(len(f)))
        made.append(AtTemperature(Sweep(f, v, drive, segment, one, std_m_s=std), float(t), f"{t:g}"))
    return made


def _half(loss):
    return float(np.clip(loss, 0.01, 0.15))


@pytest.mark.parametrize("off", [(1.5, -1.5, 0.0), (-1.0, 1.0, 1.0)])
def test_shift_and_law_are_off_by_what_is_said_and_no_cause_is_named(off):
    start = replace(BEAM, core=replace(BEAM.core, law=LAWS["fractional-zener"](2e6, 400e6, 3e-4, 0.5)))
    found = identify_shifted(sweeps(off), start, "wlf", REFERENCE, temperature_k=0.0)
    assert max(one.begun.none.chi2_per_dof for one in found.alone) < 1.3
    assert found.cause is None
    assert found.verdict.simple
    moved = T != REFERENCE
    assert np.abs((found.fit.log_shift - LOG_SHIFT)[moved] / found.fit.log_shift_errors[moved]).max() < 2.5
    band = found.band
    true = BEAM.core.law.modulus(2 * np.pi * band.frequency_hz).real
    assert np.abs((band.storage_modulus_pa - true) / band.storage_modulus_standard_error_pa).max() < 2.5
