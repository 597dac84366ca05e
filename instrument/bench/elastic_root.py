"""The sweep whose diagnosis is timed: the solid plate on springs at its root, as noisy as a rig in use."""

import numpy as np

from drivers.simulated.plant.effects import ClampCompliance, Effects
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.sandwich import sandwich
from fitting.arrays import Array, Complex
from fitting.laws.fractional_zener import FractionalZener
from fitting.sweep import Sweep
from instrument.bench.sweeps import GRID_HZ

SPRINGS_N_M3 = 3e13
"""Stiffness of the root along x and z: soft enough that a diagnosis has something to find."""
_OF_PEAK = 0.004
"""White noise as a share of a pass's peak; this and the next are of a rig in use."""
_REPEATS = 0.002
"""Scatter of a reading's own size."""
_FLOOR_M_S = 2e-5
"""The vibrometer's white noise whatever the peak."""
_DRIVE = 0.003
"""Scatter of the level from point to point."""
_DRIVE_PHASE_RAD = np.deg2rad(0.3)
"""Scatter of its phase."""


def elastic_root_sweep(g_m_s2: float, levels_g: tuple[float, ...], seed: int = 0) -> Sweep:
    """353 points at each of the levels, all of a segment and level in one pass."""
    f, level_g = np.tile(GRID_HZ, len(levels_g)), np.repeat(np.array(levels_g, float), len(GRID_HZ))
    segment = np.digitize(f, [50, 200]).astype(np.intp) + 1
    number = segment + 3 * np.repeat(np.arange(len(levels_g)), len(GRID_HZ))
    rng = np.random.default_rng(seed)
    commanded = level_g * g_m_s2
    response = np.tile(_velocity_per_acceleration_s(_draw_core(rng), GRID_HZ), len(levels_g))
    level, phase = rng.standard_normal((2, len(f)))
    base = commanded * (1 + _DRIVE * level) * np.exp(1j * _DRIVE_PHASE_RAD * phase)
    along, across = rng.standard_normal((2, len(f)))
    std = _std_m_s(np.abs(response * commanded), number)
    return Sweep(
        frequency_hz=f,
        velocity_m_s=response * base + std * (along + 1j * across),
        commanded_m_s2=commanded,
        segment=segment,
        sweep=number,
        base_m_s2=base,
        time_s=np.linspace(0.0, 2.0 * len(f), len(f)),
    )


def _draw_core(rng: np.random.Generator) -> FractionalZener:
    g0, ginf = rng.uniform(0.16e6, 0.36e6), rng.uniform(2.4e6, 5.4e6)
    tau, alpha = rng.uniform(0.8e-4, 1.7e-4), rng.uniform(0.62, 0.96)
    return FractionalZener(g0_pa=float(g0), ginf_pa=float(ginf), tau_s=float(tau), alpha=float(alpha))


@one_thread
def _velocity_per_acceleration_s(core: FractionalZener, frequency_hz: Array) -> Complex:
    """At the spot, relative to the clamp. Shape (points,)."""
    structure = sandwich(Effects(clamp_compliance=ClampCompliance(SPRINGS_N_M3, SPRINGS_N_M3))).structure
    layer, *springs = structure.branches
    fixed = structure.K + sum(spring.K for spring in springs)
    omega = 2 * np.pi * frequency_hz
    q = [
        np.linalg.solve(
            fixed - w**2 * structure.M + 1j * w * structure.C + G * layer.K, structure.loads[:, 0]
        )
        for w, G in zip(omega, core.modulus(omega), strict=True)
    ]
    return np.asarray(1j * omega * (np.array(q) @ structure.readings[0]))


def _std_m_s(size_m_s: Array, number: Array) -> Array:
    """Of each part of each reading, by the passes' numbers. Shape (points,)."""
    peak = np.array([size_m_s[number == n].max() for n in number])
    return np.hypot(np.hypot(_OF_PEAK * peak, _FLOOR_M_S) / np.sqrt(2), _REPEATS * size_m_s)
