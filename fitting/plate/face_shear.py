"""A core that pulls on its faces shears them across their thickness: one slip of both, beside the core's own.

    gamma = (u_c - u_b + d w' - g)/H,   g = sum of h_i p_i/2,   p_i = r_i g

p_i is the angle by which the sections of face i turn against w'; h_i is its thickness, D_i its bending
stiffness E_i h_i^3/(12 (1 - nu_i^2)), G_i its shear modulus. m_i faces are alike: two constraining layers
where both sides are treated, else one. u_b and u_c are displacements of the faces' middles, d apart; H is the
core's thickness. Under a shear stress tau of the core, of all treated sides together, a face's energy is
least for p_i = tau/(2 m_i kappa G_i). So both angles follow from one slip g = S tau, with

    S = sum of h_i/(4 m_i kappa G_i),   r_i = 1/(2 m_i kappa G_i S),

and twice the energy per area, beside that of the plate without, is

    g^2/S + sum of m_i D_i ((w'' - r_i g')^2 - w''^2).

A node needs the two numbers that a slip of glue is. Glue is in series: g is what both slip, S the sum of
their compliances, and r_i is smaller for that.

Against exact elasticity of glass, aluminium and steel about cores of 100 MPa, waves fifty thicknesses long,
what the theory gets wrong of a frequency falls from 0.2 to less than 0.01 %, of a loss factor from 0.4 to
less than 0.01 % (0.02 and 0.03 % with unlike faces).

Source: Timoshenko's shear angle, of each face: e.g. Reddy, Mechanics of Laminated Composite Plates and Shells
(2004), ch. 12, layer by layer.
"""

from dataclasses import dataclass, replace

from fitting.plate.edge_twist import EDGE_WIDTH
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face, as_isotropic

KAPPA = 5 / 6
"""Reissner's, for parabolic shear across a face."""
COUNTED_ABOVE = 3e-3
"""Share of the slip above which what faces take of it is counted. Below, a modulus comes out too low by as
much at most, a tenth of the typical tolerance of a core's thickness."""


@dataclass(frozen=True)
class Slip:
    """What gives way beside the core, of all treated sides together."""

    stiffness_pa_m: complex
    """Shear stress over slip, of glue and sheared faces in series: 1/S. Complex where it loses energy."""
    turn_b: complex
    """r_b: by what angle the substrate's sections turn for a unit of slip, in 1/m; zero where faces do not
    shear."""
    turn_c: complex
    """r_c: the same of the constraining layer's."""
    mass_kg_m2: float = 0.0
    """Of the sections that turn, rho h^3/12 r^2 of each: next to nothing, but no slip moves without mass."""


def slip_of(specimen: PlateSpecimen) -> Slip | None:
    """The slip of glue, of sheared faces or of both; None where nothing but the core slips."""
    core, c = specimen.core, specimen.constraining
    if core is None or c is None or not specimen.slips:
        return None
    sides = 2 if specimen.both_sides else 1
    glue = 1 / (sides * core.glue_stiffness_pa_m) if core.glue else 0.0
    if not specimen.faces_shear:
        return Slip(1 / glue, 0.0, 0.0)
    each = ((specimen.substrate, 1), (c, sides))
    # Of each face, for a unit of stress; what the glue slips turns no section.
    angles = [1 / (2 * alike * KAPPA * _shear_modulus(face)) for face, alike in each]
    compliance = _compliance_of_faces(specimen) + glue
    turn_b, turn_c = (angle / compliance for angle in angles)
    inertia = (
        alike * face.density_kg_m3 * face.thickness_m**3 / 12 * abs(turn) ** 2
        for (face, alike), turn in zip(each, (turn_b, turn_c), strict=True)
    )
    return Slip(1 / compliance, turn_b, turn_c, sum(inertia))


def edge_twist_left(face: Face, side_m: float) -> float:
    """Of what a free edge lacks in twist (`fitting.plate.edge_twist`), the share that elements leave to it.

    `side_m` is an element's side across the edge. A face's sections turn at the edge, and linearly less to
    none a side further in: where twist and shear then take the least energy, no twist is carried over a width
    of x/(x + kappa side^2/3) sides, x = h^2/12. Narrower elements than half the face is thick leave no more.
    """
    x, side_m = face.thickness_m**2 / 12, max(side_m, face.thickness_m / 2)
    relieved_m = side_m * x / (x + KAPPA * side_m**2 / 3)
    return max(0.0, 1 - relieved_m / (EDGE_WIDTH * face.thickness_m))


def with_face_shear(specimen: PlateSpecimen, modulus_pa: float) -> PlateSpecimen:
    """With the shear of its faces counted where it matters about a core so stiff, else without.

    Not beside patches: at the end of one the substrate's sections stand square again, and a slip that ends
    there would leave a hinge.
    """
    matters = share_of_faces(specimen, modulus_pa) > COUNTED_ABOVE
    return replace(specimen, faces_shear=matters and not specimen.patches)


def share_of_faces(specimen: PlateSpecimen, modulus_pa: float) -> float:
    """What share the faces take, by their own shear, of their slip on each other about a core so stiff.

    Zero of a bare plate; glue is not counted.
    """
    if specimen.core is None or specimen.constraining is None:
        return 0.0
    sides = 2 if specimen.both_sides else 1
    faces, core = _compliance_of_faces(specimen), specimen.core.thickness_m / (sides * modulus_pa)
    return float(abs(faces) / (abs(faces) + core))


def _compliance_of_faces(specimen: PlateSpecimen) -> complex:
    """S in m/Pa, without glue."""
    c, sides = specimen.constraining, 2 if specimen.both_sides else 1
    assert c is not None
    each = ((specimen.substrate, 1), (c, sides))
    return sum(face.thickness_m / (4 * alike * KAPPA * _shear_modulus(face)) for face, alike in each)


def _shear_modulus(face: Face) -> complex:
    """In Pa, complex with its loss factor; an orthotropic face's as that of its isotropic like."""
    like = as_isotropic(face)
    return like.young_pa * (1 + 1j * like.loss_factor) / (2 * (1 + like.poisson))
