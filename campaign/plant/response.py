"""Steady sweeps of the plant without the rig: what the plate does at each point, per base acceleration.

Phasors of e^{i w t}. The velocity is relative to the clamp; what channels make of it is in `channels.py`.
Friction in the clamp is independent of rate here, k (1 + i loss). The rig's plant lives in time: its friction
needs elements that relax, which stiffen with frequency too.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drivers.simulated.plant.effects import Effects, TemperatureDrift
from drivers.simulated.plant.law import maxwell_series, wlf_shift
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.slow_change import LEAST_FACTOR
from drivers.simulated.plant.structure import Structure, condensed
from fitting.arrays import Array, Complex

Modulus = Callable[[Array], Complex]
"""G*(omega) in Pa of the core at the reference temperature and small strain, omega in rad/s."""

_CHUNK = 128
"""Points solved at once."""
_FACTORS = (1.0, 0.8, 0.55)
"""Softened moduli whose responses span the motion of a softening core."""
_RELAXED = 0.5
_MOST_STEPS = 300
_SETTLED = 1e-9


@dataclass(frozen=True)
class Steady:
    """What the plate does at each point. Shape (points,) each."""

    velocity_per_acceleration_s: Complex
    """At the spot, relative to the clamp."""
    core_strain: Array
    """Amplitude of the core's shear strain, rms over its volume."""
    modulus_pa: Complex
    """Of the core, as warm and as soft as it is there."""


@one_thread
def steady(
    effects: Effects, modulus: Modulus, frequency_hz: Array, level_m_s2: Array, time_s: Array
) -> Steady:
    """The plate at each point, its base moved with amplitude `level_m_s2`, `time_s` after warming began.

    Shape (points,). `modulus` takes the place of the plant's own law and of `effects.core_law`. Softening has
    come to its fixed point. Raises `ArithmeticError` where it has none, `ValueError` for a place off the
    plate.
    """
    omega = 2 * np.pi * frequency_hz
    plate = sandwich(replace(effects, core_law=None))
    pitch = pitch_per_acceleration(effects, omega)
    G = modulus(omega * time_shift(effects.temperature_drift, time_s))
    root = 1 + 1j * (effects.clamp_friction.loss_factor if effects.clamp_friction else 0.0)
    soft = effects.amplitude_softening
    if soft is None:
        bare = _Loaded(plate, plate.structure, omega, pitch, root)
        v, strain = bare.solved(G, slice(None))
        return Steady(v, strain * level_m_s2, G)
    loaded = _Loaded(plate, _condensed(plate.structure, modulus), omega, pitch, root)
    factor = np.ones(len(omega))
    moving = np.arange(len(omega))
    for _ in range(_MOST_STEPS):
        _, strain = loaded.solved(factor[moving] * G[moving], moving)
        goal = np.maximum(1 - soft.k * strain * level_m_s2[moving] / soft.reference_strain, LEAST_FACTOR)
        step = goal - factor[moving]
        factor[moving] += _RELAXED * step
        moving = moving[np.abs(step) > _SETTLED]
        if not moving.size:
            v, strain = loaded.solved(factor * G, slice(None))
            return Steady(v, strain * level_m_s2, factor * G)
    raise ArithmeticError(
        f"softening k = {soft.k:g} finds no steady state at {frequency_hz[moving[0]]:g} Hz: use a smaller k"
    )


def time_shift(drift: TemperatureDrift | None, time_s: Array) -> Array:
    """Factor on the relaxation times, and so on the frequency at which the law is read. Shape (points,)."""
    if drift is None:
        return np.ones(len(time_s))
    kelvin = -drift.kelvin * np.expm1(-time_s / drift.time_constant_s)
    return np.array([wlf_shift(float(k), drift.c1, drift.c2_kelvin) for k in kelvin])


def pitch_per_acceleration(effects: Effects, omega: Array) -> Complex:
    """Angular acceleration of the base over its acceleration, rad/m. Shape of `omega`."""
    rocking, fixture = effects.base_rocking, effects.fixture_resonance
    pitch = np.full(len(omega), rocking.pitch_rad_m if rocking else 0.0, dtype=complex)
    if fixture:
        w0 = 2 * np.pi * fixture.frequency_hz
        pitch += fixture.gain_rad_m * w0**2 / (w0**2 - omega**2 + 2j * fixture.damping_ratio * w0 * omega)
    return pitch


@dataclass(frozen=True)
class _Loaded:
    """A structure under base motion at every point."""

    plate: Mounted
    structure: Structure
    omega: Array
    pitch: Complex
    root: complex
    """Factor on the springs of the clamp."""

    def solved(self, G: Complex, points: NDArray[np.intp] | slice) -> tuple[Complex, Array]:
        """Velocity and core strain per base acceleration at some points, G their modulus."""
        s, omega, pitch = self.structure, self.omega[points], self.pitch[points]
        q = np.concatenate(
            [
                self._displacements(omega[k : k + _CHUNK], pitch[k : k + _CHUNK], G[k : k + _CHUNK])
                for k in range(0, len(omega), _CHUNK)
            ]
        )
        v = 1j * omega * (q @ s.readings[0]) + self.plate.spot_x_m * pitch / (1j * omega)
        square = np.einsum("pi,pi->p", q.conj(), q @ s.branches[0].K).real / self.plate.core_volume_m3
        return v, np.sqrt(np.maximum(square, 0.0))

    def _displacements(self, omega: Array, pitch: Complex, G: Complex) -> Complex:
        """Shape (points, coordinates)."""
        s, w = self.structure, omega[:, None, None]
        Z = s.K - w**2 * s.M + 1j * w * s.C + G[:, None, None] * s.branches[0].K
        for branch in s.branches[1:]:
            Z += self.root * branch.K
        load = s.loads[:, 0] + pitch[:, None] * s.loads[:, 1]
        return np.asarray(np.linalg.solve(Z, load[:, :, None])[:, :, 0])


def _condensed(structure: Structure, modulus: Modulus) -> Structure:
    """On a basis for many solutions with softer and softer cores."""
    law = maxwell_series(lambda omega: modulus(np.asarray(omega, dtype=float)), terms=12)
    return condensed(structure, tuple(law.scaled(f) for f in _FACTORS))[0]
