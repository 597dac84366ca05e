"""A widened reduced plate on fewer columns of its own: those that it answers with in a fit."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, as_slice
from fitting.dynamics.dynamic_stiffness import dynamic_stiffness, stacked
from fitting.widened.change import Change
from fitting.widened.combined_columns import OwnCombined
from fitting.widened.enriched_plate import EnrichedReducedPlate

CONDENSED = 1e-4
"""Of the largest singular value, what a condensed plate may leave out; its reading is then off by 1e-5."""


@dataclass(frozen=True, eq=False)
class Training:
    """Where a plate's answers are kept."""

    omega: Array
    """In rad/s. Shape (points,)."""
    G: Complex
    """The core's modulus in Pa. Shape (points,)."""
    changes: Sequence[Change] = ()
    """Of the plate, on its columns: its answers with each of them are kept too."""
    changed_omega: Array | None = None
    """Where those are. Shape (any,)."""
    changed_G: Complex | None = None
    """Shape (any,)."""


def condensed(
    plate: EnrichedReducedPlate,
    training: Training,
    sides: Sequence[Array] = (),
    left_out: float = CONDENSED,
) -> EnrichedReducedPlate:
    """Its own even columns as far as they answer at some frequencies and moduli; others as they are.

    `sides` are further loads to be answered, or rows that read it. Shape (k,) each. `left_out`: of the
    largest singular value.
    """
    own = np.flatnonzero(plate.group == "plate")
    found = [_answers(plate, own, training.omega, training.G, Change(), sides)]
    if training.changed_omega is not None and training.changed_G is not None:
        found += [
            _answers(plate, own, training.changed_omega, training.changed_G, c, sides)
            for c in training.changes
        ]
    X = np.concatenate(found, axis=1)
    V, size, _ = np.linalg.svd(np.hstack([X.real, X.imag]), full_matrices=False)
    # Motions that effects stir are of several sides more of its own and less beside them.
    kept = size > left_out / max(1.0, len(sides) / 2) * size[0]
    V = V[:, kept]
    rest = np.flatnonzero(plate.group != "plate")
    on = OwnCombined(V, as_slice(own), as_slice(rest))
    group = np.concatenate([np.full(V.shape[1], "plate"), plate.group[rest]])
    return replace(plate.combined(on, group), shares=size[kept])


def _answers(
    plate: EnrichedReducedPlate,
    own: NDArray[np.intp],
    omega: Array,
    G: Complex,
    change: Change,
    further: Sequence[Array],
) -> Complex:
    """Of its own columns to base, pickup and pitch, of unit size. Shape (k, any)."""
    square = np.ix_(own, own)
    K_0, K_1, M = (
        (getattr(plate, a) + getattr(change, b))[square]
        for a, b in (("K_0", "K"), ("K_1", "K_1"), ("M", "M"))
    )
    C_1 = (plate.viscous(change.damping) + change.C)[square]
    A = dynamic_stiffness(stacked(K_0, K_1, M, C_1), omega, G)
    given = [plate.load + change.load, plate.observe + change.observe, plate.pitch, *further]
    sides = np.stack([side[own] for side in given if np.any(side)], axis=1).astype(complex)
    X = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
    return np.concatenate(X / np.linalg.norm(X, axis=1, keepdims=True), axis=1)
