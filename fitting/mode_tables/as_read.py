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
from scipy.optimize.elementwise import find_root

from fitting.arrays import Array, Complex

Read = Literal["model", "poles", "half-power"]
READS: tuple[str, ...] = get_args(Read)

_NEWTON = 40
"""Steps to a pole: a handful are taken."""
_STILL = 1e-13
"""A step to a pole that is smaller than this is the last one: rounding."""
_COME_TO = 1e-6
"""A step above which the last one has come to no pole: those that have one end at rounding."""
_OUT = 8.0
"""How far from a peak its half-power points are searched, in ln omega: within it any mode has come down."""


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

    def denominator(self, t: Complex | Array) -> tuple[Complex, Complex]:
        """Lambda - omega^2 at t = ln x, and its derivative to t."""
        core, viscous, heavy = self.core * np.exp(self.sigma * t), self.viscous * np.exp(t), np.exp(2 * t)
        return self.rest + core + viscous - heavy, self.sigma * core + viscous - 2 * heavy

    def pole(self) -> Complex:
        """In ln x; NaN where a mode has none. Shape (modes,)."""
        t: Complex = np.asarray(np.log(self.rest + self.core + self.viscous) / 2, complex)
        for _ in range(_NEWTON):
            D, D_1 = self.denominator(t)
            t = np.asarray(t - D / D_1, complex)
            if np.abs(D / D_1).max() < _STILL:
                break
        # What oscillates no more has none: steps go on, or end where it would gain.
        return np.where((np.abs(D / D_1) < _COME_TO) & (t.imag >= 0), t, np.nan)

    def size(self, t: Array) -> tuple[Array, Array]:
        """Ln of the velocity's amplitude, and its slope over t."""
        D, D_1 = self.denominator(t)
        return t - np.log(np.abs(D)), 1 - (D_1 / D).real


def as_read(how: Read, k: Stiffness) -> tuple[Array, Array]:
    """Ln of the frequency read over the model's, and the loss factor read. Shape (modes,) each.

    A mode that has no pole or peak to be read, as a search may come by with losses of 2 and more, is left as
    it is.
    """
    own = np.zeros(len(k.core)), k.loss_factor
    if how == "model":
        return own
    with np.errstate(all="ignore"):
        f, eta = _pole(k) if how == "poles" else _peak(k)
    there = np.isfinite(f) & np.isfinite(eta)
    return np.where(there, f, own[0]), np.where(there, eta, own[1])


def _pole(k: Stiffness) -> tuple[Array, Array]:
    pole = k.pole()
    return pole.real, 2 * np.sin(pole.imag)


def _peak(k: Stiffness) -> tuple[Array, Array]:
    pole = k.pole()
    # A peak is no further from its pole's frequency than half its width.
    peak = _root(1, k, (pole.real - pole.imag, pole.real + pole.imag), 0.0)
    level = k.size(peak)[0] - np.log(2) / 2
    low, high = (_root(0, k, (peak, peak + side * _OUT), level) for side in (-1, 1))
    return peak, np.exp(high - peak) - np.exp(low - peak)


def _root(derivative: int, k: Stiffness, bracket: tuple[Array, Array], level: Array | float) -> Array:
    """Where ln of the amplitude, or its slope, has a value. Shape (modes,)."""

    def off(t: Array, level: Array, *parts: Complex) -> Array:
        return np.asarray(Stiffness(*parts).size(t)[derivative] - level)

    found = find_root(off, bracket, args=(level, k.rest, k.core, k.sigma, k.viscous))
    return np.asarray(found.x)
