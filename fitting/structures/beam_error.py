"""How far a beam's theory is from a beam that is a solid: sizes of what it gets wrong.

A clamp holds the width too: near it the beam cannot bend across as it bends along (anticlastic), and is
stiffer there, as if it were shorter by 0.33 nu^2 b at every held end (`HELD_WIDTH`). Farther on that
curvature is hindered the more the shorter the wave is against the width (`ACROSS`). Both, and what is left,
from solids of bricks: thirteen beams 10 to 40 mm wide, sandwiches on one side and on both, free layers, all
four kinds of ends, modes 1 to 4. What faces do that shear and turn, exact elasticity of the layers says.
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.model_error import ModelError
from fitting.specimen import Specimen
from fitting.theory_error import theory_error

HELD_WIDTH = 0.33
"""Of nu^2 times the width: solids have 0.26 to 0.37."""
HELD_WIDTH_WITHIN = 0.2
"""Relative: what is left of it where it is counted."""
FREQUENCY = 7e-4
"""Of a resonance, relative: shortened so, solids are within 5e-4, the worst beam 1.5e-3."""
ACROSS = 0.03
"""Of a resonance, in units of (nu k b)^2: solid free beams are 0.035 higher, clamped ones hardly at all."""
LOSS, LOSS_OF_FREE_LAYER = 7e-3, 1.2e-2
"""Of a modal loss factor, relative. A layer of polymer would bend across more than the metal lets it."""


def shortened_m(width_m: float, poisson: float) -> float:
    """By how much a clamp that holds the width makes a beam stiffer, as a shorter length."""
    return HELD_WIDTH * poisson**2 * width_m


def sandwich_error(layers: Specimen, nu_b_m: float, frequency_hz: Array, G: Complex) -> ModelError:
    """Around some frequencies, the core's modulus there given; `layers` a plate of the same ones.

    `nu_b_m` is the width times Poisson's ratio of the faces. Shape (points,) each.
    """
    found = theory_error(layers, frequency_hz, G)
    return ModelError(
        frequency=np.hypot(FREQUENCY, found.frequency_error),
        loss=np.hypot(LOSS, found.loss_factor_error),
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
