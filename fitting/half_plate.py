"""A plate's motions of one parity in y: half as many unknowns, ordered and solved line by line."""

from collections.abc import Callable
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.damping import LowRankDamping
from fitting.element import DOFS
from fitting.linear import Chain, with_damping
from fitting.plate import Plate

Indices = NDArray[np.intp]


class HalfPlate:
    """The plate's matrices on motions even or odd in y, as blocks of `chain`."""

    def __init__(self, plate: Plate, *, odd: bool) -> None:
        whole = plate.odd if odd else plate.even
        line = _lines(plate, whole)
        order = np.argsort(line, kind="stable")
        self.plate = plate
        self.chain = Chain(tuple(np.bincount(line).tolist()))
        self.P = sp.csc_array(whole[:, order])
        """Motions of the plate, orthonormal. Shape (n, half)."""
        self.down = sp.csr_array(self.P.T)
        self.place = np.asarray(np.argsort(order), dtype=np.intp)
        """Of each of the columns of `Plate.even` or `Plate.odd` among those of `P`."""

    def blocks(self, A: sp.sparray) -> NDArray[np.float64] | Complex:
        """A matrix of the plate on these motions. Shape (values,)."""
        return self.chain.blocks(self.down @ A @ self.P)

    @cached_property
    def M(self) -> Array:
        """Mass. Shape (values,)."""
        return np.asarray(self.blocks(self.plate.M))

    @cached_property
    def K_0(self) -> Array | Complex:
        """The faces' stiffness. Shape (values,)."""
        return self.blocks(self.plate.K_0)

    @cached_property
    def K_1(self) -> Array:
        """The core's, for a modulus of one. Shape (values,)."""
        return np.asarray(self.blocks(self.plate.K_1))

    def solver(
        self, omega: float, G: complex, damping: LowRankDamping
    ) -> Callable[[Array | Complex], Complex]:
        """Solver of A X = loads, (half, m), at a frequency and modulus; `damping` is on these motions."""
        A = G * self.K_1
        A += self.K_0
        A.real -= omega**2 * self.M
        return with_damping(self.chain.factorise(A), omega, damping.U, damping.d)


def _lines(plate: Plate, P: sp.csc_array) -> Indices:
    """Of every column of P the line of nodes it lies on, across the plate or along it: short ones."""
    node = plate.free[P.indices[P.indptr[:-1]]] // DOFS
    i, j = np.divmod(node, plate.mesh.n_y + 1)
    across, along = (
        np.unique(line, return_inverse=True)[1] for line in (i, np.minimum(j, plate.mesh.n_y - j))
    )
    return np.asarray(min(across, along, key=lambda line: np.bincount(line).max()), dtype=np.intp)
