"""A plate's motions of one parity in y: half as many unknowns, ordered and solved line by line.

Or all motions that what drives it excites: both parities side by side, or, where the long edges are not
alike, as they are.
"""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Literal

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Indices
from fitting.dynamics.damping import LowRankDamping
from fitting.numerics.linear import Chain, with_damping
from fitting.plate.plate import Plate

Parity = Literal["even", "odd", "carried", "all"]


class HalfPlate:
    """The plate's matrices on motions even or odd in y, what it carries or all, as blocks of `chain`."""

    def __init__(self, plate: Plate, parity: Parity) -> None:
        sides = _sides(plate, parity)
        whole = sp.csc_array(sp.hstack(sides)) if len(sides) > 1 else sides[0]
        line = _chained([_lines(plate, P) for P in sides])
        order = np.argsort(line, kind="stable")
        self.plate = plate
        self.chain = Chain(tuple(np.bincount(line).tolist()))
        self.P = sp.csc_array(whole[:, order])
        """Motions of the plate, orthonormal. Shape (n, half)."""
        self.down = sp.csr_array(self.P.T)
        self.place = np.asarray(np.argsort(order), dtype=np.intp)
        """Of each of the columns of `Plate.even`, `Plate.odd` or `Plate.carried` among those of `P`."""

    def blocks(self, A: sp.sparray) -> NDArray[np.float64] | Complex:
        """A matrix of the plate on these motions. Shape (values,)."""
        return self.chain.blocks(self.down @ A @ self.P)

    @cached_property
    def M(self) -> Array:
        """Mass. Shape (values,)."""
        return np.asarray(self.blocks(self.plate.M))

    @cached_property
    def K_0(self) -> Array | Complex:
        """Stiffness of the faces on this half's motions. Shape (values,)."""
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


def _sides(plate: Plate, parity: Parity) -> tuple[sp.csc_array, ...]:
    if parity == "all":
        return (sp.eye_array(plate.size, format="csc"),)
    if parity == "carried":
        return plate.sides
    return (plate.even,) if parity == "even" else (plate.odd,)


def _chained(each: Sequence[Indices]) -> Indices:
    """Lines of several sets of motions, one after the other: nothing couples the sets."""
    starts = np.cumsum([0, *(line.max() + 1 for line in each)])[:-1]
    return np.concatenate([line + start for line, start in zip(each, starts, strict=True)])


def _lines(plate: Plate, P: sp.csc_array) -> Indices:
    """Of every column of P the line of nodes it lies on, across the plate or along it: short ones."""
    node = plate.free[P.indices[P.indptr[:-1]]] // plate.mesh.dofs
    i, j = np.divmod(node, plate.mesh.n_y + 1)
    mirrored = np.minimum(j, plate.mesh.n_y - j) if P.shape[1] < plate.size else j
    across, along = (np.unique(line, return_inverse=True)[1] for line in (i, mirrored))
    return np.asarray(min(across, along, key=lambda line: np.bincount(line).max()), dtype=np.intp)
