"""A plate as a 3D solid: quadratic bricks, one through each layer, finer at clamp and long edges.

It shares nothing with the plate model of the fit. Degree of freedom 3 node + axis, nodes x slow, y, z fast.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import SuperLU, splu

from campaign.plates import brick
from campaign.plates.geometry import TruePlate
from campaign.plates.grid import Fineness, dissected, grid_of, interpolation, line_mass
from fitting.arrays import Array

Field = Callable[[Array, Array], Array]
"""A factor over the plate, of x and y in m, broadcast."""

_GAUSS = (np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)]), np.array([5, 8, 5]) / 18)


@dataclass(frozen=True)
class RootSprings:
    """Springs between the root face and the base, per area, over y. Along y the root stays rigid."""

    along_x_n_m3: Callable[[Array], Array]
    along_z_n_m3: Callable[[Array], Array]
    loss: float = 0.0
    """Imaginary part over the real one."""


@dataclass(frozen=True)
class Patch:
    """A mass spread over a small square of the upper face."""

    mass_kg: float
    x_m: float
    y_m: float
    side_m: float


@dataclass(frozen=True)
class Build:
    """What the solid has that the clean plate has not."""

    substrate_factor: Field | None = None
    """On the stiffness, brick by brick (mean over the brick); likewise below."""
    core_factor: Field | None = None
    constraining_factor: Field | None = None
    whole_factor: Field | None = None
    """On stiffness and mass of all layers."""
    root: RootSprings | None = None
    """None: the root does not move."""
    free: bool = False
    """No edge is held, the root neither."""
    treatment_from_m: float | None = None
    """None: core and constraining layer are gripped with the substrate. Else they begin here, free."""
    patches: tuple[Patch, ...] = ()
    lines_x_m: tuple[float, ...] = ()
    """Where bricks shall end."""
    lines_y_m: tuple[float, ...] = ()


class Solid:
    """The unreduced model of one plate as built."""

    def __init__(
        self, plate: TruePlate, build: Build | None = None, fineness: Fineness | None = None
    ) -> None:
        self.plate, self.build = plate, build or Build()
        begin = self.build.treatment_from_m
        lines_x = np.array([*self.build.lines_x_m, *([begin] if begin else [])])
        lines_y = np.array(self.build.lines_y_m)
        self.grid = grid_of(plate, fineness or Fineness(), lines_x, lines_y)
        self.nodes = self.grid.nodes
        self.counts = tuple(len(axis) for axis in self.nodes)
        self.size = 3 * self.counts[0] * self.counts[1] * self.counts[2]

    def dofs(self, layer: int) -> NDArray[np.intp]:
        """Of every brick of a layer, x slow. Shape (bricks, 81)."""
        nx, ny = len(self.grid.x) - 1, len(self.grid.y) - 1
        p, q, r = np.arange(3)[:, None, None], np.arange(3)[:, None], np.arange(3)
        first = 2 * np.arange(nx)[:, None, None, None, None] + p
        second = 2 * np.arange(ny)[:, None, None, None] + q
        node = (first * self.counts[1] + second) * self.counts[2] + 2 * layer + r
        return np.asarray((3 * node[..., None] + np.arange(3)).reshape(nx * ny, 81))

    def mean(self, factor: Field | None) -> Array:
        """Of a factor over each brick, seen from above. Shape (columns x, columns y)."""
        x, y = self.grid.x, self.grid.y
        if factor is None:
            return np.ones((len(x) - 1, len(y) - 1))
        at, weight = _GAUSS
        gx = (x[:-1, None] + np.diff(x)[:, None] * at)[:, None, :, None]
        gy = (y[:-1, None] + np.diff(y)[:, None] * at)[:, None, :]
        values = np.broadcast_to(factor(gx, gy), (len(x) - 1, len(y) - 1, 3, 3))
        return np.einsum("xypq,p,q->xy", values, weight, weight)

    @cached_property
    def treated(self) -> Array:
        """One where there is core and constraining layer, by brick. Shape (columns x, columns y)."""
        begin = self.build.treatment_from_m or 0.0
        return np.outer(self.grid.middles[0] > begin, np.ones(len(self.grid.y) - 1))

    def _assembled(self, local: Array, layer: int) -> sp.csr_array:
        dofs = self.dofs(layer)
        local = local.reshape(len(dofs), 81, 81)
        rows = np.broadcast_to(dofs[:, :, None], local.shape).ravel()
        columns = np.broadcast_to(dofs[:, None, :], local.shape).ravel()
        return sp.coo_array((local.ravel(), (rows, columns)), shape=(self.size, self.size)).tocsr()

    def _bricks(self, layer: int, C: Array, factor: Field | None) -> Array:
        shares = self.mean(factor) * self.mean(self.build.whole_factor) * (self.treated if layer else 1.0)
        local = brick.stiffness(self.grid.x, self.grid.y, self.plate.heights_m[layer], C)
        return np.asarray(local * shares[:, :, None, None])

    @cached_property
    def core_bricks(self) -> Array:
        """Stiffness of every brick of the core for unit shear modulus. Shape (bricks, 81, 81)."""
        assert self.plate.core is not None
        local = self._bricks(1, brick.unit_core(self.plate.core.poisson), self.build.core_factor)
        return local.reshape(-1, 81, 81)

    @cached_property
    def K_1(self) -> sp.csr_array:
        """Of the core for unit shear modulus."""
        return self._assembled(self.core_bricks, 1)

    def core_with(self, factor: Field) -> sp.csr_array:
        """Of the core for a modulus that varies over the plate."""
        return self._assembled(self.core_bricks * self.mean(factor).reshape(-1, 1, 1), 1)

    @cached_property
    def K_0(self) -> sp.csr_array:
        """Of the faces and the clamp."""
        s, c = self.plate.substrate, self.plate.constraining
        C = brick.metal(s.young_pa, s.poisson, s.rolled)
        K = self._assembled(self._bricks(0, C, self.build.substrate_factor), 0)
        if c is not None:
            C = brick.metal(c.young_pa, c.poisson, c.rolled)
            K = K + self._assembled(self._bricks(2, C, self.build.constraining_factor), 2)
        if self.build.root is not None:
            K = K + self._root(self.build.root)
        return K.tocsr()

    @cached_property
    def rubbing(self) -> sp.csr_array:
        """Imaginary part of the root's springs. Shape (size, size)."""
        root = self.build.root
        return sp.csr_array((self.size, self.size)) if root is None else root.loss * self._root(root)

    def _root(self, springs: RootSprings) -> sp.csr_array:
        z = self.grid.z if self.build.treatment_from_m is None else self.grid.z[:2]
        through = np.zeros((self.counts[2],) * 2)
        part = line_mass(z)
        through[: len(part), : len(part)] = part
        at, weight = _GAUSS
        places = self.grid.y[:-1, None] + np.diff(self.grid.y)[:, None] * at
        out = sp.csr_array((self.size, self.size))
        for axis, along in ((0, springs.along_x_n_m3), (2, springs.along_z_n_m3)):
            # A bolt may be narrower than a brick: its share is kept, its place to within the brick.
            face = sp.coo_array(np.kron(line_mass(self.grid.y, along(places) @ weight), through))
            place = (3 * face.row + axis, 3 * face.col + axis)
            out = out + sp.coo_array((face.data, place), shape=out.shape).tocsr()
        return out

    @cached_property
    def M(self) -> sp.csr_array:
        """Mass."""
        layers = (self.plate.substrate, self.plate.core, self.plate.constraining)
        out = sp.csr_array((self.size, self.size))
        for k, layer in enumerate(layers):
            if layer is None:
                continue
            local = brick.mass(self.grid.x, self.grid.y, layer.thickness_m, layer.density_kg_m3)
            there = self.mean(self.build.whole_factor) * (self.treated if k else 1.0)
            out = out + self._assembled(local * there[..., None, None], k)
        for patch in self.build.patches:
            out = out + self._patch(patch)
        return out.tocsr()

    def _patch(self, patch: Patch) -> sp.csr_array:
        at, weight = _GAUSS
        half = patch.side_m / 2
        x = np.clip(patch.x_m + 2 * half * (at - 0.5), 0, self.plate.length_m)
        y = np.clip(patch.y_m + 2 * half * (at - 0.5), 0, self.plate.width_m)
        out = sp.csr_array((self.size, self.size))
        for a, wa in zip(x, weight, strict=True):
            for b, wb in zip(y, weight, strict=True):
                for axis in range(3):
                    row = self.displacement(float(a), float(b), axis)
                    out = out + patch.mass_kg * wa * wb * (row.T @ row)
        return out

    def displacement(self, x_m: float, y_m: float, axis: int = 2, top: bool = True) -> sp.csr_array:
        """Row that reads the motion of a point of the upper or the lower face."""
        through = np.zeros(self.counts[2])
        through[-1 if top else 0] = 1
        plane = np.kron(interpolation(self.grid.x, x_m), interpolation(self.grid.y, y_m))
        w = sp.coo_array(np.kron(plane, through)[None])
        return sp.coo_array((w.data, (w.row, 3 * w.col + axis)), shape=(1, self.size)).tocsr()

    def face(self, V: Array, top: bool = True) -> Array:
        """Deflection of a face's nodes under motions V (size, k). Shape (nodes x, nodes y, k)."""
        whole = V.reshape(*self.counts, 3, -1)
        return np.asarray(whole[:, :, -1 if top else 0, 2])

    @cached_property
    def rigid(self) -> Array:
        """Heave of the base; pitch that raises the tip; roll that raises large y. Shape (size, 3)."""
        x, y, z = np.meshgrid(*self.nodes, indexing="ij")
        motion = np.zeros((self.size, 3))
        motion[2::3, 0] = 1
        motion[2::3, 1], motion[0::3, 1] = x.ravel(), -z.ravel()
        motion[2::3, 2], motion[1::3, 2] = y.ravel() - self.plate.width_m / 2, -z.ravel()
        return motion

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """Degrees of freedom that move, ordered for factorisation. Shape (n,)."""
        nx, ny, nz = self.counts
        columns = dissected(nx, ny)
        i, k = columns[:, 0][:, None, None], np.arange(nz)[:, None]
        dof = 3 * ((i * ny + columns[:, 1][:, None, None]) * nz + k) + np.arange(3)
        # Rigid, or sprung along x and z.
        held = (i == 0) & ((self.build.root is None) | (np.arange(3) == 1)) & (k >= 0) & (not self.build.free)
        begin = self.build.treatment_from_m
        if begin is not None:
            above = k > 2
            held = held & ~above | above & (self.nodes[0][i] < begin - 1e-12)
        return np.asarray(dof[~held])


def factorised(K: sp.csr_array) -> SuperLU:
    """LU without pivoting, in the order given."""
    options = {"SymmetricMode": True}
    return splu(K.tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options)
