"""The plate as a sum of parts: stated numbers enter through scalar coefficients alone.

    K_0 = sum of c_p(specimen) P_p,   so K_1, M;   load = -m_A l

The parts P_p (`fitting.plate.part_matrices`) are integrals over the undeformed reference mesh, of shape
functions that stretch with the plate: the same nodal deflections, rotations as d/dx of them. So a plate with
another modulus, thickness, density, Poisson's ratio, length or width has the same parts, and a model reduced
once serves all of them exactly on its basis. Where a patch lies enters to first order.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.plate.element import DOFS, GLUE_TURNS, THETA_X, THETA_Y, face_plane_stress
from fitting.plate.face_shear import slip_of
from fitting.plate.mesh import is_turned
from fitting.plate.part_names import CORE, MASS, MEMBRANE, SHEARED, TURNED
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face
from fitting.stated.patches import shifts_of


@dataclass(frozen=True)
class Coefficients:
    """What one specimen's stated numbers make of the parts of its matrices. Shapes as `names_of` has them."""

    K_0: NDArray[np.complex128]
    K_1: Array
    M: Array
    load: float | Array
    """Mass per area over the reference's scale: times `load_part`, with a minus, the load of a unit heave.

    One for each of several parts.
    """

    @property
    def all(self) -> Complex | Array:
        """One after the other, those of the load last; real where they can be. Shape (parts + loads,)."""
        found = np.concatenate([self.K_0, self.K_1, self.M, np.atleast_1d(self.load)])
        return np.asarray(found if np.any(found.imag) else found.real)


def loaded(load: float | Array, part: Array) -> Array:
    """Coefficients of the load times their parts. Shape (k,); of `part` (k,) or (loads, k)."""
    return np.asarray(load * part if part.ndim == 1 else np.asarray(load) @ part)


def coefficients(specimen: PlateSpecimen, reference: PlateSpecimen) -> Coefficients:
    """Of a specimen on the mesh of another: the same number of elements, stretched, and what it counts."""
    specimen = replace(specimen, faces_shear=reference.faces_shear)
    sides = _Sides.of(specimen, reference)
    K_0 = sides.area * np.concatenate(
        [*_of_faces(specimen, reference, sides), *_of_glue_and_pull(specimen, reference, sides)]
    )
    mass = _MassPerArea.of(specimen)
    if specimen.core is None or specimen.constraining is None:
        M = sides.area * np.array([mass.b, mass.b, *np.zeros(len(MASS) - 2)])
        return Coefficients(np.asarray(K_0, complex), np.zeros(len(CORE)), M, mass.b * sides.area)
    K_1, M = _of_core(specimen, reference, sides), _of_inertia(specimen, reference, sides)
    if not reference.patches:
        return Coefficients(np.asarray(K_0, complex), K_1, M, mass.whole * sides.area)
    moved = np.array([shift.by_m(specimen, reference) for shift in shifts_of(reference)])
    return Coefficients(
        K_0=np.asarray(np.concatenate([K_0, moved * (1 + 1j * specimen.constraining.loss_factor)]), complex),
        K_1=np.concatenate([K_1, moved]),
        M=np.concatenate([M, moved]),
        load=np.array([mass.b * sides.area, mass.treated * sides.area, *moved]),
    )


@dataclass(frozen=True)
class _Sides:
    """How derivatives along either side of the reference scale, and areas."""

    rx: float
    ry: float

    @classmethod
    def of(cls, specimen: PlateSpecimen, reference: PlateSpecimen) -> "_Sides":
        return cls(reference.length_m / specimen.length_m, reference.width_m / specimen.width_m)

    @property
    def area(self) -> float:
        return 1 / (self.rx * self.ry)

    @property
    def bending(self) -> Array:
        """Of `_BENDING`."""
        rx, ry = self.rx, self.ry
        return np.array([rx**4, ry**4, rx**2 * ry**2, rx**2 * ry**2])

    @property
    def bending_turned(self) -> Array:
        """Of `_BENDING_TURNED`."""
        return np.array([self.rx**3 * self.ry, self.rx * self.ry**3])


@dataclass(frozen=True)
class _MassPerArea:
    """In kg/m^2; of a treatment on both sides, of both."""

    b: float
    c: float
    core: float
    glue: float

    @classmethod
    def of(cls, specimen: PlateSpecimen) -> "_MassPerArea":
        b, c, v = specimen.substrate, specimen.constraining, specimen.core
        return cls(
            b=b.density_kg_m3 * b.thickness_m,
            c=_treated_sides(specimen) * (c.density_kg_m3 * c.thickness_m) if c is not None else 0.0,
            core=_treated_sides(specimen) * v.density_kg_m3 * v.thickness_m if v is not None else 0.0,
            glue=_treated_sides(specimen) * v.glue_mass_kg_m2 if v is not None else 0.0,
        )

    @property
    def whole(self) -> float:
        return self.b + self.c + self.core + self.glue

    @property
    def treated(self) -> float:
        return self.c + self.core + self.glue


def _treated_sides(specimen: PlateSpecimen) -> float:
    return 2.0 if specimen.both_sides else 1.0


def _of_faces(specimen: PlateSpecimen, reference: PlateSpecimen, sides: _Sides) -> list[Complex]:
    """`STIFFNESS`, `OFF_AXIS` of turned faces, `PATCHED` and `PATCHED_OFF_AXIS` where there are patches."""
    b, c, twice = specimen.substrate, specimen.constraining, _treated_sides(specimen)
    rx, ry = sides.rx, sides.ry
    stretch = [(_stretch(b, rx, ry), twice * _stretch(c, rx, ry))]
    bend = [(_bend(b), twice * _bend(c), sides.bending)]
    if is_turned(reference):
        stretch.append((_stretch_turned(b, rx, ry), twice * _stretch_turned(c, rx, ry)))
        bend.append((_bend(b, turned=True), twice * _bend(c, turned=True), sides.bending_turned))
    found = []
    for (K_b, K_c), (D_b, D_c, along) in zip(stretch, bend, strict=True):
        found += [K_b, K_c, (D_b if reference.patches else D_b + D_c) * along]
    if reference.patches:
        found += [D_c * along for _, D_c, along in bend]
    return found


def _of_glue_and_pull(
    specimen: PlateSpecimen, reference: PlateSpecimen, sides: _Sides
) -> list[Complex | Array]:
    """`GLUE` where it or the faces slip, then `SHEARED`, `PULLED` along clamps on opposite edges."""
    found: list[Complex | Array] = []
    if (slip := slip_of(specimen)) is not None:
        found += [np.array([slip.stiffness_pa_m])]
        if reference.faces_shear:
            b, c, twice = specimen.substrate, specimen.constraining, _treated_sides(specimen)
            found += [_turn(b, slip.turn_b, sides) + twice * _turn(c, slip.turn_c, sides)]
    pulled = zip(specimen.axial_pa, (sides.rx, sides.ry), strict=True)
    found += [np.array([p * specimen.pulled_thickness_m * r**2]) for p, r in pulled if p is not None]
    return found


def _of_core(specimen: PlateSpecimen, reference: PlateSpecimen, sides: _Sides) -> Array:
    """`CORE`: with d between the faces' middles, gamma = (u_c - u_b + d w' - slip)/H."""
    v, core_0 = specimen.core, reference.core
    assert v is not None
    assert core_0 is not None
    H, d, rx, ry = v.thickness_m, specimen.apart_m, sides.rx, sides.ry
    stretch = H / core_0.thickness_m * (1 - core_0.poisson) / (1 - v.poisson)
    K_1 = sides.area * np.array(
        [1 / H, 1 / H, d / H * rx, d / H * ry, d**2 / H * rx**2, d**2 / H * ry**2, stretch * (rx * ry) ** 0.5]
    )
    return _treated_sides(specimen) * K_1


def _of_inertia(specimen: PlateSpecimen, reference: PlateSpecimen, sides: _Sides) -> Array:
    """`MASS`, `W_TREATED` where there are patches, `GLUE` where it slips.

    The core's middle moves as the mean of its two sides, (u_c + u_b + e w')/2.
    """
    b, c, mass = specimen.substrate, specimen.constraining, _MassPerArea.of(specimen)
    assert c is not None
    e, quarter, rx, ry = (c.thickness_m - b.thickness_m) / 2, mass.core / 4, sides.rx, sides.ry
    M = sides.area * np.array(
        [
            mass.b if reference.patches else mass.whole,
            mass.b,
            mass.c,
            quarter,
            quarter * e * rx,
            quarter * e * ry,
            quarter * (e * rx) ** 2,
            quarter * (e * ry) ** 2,
        ]
    )
    if reference.patches:
        M = np.append(M, mass.treated * sides.area)
    if reference.slips:
        slip = slip_of(specimen)
        turning = slip.mass_kg_m2 if slip is not None else 0.0
        M = np.append(M, (GLUE_TURNS * mass.glue + turning) * sides.area)
    return M


def substrate_coefficients(face: Face) -> Complex:
    """Of `STIFFNESS`, of a substrate alone on the reference's sides, its axes the plate's. Shape (16,)."""
    return np.concatenate([_stretch(face, 1.0, 1.0), _stretch(None, 1.0, 1.0), _bend(face)])


def stretched(specimen: PlateSpecimen, reference: PlateSpecimen) -> Array:
    """Factors on a node's motions in the reference's shapes, on a stretched plate. Shape (DOFS,)."""
    found = np.ones(DOFS)
    found[THETA_X] = reference.width_m / specimen.width_m
    found[THETA_Y] = reference.length_m / specimen.length_m
    return found


def _plane_stress(face: Face) -> Array:
    """Q_11, Q_22, Q_12, Q_66 in Pa."""
    if face.rolled is not None:
        D = face_plane_stress(face)
        return np.array([D[0, 0], D[1, 1], D[0, 1], D[2, 2]])
    Q = face.young_pa / (1 - face.poisson**2)
    return np.array([Q, Q, face.poisson * Q, (1 - face.poisson) / 2 * Q])


def _bend(face: Face | None, *, turned: bool = False) -> Complex:
    if face is None:
        return np.zeros(2 if turned else 4, complex)
    Q = face_plane_stress(face)[:2, 2] if turned else _plane_stress(face)
    return np.asarray((1 + 1j * face.loss_factor) * face.thickness_m**3 / 12 * Q)


def _stretch(face: Face | None, rx: float, ry: float) -> NDArray[np.complex128]:
    if face is None:
        return np.zeros(len(MEMBRANE), complex)
    Q_11, Q_22, Q_12, Q_66 = _plane_stress(face)
    parts = np.array([Q_11 * rx**2, Q_22 * ry**2, Q_12 * rx * ry, Q_66 * ry**2, Q_66 * rx**2, Q_66 * rx * ry])
    return np.asarray((1 + 1j * face.loss_factor) * face.thickness_m * parts)


def _turn(face: Face | None, turn: complex, sides: _Sides) -> Complex:
    """Of `SHEARED`. Shape (12,)."""
    if face is None:
        return np.zeros(len(SHEARED), complex)
    Q_11, Q_22, Q_12, Q_66 = _plane_stress(face)
    rx, ry = sides.rx, sides.ry
    curved = [Q_11 * rx**3, Q_22 * ry**3, Q_12 * rx * ry**2, Q_12 * rx**2 * ry, Q_66 * rx * ry**2]
    curved += [Q_66 * rx**2 * ry]
    bend = (1 + 1j * face.loss_factor) * face.thickness_m**3 / 12
    # Sections strain as the plane does, by h^2/12 of it.
    alone = turn**2 * face.thickness_m**2 / 12 * _stretch(face, rx, ry)
    return np.concatenate([-turn * bend * np.array(curved), alone])


def _stretch_turned(face: Face | None, rx: float, ry: float) -> NDArray[np.complex128]:
    if face is None:
        return np.zeros(len(TURNED), complex)
    Q_16, Q_26 = face_plane_stress(face)[:2, 2]
    parts = np.array([Q_16 * rx * ry, Q_16 * rx**2, Q_26 * ry**2, Q_26 * rx * ry])
    return np.asarray((1 + 1j * face.loss_factor) * face.thickness_m * parts)
