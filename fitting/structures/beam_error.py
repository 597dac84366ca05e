"""How far a beam's theory is from a beam that is a solid: sizes of what it gets wrong.

Against solids of bricks, ten beams 12 to 30 mm wide, soft and stiff cores, sandwiches on one side and on
both, a free layer, all four kinds of ends, modes below 2.5 kHz: what is left once width, turning and the
faces' own shear are counted (`beam_width`). So is a core that stretches across its thickness (`beam_apart`):
exact elasticity of the layers says how much that does, and a share of it is left.
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.discrepancy.model_error import ModelError
from fitting.discrepancy.theory_error import theory_error, thickness_error
from fitting.specimen import PlateSpecimen

HELD_WIDTH = 0.33
"""Of nu^2 times the width: what a held width does to the first modes, as a shorter span. Solids have 0.26 to
0.37; only to say how much it is, and as its unit."""
HELD_WIDTH_WITHIN = 0.2
"""Relative: what is left of it where it is counted."""
FREQUENCY = 5e-4
"""Relative error of every resonance's frequency."""
ACROSS = 5e-3
"""Of a resonance, in units of (nu k b)^2: short waves, where curvature across is no parabola."""
APART_LEFT = 0.15
"""Of what exact elasticity says of a core that stretches: left where it is counted, beside what is common to
all resonances. Six free solids, thin and thick cores, faces alike and not: 0.01 to 0.15 where it does less
than 30 %."""
LOSS, LOSS_OF_FREE_LAYER = 3e-3, 7e-3
"""Of a modal loss factor, relative. A layer of polymer gives way at its edges."""

METAL_LOSS = 1e-3
"""A loss factor: bare metal beams in a clamp have 0.0002 to 0.002, whose root mean square this is."""


def shortened_m(width_m: float, poisson: float) -> float:
    """By how much a clamp that holds the width makes a beam stiffer, as a shorter length."""
    return HELD_WIDTH * poisson**2 * width_m


def sandwich_error(layers: PlateSpecimen, nu_b_m: float, frequency_hz: Array, G: Complex) -> ModelError:
    """Around some frequencies, the core's modulus there given; `layers` a plate of the same ones.

    `nu_b_m` is the width times Poisson's ratio of the faces. Shape (points,) each.
    """
    found = theory_error(layers, frequency_hz, G)
    frequency, loss = thickness_error(layers, found.wavenumber, G)
    return ModelError(
        frequency=np.hypot(FREQUENCY, APART_LEFT * frequency),
        loss=np.hypot(LOSS, APART_LEFT * loss),
        modal_loss=found.loss_factor,
        together=_across(found.wavenumber, nu_b_m),
    )


def free_layer_error(rigidity: Complex, mass_kg_m: float, nu_b_m: float, frequency_hz: Array) -> ModelError:
    """The same of a beam that bends as one, its complex rigidity in N m^2 given. Shape (points,) each."""
    omega = 2 * np.pi * frequency_hz
    wavenumber = (omega**2 * mass_kg_m / rigidity.real) ** 0.25
    return ModelError(
        frequency=np.full(len(omega), FREQUENCY),
        loss=np.full(len(omega), LOSS_OF_FREE_LAYER),
        modal_loss=rigidity.imag / rigidity.real,
        together=_across(wavenumber, nu_b_m),
    )


def _across(wavenumber: Array, nu_b_m: float) -> Array:
    return ACROSS * (wavenumber * nu_b_m)[None] ** 2
