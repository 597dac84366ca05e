"""A disc of rubber in shear as a 3D solid of revolution: one harmonic around its axis, exact in the angle.

    u_r = U(r, z) cos t,   u_t = V(r, z) sin t,   u_z = W(r, z) cos t

The face at z = 0 is bonded to the base, the other to a mass that moves across the axis and neither tilts nor
comes nearer. So the disc shears, bends and bulges at its free edges, and its own inertia is spread over it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from drivers.arrays import Array
from drivers.simulated.plant.lines import Line

POISSON = 0.499
"""Of rubber: a hundred times stiffer in volume than in shape, and still no element locks."""


@dataclass(frozen=True)
class PairStated:
    """Mass and discs of a shear pair that is built as a solid."""

    mass_kg: float
    discs: int
    thickness_m: float
    outer_m: float
    """Diameters of a disc."""
    inner_m: float
    """Zero for a full one."""
    density_kg_m3: float

    @property
    def volume_m3(self) -> float:
        """Volume of all discs together."""
        return self.discs * float(np.pi / 4) * (self.outer_m**2 - self.inner_m**2) * self.thickness_m


class SolidPad:
    """The unreduced discs, all of them; their shear modulus is one."""

    def __init__(self, stated: PairStated, pieces: tuple[int, int] = (8, 6), order: int = 3) -> None:
        self.stated = stated
        low, high = stated.inner_m / 2, stated.outer_m / 2
        r, z = low + (high - low) * _graded(pieces[0]), stated.thickness_m * _graded(pieces[1])
        self.r, self.z = Line(tuple(r.tolist()), order), Line(tuple(z.tolist()), order)

    @property
    def size(self) -> int:
        """Degrees of freedom: U, then V, then W."""
        return 3 * len(self.r.nodes) * len(self.z.nodes)

    @cached_property
    def _weight(self) -> Array:
        r, z = self.r.sampled, self.z.sampled
        return np.asarray(np.kron(np.pi * r.weight * r.x, z.weight) * self.stated.discs)

    def _rows(self, component: int, derive: str = "", over_r: bool = False) -> sp.csr_array:
        """Reads U, V or W, or a derivative of it, at every point."""
        r, z = self.r.sampled, self.z.sampled
        along_r = r.slopes if derive == "r" else r.values
        if over_r:
            along_r = sp.diags_array(1 / r.x) @ along_r
        field = sp.kron(along_r, z.slopes if derive == "z" else z.values)
        place = np.zeros((1, 3))
        place[0, component] = 1.0
        return sp.kron(place, field).tocsr()

    @cached_property
    def K_1(self) -> sp.csr_array:
        """Stiffness for unit shear modulus. Shape (size, size)."""
        U, V, W = 0, 1, 2
        row = self._rows
        stretch = (row(U, "r"), row(U, over_r=True) + row(V, over_r=True), row(W, "z"))
        shear = (
            row(U, "z") + row(W, "r"),
            row(V, "r") - row(U, over_r=True) - row(V, over_r=True),
            row(V, "z") - row(W, over_r=True),
        )
        lame = 2 * POISSON / (1 - 2 * POISSON)
        w = sp.diags_array(self._weight)
        volume = stretch[0] + stretch[1] + stretch[2]
        out = lame * volume.T @ w @ volume
        for e in stretch:
            out = out + 2 * e.T @ w @ e
        for g in shear:
            out = out + g.T @ w @ g
        return out.tocsr()

    @cached_property
    def M(self) -> sp.csr_array:
        """Mass of the discs."""
        w = sp.diags_array(self.stated.density_kg_m3 * self._weight)
        rows = [self._rows(k) for k in range(3)]
        return sum((b.T @ w @ b for b in rows[1:]), rows[0].T @ w @ rows[0]).tocsr()

    @cached_property
    def moves(self) -> sp.csr_array:
        """From what moves to all: first the mass, then every node between the faces. Shape (size, n)."""
        nr, nz = len(self.r.nodes), len(self.z.nodes)
        number = np.arange(self.size).reshape(3, nr, nz)
        inner = number[:, :, 1:-1].ravel()
        rows = np.concatenate([number[0, :, -1], number[1, :, -1], inner])
        columns = np.concatenate([np.zeros(2 * nr, int), 1 + np.arange(len(inner))])
        data = np.concatenate([np.ones(nr), -np.ones(nr), np.ones(len(inner))])
        return sp.coo_array((data, (rows, columns)), shape=(self.size, 1 + len(inner))).tocsr()

    @cached_property
    def rigid(self) -> Array:
        """All discs moving across with the base. Shape (size,)."""
        each = len(self.r.nodes) * len(self.z.nodes)
        return np.concatenate([np.ones(each), -np.ones(each), np.zeros(each)])


def _graded(pieces: int) -> Array:
    """From 0 to 1, much finer at both: where a bonded face ends, stress has no bound. Shape (pieces + 1,)."""
    s = np.linspace(0, 1, pieces + 1)
    for _ in range(2):
        s = (1 - np.cos(np.pi * s)) / 2
    return np.asarray(s)
