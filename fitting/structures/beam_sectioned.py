"""A beam's matrices over all unknowns, with what its width and its faces' own shear add to them."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from fitting.arrays import Array
from fitting.structures.beam_apart import ODD, Squeezed, stretched
from fitting.structures.beam_section import PARTS, BeamSection
from fitting.structures.beam_shapes import BeamMatrices, matrices_of, square
from fitting.structures.beam_width import (
    PLACES,
    WEIGHT,
    curved_across,
    followed,
    give_of_face,
    give_of_layer,
    narrowed,
    sheared,
)


def summed(section: BeamSection, which: str) -> Array:
    """K_0, K_1 or M over all unknowns, K_1 for a modulus of one. Shape (size, size)."""
    return np.tensordot(section.coefficients[PARTS[which]], getattr(sectioned(section), which), axes=1)


def sectioned(section: BeamSection) -> BeamMatrices:
    """Matrices of its ends with what its width does; K_0 has what is more where that is held before the pull.

    One set wherever a force drives.
    """
    return _sectioned(replace(section, forced_at=()))


@lru_cache(maxsize=64)
def _sectioned(section: BeamSection) -> BeamMatrices:
    plain = matrices_of(section.ends, section.share, section.arms, section.order)
    faces, pull = plain.K_0[:4], plain.K_0[4:]
    if section.is_slender:
        return replace(plain, K_0=np.concatenate([faces, np.zeros_like(faces), pull]))
    free, held = (_across(section, held=held) for held in (False, True))
    s, K_0 = section.shapes, faces + free
    for n, k, nu in _faces(section):
        give, bend = give_of_face(section.thickness_m[k] / section.length_m, nu), _bend(section, n)
        if section.is_sandwich:
            # The core pulls on its sections too: their shear is an unknown.
            angle = s.rows(("p_b", "p_c")[n], PLACES)
            K_0[2 + n] += square(bend, WEIGHT) + square(angle, WEIGHT) / give - faces[2 + n]
        else:
            K_0[2 + n] -= sheared(bend, bend, give, section.ends)
    return replace(plain, K_0=np.concatenate([K_0, held - free, pull]), K_1=plain.K_1 + _core_across(section))


def _core_across(section: BeamSection) -> Array:
    """What a width adds to a core's shear, and what width and shear do to a free layer. As K_1."""
    s, L = section.shapes, section.length_m
    (nu_b, nu_v, _), h_v = section.poisson, section.thickness_m[1]
    bend, found = s.rows("w", PLACES, 2), np.zeros_like(matrices_of(section.ends, order=section.order).K_1)
    if section.is_sandwich:
        # Its faces narrow by what it lets them slip, and it shears across.
        nu = section.faces_poisson
        apart = s.rows("c", PLACES, 1) - s.rows("b", PLACES, 1)
        apart, bend = (followed(e, section.reach(0), section.ends) for e in (apart, bend))
        crossed = (apart * WEIGHT) @ bend.T
        slip = np.array([square(apart, WEIGHT), crossed + crossed.T, square(bend, WEIGHT)])
        found[:3] = (nu * section.width_m / L) ** 2 / 12 * slip
        found[13] = _core_stretched(section)
    elif h_v:
        stretch, give = s.rows("b", PLACES, 1), give_of_layer(h_v / L, nu_v)
        crossed = sheared(stretch, bend, give, section.ends)
        found[3] -= sheared(stretch, stretch, give, section.ends)
        found[4] += crossed + crossed.T
        found[5] -= sheared(bend, bend, give, section.ends)
        across = curved_across(bend, section.reach(0), section.ends, held=False)
        found[5] += nu_b**2 / (1 + nu_v) / (1 - nu_b) * across
    return found


def _core_stretched(section: BeamSection) -> Array:
    """Of one side's core: e_z = a/H - 8 m z/H^2, and e_x as its two faces have it. As K_1, times H/L."""
    s, L = section.shapes, section.length_m
    h_b, h_v, h_c = section.thickness_m
    core = Squeezed(h_v / L, section.width_m / L, section.poisson[1], section.faces_poisson, section.ends)
    below = s.rows("b", PLACES, 1) - h_b / 2 / L * _bend(section, 0)
    above = s.rows("c", PLACES, 1) + h_c / 2 / L * _bend(section, 1)
    mean = stretched(s.rows("a", PLACES), h_v / L * (above + below) / 2, core)
    # Over its thickness z^2 is a twelfth on the average.
    return mean + stretched(-8 * s.rows("m", PLACES), h_v / L * (above - below), core, ODD) / 12


def _bend(section: BeamSection, face: int) -> Array:
    """By which the sections of one of the two faces turn along it. Shape (size, places)."""
    s = section.shapes
    curvature = s.rows("w", PLACES, 2) + (face - section.share) * s.rows("a", PLACES, 2)
    return curvature - s.rows(("p_b", "p_c")[face], PLACES, 1) if section.is_sandwich else curvature


def _faces(section: BeamSection) -> list[tuple[int, int, float]]:
    """Which of the two, place among the layers, Poisson's ratio."""
    return [(n, 2 * n, section.poisson[2 * n]) for n in (0, 1) if section.rigidity[n] > 0]


def _across(section: BeamSection, *, held: bool) -> Array:
    """What a width adds to stretching of u_b and u_c and to bending of both. Shape (4, size, size)."""
    s, found = section.shapes, np.zeros((4, section.shapes.size, section.shapes.size))
    for n, k, nu in _faces(section):
        stretch = s.rows("c" if k else "b", PLACES, 1)
        stiffer = nu**2 / (1 - nu**2)
        if section.is_sandwich:
            width = section.width_m / section.length_m
            found[n] = stiffer * narrowed(stretch, width, nu, section.ends, held=held)
        bent = curved_across(_bend(section, n), section.reach(k), section.ends, held=held)
        found[2 + n] = stiffer * bent
    return found
