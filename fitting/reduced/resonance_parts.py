"""A plate's response by its resonances: what each of them has in it, and what all beyond a band have.

With phi_r a real mode at the core's modulus of its own frequency, phi_r^T M phi_r = 1, and q, z the answers
to the load and to a unit force at the pickup (observe = the row that reads)

    x_r = (observe . phi_r) (phi_r^T M q),   d x / d ln f_r = -2 (z^T M phi_r) (phi_r^T K q)

with K = K_0 + G K_1. The parts of all modes add up to x and to its derivative to all natural frequencies.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from fitting.arrays import Array, Complex
from fitting.laws import CoreLaw

_NEAR = 1.5
"""Ratio by which a resonance may move from the modulus of a band's middle to that of its own: a choice."""


@dataclass(frozen=True)
class Answers:
    """Of a plate with the law's modulus, at some frequencies."""

    K_0: Complex
    K_1: Array
    M: Array
    observe: Array
    """Shape (k,)."""
    q: Complex
    """To its load. Shape (points, k)."""
    z: Complex
    """To a unit force at its pickup. Shape (points, k)."""
    G: Complex
    """Shape (points,)."""

    @property
    def displacement(self) -> Complex:
        """Read at the pickup. Shape (points,)."""
        return self.q @ self.observe

    def by_frequency(self, shape: Array | None = None) -> Complex:
        """Derivative of the displacement to the logarithm of all natural frequencies, or of one mode's.

        Shape (points,), of a mode's shape (k,).
        """
        strained = self.q @ self.K_0.T + self.G[:, None] * (self.q @ self.K_1.T)
        if shape is None:
            return np.asarray(-2 * (self.z * strained).sum(axis=1))
        return np.asarray(-2 * (self.z @ (self.M @ shape)) * (strained @ shape))


@dataclass(frozen=True)
class Part:
    """Of a response: one resonance of a band, or what it has from all others."""

    frequency_hz: float
    displacement: Complex
    """Shape (points,)."""
    by_frequency: Complex
    """Derivative of the displacement to ln of its natural frequency. Shape (points,)."""
    shape: Array | None = None
    """Of the one resonance of the band in it. Shape (k,)."""


def parts_of(answers: Answers, law: CoreLaw, low_hz: float, high_hz: float) -> list[Part]:
    """The resonances of a band in ascending order, then the rest; with one or none all is one part.

    What lies beyond is as uncertain as at the band's upper end; where all is one part its frequency is the
    band's middle.
    """
    whole = answers.displacement, answers.by_frequency()
    modes = modes_between(answers, law, low_hz, high_hz)
    if len(modes) < 2:
        middle, shape = float(np.sqrt(low_hz * high_hz)), modes[0].shape if modes else None
        return [Part(middle, whole[0], whole[1], shape)]
    found = [
        Part(
            m.frequency_hz,
            (answers.observe @ m.shape) * (answers.q @ (answers.M @ m.shape)),
            answers.by_frequency(m.shape),
            m.shape,
        )
        for m in modes
    ]
    x, by_frequency = whole
    rest = x - sum(p.displacement for p in found), by_frequency - sum(p.by_frequency for p in found)
    return [*found, Part(high_hz, *rest)]


class Moving(Protocol):
    """What moves: shape (k, k) each."""

    @property
    def K_0(self) -> Complex:
        """Without the core's shear."""

    @property
    def K_1(self) -> Array:
        """Stiffness that goes with the core's modulus."""

    @property
    def M(self) -> Array:
        """Inertia."""


@dataclass(frozen=True)
class RealMode:
    """Of a plate at the core's modulus of its own frequency, phi^T M phi = 1."""

    number: int
    """Among all it has, from 0 in ascending order."""
    frequency_hz: float
    shape: Array
    """Shape (k,)."""


def modes_between(moving: Moving, law: CoreLaw, low_hz: float, high_hz: float) -> list[RealMode]:
    """Those in a band, each at the modulus of its own frequency, ascending."""
    omega_r, _ = _at(moving, law, np.sqrt(low_hz * high_hz))
    found = []
    for r in np.flatnonzero((omega_r > 2 * np.pi * low_hz / _NEAR) & (omega_r < 2 * np.pi * high_hz * _NEAR)):
        own, shapes = _at(moving, law, omega_r[r] / (2 * np.pi))
        f = float(own[r] / (2 * np.pi))
        if low_hz < f < high_hz:
            found.append(RealMode(int(r), f, shapes[:, r]))
    return found


def _at(moving: Moving, law: CoreLaw, frequency_hz: float) -> tuple[Array, Array]:
    """Natural frequencies in rad/s and shapes under the modulus of one frequency. Shapes (k,), (k, k)."""
    G = law.modulus(np.array([2 * np.pi * frequency_hz]))[0]
    squared, shapes = eigh(np.real(moving.K_0) + G.real * moving.K_1, moving.M)
    return np.sqrt(np.maximum(squared, 0.0)), shapes
