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
WIDE_FROM, WIDE_LOSS, WIDE_FREQUENCY = 0.3, 0.025, 4e-4
"""Of half the width over the length in which a core's shear dies out from an edge: from where, of the loss
for each more, of the frequency for its square. Across a stiff core shear is no smooth curve of the width, and
the theory's loss is too low: solids of aluminium and of steel 4 to 40 mm wide, 30 to 450 MPa, have 0.4 % at
0.3, 2.3 to 3.5 % at 1.7, 6 to 8 % at 3.3, all modes alike."""

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
    wide = np.maximum(_half_widths(layers, G) - WIDE_FROM, 0.0)
    return ModelError(
        frequency=np.sqrt(FREQUENCY**2 + (APART_LEFT * frequency) ** 2 + (WIDE_FREQUENCY * wide**2) ** 2),
        loss=np.sqrt(LOSS**2 + (APART_LEFT * loss) ** 2 + (WIDE_LOSS * wide) ** 2),
        modal_loss=found.loss_factor,
        together=_across(found.wavenumber, nu_b_m),
    )


def _half_widths(layers: PlateSpecimen, G: Complex) -> Array:
    """Half the width over sqrt(h E1 h1 E3 h3 / (E1 h1 + E3 h3) / abs(G)). Shape of `G`."""
    b, c, v = layers.substrate, layers.constraining, layers.core
    assert v is not None
    assert c is not None
    stiff = b.young_pa * b.thickness_m, c.young_pa * c.thickness_m
    dies_out = np.sqrt(v.thickness_m * stiff[0] * stiff[1] / sum(stiff) / np.abs(G))
    return np.asarray(layers.width_m / 2 / dies_out)


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
