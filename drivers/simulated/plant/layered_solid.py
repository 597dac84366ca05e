"""Layers bonded to each other as one 3D solid on a tensor grid of polynomials.

Displacements u, v, w along x, y, z; degree of freedom 3 node + axis, nodes x slow, z fast.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from drivers.arrays import Array
from drivers.simulated.plant.lines import Line


@dataclass(frozen=True)
class Sheet:
    """One layer."""

    thickness_m: float
    young_pa: float
    """Of the core: 2 (1 + nu), which makes its shear modulus one."""
    poisson: float
    density_kg_m3: float
    loss_factor: float = 0.0


class LayeredSolid:
    """A layered solid with all its degrees of freedom, before it is reduced."""

    def __init__(
        self, sheets: Sequence[Sheet], x: Line, y: Line, *, order: int = 2, times: float = 1.0
    ) -> None:
        """`sheets` from below, of so many `times` what the grid covers; `order` through each of them."""
        self.sheets, self.x, self.y = tuple(sheets), x, y
        heights = np.cumsum([0.0, *(s.thickness_m for s in sheets)])
        self.z = Line(tuple(heights.tolist()), order)
        self._times = times

    @property
    def shape(self) -> tuple[int, int, int]:
        """Nodes along each axis."""
        return len(self.x.nodes), len(self.y.nodes), len(self.z.nodes)

    def _within(self, sheet: int) -> tuple[float, float]:
        return self.z.ends[sheet], self.z.ends[sheet + 1]

    def stiffness(
        self,
        sheet: int,
        only_x: tuple[float, float] | None = None,
        only_y: tuple[float, float] | None = None,
        along_x: Callable[[Array], Array] | None = None,
    ) -> sp.csr_array:
        """Of one layer, or of a part of it that pieces of the grid make up, in m. Shape (size, size).

        `along_x` is a factor on its moduli that varies with x.
        """
        s, only = self.sheets[sheet], self._within(sheet)
        shear = s.young_pa / (2 * (1 + s.poisson))
        lame = 2 * shear * s.poisson / (1 - 2 * s.poisson)

        def product(i: int, j: int) -> sp.csr_array:
            """Integral of the derivative along i of one and along j of another."""
            a, b, c = ((int(i == axis), int(j == axis)) for axis in range(3))
            plane = sp.kron(self.x.integral(*a, only_x, along_x), self.y.integral(*b, only_y))
            return sp.kron(plane, self.z.integral(*c, only)).tocsr()

        laplace = shear * (product(0, 0) + product(1, 1) + product(2, 2))
        out = sp.csr_array((3 * laplace.shape[0],) * 2)
        for i in range(3):
            for j in range(3):
                part = lame * product(i, j) + shear * product(j, i)
                place = np.zeros((3, 3))
                place[i, j] = 1.0
                out = out + sp.kron(part + laplace if i == j else part, place)
        return (self._times * out).tocsr()

    def turned(self, sheet: int) -> sp.csr_array:
        """What a unit of stress along x in a layer adds to its stiffness. Shape (size, size).

        Integral of u_x^2 + v_x^2 + w_x^2: the second-order part of its strain along x.
        """
        plane = sp.kron(self.x.integral(1, 1), self.y.integral(0, 0))
        through = self.z.integral(0, 0, self._within(sheet))
        return (self._times * sp.kron(sp.kron(plane, through), np.eye(3))).tocsr()

    @cached_property
    def M(self) -> sp.csr_array:
        """Mass."""
        across, parts = self.y.integral(0, 0), []
        for k, s in enumerate(self.sheets):
            plane = sp.kron(self.x.integral(0, 0, None, self.there(k)), across)
            parts.append(s.density_kg_m3 * sp.kron(plane, self.z.integral(0, 0, self._within(k))))
        return (self._times * sp.kron(sum(parts[1:], parts[0]), np.eye(3))).tocsr()

    def there(self, sheet: int) -> Callable[[Array], Array] | None:
        """How much of a layer is there, a function of x, shape of x; None: all of it."""
        return None

    @cached_property
    def rigid(self) -> Array:
        """Heave, and pitch that raises large x. Shape (size, 2)."""
        x, _, z = np.meshgrid(self.x.nodes, self.y.nodes, self.z.nodes, indexing="ij")
        out = np.zeros((3 * x.size, 2))
        out[2::3, 0] = 1.0
        out[2::3, 1], out[0::3, 1] = x.ravel(), -z.ravel()
        return out

    def row(self, x_m: float, y_m: float, axis: int = 2, *, below: bool = False) -> Array:
        """Reads w, or u or v by `axis`, at a place of the upper face, or of the lower. Shape (size,)."""
        height = self.z.ends[0 if below else -1]
        row = np.kron(np.kron(self.x.at(x_m), self.y.at(y_m)), self.z.at(height))
        return np.asarray(np.kron(row, np.eye(3)[axis]))
