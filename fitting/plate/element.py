"""The paper's layer-wise rectangular element: four nodes, seven degrees of freedom each; nine with slip.

Degrees of freedom of a node, in this order: u_c, v_c, u_b, v_b, w, theta_x, theta_y, with
theta_x = dw/dy and theta_y = -dw/dx. In-plane displacements are bilinear, the deflection is
the twelve-term polynomial of Adini, Clough and Melosh. The core follows its faces: the
interfaces are continuous, so its displacement and shear strain follow from the seven. Thin layers of glue
beside the core carry its shear and nothing else; how far they slip, along x and y, is two degrees of freedom
more, behind the seven. Faces that the core shears add to that slip (`fitting.plate.face_shear`).

Source: the paper's Eq. (15) to (18), with the thickness restored in Eq. (16) and
1/(1 - mu) in Eq. (17b).
"""

from dataclasses import dataclass
from math import perm

import numpy as np

from fitting.arrays import Array, Complex
from fitting.stated.layers import Core, Face

U_C, V_C, U_B, V_B, W, THETA_X, THETA_Y, G_X, G_Y = range(9)
"""Places of a node's degrees of freedom: both faces in their plane, w, its slopes, slip beside the core."""
DOFS = 7
"""Degrees of freedom of a node without slip."""
WITH_SLIP = 9
"""Degrees of freedom of a node where glue or sheared faces slip."""
GLUE_TURNS = 1 / 3
"""Of the glue's mass: mean square of what moves with one side from 0 to the slip of the other."""
CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
"""Local corners of the element, counter-clockwise, in fractions of its sides."""

_POWERS = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (1, 3))
"""Of x and y: the twelve terms of the deflection."""


_DERIVED = [np.array([[perm(n, d), max(n - d, 0)] for n in range(4)], dtype=float).T for d in range(4)]
"""For every order of derivative of t^0 to t^3: factors and powers left."""
_P, _Q = np.array(_POWERS).T


def _monomials(x: float, y: float, dx: int = 0, dy: int = 0) -> Array:
    """The twelve terms x^p y^q of the deflection, differentiated `dx` and `dy` times."""
    along_x, along_y = (factor * t**left for t, (factor, left) in ((x, _DERIVED[dx]), (y, _DERIVED[dy])))
    return np.asarray(along_x[_P] * along_y[_Q])


def _unit() -> Array:
    """Terms of the deflection by w, dw/dy and -dw/dx at the corners of a unit square. Shape (12, 12)."""
    nodal = []
    for x, y in CORNERS:
        nodal += [_monomials(x, y), _monomials(x, y, dy=1), -_monomials(x, y, dx=1)]
    return np.asarray(np.linalg.inv(np.array(nodal)))


_UNIT = _unit()


def _bilinear(a: float, b: float, x: float, y: float, dx: int = 0, dy: int = 0) -> Array:
    """Bilinear shape functions of the four corners, or their derivative."""
    along_x = {0: (1 - x / a, x / a), 1: (-1 / a, 1 / a)}[dx]
    along_y = {0: (1 - y / b, y / b), 1: (-1 / b, 1 / b)}[dy]
    return np.array([along_x[int(cx)] * along_y[int(cy)] for cx, cy in CORNERS])


@dataclass(frozen=True)
class Shape:
    """Shape function vectors of one element of sides `a_m`, `b_m`.

    Every method takes local coordinates from corner one and returns rows over the element's
    4 `dofs` degrees of freedom, corner by corner.
    """

    a_m: float
    b_m: float
    dofs: int = DOFS
    """Degrees of freedom of a node: `Mesh.dofs`."""

    def inplane(self, dof: int, x: float, y: float, dx: int = 0, dy: int = 0) -> Array:
        """N_1 to N_4: one of u_c, v_c, u_b, v_b (or its derivative). Shape (4 dofs,)."""
        row = np.zeros(4 * self.dofs)
        row[dof :: self.dofs] = _bilinear(self.a_m, self.b_m, x, y, dx, dy)
        return row

    def deflection(self, x: float, y: float, dx: int = 0, dy: int = 0) -> Array:
        """N_5: w, or its derivative. Shape (4 dofs,)."""
        row = np.zeros((4, self.dofs))
        row[:, W:DOFS] = self.deflection_by_corners(x, y, dx, dy)
        return row.ravel()

    def deflection_by_corners(self, x: float, y: float, dx: int = 0, dy: int = 0) -> Array:
        """The same over w, dw/dy and -dw/dx of every corner alone. Shape (4, 3)."""
        a, b = self.a_m, self.b_m
        values = (_monomials(x / a, y / b, dx, dy) / (a**dx * b**dy)) @ _UNIT
        return np.asarray(values.reshape(4, 3) * (1.0, b, a))

    def membrane(self, u: int, v: int, x: float, y: float) -> Array:
        """B_b or B_c: strains (xx, yy, xy) of a face's neutral plane. Shape (3, 4 dofs)."""
        return np.array(
            [
                self.inplane(u, x, y, dx=1),
                self.inplane(v, x, y, dy=1),
                self.inplane(u, x, y, dy=1) + self.inplane(v, x, y, dx=1),
            ]
        )

    def bending(self, x: float, y: float) -> Array:
        """B: curvatures (-w_xx, -w_yy, -2 w_xy), shared by all layers. Shape (3, 4 dofs)."""
        w = self.deflection
        return -np.array([w(x, y, dx=2), w(x, y, dy=2), 2 * w(x, y, dx=1, dy=1)])


Rectangle = tuple[float, float, float, float]
"""A part of an element: from and to along x, from and to along y, in m from its first corner."""
Rectangles = tuple[Rectangle, ...]
Point = tuple[float, float, float]


def plane_stress(modulus: float, poisson: float) -> Array:
    """D of Eq. (17): `modulus` is E/(1 - mu^2), for the core 2 G/(1 - mu). Shape (3, 3)."""
    return modulus * np.array([[1, poisson, 0], [poisson, 1, 0], [0, 0, (1 - poisson) / 2]])


def face_plane_stress(face: Face) -> Array:
    """D of a face about the plate's axes; of an orthotropic one turned from its own. Shape (3, 3).

    Q_11 = E_1/(1 - nu_12 nu_21), Q_22 = E_2/E_1 Q_11, Q_12 = nu_12 Q_22, Q_66 = G_12, turned as a tensor:
    e.g. Jones, Mechanics of Composite Materials (1999), Eq. (2.61) and (2.80).
    """
    if face.rolled is None:
        return plane_stress(face.young_pa / (1 - face.poisson**2), face.poisson)
    E_1, E_2, nu = face.young_pa, face.rolled.young_y_pa, face.poisson
    Q_11 = E_1 / (1 - nu**2 * E_2 / E_1)
    Q_22 = Q_11 * E_2 / E_1
    Q = np.array([[Q_11, nu * Q_22, 0], [nu * Q_22, Q_22, 0], [0, 0, face.rolled.shear_pa]])
    c, s = np.cos(face.rolled.angle_rad), np.sin(face.rolled.angle_rad)
    # Strains about the face's own axes, of those about the plate's.
    T = np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]])
    return np.asarray(T.T @ Q @ T)


def _gauss(side: float) -> tuple[Array, Array]:
    """Four Gauss points on (0, side): exact for the squares of every shape function used."""
    t, weight = np.polynomial.legendre.leggauss(4)
    return side * (t + 1) / 2, side * weight / 2


def gauss_points(shape: Shape, over: Rectangles | None = None) -> list[Point]:
    """Points (x, y) and their areas, over the whole element or over parts of it."""
    found = []
    for x_0, x_1, y_0, y_1 in ((0.0, shape.a_m, 0.0, shape.b_m),) if over is None else over:
        xs, wx = _gauss(x_1 - x_0)
        ys, wy = _gauss(y_1 - y_0)
        found += [
            (x_0 + x, y_0 + y, px * py)
            for x, px in zip(xs, wx, strict=True)
            for y, py in zip(ys, wy, strict=True)
        ]
    return found


def _square(shape: Shape) -> Array:
    return np.zeros((4 * shape.dofs, 4 * shape.dofs))


def face_stiffness(shape: Shape, face: Face, u: int, v: int, over: Rectangles | None = None) -> Array:
    """Eq. (15a): stretching and bending of a face. Real, loss factor left out. Shape (4 dofs, 4 dofs)."""
    D = face_plane_stress(face)
    H = face.thickness_m
    K = _square(shape)
    for x, y, dA in gauss_points(shape, over):
        B_i, B = shape.membrane(u, v, x, y), shape.bending(x, y)
        K += (H * B_i.T @ D @ B_i + H**3 / 12 * B.T @ D @ B) * dA
    return K


def pulled_stiffness(shape: Shape, along: str) -> Array:
    """What a unit of force per width along x or y adds for w_x or w_y. Shape (4 dofs, 4 dofs)."""
    K = _square(shape)
    for x, y, dA in gauss_points(shape):
        slope = shape.deflection(x, y, dx=1) if along == "x" else shape.deflection(x, y, dy=1)
        K += np.outer(slope, slope) * dA
    return K


def core_stiffness(
    shape: Shape, core: Core, substrate: Face, constraining: Face, over: Rectangles | None = None
) -> Array:
    """Eq. (15b) for G* = 1: stretching, bending and transverse shear. Shape (4 dofs, 4 dofs)."""
    D = plane_stress(2 / (1 - core.poisson), core.poisson)
    H = core.thickness_m
    K = core_shear_stiffness(shape, core, substrate, constraining, over)
    for x, y, dA in gauss_points(shape, over):
        B_v, B = _core_membrane(shape, substrate, constraining, x, y), shape.bending(x, y)
        K += (H * B_v.T @ D @ B_v + H**3 / 12 * B.T @ D @ B) * dA
    return K


def core_shear_stiffness(
    shape: Shape, core: Core, substrate: Face, constraining: Face, over: Rectangles | None = None
) -> Array:
    """The transverse shear's part of `core_stiffness`. Shape (4 dofs, 4 dofs)."""
    K = _square(shape)
    for x, y, dA in gauss_points(shape, over):
        N_10, N_11 = core_shear(shape, core, substrate, constraining, x, y)
        K += core.thickness_m * (np.outer(N_10, N_10) + np.outer(N_11, N_11)) * dA
    return K


def core_shear(
    shape: Shape, core: Core, substrate: Face, constraining: Face, x: float, y: float
) -> tuple[Array, Array]:
    """N_10, N_11: transverse shear strains, gamma_xz = (u_c - u_b + d w_x)/H_v. Shape (4 dofs,) each.

    The slip of glue and sheared faces is taken off.
    """
    H_v = core.thickness_m
    d = core.between_faces_m + (constraining.thickness_m + substrate.thickness_m) / 2
    N_10 = shape.inplane(U_C, x, y) - shape.inplane(U_B, x, y) + d * shape.deflection(x, y, dx=1)
    N_11 = shape.inplane(V_C, x, y) - shape.inplane(V_B, x, y) + d * shape.deflection(x, y, dy=1)
    if shape.dofs == WITH_SLIP:
        N_10, N_11 = N_10 - shape.inplane(G_X, x, y), N_11 - shape.inplane(G_Y, x, y)
    return N_10 / H_v, N_11 / H_v


def slip_stiffness(shape: Shape, over: Rectangles | None = None) -> Array:
    """Of the slip beside the core, for a shear stiffness per area of one. Shape (4 dofs, 4 dofs)."""
    K = _square(shape)
    for x, y, dA in gauss_points(shape, over):
        for dof in (G_X, G_Y):
            row = shape.inplane(dof, x, y)
            K += np.outer(row, row) * dA
    return K


def turned_sections(shape: Shape, face: Face, turn: complex, over: Rectangles | None = None) -> Complex:
    """By how much bending a face takes more where its sections turn by `turn` (1/m) times the slip.

    h^3/12 times the integral of (B + turn B_g)^T D (B + turn B_g) - B^T D B, B the curvatures -w'' and B_g
    the slip's derivatives g', as a face's strains are made of u and v. Loss factor left out. Of a face whose
    own axes are turned, what couples shear to the rest is left out. Shape (4 dofs, 4 dofs).
    """
    D = face_plane_stress(face)
    D[2, :2] = D[:2, 2] = 0.0
    K = _square(shape).astype(complex)
    for x, y, dA in gauss_points(shape, over):
        B, turns = shape.bending(x, y), turn * shape.membrane(G_X, G_Y, x, y)
        K += face.thickness_m**3 / 12 * ((B + turns).T @ D @ (B + turns) - B.T @ D @ B) * dA
    return K


def _core_displacement(
    shape: Shape, substrate: Face, constraining: Face, x: float, y: float
) -> tuple[Array, Array]:
    """N_8, N_9: displacements of the core's neutral plane, the mean of its two interfaces."""
    e = (constraining.thickness_m - substrate.thickness_m) / 2
    N_8 = shape.inplane(U_C, x, y) + shape.inplane(U_B, x, y) + e * shape.deflection(x, y, dx=1)
    N_9 = shape.inplane(V_C, x, y) + shape.inplane(V_B, x, y) + e * shape.deflection(x, y, dy=1)
    return N_8 / 2, N_9 / 2


def _core_membrane(shape: Shape, substrate: Face, constraining: Face, x: float, y: float) -> Array:
    """B_v: strains of the core's neutral plane, derivatives of N_8 and N_9. Shape (3, 4 dofs)."""
    e = (constraining.thickness_m - substrate.thickness_m) / 2
    faces = shape.membrane(U_C, V_C, x, y) + shape.membrane(U_B, V_B, x, y)
    return (faces - e * shape.bending(x, y)) / 2


def face_mass(shape: Shape, face: Face, u: int, v: int, over: Rectangles | None = None) -> Array:
    """Eq. (16a), (16c), times the thickness. Shape (4 dofs, 4 dofs)."""
    M = _square(shape)
    for x, y, dA in gauss_points(shape, over):
        rows = np.array([shape.inplane(u, x, y), shape.inplane(v, x, y), shape.deflection(x, y)])
        M += face.density_kg_m3 * face.thickness_m * rows.T @ rows * dA
    return M


def core_mass(
    shape: Shape, core: Core, substrate: Face, constraining: Face, over: Rectangles | None = None
) -> Array:
    """Eq. (16b), times the thickness; glue weighs up and down, and as it slips. Shape (4 dofs, 4 dofs)."""
    M = _square(shape)
    glue = core.glue_mass_kg_m2
    for x, y, dA in gauss_points(shape, over):
        N_8, N_9 = _core_displacement(shape, substrate, constraining, x, y)
        rows = np.array([N_8, N_9, shape.deflection(x, y)])
        M += core.density_kg_m3 * core.thickness_m * rows.T @ rows * dA
        if glue:
            M += glue * np.outer(rows[2], rows[2]) * dA
    if shape.dofs == WITH_SLIP:
        M += GLUE_TURNS * glue * slip_stiffness(shape, over)
    return M
