"""The equation of motion solved as it stands, on every degree of freedom: Eq. (3)."""

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.dynamics.damping import LowRankDamping
from fitting.numerics.linear import factorise
from fitting.plate.plate import Plate


def direct_solver(
    A: sp.sparray, omega: float, damping: LowRankDamping
) -> Callable[[Complex | Array], Complex]:
    """Solver of (A + i omega C_1) X = loads, factorised once; A = -omega^2 M + K_0 + G K_1. Loads (n, k).

    C_1 has the rank of a few modes: it enters by the Woodbury identity, the matrix stays sparse.
    """
    solve, U, d = factorise(A.astype(complex)), damping.U, damping.d
    Z = solve(U.astype(complex)) if d.size else U
    small = np.diag(1 / (1j * omega * d)) + U.T @ Z

    def damped(loads: Complex | Array) -> Complex:
        X_0 = solve(loads.astype(complex))
        return np.asarray(X_0 - Z @ np.linalg.solve(small, U.T @ X_0)) if d.size else X_0

    return damped


def solve_direct(A: sp.sparray, omega: float, damping: LowRankDamping, loads: Array) -> Complex:
    """X of (A + i omega C_1) X = loads. Shape of `loads`, (n, k)."""
    return direct_solver(A, omega, damping)(loads)


def displacement_direct(plate: Plate, damping: LowRankDamping, omega: Array, G: Complex) -> Complex:
    """Relative displacement at the pickup for a unit of what drives it, in m. Shape of `omega`."""
    load = plate.load[:, None]
    return np.array(
        [
            plate.pickup @ solve_direct(plate.dynamic_stiffness(w, g), w, damping, load)[:, 0]
            for w, g in zip(omega, G, strict=True)
        ]
    )
