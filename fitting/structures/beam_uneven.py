"""A beam whose core is thicker towards one end or in the middle: which of its matrices change."""

import numpy as np
from numpy.polynomial import Polynomial

from fitting.arrays import Array
from fitting.structures.beam_section import MASSES, BeamSection
from fitting.structures.beam_shapes import gauss

THICKER = {"wedge": Polynomial((-0.5, 1.0)), "bow": Polynomial((-2 / 3, 4.0, -4.0))}
"""How much thicker than in the mean, over x from 0 to 1."""
_UNEVEN = 1e-3
"""Of how its outer face slides: less is in the other columns. A choice."""
_TURNS = 1e-6
"""Of the column that turns the beam most: less is rounding."""


def uneven(section: BeamSection, shape: Polynomial) -> dict[str, Array]:
    """Of a core H (1 + delta) thick, delta times a shape: what goes with H delta, and 1/(1 + delta) - 1.

    With a = (h_b + h_c)/2 the slip is that of 1/H, (H + a)/H and (H + a)^2/H. The last in powers of delta, up
    to the third. The outer face lies as high as the core is thick: it stretches by u_c' + H delta' w'
    (`tilted`). Over all unknowns, shape (size, size) each.
    """
    (h_b, H, h_c), (x, weight) = section.thickness_m, gauss(2 * section.shapes.order)
    L, a, width = section.length_m, (h_b + h_c) / 2, section.copies * section.width_m
    by_inverse = width * np.array([L / H, a / H, a**2 / H / L])
    w, turned, stretched = (section.shapes.rows(*one) for one in (("w", x), ("w", x, 1), ("c", x, 1)))
    thick, slope = shape(x), shape.deriv()(x)
    crossed = (stretched * weight * slope) @ turned.T
    found = {f"inverse_{n}": (-1) ** n * _sheared(section, by_inverse, thick**n) for n in (1, 2, 3)}
    found["K_1"] = _sheared(section, width * np.array([0.0, 0.0, H / L]), thick)
    outer = section.coefficients[1]
    found["tilted_1"] = outer * H / L * (crossed + crossed.T)
    found["tilted_2"] = outer * (H / L) ** 2 * np.asarray((turned * weight * slope**2) @ turned.T)
    found["M"] = _core_mass(section) * np.asarray((w * weight * thick) @ w.T)
    return found


def where_uneven(section: BeamSection, own: Array, size: Array, shape: Polynomial) -> Array:
    """How the outer face slides as far as it is higher where the beam is turned. Shape (size, any)."""
    if not section.is_sandwich or section.is_doubled:
        return np.zeros((len(own), 0))
    s, (x, weight) = section.shapes, gauss(2 * section.shapes.order)
    at = np.arange(s.size)[s.place["c"]]
    at = at[s.is_held[at]]
    slides = shape(x)[:, None] * (s.rows("w", x, 1).T @ own)
    root = np.sqrt(weight)[:, None]
    above = np.zeros_like(own)
    above[at] = np.linalg.lstsq(root * s.rows("c", x)[at].T, root * slides, rcond=None)[0]
    scale = np.where(size > 0, size, 1.0)[:, None]
    Q, Y = own / scale, above / scale
    far = np.linalg.norm(Y, axis=0)
    # A column that turns nothing has no direction here.
    turns = far > _TURNS * far.max()
    Y = Y[:, turns] / far[turns]
    left, values, _ = np.linalg.svd(Y - Q @ (Q.T @ Y), full_matrices=False)
    return np.asarray(scale * left[:, values > _UNEVEN])


def loads_of_uneven(section: BeamSection, V: Array) -> dict[str, Array]:
    """What a moving base drives more, `V` the columns. Shape (k,) each."""
    x, weight = gauss(2 * section.shapes.order)
    moves = -_core_mass(section) * (V.T @ section.shapes.rows("w", x)) * weight
    return {f"uneven_{name}.load": moves @ shape(x) for name, shape in THICKER.items()}


def _sheared(section: BeamSection, coefficients: Array, share: Array | float) -> Array:
    x, weight = gauss(2 * section.shapes.order)
    return np.tensordot(coefficients, section.shapes.slip(x, weight * share, section.arms), axes=1)


def _core_mass(section: BeamSection) -> float:
    mass, *faces = section.coefficients[MASSES]
    return mass - sum(faces)
