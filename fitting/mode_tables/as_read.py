"""What a test reads of a mode where the core changes over its resonance.

About omega_r a mode answers by 1/(lambda(omega) - omega^2), and lambda follows the core. With
x = omega/omega_r:

    lambda(omega)/omega_r^2 = rest + core x^sigma + viscous x,   sigma = d ln G*/d ln omega at omega_r

* the model's own mode: omega_r and eta, the core held as it is at omega_r;
* a pole p, as fits to an FRF find it: p^2 = lambda(p); read are |p| and 2 Im p/|p|;
* a peak of the velocity and its half-power width over it: the largest |omega/(lambda - omega^2)|, and where
  that has come down by the square root of two.

To first order poles and widths are eta/(1 - s/2), s = d ln Re lambda/d ln omega: a stiffness that rises with
frequency is outrun later.
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from fitting.arrays import Array, Complex

Read = Literal["model", "poles", "half-power"]
READS: tuple[str, ...] = get_args(Read)

_NEWTON = 40
"""Steps to a pole or a peak: a handful are taken."""
_STILL = 1e-13
"""A step that is the last."""
_HALVED = 45
"""Halvings of a bracket: to 1e-13 of it."""
_OUT = 8.0
"""In ln omega, from a peak: beyond it any mode has come down."""
_FARTHEST = 0.3
"""In ln omega: a Newton step at most, so that a peak as wide as its frequency is not overrun."""


@dataclass(frozen=True)
class Stiffness:
    """Lambda over omega_r^2 and what it is made of, so that its parts add up to 1 + i eta. Shape (modes,)."""

    rest: Complex
    core: Complex
    sigma: Complex
    viscous: Complex

    @property
    def loss_factor(self) -> Array:
        """Of the model's own modes."""
        whole = self.rest + self.core + self.viscous
        return np.asarray(whole.imag / whole.real)

    def denominator(self, t: Complex | Array) -> tuple[Complex, Complex, Complex]:
        """Lambda - omega^2 at t = ln x, and two derivatives to t."""
        core, viscous, heavy = self.core * np.exp(self.sigma * t), self.viscous * np.exp(t), np.exp(2 * t)
        return (
            self.rest + core + viscous - heavy,
            self.sigma * core + viscous - 2 * heavy,
            self.sigma**2 * core + viscous - 4 * heavy,
        )

    def pole(self) -> Complex:
        """In ln x."""
        t: Complex = np.asarray(np.log(self.rest + self.core + self.viscous) / 2, complex)
        for _ in range(_NEWTON):
            D, D_1, _ = self.denominator(t)
            t = np.asarray(t - D / D_1, complex)
            if np.abs(D / D_1).max() < _STILL:
                break
        return t

    def size(self, t: Array) -> tuple[Array, Array, Array]:
        """Ln of the velocity's amplitude, and two derivatives to t."""
        D, D_1, D_2 = self.denominator(t)
        return t - np.log(np.abs(D)), 1 - (D_1 / D).real, -(D_2 / D - (D_1 / D) ** 2).real


def as_read(how: Read, k: Stiffness) -> tuple[Array, Array]:
    """Ln of the frequency read over the model's, and the loss factor read. Shape (modes,) each."""
    if how == "model":
        return np.zeros(len(k.core)), k.loss_factor
    pole = k.pole()
    if how == "poles":
        return pole.real, 2 * np.sin(pole.imag)
    peak = _peak(k, pole.real)
    level = k.size(peak)[0] - np.log(2) / 2
    low, high = (_crossing(k, peak, s * _OUT, level) for s in (-1, 1))
    return peak, np.exp(high - peak) - np.exp(low - peak)


def _peak(k: Stiffness, t: Array) -> Array:
    for _ in range(_NEWTON):
        _, slope, bend = k.size(t)
        # Uphill where it is not yet a hill.
        step = np.clip(slope / np.maximum(-bend, 1e-3), -_FARTHEST, _FARTHEST)
        t = t + step
        if np.abs(step).max() < _STILL:
            break
    return t


def _crossing(k: Stiffness, peak: Array, reach: float, level: Array) -> Array:
    """Where the amplitude has come down to `level` between a peak and so far from it."""
    above, below = peak, peak + reach
    for _ in range(_HALVED):
        middle = (above + below) / 2
        over = k.size(middle)[0] > level
        above, below = np.where(over, middle, above), np.where(over, below, middle)
    return np.asarray((above + below) / 2)
