"""The remaining equivalent viscous damping C_1, from measured modal ratios: Eq. (11)."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fitting.arrays import Array
from fitting.dynamics.real_modes import RealModes, real_modes
from fitting.plate.element import W
from fitting.plate.plate import Plate

REFERENCE_MODULUS_PA = 0.5e6
"""The core modulus whose real modes carry the ratios. 0.3 to 1 MPa moves peak 1 by 0.5 %."""
_SPARE = 3
"""Modes beyond the stated ratios' among which their shapes are looked for."""


@dataclass(frozen=True)
class LowRankDamping:
    """C_1 = U diag(d) U^T, constant and real, of rank `len(d)`."""

    U: Array
    """M Phi. Shape (n, modes)."""
    d: Array
    """2 zeta_r omega_r in rad/s. Shape (modes,)."""
    mode: NDArray[np.intp]
    """Which of the stated ratios each has, from 0. Shape (modes,)."""

    def projected(self, P: sp.csc_array) -> "LowRankDamping":
        """The same damping in the subspace of P, modes outside it dropped."""
        U = np.asarray(P.T @ self.U)
        inside = np.linalg.norm(U, axis=0) > 1e-6 * np.linalg.norm(self.U, axis=0)
        return LowRankDamping(U[:, inside], self.d[inside], self.mode[inside])


def viscous_damping(plate: Plate) -> LowRankDamping:
    """C_1 = M Phi diag(2 zeta_r omega_r) Phi^T M, each ratio with the mode that has its bare mode's shape."""
    ratios = np.array(plate.specimen.modal_ratios)
    if not ratios.any():
        return LowRankDamping(np.empty((plate.size, 0)), np.empty(0), np.empty(0, dtype=np.intp))
    modes = real_modes(plate, REFERENCE_MODULUS_PA, len(ratios) + _SPARE)
    damped = np.flatnonzero(ratios)
    its = paired_modes(plate, modes, len(ratios))[damped]
    return LowRankDamping(plate.M @ modes.shapes[:, its], 2 * ratios[damped] * modes.omega[its], damped)


def paired_modes(plate: Plate, modes: RealModes, count: int) -> NDArray[np.intp]:
    """Which of the plate's modes is shaped as each of the bare plate's first `count`. Shape (count,).

    By the modal assurance criterion of deflections: a treatment may change the order of modes.
    """
    if plate.specimen.core is None:
        return np.arange(count)
    bare = Plate(plate.specimen.bare)
    treated, stated = (
        w / np.linalg.norm(w, axis=0)
        for w in (
            plate.on_nodes(modes.shapes)[:, W],
            bare.on_nodes(real_modes(bare, 0.0, count).shapes)[:, W],
        )
    )
    return np.asarray(linear_sum_assignment(-((stated.T @ treated) ** 2))[1])
