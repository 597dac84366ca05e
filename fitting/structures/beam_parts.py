"""A beam's matrices on a basis of its modes, and what effects ask for, on motions beside them.

A sound beam is fitted on its modes at a few moduli of the core. Effects let it move as those modes do not, so
further columns stand beside them, in groups:

    root        motions of a held end that yields
    treatment   those of a treatment that the clamp does not hold, the substrate held
    faces       the faces stretching against each other otherwise than in the proportion of their stated
                stiffness, as they do where one of them is stiffer than stated

Matrices go by the names that a plate's have (`fitting.effects`).
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.structures.beam_let_go import hold_above, treatment_let_go
from fitting.structures.beam_reading import ELEMENTS, deflection, read_otherwise, row_at
from fitting.structures.beam_section import SLIP, BeamSection
from fitting.structures.beam_sectioned import sectioned, summed
from fitting.structures.beam_shapes import (
    gauss,
    slip_by_pieces,
)
from fitting.structures.beam_strip import loads_of_strip, strip
from fitting.structures.beam_uneven import THICKER, loads_of_uneven, uneven, where_uneven
from fitting.structures.small import Parts

_MODES = 10
"""Of each modulus, that the basis holds."""
_MODULI_PA = (1e5, 3e6, 1e8, 3e9)
"""From a core that only stores to a free layer as stiff as a plastic: the modes of each are in the basis."""
_BESIDE_MODES = 1e-6
"""Of how a beam yields to a force at a point: what its modes do not have already."""
_NEGLIGIBLE = 1e-9
"""Of the basis' vectors, relative: what is in the others."""
_APART = 1e-5
"""Of the faces' own stretching: what their modes have already."""
_PARTED = 1e-5
"""Of how far faces part by themselves."""


@lru_cache(maxsize=64)
def parts_of(section: BeamSection, pickup: float | None, force: float | None) -> Parts:
    """For unit coefficients; where it is read, and where a force drives it, in shares of its length.

    None: not read, and driven by its base.
    """
    matrices, s = sectioned(section), section.shapes
    group, V, size = _columns(section)
    K_0, K_1, M = (np.array([V.T @ P @ V for P in getattr(matrices, name)]) for name in ("K_0", "K_1", "M"))
    lifted = V.T @ matrices.load if s.held_ends else np.zeros(V.shape[1])
    scaled = V / size[:, None]
    return Parts(
        K_0=K_0,
        K_1=K_1,
        M=M,
        load=(lifted if force is None else row_at(section, V, force))[None],
        observe=row_at(section, V, pickup) if pickup is not None else np.zeros(V.shape[1]),
        matrices={name: V.T @ A @ V for name, A in _asked_for(section).items()},
        deflection=deflection(section, V),
        size=(section.length_m, section.width_m, ELEMENTS, 1),
        pickup_m=((pickup or 0.0) * section.length_m, 0.0),
        group=group,
        gram=scaled.T @ scaled,
        pitch=-V.T @ summed(section, "M") @ _turned(section) if s.held_ends else np.zeros(V.shape[1]),
        vectors=_loads(section, V, lifted, by_base=force is None)
        | {f"{why}.observe": V.T @ row for why, row in read_otherwise(section, pickup).items()}
        | {f"{why}.load": V.T @ row for why, row in read_otherwise(section, force).items()},
    )


def _loads(section: BeamSection, V: Array, lifted: Array, *, by_base: bool) -> dict[str, Array]:
    """How much more a base drives, `V` the columns: air that goes along, an uneven core's mass, a strip's.

    Shape (k,) each; zero where a force drives.
    """
    found = {"air.load": _air_kg_m(section) * section.length_m * lifted} | loads_of_uneven(section, V)
    if section.is_sandwich and section.shapes.held_ends:
        found |= {f"root.strip_{name}": load for name, load in loads_of_strip(section, V).items()}
    return {name: load * by_base for name, load in found.items()}


def carrying(
    parts: Parts, section: BeamSection, masses: Sequence[tuple[float, float]], *, by_base: bool
) -> Parts:
    """The same with point masses, kg and shares of its length: parts of M, and loads `by_base`.

    A mass that is off by d reads w + d w' + d^2 w''/2: three parts each, of m, m d and m d^2.
    """
    _, V, _ = _columns(section)
    M, loads, turned = list[Array](), list[Array](), np.zeros(V.shape[1])
    for m, x in masses:
        w, slope, bend = (row_at(section, V, x, d) / section.length_m**d for d in (0, 1, 2))
        M += [np.outer(w, w), _both(w, slope), np.outer(slope, slope) + _both(w, bend) / 2]
        loads += [-w, -slope, -bend / 2]
        # A base that turns lifts each as far as it is away.
        turned += m * x * section.length_m * w
    return replace(
        parts,
        M=np.concatenate([parts.M, np.array(M)]),
        load=np.concatenate([parts.load, np.array(loads)]) if by_base else parts.load,
        pitch=None if parts.pitch is None else parts.pitch - turned,
    )


def _both(a: Array, b: Array) -> Array:
    return np.asarray(np.outer(a, b) + np.outer(b, a))


def _turned(section: BeamSection) -> Array:
    """The whole beam turned by one about x = 0: w is the distance, and the layer above slides back.

    Shape (size,).
    """
    s = section.shapes
    h_b, h_v, h_c = section.thickness_m
    found = np.zeros(s.size)
    found[s.rising] = section.length_m
    if section.is_sandwich:
        found[s.level("c")] = -(h_v + (h_b + h_c) / 2)
    return found


def _columns(section: BeamSection) -> tuple[NDArray[np.str_], Array, Array]:
    """Groups of the columns, the columns, and the size of each unknown. Shapes (k,), (size, k), (size,)."""
    s, moves = section.shapes, section.moves
    size = np.zeros(s.size)
    stiff, core, M = (summed(section, name) for name in ("K_0", "K_1", "M"))
    size[moves] = 1 / np.sqrt(np.diag(M)[moves])
    own = _own(section, size)
    root = np.diag(size)[:, moves & ~s.is_held & ~section.of_core]
    beside = [("faces", _faces_apart(section, own, size)), ("root", root)]
    beside.append(("treatment", treatment_let_go(section, own, size, stiff, core, M)))
    beside += [(f"uneven_{name}", where_uneven(section, own, size, p)) for name, p in THICKER.items()]
    groups = np.concatenate([np.full(own.shape[1], "plate"), *(np.full(b.shape[1], n) for n, b in beside)])
    return groups.astype(str), np.hstack([own, *(b for _, b in beside)]), np.where(size > 0, size, 1.0)


@lru_cache(maxsize=64)
def _modes(section: BeamSection) -> Array:
    """Of a few moduli, and what rests, in units of each unknown's own size. Shape (moving, k).

    Where a force drives at a point its beam yields there as many modes more do: that is in the basis too, as
    the answers to the force (and to one where it is read) while its own inertia holds it.
    """
    kept = np.flatnonzero(section.moves & section.shapes.is_held)
    square = np.ix_(kept, kept)
    stiff, core, mass = (summed(section, name)[square] for name in ("K_0", "K_1", "M"))
    # Equal sizes of all polynomials: their squares differ by many orders.
    size = 1 / np.sqrt(np.diag(mass))
    rows = [row_at(section, np.eye(section.shapes.size)[:, kept], x) for x in section.forced_at]
    # A held end does not yield.
    rows = [row * size for row in rows if row.any()]
    found, yielding = [], []
    for G in _MODULI_PA if core.any() else (0.0,):
        K, M = (A * np.outer(size, size) for A in (stiff + G * core, mass))
        squares, V = la.eigh(K, M, subset_by_index=[0, min(_MODES, len(kept)) - 1])
        found.append(V)
        if rows:
            # A free beam does not rest under a force; held softly and firmly they span how it yields between.
            held = (squares[len(squares) // 2], squares[-1])
            yielding += [la.solve(K + by * M, np.transpose(rows), assume_a="pos") for by in held]
    whole = np.hstack(found)
    Q, values, _ = np.linalg.svd(whole / np.linalg.norm(whole, axis=0), full_matrices=False)
    Q = np.asarray(Q[:, values > _NEGLIGIBLE * values[0]])
    if yielding:
        more = np.hstack(yielding)
        more = more / np.linalg.norm(more, axis=0)
        beside, values, _ = np.linalg.svd(more - Q @ (Q.T @ more), full_matrices=False)
        Q = np.hstack([Q, beside[:, values > _BESIDE_MODES]])
    # How far faces part goes with 1/G, beside what moves with it.
    return np.hstack([Q, _alone(Q, section.of_core[kept], _PARTED)])


def _alone(Q: Array, which: NDArray[np.bool_], above: float) -> Array:
    """What some unknowns by themselves add to the columns that they are part of. Shape (size, any)."""
    alone = np.where(which[:, None], Q, 0.0)
    apart, values, _ = np.linalg.svd(alone - Q @ (Q.T @ alone), full_matrices=False)
    return np.asarray(apart[:, values > above])


def _own(section: BeamSection, size: Array) -> Array:
    kept = np.flatnonzero(section.moves & section.shapes.is_held)
    Q = _modes(section)
    V = np.zeros((section.shapes.size, Q.shape[1]))
    V[kept] = size[kept, None] * Q
    return V


def _faces_apart(section: BeamSection, own: Array, size: Array) -> Array:
    """What the substrate's stretching by itself adds to its own columns. Shape (size, any)."""
    if not section.is_sandwich or section.is_doubled:
        return np.zeros((len(own), 0))
    Q = own / np.where(size > 0, size, 1.0)[:, None]
    below = np.isin(np.arange(len(Q)), np.arange(len(Q))[section.shapes.place["b"]])
    return size[:, None] * _alone(Q, below, _APART)


def _asked_for(section: BeamSection) -> dict[str, Array]:
    """Matrices over all unknowns by the names that effects know. Shape (size, size) each."""
    s, L = section.shapes, section.length_m
    x, weight = gauss(2 * s.order)
    w = s.rows("w", x)
    moving = L * np.asarray((w * weight) @ w.T)
    found = {"air.M": _air_kg_m(section) * moving, "air.film": section.copies * section.width_m * moving}
    if s.held_ends:
        found |= {f"root.{axis}": A for axis, A in _root_springs(section).items()}
    if not section.is_sandwich:
        return found
    sides = 2 if section.is_doubled else 1
    width = section.copies * section.width_m
    found["strain.mean_square"] = _slip(section) / (sides * width * L * section.thickness_m[1])
    if s.held_ends:
        found["treatment.hold"] = sides * width * hold_above(section)
        found |= {f"root.strip_{key}": A for key, A in strip(section).items()}
    if section.is_doubled:
        return found
    by_pieces = np.einsum(
        "p,kpij->kij", section.coefficients[SLIP], slip_by_pieces(section.ends, section.arms, section.order)
    )
    found |= {f"strips_x.{k:03d}": A for k, A in enumerate(by_pieces)}
    found["grading_x.K_1"] = _slip(section, x - 0.5)
    for name, shape in THICKER.items():
        found |= {f"uneven_{name}.{key}": A for key, A in uneven(section, shape).items()}
    return found


def _slip(section: BeamSection, share: Array | float = 1.0) -> Array:
    """The core's shear for a modulus of one, times a share at every place of quadrature."""
    x, weight = gauss(2 * section.shapes.order)
    return np.tensordot(
        section.coefficients[SLIP], section.shapes.slip(x, weight * share, section.arms), axes=1
    )


def _root_springs(section: BeamSection) -> dict[str, Array]:
    """Unit springs per area of the faces of all held ends, along x and across. Shape (size, size) each."""
    s, ends = section.shapes, np.array(section.shapes.held_ends)
    h_b, h_v, h_c = section.thickness_m
    u_b, u_c, w = (s.rows(name, ends) for name in ("b", "c", "w"))
    turn = s.rows("w", ends, 1) / section.length_m
    below, above = u_b + h_b / 2 * turn, u_b - h_b / 2 * turn
    layers = [(h_b, below, above, 1)]
    sides = 2 if section.both_sides else 1
    if section.is_sandwich:
        low, high = u_c + h_c / 2 * turn, u_c - h_c / 2 * turn
        layers += [(h_v, above, low, sides), (h_c, low, high, sides)]
    else:
        layers.append((h_v, above, u_b - (h_b / 2 + h_v) * turn, 1))
        layers += [(h_v, below, u_b + (h_b / 2 + h_v) * turn, 1)] if section.both_sides else []
    # u is linear across a layer: its mean, and a twelfth of the square of its difference.
    along = sum(n * h * ((a + b) @ (a + b).T / 4 + (a - b) @ (a - b).T / 12) for h, a, b, n in layers)
    height = sum(n * h for h, _, _, n in layers)
    width = section.copies * section.width_m
    return {"x": width * np.asarray(along), "z": width * height * (w @ w.T)}


def _air_kg_m(section: BeamSection) -> float:
    """Of still air with a strip that moves across its width, per length and density.

    pi b^2/4, Lamb, Hydrodynamics (1932), section 71: where half a wave is long against the width.
    """
    return section.copies * np.pi / 4 * section.width_m**2
