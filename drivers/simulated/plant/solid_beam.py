"""A layered beam as a 3D solid: bricks of third order along it, of second across and through each layer.

Half its width, the plane in its middle a plane of symmetry: a base in heave and pitch stirs nothing else. It
shares nothing with the beam that is fitted. Displacements u, v, w along x, y, z; degree of freedom 3 node +
axis, nodes x slow, z fast.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from drivers.arrays import Array
from drivers.simulated.plant.lines import Line

Ends = Literal["clamped-free", "clamped-clamped", "centre-driven"]

PIECES = 20
"""Along the beam, besides the fine ones at a clamp."""
_NEAR_ROOT = (0.4, 1.5)
"""Of the stack's height: where fine pieces end."""


@dataclass(frozen=True)
class Sheet:
    """One layer."""

    thickness_m: float
    young_pa: float
    """Of the core: 2 (1 + nu), which makes its shear modulus one."""
    poisson: float
    density_kg_m3: float
    loss_factor: float = 0.0


@dataclass(frozen=True)
class BeamStated:
    """What the beam is."""

    length_m: float
    """Free length; of both halves where it is driven in its centre."""
    width_m: float
    ends: Ends
    sheets: tuple[Sheet, ...]
    """From below."""
    cores: tuple[int, ...]
    """Which of them are viscoelastic."""
    spot_x_m: float
    """From a clamped end, or from the centre."""

    @property
    def span_m(self) -> float:
        """What vibrates as one piece."""
        return self.length_m / 2 if self.ends == "centre-driven" else self.length_m


class SolidBeam:
    """The unreduced model."""

    def __init__(self, stated: BeamStated, pieces: int = PIECES) -> None:
        self.stated = stated
        heights = np.cumsum([0.0, *(s.thickness_m for s in stated.sheets)])
        L, near = stated.span_m, np.array(_NEAR_ROOT) * heights[-1]
        ends = np.concatenate([np.linspace(0, L, pieces + 1), near[near < L / pieces]])
        if stated.ends == "clamped-clamped":
            ends = np.concatenate([ends, L - near[near < L / pieces]])
        self.x = Line(tuple(np.unique(ends).tolist()), 3)
        half = stated.width_m / 2
        self.y = Line((0.0, half / 2, half), 2)
        self.z = Line(tuple(heights.tolist()), 2)
        # Both halves of the width, and of a beam that is driven in its centre.
        self._times = 4.0 if stated.ends == "centre-driven" else 2.0

    @property
    def shape(self) -> tuple[int, int, int]:
        """Nodes along each axis."""
        return len(self.x.nodes), len(self.y.nodes), len(self.z.nodes)

    def _within(self, sheet: int) -> tuple[float, float]:
        return self.z.ends[sheet], self.z.ends[sheet + 1]

    def stiffness(self, sheet: int) -> sp.csr_array:
        """Of one layer. Shape (size, size)."""
        s, only = self.stated.sheets[sheet], self._within(sheet)
        shear = s.young_pa / (2 * (1 + s.poisson))
        lame = 2 * shear * s.poisson / (1 - 2 * s.poisson)

        def product(i: int, j: int) -> sp.csr_array:
            """Integral of the derivative along i of one and along j of another."""
            a, b, c = ((int(i == axis), int(j == axis)) for axis in range(3))
            plane = sp.kron(self.x.integral(*a), self.y.integral(*b))
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

    @cached_property
    def M(self) -> sp.csr_array:
        """Mass."""
        plane = sp.kron(self.x.integral(0, 0), self.y.integral(0, 0))
        through = sum(
            s.density_kg_m3 * self.z.integral(0, 0, self._within(k)) for k, s in enumerate(self.stated.sheets)
        )
        return (self._times * sp.kron(sp.kron(plane, through), np.eye(3))).tocsr()

    @cached_property
    def rigid(self) -> Array:
        """Heave, and pitch that raises large x. Shape (size, 2)."""
        x, _, z = np.meshgrid(self.x.nodes, self.y.nodes, self.z.nodes, indexing="ij")
        out = np.zeros((3 * x.size, 2))
        out[2::3, 0] = 1.0
        out[2::3, 1], out[0::3, 1] = x.ravel(), -z.ravel()
        return out

    def deflection(self, x_m: float) -> Array:
        """Row that reads w on the middle of the upper face. Shape (size,)."""
        row = np.kron(np.kron(self.x.at(x_m), self.y.at(0.0)), self.z.at(self.z.ends[-1]))
        return np.asarray(np.kron(row, [0.0, 0.0, 1.0]))

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """Degrees of freedom that move. Shape (n,)."""
        nx, ny, nz = self.shape
        held = np.zeros((nx, ny, nz, 3), bool)
        held[0] = True
        if self.stated.ends == "clamped-clamped":
            held[-1] = True
        held[:, 0, :, 1] = True
        return np.flatnonzero(~held.ravel())
