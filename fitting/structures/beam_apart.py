"""A core that stretches across its thickness: what it takes to move a sandwich beam's faces apart.

The layers above and below are no longer at one w: w_b = w - beta a, w_c = w + (1 - beta) a. Per volume, nu
and G of the core, e_z = a/H, e_x what its faces stretch on the average, e_y = -nu_f e_x,

    G/(1 - nu) (e_z + nu e_x)^2 + K/2 (e_z + nu/(1 - nu) (e_x + e_y)) p,   K = 2 G nu^2/((1 - 2 nu)(1 - nu))

the first held along alone, the second what it is stiffer by where it is held across too. A core that hardly
gives in volume flows to its free edges, as a layer between plates does (Gent and Lindley 1959, with
compressibility): p - l^2 (p_xx + p_yy) = that strain, l^2 = K H^2/(12 G), p zero at free edges. All of it
goes with G. Lengths are in shares of the beam's.

Its middle may rise by m beside its faces, w = ... + (1 - 4 z^2/H^2) m: its own inertia does that, and faces
that stretch it unevenly. The strain then goes with z, and so does p.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.structures.beam_shapes import square
from fitting.structures.beam_width import WEIGHT, flowing

APART_WITHIN = 0.2
"""Relative: what is left open of it where Poisson's ratio is known. Solids say 0.03 to 0.05 of faces of
1.5 mm of steel and more, 0.25 of a soft core of 5 mm under 1 mm of aluminium, that bends across too."""
_WAVES = 10
"""Of the pressure across the width, cosines: what is left falls with the fourth power."""
_STEP = 0.5
"""Of a tolerance, that a derivative is taken over."""
_LARGEST_POISSON = 0.4995
"""Below one half, where a core would not give in volume at all."""


EVEN, ODD = 12.0, 60.0
"""G/H^2 times this holds a flow along the layer: of an even pressure, and of one that goes with z."""


@dataclass(frozen=True)
class Squeezed:
    """A core between two faces; lengths in shares of the beam's."""

    thickness: float
    width: float
    poisson: float
    of_faces: float
    """Their Poisson's ratio."""
    ends: str


def held_along(poisson: float) -> float:
    """Stiffness in units of G of a core that may narrow across: E/(1 - nu^2)."""
    return 2 / (1 - poisson)


def held_across(poisson: float) -> float:
    """By how much it is stiffer where it may not."""
    return 2 * poisson**2 / (1 - 2 * poisson) / (1 - poisson)


def stretched(rises: Array, along: Array, core: Squeezed, flow: float = EVEN) -> Array:
    """Twice the energy above per volume and G, integrated over the length.

    `rises` is e_z and `along` e_x at `beam_width.PLACES`, shape (k, places). Returns (k, k).
    """
    nu = core.poisson
    K, reach_2 = held_across(nu), held_across(nu) * core.thickness**2 / flow
    found = held_along(nu) * square(rises + nu * along, WEIGHT)
    strain = rises + nu / (1 - nu) * (1 - core.of_faces) * along
    for n in range(_WAVES):
        wave = (2 * n + 1) * np.pi / core.width
        share = 8 / ((2 * n + 1) * np.pi) ** 2
        softer = 1 + reach_2 * wave**2
        found = found + share * K / softer * flowing(strain, np.sqrt(reach_2 / softer), core.ends)
    return np.asarray(found)


def stiffness_across(thickness: float, width: float, poisson: float) -> float:
    """The same in units of G of a long beam in even stretch."""
    K = held_across(poisson)
    s = width / 2 / np.sqrt(K * thickness**2 / 12)
    return float(held_along(poisson) + K * (1 - np.tanh(s) / s))


def open_by_poisson(thickness: float, width: float, poisson: float, tolerance: float) -> float:
    """What a relative tolerance of Poisson's ratio leaves open of it, in its logarithm."""
    if not tolerance:
        return 0.0
    low, high = (
        stiffness_across(thickness, width, min(poisson * np.exp(s * tolerance), _LARGEST_POISSON))
        for s in (-_STEP, _STEP)
    )
    return float(np.log(high / low) / (2 * _STEP))
