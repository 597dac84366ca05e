"""A core whose bricks soften each with its own strain: the fixed point at every point of a sweep."""

from dataclasses import replace

import numpy as np

from campaign.plates.hidden.core import HiddenAmplitudeSoftening
from campaign.plates.reduced import ReducedSolid
from campaign.plates.response import Shaken
from campaign.schedule import Schedule
from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2

_RELAXED = 0.8
_SETTLED = 1e-6
_MOST_STEPS = 200
_SMALLEST = 1e-6
"""Of the singular values kept, to the largest."""


@one_thread
def softened(shaken: Shaken, G: Complex, soft: HiddenAmplitudeSoftening, schedule: Schedule) -> Complex:
    """Relative motion q per acceleration of the base. Shape (points, k). Raises `ArithmeticError`.

    `G` is the modulus at small strain, shape (points,) or (points, bricks).
    """
    level = schedule.level_g * PUBLISHED_G_M_S2
    plate = shaken.plate
    G = np.broadcast_to(G[:, None] if G.ndim == 1 else G, (len(level), len(plate.K_1)))
    q = shaken.displacements(G)
    reference = _reference(plate, q, schedule)
    # What the points of a sweep move by before they soften spans what they move by softer, to 1e-5.
    V = _spanned(plate, q)
    small = _on(shaken, V)
    return _settled(small, G, soft, level, reference) @ V.T


def _reference(plate: ReducedSolid, q: Complex, schedule: Schedule) -> float:
    """The core's rms strain at 1 g where it is largest in the first segment, before it softens."""
    strain = strains(plate, q[schedule.segment == schedule.segment.min()])
    return float(np.sqrt((strain**2) @ plate.volume_m3 / plate.volume_m3.sum()).max()) * PUBLISHED_G_M_S2


def _settled(
    shaken: Shaken, G: Complex, soft: HiddenAmplitudeSoftening, level: Array, reference: float
) -> Complex:
    q = shaken.displacements(G)
    factor = np.ones(G.shape, complex)
    moving = np.arange(len(level))
    for _ in range(_MOST_STEPS):
        goal = soft.factor(strains(shaken.plate, q[moving]) * level[moving, None], reference)
        step = goal - factor[moving]
        factor[moving] += _RELAXED * step
        moving = moving[np.abs(step).max(axis=1) > _SETTLED]
        if not moving.size:
            return q
        q[moving] = shaken.displacements(factor[moving] * G[moving], moving)
    raise ArithmeticError(f"softening k = {soft.k:g} finds no steady state: use a smaller k")


def _spanned(plate: ReducedSolid, q: Complex) -> Array:
    """A basis of these motions, each of unit size. Shape (k, fewer)."""
    R = np.linalg.cholesky(plate.M).T
    moves = R @ q.T
    moves = moves / np.linalg.norm(moves, axis=0)
    u, size, _ = np.linalg.svd(np.hstack([moves.real, moves.imag]), full_matrices=False)
    return np.asarray(np.linalg.solve(R, u[:, size > _SMALLEST * size[0]]))


def _on(shaken: Shaken, V: Array) -> Shaken:
    """The same on the columns of V."""
    p = shaken.plate
    M, K_0, K_1, rubbing = (V.T @ A @ V for A in (p.M, p.K_0, p.K_1, p.rubbing))
    plate = replace(p, M=M, K_0=K_0, K_1=K_1, load=V.T @ p.load, top=p.top @ V, rubbing=rubbing)
    hung = shaken.attached
    attached = None if hung is None else (hung[0] @ V, hung[1], hung[2])
    return Shaken(plate, V.T @ shaken.C_1 @ V, shaken.omega, shaken.motion, attached)


def strains(plate: ReducedSolid, q: Complex) -> Array:
    """Shear strain amplitude of each group of the core by its energy. Shape (points, groups)."""
    flat = plate.K_1.reshape(len(plate.K_1), -1)
    pairs = (q.conj()[:, :, None] * q[:, None, :]).real.reshape(len(q), -1)
    # A brick without core has neither energy nor volume.
    volume = np.where(plate.volume_m3 > 0, plate.volume_m3, 1.0)
    return np.asarray(np.sqrt(np.maximum(pairs @ flat.T / volume, 0.0)))
