"""A solid beam on few motions: what its base, forces at points and what it hides will stir."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant import air
from drivers.simulated.plant.basis import basis_of, motions
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.progress import Report
from drivers.simulated.plant.solid_beam import SolidBeam

Factor = Callable[[Array], Array]

_MODES = 12
_SHIFT = (2 * np.pi * 20.0) ** 2
"""Of a free beam's eigenvalues."""
_PANELS = (48, 8)
"""Of the air, along and across."""


@dataclass(frozen=True)
class Place:
    """A place on the middle line."""

    x_m: float
    below: bool = False
    """On the lower face."""


@dataclass(frozen=True)
class BeamOnBasis:
    """Matrices on the basis."""

    M: Array
    K_faces: Array
    """Each apart. Shape (faces, n, n)."""
    K_core: Array
    """For unit modulus, of each strip of the beam. Shape (strips, n, n)."""
    K_root: Array
    """Of the springs at the root. Shape (n, n)."""
    M_air: Array
    """Of still air on both faces, for unit density. Shape (n, n)."""
    load: Array
    """M times heave and pitch. Shape (n, 2)."""
    load_air: Array
    """The same of the air."""
    w: Array
    """Read the deflection at the places. Shape (places, n)."""
    u: Array
    """The same along the beam."""


@one_thread
def on_basis(
    solid: SolidBeam,
    moduli_pa: Array,
    places: Sequence[Place],
    strips: int = 1,
    *,
    with_air: bool = False,
    report: Report = lambda done: None,
) -> BeamOnBasis:
    """The solid on modes at the given moduli, shape (moduli,), and on what steady forces at the places move.

    Of several strips each may have a modulus of its own, not far from those of the others.
    """
    free, stated = solid.free, solid.stated
    heave_pitch = solid.M @ solid.rigid
    w, u = (np.array([solid.row(p.x_m, 0.0, axis, below=p.below) for p in places]) for axis in (2, 0))
    faces = [solid.face(k) for k in range(len(stated.sheets)) if k not in stated.cores]
    cores = [solid.core_times(factor) for factor in _strips(strips, stated.span_m)]
    M, K_0, core, root = (
        A[free][:, free] for A in (solid.M, sum(faces[1:], faces[0]), sum(cores[1:], cores[0]), solid.root)
    )
    stirred = [root] if solid.build.springs is not None else []
    stirred += [solid.core_times(wave)[free][:, free] for wave in _waves(stated.span_m) if strips > 1]
    steady = np.column_stack([heave_pitch, *w])[free]
    held = K_0 + root
    if stated.ends == "free-free":
        # Its stiffness alone cannot be solved with; and beside what a force moves it by as a whole, which
        # modes have, nothing would be left of how it bends.
        held, rigid, forces = held + _SHIFT * M, solid.rigid[free], w.T[free]
        steady = forces - M @ rigid @ np.linalg.solve(rigid.T @ (M @ rigid), rigid.T @ forces)
    # A force on what a clamp holds moves nothing.
    steady = steady[:, steady.any(axis=0)]
    parts = []
    for k, G in enumerate(moduli_pa):
        parts.append(motions(held + G * core, M, steady, _MODES, stirred))
        report((k + 1) / len(moduli_pa))
    few = basis_of(np.hstack(parts), M)
    V = np.zeros((len(heave_pitch), few.shape[1]))
    V[free] = few
    n = V.shape[1]
    of_air = _air(solid, V) if with_air else (np.zeros((n, n)), np.zeros((n, 2)))
    K_faces, K_core = (np.array([V.T @ (K @ V) for K in every]) for every in (faces, cores))
    root, M = (V.T @ (A @ V) for A in (solid.root, solid.M))
    return BeamOnBasis(M, K_faces, K_core, root, of_air[0], V.T @ heave_pitch, of_air[1], w @ V, u @ V)


def _strips(count: int, span_m: float) -> list[Factor]:
    """One on each strip of equal length, none elsewhere."""
    ends = np.linspace(0.0, span_m, count + 1)
    ends[-1] = np.inf
    return [lambda x, k=k: ((x >= ends[k]) & (x < ends[k + 1])).astype(float) for k in range(count)]  # type: ignore[misc]


def _waves(span_m: float) -> list[Factor]:
    """How strips may differ: their forces on the modes, moved at rest, are in the basis."""
    return [lambda x, n=n: np.cos(n * np.pi * x / span_m) for n in (1, 2)]  # type: ignore[misc]


def _air(solid: SolidBeam, V: Array) -> tuple[Array, Array]:
    """Added mass of still air, and that times heave and pitch. Shapes (n, n) and (n, 2)."""
    stated = solid.stated
    size = stated.span_m, stated.width_m
    x, y = air.centres(*size, _PANELS)
    at = [(float(a), abs(float(b) - stated.width_m / 2)) for a in x for b in y]
    rows = np.array([solid.row(*place) for place in at])
    rigid, w = rows @ solid.rigid, rows @ V
    # Of a beam that is driven in its centre both halves.
    halves = 2.0 if stated.ends == "centre-driven" else 1.0
    A = halves * air.mass_per_density(*size, _PANELS)
    return w.T @ A @ w, w.T @ A @ rigid
