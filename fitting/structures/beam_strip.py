"""A bare strip of the substrate between a clamp and a treatment that ends short of it.

An Euler-Bernoulli beam of length g, held at its other end: where the sandwich begins it resists w, the turn t
and u_b, and drags along. With the consistent matrices of a beam element (e.g. Cook, Malkus, Plesha and Witt,
Concepts and Applications of Finite Element Analysis)

    EI/g^3 (12 w^2 - 12 g w t + 4 g^2 t^2) + E A u_b^2/g,   m g (13/35 w^2 - 11/105 g w t + g^2/105 t^2)

twice the energies, and -m g (w/2 - g t/12) what a base that lifts does. Here without their powers of g.
"""

import numpy as np

from fitting.arrays import Array
from fitting.structures.beam_section import MASSES, BeamSection


def strip(section: BeamSection) -> dict[str, Array]:
    """Matrices by the power of g that they go with, at all held ends. Over all unknowns, (size, size)."""
    E_A, E_I, m = _of_substrate(section)
    w, t, u_b = _at_ends(section)
    crossed = w @ t.T
    return {
        "slide": E_A * u_b @ u_b.T,
        "spring_3": 12 * E_I * w @ w.T,
        "spring_2": -6 * E_I * (crossed + crossed.T),
        "spring_1": 4 * E_I * t @ t.T,
        "mass_1": 13 / 35 * m * w @ w.T,
        "mass_2": -11 / 210 * m * (crossed + crossed.T),
        "mass_3": m / 105 * t @ t.T,
    }


def loads_of_strip(section: BeamSection, V: Array) -> dict[str, Array]:
    """What a moving base drives more, `V` the columns. Shape (k,) each."""
    _, _, m = _of_substrate(section)
    w, t, _ = (V.T @ rows for rows in _at_ends(section))
    return {"lift_1": -m / 2 * w.sum(axis=1), "lift_2": m / 12 * t.sum(axis=1)}


def _of_substrate(section: BeamSection) -> tuple[float, float, float]:
    """E A, E I and the mass per length."""
    c, L = section.coefficients, section.length_m
    return c[0] * L, c[2] * L**3, c[MASSES][1] / L


def _at_ends(section: BeamSection) -> tuple[Array, Array, Array]:
    """The substrate's w, its slope inwards and u_b at the held ends. Shape (size, ends) each."""
    s, ends = section.shapes, np.array(section.shapes.held_ends)
    inwards = np.where(ends == 0, 1.0, -1.0) / section.length_m
    w, slope = (s.rows("w", ends, d) - section.share * s.rows("a", ends, d) for d in (0, 1))
    return w, inwards * slope, s.rows("b", ends)
