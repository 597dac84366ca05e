"""The plate as a 3D solid: quadratic bricks (27 nodes), one through each layer, finer at clamp and edges.

It shares nothing with the plate model of the fit. `build_plant.py` reduces it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from skfem import Basis, BilinearForm, ElementHex2, ElementVector, MeshHex
from skfem.helpers import ddot, dot, trace

from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.specimen import LAYERS, LENGTH_M, WIDTH_M, Layer
from drivers.simulated.plant.strips import EDGE_STRIP_M, EDGE_STRIPS, debonded

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mesh:
    """Columns of bricks along x and y, the layers through the thickness."""

    elements: tuple[int, int] = (44, 20)
    near_root_m: tuple[float, ...] = (0.5e-3, 1.5e-3, 4e-3)
    near_edge_m: tuple[float, ...] = (1.2e-3, 4e-3)
    strips_x: int = 22
    """Of the core, over the length. They divide the columns."""
    air_panels: tuple[int, int] = (54, 36)
    layers: tuple[Layer, ...] = LAYERS

    @cached_property
    def corners(self) -> tuple[Array, Array, Array]:
        """Element ends along each axis."""
        along_x = np.linspace(0, LENGTH_M, self.elements[0] + 1)
        along_y = np.linspace(0, WIDTH_M, self.elements[1] + 1)
        edge = np.array(self.near_edge_m)
        heights = np.cumsum([0.0, *(layer.thickness_m for layer in self.layers)])
        x = np.unique([*along_x, *self.near_root_m])
        return x, np.unique([*along_y, *edge, *(WIDTH_M - edge)]), heights


def fine(corners: Array) -> Array:
    """Nodes along one axis: ends and middles."""
    return np.sort(np.concatenate([corners, (corners[1:] + corners[:-1]) / 2]))


def nearest(values: Array, wanted: Array) -> NDArray[np.intp]:
    """Index of the nearest of the sorted values."""
    return np.asarray(np.searchsorted((values[1:] + values[:-1]) / 2, wanted))


def interpolation(corners: Array, x: float) -> Array:
    """Quadratic shape functions of all nodes along one axis, at x."""
    e = min(int(np.searchsorted(corners, x, side="right")) - 1, len(corners) - 2)
    s = (x - corners[e]) / (corners[e + 1] - corners[e])
    row = np.zeros(2 * len(corners) - 1)
    row[2 * e : 2 * e + 3] = (1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)
    return row


def line_mass(corners: Array) -> Array:
    """Mass matrix of quadratic shape functions along one axis."""
    local = np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]]) / 30
    out = np.zeros((2 * len(corners) - 1,) * 2)
    for e, h in enumerate(np.diff(corners)):
        out[2 * e : 2 * e + 3, 2 * e : 2 * e + 3] += h * local
    return out


def dissect(x0: int, x1: int, y0: int, y1: int) -> list[tuple[int, int]]:
    """Columns of nodes in nested dissection: both halves, then the line of element ends that parts them."""
    wide = x1 - x0 >= y1 - y0
    low, high = (x0, x1) if wide else (y0, y1)
    cut = (low + high) // 2
    cut += cut % 2
    if high - low <= 4 or not low < cut < high - 1:
        return [(i, j) for i in range(x0, x1) for j in range(y0, y1)]
    if wide:
        return dissect(x0, cut, y0, y1) + dissect(cut + 1, x1, y0, y1) + [(cut, j) for j in range(y0, y1)]
    return dissect(x0, x1, y0, cut) + dissect(x0, x1, cut + 1, y1) + [(i, cut) for i in range(x0, x1)]


def elasticity(layer: Layer, first: tuple[int, ...], second: tuple[int, ...]) -> BilinearForm:
    """Strain energy of derivatives along the axes `first` with those along `second`."""
    shear = layer.young_pa / (2 * (1 + layer.poisson))
    lame = 2 * shear * layer.poisson / (1 - 2 * layer.poisson)

    def only(gradient: Array, axes: tuple[int, ...]) -> Array:
        kept = np.zeros_like(gradient)
        kept[:, list(axes)] = gradient[:, list(axes)]
        return kept

    def energy(u, v, _):  # noqa: ANN001, ANN202
        a, b = only(u.grad, first), only(v.grad, second)
        strain = (a + a.swapaxes(0, 1)) / 2
        return lame * trace(a) * trace(b) + 2 * shear * ddot(strain, b)

    return BilinearForm(energy)


ALL, PLANE, NORMAL = (0, 1, 2), (0, 1), (2,)


class Solid:
    """The unreduced model. Degree of freedom 3 node + axis, nodes x slow, y, z fast."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self.x, self.y, self.z = mesh.corners
        self.nodes = tuple(fine(a) for a in mesh.corners)
        bricks = MeshHex.init_tensor(self.x, self.y, self.z)
        numbering = Basis(bricks, ElementHex2(), intorder=1)
        nx, ny, nz = (nearest(a, d) for a, d in zip(self.nodes, numbering.doflocs, strict=True))
        node = (nx * len(self.nodes[1]) + ny) * len(self.nodes[2]) + nz
        self.dofs = (3 * node[numbering.element_dofs][:, None] + np.arange(3)[:, None]).reshape(81, -1).T
        self.bricks = bricks
        self.middle = bricks.p[:, bricks.t].mean(axis=1)
        self.size = 3 * len(nx)
        layer = nearest((self.z[1:] + self.z[:-1]) / 2, self.middle[2])
        self.of_layer = [np.flatnonzero(layer == k) for k in range(len(mesh.layers))]
        self._assemble_layers()

    def _assemble_layers(self) -> None:
        forms = [elasticity(layer, ALL, ALL) for layer in self.mesh.layers]
        self.K_faces = [self.assemble(self.local(form, k), k) for k, form in enumerate(forms) if k != 1]
        mass = BilinearForm(lambda u, v, _: dot(u, v))
        self.M_layers = [
            layer.density_kg_m3 * self.assemble(self.local(mass, k), k)
            for k, layer in enumerate(self.mesh.layers)
        ]
        if len(self.mesh.layers) > 1:
            core = self.mesh.layers[1]
            parts = ((PLANE, PLANE), (PLANE, NORMAL), (NORMAL, PLANE), (NORMAL, NORMAL))
            local = [self.local(elasticity(core, *axes), 1) for axes in parts]
            self.core_local = (local[0], local[1] + local[2], local[3])

    def local(self, form: BilinearForm, layer: int) -> Array:
        """Element matrices of one layer, each size of brick once. Shape (elements, 81, 81)."""
        elements = self.of_layer[layer]
        sizes = np.round(np.ptp(self.bricks.p[:, self.bricks.t[:, elements]], axis=1) / 1e-9)
        _, first, alike = np.unique(sizes, axis=1, return_index=True, return_inverse=True)
        basis = Basis(self.bricks, ElementVector(ElementHex2()), intorder=4, elements=elements[first])
        return np.asarray(form.elemental(basis).tolocal()[alike.ravel()])

    def assemble(self, local: Array, layer: int) -> sp.csr_array:
        """The whole matrix of one layer's element matrices."""
        dofs = self.dofs[self.of_layer[layer]]
        rows = np.broadcast_to(dofs[:, :, None], local.shape).ravel()
        columns = np.broadcast_to(dofs[:, None, :], local.shape).ravel()
        return sp.coo_array((local.ravel(), (rows, columns)), shape=(self.size, self.size)).tocsr()

    @property
    def strip_of(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Strip of each core element, along x and along y; -1 between the edge strips."""
        x, y, _ = self.middle[:, self.of_layer[1]]
        along_y = (y / EDGE_STRIP_M).astype(np.intp)
        first_upper = round(WIDTH_M / EDGE_STRIP_M) - EDGE_STRIPS
        upper = np.where(along_y >= first_upper, along_y - first_upper + EDGE_STRIPS, -1)
        return (x * self.mesh.strips_x / LENGTH_M).astype(np.intp), np.where(
            along_y < EDGE_STRIPS, along_y, upper
        )

    def core(self, thickness: float = 1.0, factor: Array | float = 1.0) -> sp.csr_array:
        """Stiffness of the core for unit modulus, exact in its thickness (a multiple of nominal)."""
        in_plane, mixed, normal = self.core_local
        local = thickness * in_plane + mixed + normal / thickness
        return self.assemble(local * np.reshape(factor, (-1, 1, 1)), 1)

    @cached_property
    def root(self) -> tuple[sp.csr_array, sp.csr_array]:
        """Springs of unit stiffness per area of the root face, along x and along z."""
        face = sp.coo_array(np.kron(line_mass(self.y), line_mass(self.z)))
        shape = (self.size, self.size)
        first, second = face.row * 3, face.col * 3
        along = [sp.coo_array((face.data, (first + a, second + a)), shape=shape).tocsr() for a in (0, 2)]
        return along[0], along[1]

    def deflection(self, x: float, y: float, top: bool) -> sp.csr_array:
        """Row that reads w at a point of the upper or the lower face."""
        through = np.zeros(len(self.nodes[2]))
        through[-1 if top else 0] = 1
        w = sp.coo_array(np.kron(np.kron(interpolation(self.x, x), interpolation(self.y, y)), through)[None])
        return sp.coo_array((w.data, (w.row, 3 * w.col + 2)), shape=(1, self.size)).tocsr()

    def readings(self, x: Array, y: Array, top: bool) -> sp.csr_array:
        """Rows that read w on a tensor grid, y fast."""
        return sp.vstack([self.deflection(a, b, top) for a in x for b in y]).tocsr()

    @cached_property
    def rigid(self) -> Array:
        """Heave, and pitch about the root's lower edge that raises the tip. Shape (size, 2)."""
        x, _, z = np.meshgrid(*self.nodes, indexing="ij")
        motion = np.zeros((self.size, 2))
        motion[2::3, 0] = 1
        motion[2::3, 1], motion[0::3, 1] = x.ravel(), -z.ravel()
        return motion

    def order(self, rigid_root: bool) -> NDArray[np.intp]:
        """Free degrees of freedom, ordered for factorisation. Along y the root never moves."""
        deep = 3 * len(self.nodes[2])
        columns = np.array(dissect(0, len(self.nodes[0]), 0, len(self.nodes[1])))
        dofs = ((columns[:, :1] * len(self.nodes[1]) + columns[:, 1:]) * deep + np.arange(deep)).ravel()
        at_root = dofs < deep * len(self.nodes[1])
        return dofs[~at_root | (not rigid_root) & (dofs % 3 != 1)]

    def stiffness(self, modulus_pa: complex, effects: Effects) -> sp.csr_array:
        """K with its effects, the core's modulus given."""
        K = sum(self.K_faces[1:], self.K_faces[0])
        if len(self.mesh.layers) > 1:
            thickness = effects.core_thickness.scale if effects.core_thickness else 1.0
            K = K + modulus_pa * self.core(thickness, self.bonded(effects))
        springs = effects.clamp_compliance
        if springs:
            K = K + springs.along_x_n_m3 * self.root[0] + springs.along_z_n_m3 * self.root[1]
        return K

    def bonded(self, effects: Effects) -> Array:
        """Factor on the stiffness of each core element."""
        debond = effects.partial_debond
        if debond is None:
            return np.ones(len(self.of_layer[1]))
        strip = self.strip_of[debond.along == "y"]
        covered = debonded(debond, self.mesh.strips_x)
        return np.asarray(1 - 0.99 * np.where(strip < 0, 0, covered[strip]))

    def mass(self, effects: Effects) -> sp.csr_array:
        """M with its effects but air."""
        thickness = effects.core_thickness.scale if effects.core_thickness else 1.0
        M = sum(m * (thickness if k == 1 else 1) for k, m in enumerate(self.M_layers))
        added = effects.added_mass
        if added:
            w = self.deflection(added.x_m, added.y_m, top=True)
            M = M + added.mass_kg * (w.T @ w)
        return M.tocsr()
