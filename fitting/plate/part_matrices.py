"""The matrices whose sum a plate is (`fitting.plate.parts`): integrands are of `fitting.plate.element`."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex, Indices
from fitting.plate.element import (
    CORNERS,
    G_X,
    G_Y,
    U_B,
    U_C,
    V_B,
    V_C,
    WITH_SLIP,
    Rectangle,
    Rectangles,
    Shape,
    W,
    core_stiffness,
    gauss_points,
    slip_stiffness,
)
from fitting.plate.mesh import SHIFT_M, Cell, cells_of, is_turned, mesh_of
from fitting.plate.part_names import (
    GLUE,
    MASS,
    OFF_AXIS,
    PATCHED,
    PATCHED_OFF_AXIS,
    PULLED,
    SHEARED,
    STIFFNESS,
    W_TREATED,
    Names,
    names_of,
)
from fitting.plate.parts import coefficients
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved
from fitting.specimen import PlateSpecimen
from fitting.stated.number_names import number_name
from fitting.stated.patches import shifts_of

Rows = dict[str, Array]
_STRETCH_C = tuple(name for name in STIFFNESS if name.startswith("stretch c"))
_STRETCH_C_TURNED = tuple(name for name in OFF_AXIS if name.startswith("stretch c"))


def element_parts(reference: PlateSpecimen, cell: Cell | None = None) -> tuple[Array, Array, Array]:
    """Parts of K_0, K_1 and M of one element of the reference's mesh. Shape (parts, 4 dofs, 4 dofs) each."""
    shape, names = mesh_of(reference).shape, names_of(reference)
    over = cell.over if cell is not None else None
    K_0, K_1, M = (part.copy() for part in _all_over(shape, names, is_turned(reference)))
    if reference.patches:
        its_K_0, its_M = _of_treatment(names)
        K_0[its_K_0], K_1[:], M[its_M] = 0.0, 0.0, 0.0
        for rectangle in over or ():
            for to, more in zip((K_0, K_1, M), _treated(shape, names, rectangle), strict=True):
                to += more
    elif reference.slips:
        K_0[names.K_0.index(GLUE)] = M[names.M.index(GLUE)] = slip_stiffness(shape)
    core, constraining = reference.core, reference.constraining
    if core is not None and constraining is not None:
        # What the core carries by stretching and bending is a hundred thousandth of its faces'.
        whole = core_stiffness(shape, core, reference.substrate, constraining, over)
        c = coefficients(reference, reference).K_1[:6] / (2.0 if reference.both_sides else 1.0)
        K_1[6] = whole - np.tensordot(c, K_1[:6], axes=1)
    for shift, both in zip(shifts_of(reference), cell.shifts if cell is not None else (), strict=False):
        for to, name, part in zip((K_0, K_1, M), (names.K_0, names.K_1, names.M), range(3), strict=True):
            to[name.index(shift.name)] = _shifted(reference, shape, names, both)[part]
    return K_0, K_1, M


@lru_cache(maxsize=8)
def _all_over(shape: Shape, names: Names, turned: bool) -> tuple[Array, Array, Array]:
    """Integrals over the whole element; not to be changed."""
    K_0, K_1, M = (np.zeros((count, 4 * shape.dofs, 4 * shape.dofs)) for count in names.counts.each)
    few, most = len(STIFFNESS), len(STIFFNESS) + len(OFF_AXIS)
    for x, y, dA in gauss_points(shape):
        r = _rows(shape, x, y)
        K_0[:few] += dA * np.array([*_membrane(r, "b"), *_membrane(r, "c"), *_bending(r)])
        K_1[:6] += dA * np.array(_slip(r))
        M[: len(MASS)] += dA * np.array(_inertia(r))
        if turned:
            K_0[few:most] += dA * np.array(_turned(r))
        if SHEARED[0] in names.K_0:
            first = names.K_0.index(SHEARED[0])
            K_0[first : first + len(SHEARED)] += dA * np.array(_sheared(r))
        for a, name in PULLED.items():
            if name in names.K_0:
                K_0[names.K_0.index(name)] += dA * _square(r[f"w_{a}"])
    return K_0, K_1, M


def _of_treatment(names: Names) -> tuple[list[int], list[int]]:
    """Places of the treatment's parts in K_0 and M."""
    of_K = [
        k
        for k, name in enumerate(names.K_0)
        if name.startswith(("stretch c", "bend c", GLUE)) or name in SHEARED
    ]
    return of_K, [names.M.index(name) for name in (*MASS[2:], *names.M[len(MASS) :])]


@lru_cache(maxsize=512)
def _treated(shape: Shape, names: Names, rectangle: Rectangle) -> tuple[Array, Array, Array]:
    """Integrals of the treatment over a part of an element, zero for other parts; not to be changed."""
    K_0, K_1, M = (np.zeros((count, 4 * shape.dofs, 4 * shape.dofs)) for count in names.counts.each)
    at = {name: k for k, name in enumerate(names.K_0)}
    turned = PATCHED_OFF_AXIS[0] in at
    for x, y, dA in gauss_points(shape, (rectangle,)):
        r = _rows(shape, x, y)
        inertia = _inertia(r)
        K_0[[at[n] for n in _STRETCH_C]] += dA * np.array(_membrane(r, "c"))
        K_0[[at[n] for n in PATCHED]] += dA * np.array(_bending(r))
        if SHEARED[0] in at:
            K_0[[at[n] for n in SHEARED]] += dA * np.array(_sheared(r))
        if turned:
            K_0[[at[n] for n in _STRETCH_C_TURNED]] += dA * np.array(_turned(r)[4:8])
            K_0[[at[n] for n in PATCHED_OFF_AXIS]] += dA * np.array(_bending_turned(r))
        K_1[:6] += dA * np.array(_slip(r))
        M[2 : len(MASS)] += dA * np.array(inertia[2:])
        M[names.M.index(W_TREATED)] += dA * inertia[0]
    if GLUE in at:
        K_0[at[GLUE]] = M[names.M.index(GLUE)] = slip_stiffness(shape, (rectangle,))
    return K_0, K_1, M


def _shifted(
    reference: PlateSpecimen, shape: Shape, names: Names, both: tuple[Rectangles, Rectangles]
) -> tuple[Array, Array, Array]:
    """What moving a patch by a metre changes of K_0, K_1 and M, to first order.

    Shape (4 dofs, 4 dofs) each.
    """
    K_0, K_1, M = (np.zeros((count, 4 * shape.dofs, 4 * shape.dofs)) for count in names.counts.each)
    for over, sign in zip(both, (1, -1), strict=True):
        for rectangle in over:
            for to, more in zip((K_0, K_1, M), _treated(shape, names, rectangle), strict=True):
                to += sign / (2 * SHIFT_M) * more
    c = coefficients(reference, reference)
    dK_0, dK_1, dM = (
        np.tensordot(f.real, P, axes=1) for f, P in zip((c.K_0, c.K_1, c.M), (K_0, K_1, M), strict=True)
    )
    return dK_0, dK_1, dM


def load_part(reference: PlateSpecimen) -> Array:
    """The first part of M on w = 1 at all nodes, held ones too. Shape (nodes * dofs,).

    Where not all of the plate is treated, of all parts that carry the load. Shape (loads, nodes * dofs).
    """
    mesh, names = mesh_of(reference), names_of(reference)
    w = np.zeros((mesh.nodes, mesh.dofs))
    w[:, W] = 1.0
    carrying = [k for k, n in enumerate(names.M) if n not in (*MASS[1:], GLUE)]
    dofs = mesh.element_dofs()
    found = np.zeros((len(carrying), mesh.size))
    for cell in cells_of(reference, mesh):
        M, its = element_parts(reference, cell)[2], dofs[cell.elements]
        for row, k in zip(found, carrying, strict=True):
            np.add.at(row, its, w.ravel()[its] @ M[k])
    return found if reference.patches else found[0]


def moving_part(reference: PlateSpecimen) -> Array:
    """`load_part` where the base drives the plate; a force at a point does not go with any part.

    Shape as `load_part`.
    """
    return load_part(reference) if reference.drive == "base" else np.zeros_like(load_part(reference))


def on_motions(part: Array, V: Array) -> Array:
    """Parts of the load, (n,) or (loads, n), on motions V, (n, k). Shape (k,) or (loads, k)."""
    return np.asarray(V.T @ part if part.ndim == 1 else part @ V)


def projected_parts(plate: Plate, V: Array, *, one_parity: bool = False) -> Array:
    """V^T P_p V of every part: of K_0, then of K_1, then of M. `V` of shape (n, k); shape (parts, k, k).

    `one_parity`: all columns are even in y, or all are odd. Half of the elements do then, of a plate without
    patches.
    """
    dofs, weight = plate.mesh.element_dofs(), np.ones(plate.mesh.n_x * plate.mesh.n_y)
    # A patch that is laid elsewhere is no longer alike on both sides.
    if one_parity and not shifts_of(plate.specimen):
        n_y = plate.mesh.n_y
        twice = 2 * (np.arange(len(dofs)) % n_y) + 1
        weight = np.where(twice > n_y, 0.0, np.where(twice == n_y, 1.0, 2.0))
    full = np.zeros((plate.mesh.size, V.shape[1]))
    full[plate.free] = V
    found = None
    for cell in plate.cells:
        its, w = dofs[cell.elements], weight[cell.elements]
        P = np.concatenate(element_parts(plate.specimen, cell))
        more = _projected(P, full, its[w > 0], w[w > 0])
        found = more if found is None else found + more
    assert found is not None
    return found


def _projected(P: Array, full: Array, dofs: Indices, weight: Array) -> Array:
    """Over some elements, which have weights. Shape (parts, k, k)."""
    N = P.shape[1] // len(CORNERS)
    # Stretching does not touch the deflection, nor bending the layers' planes: few rows are worked on.
    kinds = [tuple(np.unique(np.flatnonzero(p.any(axis=0)) % N)) for p in P]
    found = np.zeros((len(P), full.shape[1], full.shape[1]))
    for some in set(kinds) - {()}:
        rows = np.flatnonzero(np.isin(np.arange(len(P[0])) % N, some))
        touched, place = np.unique(dofs.T[rows], return_inverse=True)
        # Sums what the elements give each degree of freedom.
        gather = sp.csr_array((np.tile(weight, len(rows)), (place.ravel(), np.arange(place.size))))
        ends = full[touched]
        on_elements = full[dofs.T[rows]].reshape(len(rows), -1)
        for p in (n for n, kind in enumerate(kinds) if kind == some):
            found[p] = ends.T @ (gather @ (P[p][np.ix_(rows, rows)] @ on_elements).reshape(place.size, -1))
    return found


def stated_steps(reference: PlateSpecimen, names: Sequence[str]) -> tuple[Complex, Array, Array]:
    """What a typical tolerance of some stated numbers changes of an element's K_0, K_1 and M, to first order.

    Shape (names, 4 dofs, 4 dofs) each; of several cells (names, cells, 4 dofs, 4 dofs).
    """
    found = []
    for name in names:
        step = number_name(name).number.typical
        up, down = (coefficients(moved(reference, [name], [s * step]), reference) for s in (1, -1))
        found.append([(getattr(up, m) - getattr(down, m)) / 2 for m in ("K_0", "K_1", "M")])
    K_0, K_1, M = (
        np.tensordot(np.array(c), parts, axes=1)
        for c, parts in zip(zip(*found, strict=True), _of_cells(reference), strict=True)
    )
    return K_0, K_1, M


def _of_cells(reference: PlateSpecimen) -> list[Array]:
    """Of K_0, K_1 and M: `element_parts`, of several cells side by side behind the first axis."""
    cells = cells_of(reference, mesh_of(reference))
    if len(cells) == 1:
        return list(element_parts(reference, cells[0]))
    each = [element_parts(reference, cell) for cell in cells]
    return [np.stack(parts, axis=1) for parts in zip(*each, strict=True)]


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
    if shape.dofs == WITH_SLIP:
        for name, dof in (("gx", G_X), ("gy", G_Y)):
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


def _turned(r: Rows) -> list[Array]:
    """Products that own axes couple: of either face in its plane, then in bending."""
    found = []
    for layer in "bc":
        u_x, u_y, v_x, v_y = (r[f"{name}{layer}_{d}"] for name in "uv" for d in "xy")
        found += [_both(u_x, u_y), _both(u_x, v_x), _both(v_y, u_y), _both(v_y, v_x)]
    return [*found, *_bending_turned(r)]


def _bending_turned(r: Rows) -> list[Array]:
    return [2 * _both(r["w_xx"], r["w_xy"]), 2 * _both(r["w_yy"], r["w_xy"])]


def _sheared(r: Rows) -> list[Array]:
    """`SHEARED`: products of curvatures and derivatives of the slip, then of the latter alone."""
    turns = [
        _both(r["w_xx"], r["gx_x"]),
        _both(r["w_yy"], r["gy_y"]),
        _both(r["w_yy"], r["gx_x"]),
        _both(r["w_xx"], r["gy_y"]),
        2 * _both(r["w_xy"], r["gx_y"]),
        2 * _both(r["w_xy"], r["gy_x"]),
    ]
    return [*turns, *_stretching(*(r[f"g{u}_{d}"] for u in "xy" for d in "xy"))]


def _membrane(r: Rows, layer: str) -> list[Array]:
    return _stretching(*(r[f"{name}{layer}_{d}"] for name in "uv" for d in "xy"))


def _stretching(u_x: Array, u_y: Array, v_x: Array, v_y: Array) -> list[Array]:
    return [_square(u_x), _square(v_y), _both(u_x, v_y), _square(u_y), _square(v_x), _both(u_y, v_x)]


def _bending(r: Rows) -> list[Array]:
    return [_square(r["w_xx"]), _square(r["w_yy"]), _both(r["w_xx"], r["w_yy"]), 4 * _square(r["w_xy"])]


def _slip(r: Rows) -> list[Array]:
    """Of gamma_x = (u_c - u_b + d w_x - g_x)/H and gamma_y, squared, in powers of d."""
    x, y = r["uc"] - r["ub"], r["vc"] - r["vb"]
    if "gx" in r:
        x, y = x - r["gx"], y - r["gy"]
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
