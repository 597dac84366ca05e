"""From drive volts to the motion of the base: modes of suspension, fixture, armature. The plate is no load.

Base displacement is a sum of second-order sections, gain_k / (s^2 + 2 zeta_k w_k s + w_k^2) times the volts.
"""

from dataclasses import dataclass

import numpy as np

from drivers.arrays import Array


@dataclass(frozen=True)
class ShakerMode:
    """One mode of the shaker."""

    frequency_hz: float
    damping_ratio: float
    gain_m_s2_v: float
    """Its part of the base acceleration per volt, far above the frequency."""

    @property
    def omega(self) -> float:
        """In rad/s."""
        return 2 * np.pi * self.frequency_hz


@dataclass(frozen=True)
class ShakerChain:
    """The chain from volts to base motion."""

    sections: tuple[ShakerMode, ...] = (
        ShakerMode(11.0, 0.12, 7.0),
        ShakerMode(162.0, 0.03, 1.4),
        ShakerMode(1900.0, 0.04, 3.0),
    )
    second_harmonic: float = 0.002
    """Distortion: a drive at twice the frequency, as a fraction of the drive."""
    third_harmonic: float = 0.001

    def acceleration(self, omega: float) -> complex:
        """Base acceleration in m/s^2 per volt."""
        s = 1j * omega
        parts = (
            k.gain_m_s2_v * s**2 / (s**2 + 2 * k.damping_ratio * k.omega * s + k.omega**2)
            for k in self.sections
        )
        return complex(sum(parts))

    def first_order(self) -> tuple[Array, Array]:
        """A and b of x' = A x + b u; states w_k x_k, then x_k', of each section. Shapes (n, n) and (n,)."""
        w = np.array([k.omega for k in self.sections])
        zeta = np.array([k.damping_ratio for k in self.sections])
        zero = np.zeros((len(w), len(w)))
        A = np.block([[zero, np.diag(w)], [-np.diag(w), -np.diag(2 * zeta * w)]])
        return A, np.concatenate([np.zeros(len(w)), [k.gain_m_s2_v for k in self.sections]])
