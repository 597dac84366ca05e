"""A beam's treatment that its clamps let go: how it moves there, and what would hold it.

Let go, the layer above slides, lifts and turns at its end while the substrate stays. How far from its end
that goes into the beam is the core's to say: (4 D H/E)^(1/4) with D the layer's rigidity and E the core's
stiffness across, millimetres.
"""

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array
from fitting.structures.beam_section import BeamSection

_MODULI_PA, _MODES, _ADDS = np.geomspace(1e5, 3e9, 6), 7, 1e-4
"""Moduli of the core, modes at each, and what a column adds at least, relative. Choices."""


def treatment_let_go(
    section: BeamSection, own: Array, size: Array, stiff: Array, core: Array, M: Array
) -> Array:
    """Columns for a treatment that is free at held ends, the substrate held. Shape (size, any).

    Modes of such a beam at a few moduli. `own` are the columns of the held one, shape (size, k), `size` that
    of each unknown, (size,); `stiff`, `core` and `M` are matrices over all unknowns, (size, size).
    """
    s, let_go = section.shapes, section.moves & ~section.shapes.is_held
    w, a, c = (np.flatnonzero(let_go & s.is_of(name)) for name in ("w", "a", "c"))
    R = np.eye(s.size)[:, np.concatenate([c, a])]
    # The substrate stays: w - share a is zero.
    R[w[: len(a)], len(c) + np.arange(len(a))] = section.share
    if not R.size:
        return R
    T = np.hstack([np.eye(s.size)[:, section.moves & s.is_held], R])
    stiff, core, M = (T.T @ A @ T for A in (stiff, core, M))
    each, found = 1 / np.sqrt(np.diag(M)), []
    for G in _MODULI_PA:
        K = (stiff + G * core) * np.outer(each, each)
        _, V = la.eigh(K, M * np.outer(each, each), subset_by_index=[0, _MODES - 1])
        found.append(T @ (each[:, None] * V))
    scale = np.where(size > 0, size, 1.0)[:, None]
    Q, Y = own / scale, np.hstack(found) / scale
    Y = Y / np.linalg.norm(Y, axis=0)
    # What its own columns lack by itself, and with what they have: that is lost where they are condensed.
    some = []
    for X in (Y - Q @ (Q.T @ Y), Y):
        left, values, _ = np.linalg.svd(X, full_matrices=False)
        some.append(left[:, values > _ADDS * values[0]])
    return np.asarray(scale * np.hstack(some))


def hold_above(section: BeamSection) -> Array:
    """A unit spring per width, even over the end faces of the layer above: it slides, lifts and turns.

    Shape (size, size).
    """
    s, ends = section.shapes, np.array(section.shapes.held_ends)
    lift, turn = (s.rows("w", ends, d) + (1 - section.share) * s.rows("a", ends, d) for d in (0, 1))
    arm = section.thickness_m[2] / np.sqrt(12) / section.length_m
    return sum(rows @ rows.T for rows in (s.rows("c", ends), lift, arm * turn))  # type: ignore[return-value]
