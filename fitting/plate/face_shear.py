"""A core that pulls on its faces shears them across their thickness: one slip of both, beside the core's own.

    gamma = (u_c - u_b + d w' - g)/H,   g = sum of h_i p_i/2,   p_i = r_i g

p_i is the angle by which the sections of face i turn against w'. A pull tau on the face's surface shears it
most cheaply by p_i = tau/(2 m_i kappa G_i), m_i faces alike; what ties both to one slip is that share. Twice
the energy per area is then, beside that of the plate without,

    g^2/S + sum of m_i D_i ((w'' - r_i g')^2 - w''^2),   S = sum of h_i/(4 m_i kappa G_i)

so that a node needs the two numbers that a slip of glue is; both are in series. Against exact elasticity of
glass, aluminium and steel about stiff cores, waves fifty thicknesses long, what the theory gets wrong of a
frequency falls from 0.1 to 0.005 %, of a loss factor from 0.2 to 0.01 %.

Source: Timoshenko's shear angle, of each face: e.g. Reddy, Mechanics of Laminated Composite Plates and Shells
(2004), ch. 12, layer by layer.
"""

from dataclasses import dataclass, replace

from fitting.plate.edge_twist import EDGE_WIDTH
from fitting.specimen import Specimen
from fitting.stated.layers import Face, as_isotropic

KAPPA = 5 / 6
"""Reissner's, for parabolic shear across a face."""
MATTERS = 3e-3
"""Share of the slip that faces take, from which on it is counted: below, a modulus is off by as much at most,
a tenth of what is stated of a core's thickness."""


@dataclass(frozen=True)
class Slip:
    """What gives way beside the core, of all treated sides together."""

    stiffness_pa_m: complex
    """Shear stress over slip, of glue and sheared faces in series; complex where it loses energy."""
    turn_b: complex
    """Of the substrate's sections for a unit of slip, in 1/m; zero where faces do not shear."""
    turn_c: complex
    """Of the constraining layer's."""


def slip_of(specimen: Specimen) -> Slip | None:
    """Of glue, of sheared faces or of both; None where nothing but the core slips."""
    core, c = specimen.core, specimen.constraining
    if core is None or c is None or not specimen.slips:
        return None
    sides = 2 if specimen.both_sides else 1
    glue = 1 / (sides * core.glue_stiffness_pa_m) if core.glue else 0.0
    if not specimen.faces_shear:
        return Slip(1 / glue, 0.0, 0.0)
    angles = [1 / (2 * times * KAPPA * _shear(face)) for face, times in ((specimen.substrate, 1), (c, sides))]
    faces = _faces_give(specimen)
    whole = faces + glue
    # What the glue slips turns no section.
    turn_b, turn_c = (angle / whole for angle in angles)
    return Slip(1 / whole, turn_b, turn_c)


def edge_twist_left(face: Face, side_m: float) -> float:
    """Of what a free edge lacks in twist (`fitting.plate.edge_twist`), what elements so wide leave to it.

    Their sections turn at the edge, linearly to none a side further in: as much as makes twist and shear of
    the face least relieves a width of x/(x + kappa side^2/3) sides, x = h^2/12.
    """
    x = face.thickness_m**2 / 12
    relieved_m = side_m * x / (x + KAPPA * side_m**2 / 3)
    return max(0.0, 1 - relieved_m / (EDGE_WIDTH * face.thickness_m))


def counted(specimen: Specimen, modulus_pa: float) -> Specimen:
    """With the shear of its faces counted where that matters beside a core so stiff."""
    return replace(specimen, faces_shear=share(specimen, modulus_pa) > MATTERS)


def share(specimen: Specimen, modulus_pa: float) -> float:
    """Of the slip between its faces' middles, what they take themselves beside a core of some modulus."""
    if specimen.core is None or specimen.constraining is None:
        return 0.0
    sides = 2 if specimen.both_sides else 1
    faces, core = _faces_give(specimen), specimen.core.thickness_m / (sides * modulus_pa)
    return float(abs(faces) / (abs(faces) + core))


def _faces_give(specimen: Specimen) -> complex:
    """S in m/Pa."""
    c, sides = specimen.constraining, 2 if specimen.both_sides else 1
    assert c is not None
    each = ((specimen.substrate, 1), (c, sides))
    return sum(face.thickness_m / (4 * times * KAPPA * _shear(face)) for face, times in each)


def _shear(face: Face) -> complex:
    """Complex with its loss factor; an orthotropic one's as that of its isotropic like."""
    like = as_isotropic(face)
    return like.young_pa * (1 + 1j * like.loss_factor) / (2 * (1 + like.poisson))
