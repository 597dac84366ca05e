"""The plate as a sum of parts: stated numbers enter through scalar coefficients alone.

    K_0 = sum of c_p(specimen) P_p,   so K_1, M;   load = -m_A l

The parts P_p are integrals over the undeformed reference mesh, of shape functions that stretch with the
plate: the same nodal deflections, rotations as d/dx of them. So a plate with another modulus, thickness,
density, Poisson's ratio, length or width has the same parts, and a model reduced once serves all of them
exactly on its basis. Integrands are those of `fitting.element` (the paper's Eq. (15) to (18)).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, Shape, W, core_stiffness
from fitting.element import _points as gauss_points
from fitting.laws.constant import ConstantModulus
from fitting.plate import Mesh, Plate
from fitting.specimen import Core, Face, Specimen
from fitting.tolerances import STATED, moved

Rows = dict[str, Array]

_LAYER = ("thickness_m", "young_pa", "poisson", "density_kg_m3", "loss_factor")
_MEMBRANE = ("11", "22", "12", "66 yy", "66 xx", "66 xy")
_BENDING = ("11", "22", "12", "66")
STIFFNESS = (
    *(f"stretch b {t}" for t in _MEMBRANE),
    *(f"stretch c {t}" for t in _MEMBRANE),
    *(f"bend {t}" for t in _BENDING),
)
CORE = ("slip x", "slip y", "slip bend x", "slip bend y", "bend x", "bend y", "stretch")
MASS = ("w", "u b", "u c", "core u", "core u bend x", "core u bend y", "core bend x", "core bend y")


@dataclass(frozen=True)
class Coefficients:
    """Of one specimen. Shapes of `STIFFNESS`, `CORE` and `MASS`."""

    K_0: NDArray[np.complex128]
    K_1: Array
    M: Array
    load: float
    """Mass per area over the reference's scale: times `load_part`, with a minus, the load of a unit heave."""


def element_parts(reference: Specimen) -> tuple[Array, Array, Array]:
    """Matrices of one element of the reference's mesh: of K_0, K_1 and M. Shape (parts, 28, 28) each."""
    mesh = Mesh(reference.length_m, reference.width_m, *reference.mesh)
    shape = Shape(*mesh.sides_m)
    K_0, K_1, M = (np.zeros((len(names), 4 * DOFS, 4 * DOFS)) for names in (STIFFNESS, CORE, MASS))
    for x, y, dA in gauss_points(shape):
        r = _rows(shape, x, y)
        K_0 += dA * np.array([*_membrane(r, "b"), *_membrane(r, "c"), *_bending(r)])
        K_1[:6] += dA * np.array(_slip(r))
        M += dA * np.array(_inertia(r))
    core, constraining = reference.core, reference.constraining
    if core is not None and constraining is not None:
        # What the core carries by stretching and bending is a hundred thousandth of its faces'.
        whole = core_stiffness(shape, core, reference.substrate, constraining)
        K_1[6] = whole - np.tensordot(coefficients(reference, reference).K_1[:6], K_1[:6], axes=1)
    return K_0, K_1, M


def load_part(reference: Specimen) -> Array:
    """The first part of M on w = 1 at all nodes, held ones too. Shape (nodes * 7,)."""
    mesh = Mesh(reference.length_m, reference.width_m, *reference.mesh)
    w = np.zeros((mesh.nodes, DOFS))
    w[:, W] = 1.0
    dofs = mesh.element_dofs()
    found = np.zeros(mesh.nodes * DOFS)
    np.add.at(found, dofs, w.ravel()[dofs] @ element_parts(reference)[2][0])
    return found


def moving_part(reference: Specimen) -> Array:
    """`load_part` where the base drives the plate; a force at a point does not go with any part.

    Shape as `load_part`.
    """
    return load_part(reference) if reference.drive == "base" else np.zeros_like(load_part(reference))


def projected_parts(plate: Plate, V: Array, *, one_parity: bool = False) -> Array:
    """V^T P_p V of every part: of K_0, then of K_1, then of M. `V` of shape (n, k); shape (parts, k, k).

    `one_parity`: all columns are even in y, or all are odd. Half of the elements do then.
    """
    dofs, weight = plate.mesh.element_dofs(), np.ones(plate.mesh.n_x * plate.mesh.n_y)
    if one_parity:
        n_y = plate.mesh.n_y
        twice = 2 * (np.arange(len(dofs)) % n_y) + 1
        dofs, weight = dofs[twice <= n_y], np.where(twice == n_y, 1.0, 2.0)[twice <= n_y]
    full = np.zeros((plate.mesh.nodes * DOFS, V.shape[1]))
    full[plate.free] = V
    P = np.concatenate(element_parts(plate.specimen))
    # Stretching does not touch the deflection, nor bending the layers' planes: few rows are worked on.
    kinds = [tuple(np.unique(np.flatnonzero(p.any(axis=0)) % DOFS)) for p in P]
    found = np.zeros((len(P), V.shape[1], V.shape[1]))
    for some in set(kinds) - {()}:
        rows = np.flatnonzero(np.isin(np.arange(4 * DOFS) % DOFS, some))
        touched, place = np.unique(dofs.T[rows], return_inverse=True)
        # Sums what the elements give each degree of freedom.
        gather = sp.csr_array((np.tile(weight, len(rows)), (place.ravel(), np.arange(place.size))))
        ends = full[touched]
        on_elements = full[dofs.T[rows]].reshape(len(rows), -1)
        for p in (n for n, kind in enumerate(kinds) if kind == some):
            found[p] = ends.T @ (gather @ (P[p][np.ix_(rows, rows)] @ on_elements).reshape(place.size, -1))
    return found


def stated_steps(reference: Specimen, names: Sequence[str]) -> tuple[Complex, Array, Array]:
    """What a typical tolerance of some stated numbers changes of an element's K_0, K_1 and M, to first order.

    Shape (names, 28, 28) each.
    """
    found = []
    for name in names:
        up, down = (
            coefficients(moved(reference, [name], [s * STATED[name].typical]), reference) for s in (1, -1)
        )
        found.append([(getattr(up, m) - getattr(down, m)) / 2 for m in ("K_0", "K_1", "M")])
    K_0, K_1, M = (
        np.tensordot(np.array(c), parts, axes=1)
        for c, parts in zip(zip(*found, strict=True), element_parts(reference), strict=True)
    )
    return K_0, K_1, M


def coefficients(specimen: Specimen, reference: Specimen) -> Coefficients:
    """Of a specimen on the mesh of another: the same number of elements, stretched."""
    b, c, v = specimen.substrate, specimen.constraining, specimen.core
    # How derivatives along either side scale, and areas.
    rx, ry = reference.length_m / specimen.length_m, reference.width_m / specimen.width_m
    area = 1 / (rx * ry)
    bend: Complex = np.zeros(4, complex)
    for face in (b, c):
        if face is not None:
            bend = bend + (1 + 1j * face.loss_factor) * face.thickness_m**3 / 12 * _plane_stress(face)
    bend = bend * np.array([rx**4, ry**4, rx**2 * ry**2, rx**2 * ry**2])
    K_0 = np.asarray(area * np.concatenate([_stretch(b, rx, ry), _stretch(c, rx, ry), bend]), complex)
    m_b, m_c = (f.density_kg_m3 * f.thickness_m if f is not None else 0.0 for f in (b, c))
    if v is None or c is None:
        M = area * np.array([m_b, m_b, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        return Coefficients(K_0, np.zeros(len(CORE)), M, m_b * area)
    H, m_v = v.thickness_m, v.density_kg_m3 * v.thickness_m
    d = H + (c.thickness_m + b.thickness_m) / 2
    e = (c.thickness_m - b.thickness_m) / 2
    core_0 = reference.core
    assert core_0 is not None
    stretch = H / core_0.thickness_m * (1 - core_0.poisson) / (1 - v.poisson)
    K_1 = area * np.array(
        [1 / H, 1 / H, d / H * rx, d / H * ry, d**2 / H * rx**2, d**2 / H * ry**2, stretch * (rx * ry) ** 0.5]
    )
    quarter = m_v / 4
    M = area * np.array(
        [
            m_b + m_c + m_v,
            m_b,
            m_c,
            quarter,
            quarter * e * rx,
            quarter * e * ry,
            quarter * (e * rx) ** 2,
            quarter * (e * ry) ** 2,
        ]
    )
    return Coefficients(K_0, K_1, M, (m_b + m_c + m_v) * area)


def layers_of(specimen: Specimen) -> Array:
    """What `coefficients` asks of substrate, constraining layer and core, in the order of `_LAYER`.

    Zero where a layer is missing or has no such number. Shape (3, 5).
    """
    each = (specimen.substrate, specimen.constraining, specimen.core)
    return np.array([[getattr(layer, name, 0.0) for name in _LAYER] for layer in each])


def specimen_of(size: Array, layers: Array) -> Specimen:
    """As far as `coefficients` asks: `size` gives length and width in m and elements along each.

    Shapes (4,) and (3, 5), see `layers_of`.
    """
    substrate, constraining = (Face(*row) for row in layers[:2].tolist())
    thickness, _, poisson, density, _ = layers[2].tolist()
    length, width, n_x, n_y = size.tolist()
    plain = Specimen(length, width, "free", substrate, elements=(int(n_x), int(n_y)))
    if not thickness:
        return plain
    core = Core(thickness, poisson, density, ConstantModulus(1e6, 0.0))
    return replace(plain, constraining=constraining, core=core)


def stretched(specimen: Specimen, reference: Specimen) -> Array:
    """Factors on the nodal degrees of freedom of the reference's shapes, on a stretched plate. Shape (7,)."""
    found = np.ones(DOFS)
    found[THETA_X] = reference.width_m / specimen.width_m
    found[THETA_Y] = reference.length_m / specimen.length_m
    return found


def _plane_stress(face: Face) -> Array:
    """Q_11, Q_22, Q_12, Q_66 in Pa."""
    Q = face.young_pa / (1 - face.poisson**2)
    return np.array([Q, Q, face.poisson * Q, (1 - face.poisson) / 2 * Q])


def _stretch(face: Face | None, rx: float, ry: float) -> NDArray[np.complex128]:
    if face is None:
        return np.zeros(len(_MEMBRANE), complex)
    Q_11, Q_22, Q_12, Q_66 = _plane_stress(face)
    parts = np.array([Q_11 * rx**2, Q_22 * ry**2, Q_12 * rx * ry, Q_66 * ry**2, Q_66 * rx**2, Q_66 * rx * ry])
    return np.asarray((1 + 1j * face.loss_factor) * face.thickness_m * parts)


def _rows(shape: Shape, x: float, y: float) -> Rows:
    """Everything integrated, at a point."""
    found: Rows = {"w": shape.deflection(x, y)}
    for name, (dx, dy) in {"x": (1, 0), "y": (0, 1), "xx": (2, 0), "yy": (0, 2), "xy": (1, 1)}.items():
        found[f"w_{name}"] = shape.deflection(x, y, dx=dx, dy=dy)
    for layer, u, v in (("b", U_B, V_B), ("c", U_C, V_C)):
        for name, dof in ((f"u{layer}", u), (f"v{layer}", v)):
            found[name] = shape.inplane(dof, x, y)
            found[f"{name}_x"], found[f"{name}_y"] = (
                shape.inplane(dof, x, y, dx=1),
                shape.inplane(dof, x, y, dy=1),
            )
    return found


def _both(a: Array, b: Array) -> Array:
    return np.outer(a, b) + np.outer(b, a)


def _square(a: Array) -> Array:
    return np.outer(a, a)


def _membrane(r: Rows, layer: str) -> list[Array]:
    u_x, u_y, v_x, v_y = (r[f"{name}{layer}_{d}"] for name in "uv" for d in "xy")
    return [_square(u_x), _square(v_y), _both(u_x, v_y), _square(u_y), _square(v_x), _both(u_y, v_x)]


def _bending(r: Rows) -> list[Array]:
    return [_square(r["w_xx"]), _square(r["w_yy"]), _both(r["w_xx"], r["w_yy"]), 4 * _square(r["w_xy"])]


def _slip(r: Rows) -> list[Array]:
    """Of gamma_x = (u_c - u_b + d w_x)/H and gamma_y, squared, in powers of d."""
    x, y = r["uc"] - r["ub"], r["vc"] - r["vb"]
    return [
        _square(x),
        _square(y),
        _both(x, r["w_x"]),
        _both(y, r["w_y"]),
        _square(r["w_x"]),
        _square(r["w_y"]),
    ]


def _inertia(r: Rows) -> list[Array]:
    """Faces; then the core's mean displacement, half of u_c + u_b + e w_x."""
    x, y = r["uc"] + r["ub"], r["vc"] + r["vb"]
    return [
        _square(r["w"]),
        _square(r["ub"]) + _square(r["vb"]),
        _square(r["uc"]) + _square(r["vc"]),
        _square(x) + _square(y),
        _both(x, r["w_x"]),
        _both(y, r["w_y"]),
        _square(r["w_x"]),
        _square(r["w_y"]),
    ]
