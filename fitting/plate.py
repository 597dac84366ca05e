"""The plate: mesh, boundary and the affine matrices of the equation of motion.

    (-omega^2 M + i omega C_1 + K_0 + G*(omega) K_1) X = -M r a        Eq. (3) to (5), (18)

K_0 holds the faces, K_1 the core for unit modulus: G* stays outside. Assembled once a specimen.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting import element
from fitting.arrays import Array
from fitting.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.errors import OutsideModel
from fitting.specimen import Specimen

Indices = NDArray[np.intp]

_STILL = 1e-9
"""A reading row below this reads nothing but rounding."""
EDGE_WIDTH = 0.63 / 2
"""Of the thickness: so wide a strip carries no twist at a free edge (decision 13). In `K_0` where motions
odd in y take part, which twist the plate."""
_SUPPORTED = {"x": (V_C, V_B, W, THETA_X), "y": (U_C, U_B, W, THETA_Y)}
"""What a simple support holds of the nodes on an edge of constant x or y."""
_RIGID = 1e-9
"""Share of a rigid motion at held degrees of freedom, below which it is not held."""


@dataclass(frozen=True)
class Mesh:
    """A regular grid of elements; node (i, j) has number i (n_y + 1) + j."""

    length_m: float
    width_m: float
    n_x: int
    n_y: int

    @property
    def nodes(self) -> int:
        """How many nodes there are."""
        return (self.n_x + 1) * (self.n_y + 1)

    @property
    def sides_m(self) -> tuple[float, float]:
        """Sides of an element."""
        return self.length_m / self.n_x, self.width_m / self.n_y

    def element_dofs(self) -> Indices:
        """Degrees of freedom of every element, corners in the element's order. Shape (elements, 28)."""
        i, j = np.meshgrid(np.arange(self.n_x), np.arange(self.n_y), indexing="ij")
        stride = self.n_y + 1
        corners = [(i + int(cx)) * stride + j + int(cy) for cx, cy in element.CORNERS]
        nodes = np.stack([c.ravel() for c in corners], axis=1)
        dofs = nodes[:, :, None] * DOFS + np.arange(DOFS)
        return np.asarray(dofs.reshape(len(nodes), -1), dtype=np.intp)

    def node_positions(self) -> Array:
        """Positions (x, y) of every node in m. Shape (nodes, 2)."""
        x, y = np.meshgrid(
            np.linspace(0, self.length_m, self.n_x + 1),
            np.linspace(0, self.width_m, self.n_y + 1),
            indexing="ij",
        )
        return np.stack([x.ravel(), y.ravel()], axis=1)


@dataclass(frozen=True)
class ElementMatrices:
    """Matrices of one element, shape (28, 28); all elements of the regular mesh are alike."""

    M: Array
    K_substrate: Array
    K_constraining: Array
    K_1: Array

    @property
    def K_0(self) -> Array:
        """Both faces, loss factors left out."""
        return self.K_substrate + self.K_constraining


def element_matrices(specimen: Specimen, mesh: Mesh) -> ElementMatrices:
    """The element of a specimen; the treatment's parts are zero for a bare plate."""
    s, shape = specimen, element.Shape(*mesh.sides_m)
    M = element.face_mass(shape, s.substrate, U_B, V_B)
    K_b = element.face_stiffness(shape, s.substrate, U_B, V_B)
    K_c, K_v = np.zeros_like(K_b), np.zeros_like(K_b)
    if s.core is not None and s.constraining is not None:
        M = M + element.face_mass(shape, s.constraining, U_C, V_C)
        M = M + element.core_mass(shape, s.core, s.substrate, s.constraining)
        K_c = element.face_stiffness(shape, s.constraining, U_C, V_C)
        K_v = element.core_stiffness(shape, s.core, s.substrate, s.constraining)
    return ElementMatrices(M, K_b, K_c, K_v)


class Plate:
    """The assembled specimen, held degrees of freedom removed.

    Attributes
    ----------
    M, K_substrate, K_constraining, K_1 : sparse (n, n), real symmetric
        Mass in kg; stiffness in N/m, the core's for G* = 1 Pa.
    K_0 : sparse (n, n)
        The faces' stiffness, complex where a face has a loss factor.
    free : (n,)
        Which of all nodes' degrees of freedom are free.
    """

    def __init__(self, specimen: Specimen) -> None:
        self.specimen = specimen
        self.mesh = Mesh(specimen.length_m, specimen.width_m, *specimen.mesh)
        self.free = np.flatnonzero(~self._held())
        self._assemble()

    @property
    def size(self) -> int:
        """How many degrees of freedom are free."""
        return len(self.free)

    def _held(self) -> NDArray[np.bool_]:
        held = np.zeros((self.mesh.nodes, DOFS), dtype=bool)
        x, y = self.mesh.node_positions().T
        if self.specimen.core is None:
            held[:, [U_C, V_C]] = True
        nodes = (x == 0, y == 0, x == self.mesh.length_m, y == self.mesh.width_m)
        for edge, on, constant in zip(self.specimen.edges, nodes, ("x", "y", "x", "y"), strict=True):
            if edge == "clamped":
                held[on] = True
            elif edge == "simply-supported":
                held[np.ix_(on, _SUPPORTED[constant])] = True
        return held.ravel()

    @cached_property
    def rigid(self) -> Array:
        """Motions that strain nothing and are not held, at most six. Shape (n, motions)."""
        s = self.specimen
        x, y = (self.mesh.node_positions() / max(s.length_m, s.width_m)).T
        apart = 0.0
        if s.core is not None and s.constraining is not None:
            apart = s.core.thickness_m + (s.substrate.thickness_m + s.constraining.thickness_m) / 2
        # Turns are scaled to the size of the plate; the upper face turns about the substrate's middle.
        slope = 1 / max(s.length_m, s.width_m)
        one = np.ones_like(x)
        motions: list[dict[int, Array]] = [
            {U_B: one, U_C: one},
            {V_B: one, V_C: one},
            {U_B: -y, U_C: -y, V_B: x, V_C: x},
            {W: one},
            {W: x, THETA_Y: -slope * one, U_C: -apart * slope * one},
            {W: y, THETA_X: slope * one, V_C: -apart * slope * one},
        ]
        R = np.zeros((self.mesh.nodes, DOFS, len(motions)))
        for k, motion in enumerate(motions):
            for dof, values in motion.items():
                R[:, dof, k] = values
        if s.core is None:
            R[:, [U_C, V_C]] = 0.0
        each = R.reshape(-1, len(motions))
        held = np.delete(each, self.free, axis=0)
        values, vectors = np.linalg.eigh(held.T @ held)
        return each[self.free] @ vectors[:, values < _RIGID * max(1.0, values[-1])]

    def _assemble(self) -> None:
        s, e = self.specimen, element_matrices(self.specimen, self.mesh)
        self.M, self.K_substrate, self.K_constraining, self.K_1 = (
            self.scatter(Ae) for Ae in (e.M, e.K_substrate, e.K_constraining, e.K_1)
        )
        loss_b = s.substrate.loss_factor
        loss_c = s.constraining.loss_factor if s.constraining is not None else 0.0
        faces = self.K_substrate + self.K_constraining
        if loss_b or loss_c:
            faces = faces + 1j * (loss_b * self.K_substrate + loss_c * self.K_constraining)
        if not s.only_even:
            faces = faces - self.edge_twist
        self.K_0 = faces.tocsc()

    @cached_property
    def edge_twist(self) -> sp.csr_array:
        """Stiffness that the faces' free edges lack in twist, `EDGE_WIDTH` of it. Shape (n, n).

        2 E h^3 / (12 (1 + nu)) int kappa_xy^2 ds over a width of `EDGE_WIDTH` h, at each free edge.
        """
        s, mesh = self.specimen, self.mesh
        node = np.arange(mesh.nodes).reshape(mesh.n_x + 1, mesh.n_y + 1)
        a, b = mesh.sides_m
        along = (
            (node[0], THETA_Y, b),
            (node[:, 0], THETA_X, a),
            (node[-1], THETA_Y, b),
            (node[:, -1], THETA_X, a),
        )
        found = sp.csr_array((mesh.nodes * DOFS,) * 2)
        faces = [face for face in (s.substrate, s.constraining) if face is not None]
        lacking = sum(
            2 * EDGE_WIDTH * f.thickness_m * f.young_pa * f.thickness_m**3 / (12 * (1 + f.poisson))
            for f in faces
        )
        for edge, (nodes, dof, step) in zip(s.edges, along, strict=True):
            if edge == "free":
                slope = sp.csr_array(
                    (np.ones(len(nodes)), (np.arange(len(nodes)), nodes * DOFS + dof)),
                    shape=(len(nodes), mesh.nodes * DOFS),
                )
                turn = slope[1:] - slope[:-1]
                found = found + lacking / step * (turn.T @ turn)
        return sp.csr_array(found[self.free][:, self.free])

    def scatter(self, Ae: Array, elements: NDArray[np.intp] | slice = slice(None)) -> sp.csc_array:
        """An element's matrix (28, 28) assembled over some elements. Shape (n, n)."""
        dofs = self.mesh.element_dofs()[elements]
        rows = np.repeat(dofs, dofs.shape[1], axis=1).ravel()
        columns = np.tile(dofs, (1, dofs.shape[1])).ravel()
        n = self.mesh.nodes * DOFS
        full = sp.coo_array((np.tile(Ae.ravel(), len(dofs)), (rows, columns)), shape=(n, n)).tocsr()
        if len(self.free) < n:
            full = full[self.free][:, self.free]
        return full.tocsc()

    def dynamic_stiffness(self, omega: float, G: complex) -> sp.csc_array:
        """A = -omega^2 M + K_0 + G K_1, the viscous damping left out. Shape (n, n)."""
        return sp.csc_array(self.K_0 + G * self.K_1 - omega**2 * self.M)

    @cached_property
    def base_load(self) -> Array:
        """-M r: the load of a unit base acceleration along +w, Eq. (5). Shape (n,).

        Raises `OutsideModel` for a free plate.
        """
        if self.specimen.boundary == "free":
            raise OutsideModel("a free plate has no base to be excited by, expected another boundary")
        r = np.zeros((self.mesh.nodes, DOFS))
        r[:, W] = 1.0
        # The held nodes move with the base too: their inertia couples to their neighbours.
        dofs = self.mesh.element_dofs()
        inertia = np.zeros(self.mesh.nodes * DOFS)
        np.add.at(inertia, dofs, r.ravel()[dofs] @ element_matrices(self.specimen, self.mesh).M)
        return -inertia[self.free]

    @cached_property
    def load(self) -> Array:
        """Of a unit of what drives it: base acceleration in m/s^2, or a force in N. Shape (n,).

        Raises `OutsideModel` for a force on a held edge.
        """
        force_m = self.specimen.force_m
        if force_m is None:
            return self.base_load
        row = self.observe(*force_m)
        if np.abs(row).max() < _STILL:
            x, y = (1e3 * v for v in force_m)
            raise OutsideModel(f"force at ({x:g}, {y:g}) mm acts on a held edge, expected a point that moves")
        return row

    def on_nodes(self, V: Array) -> Array:
        """Vectors over the free degrees of freedom, node by node, held ones zero. Shape (nodes, 7, k)."""
        full = np.zeros((self.mesh.nodes * DOFS, V.shape[1]))
        full[self.free] = V
        return full.reshape(self.mesh.nodes, DOFS, -1)

    def on_elements(self, V: Array) -> Array:
        """Vectors over the free degrees of freedom, gathered element by element. Shape (elements, 28, k)."""
        full = self.on_nodes(V).reshape(-1, V.shape[1])
        return np.asarray(full[self.mesh.element_dofs()])

    @cached_property
    def even(self) -> sp.csc_array:
        """P, orthonormal: motions even in y, all that a base excites where the long edges are alike.

        Shape (n, about n/2).
        """
        return self._of_parity(1.0)

    @cached_property
    def odd(self) -> sp.csc_array:
        """P, orthonormal: motions odd in y. Shape (n, about n/2)."""
        return self._of_parity(-1.0)

    @cached_property
    def carried(self) -> sp.csc_array:
        """P, orthonormal: the motions that what drives it can excite. Shape (n, any)."""
        return sp.csc_array(sp.hstack(self.sides))

    @property
    def sides(self) -> tuple[sp.csc_array, ...]:
        """Of `carried`, motions that do not couple: of one parity where the long edges are alike."""
        if self.specimen.only_even:
            return (self.even,)
        at_y0, at_width = self.specimen.edges[1::2]
        return (self.even, self.odd) if at_y0 == at_width else (sp.eye_array(self.size, format="csc"),)

    def _of_parity(self, parity: float) -> sp.csc_array:
        # In an even motion u_b, u_c, w and theta_y repeat at the mirrored node, v_b, v_c and theta_x turn.
        node = np.arange(self.mesh.nodes)
        i, j = np.divmod(node, self.mesh.n_y + 1)
        mirror = i * (self.mesh.n_y + 1) + self.mesh.n_y - j
        sign = np.full(DOFS, parity)
        sign[[V_C, V_B, THETA_X]] *= -1
        kept = np.repeat(node <= mirror, DOFS)
        twin = (mirror[:, None] * DOFS + np.arange(DOFS)).ravel()[kept]
        signs = np.tile(sign, self.mesh.nodes)[kept]
        column = np.arange(len(twin))
        shape = (self.mesh.nodes * DOFS, len(twin))
        P = sp.coo_array((np.ones(len(twin)), (np.flatnonzero(kept), column)), shape)
        P = (P + sp.coo_array((signs, (twin, column)), shape)).tocsr()[self.free]
        norm = np.sqrt(np.asarray((P * P).sum(axis=0)))
        moving = norm > 0
        return sp.csc_array(P.tocsc()[:, moving] @ sp.diags_array(1 / norm[moving]))

    @cached_property
    def pickup(self) -> Array:
        """The row that reads w at the specimen's pickup. Shape (n,).

        Raises `OutsideModel` without a pickup, off the plate, and on a held edge where the reading is
        relative.
        """
        if self.specimen.pickup_m is None:
            raise OutsideModel("[pickup] is missing, expected x_mm and y_mm of the measured spot")
        row = self.observe(*self.specimen.pickup_m)
        if self.specimen.reads == "relative" and np.abs(row).max() < _STILL:
            x, y = (1e3 * v for v in self.specimen.pickup_m)
            raise OutsideModel(f"pickup ({x:g}, {y:g}) mm lies on a held edge, expected a point that moves")
        return row

    def observe(self, x_m: float, y_m: float) -> Array:
        """The row that reads w at a point, by the shape functions; a unit force there too. Shape (n,).

        Raises `OutsideModel` for a point off the plate.
        """
        L, B = self.mesh.length_m, self.mesh.width_m
        if not (0 <= x_m <= L and 0 <= y_m <= B):
            raise OutsideModel(
                f"point ({x_m * 1e3:g}, {y_m * 1e3:g}) mm is off the plate, "
                f"expected 0 to {L * 1e3:g} mm and 0 to {B * 1e3:g} mm"
            )
        a, b = self.mesh.sides_m
        i = min(int(x_m / a), self.mesh.n_x - 1)
        j = min(int(y_m / b), self.mesh.n_y - 1)
        row = np.zeros(self.mesh.nodes * DOFS)
        dofs = self.mesh.element_dofs()[i * self.mesh.n_y + j]
        row[dofs] = element.Shape(a, b).deflection(x_m - i * a, y_m - j * b)
        return row[self.free]
