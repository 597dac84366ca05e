"""The plate: mesh, boundary and the affine matrices of the equation of motion.

    (-omega^2 M + i omega C_1 + K_0 + G*(omega) K_1) X = -M r a        Eq. (3) to (5), (18)

K_0 holds the faces, K_1 the core for unit modulus: G* stays outside. Assembled once a specimen.
"""

from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.errors import OutsideModel
from fitting.plate.edge_twist import EdgeTwist
from fitting.plate.element import G_X, G_Y, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.plate.element_matrices import element_matrices
from fitting.plate.face_shear import edge_twist_left
from fitting.plate.mesh import cells_of, mesh_of, treated_nodes
from fitting.specimen import PlateSpecimen

_STILL = 1e-9
"""A reading row below this reads nothing but rounding."""
_SUPPORTED = {"x": (V_C, V_B, W, THETA_X, G_Y), "y": (U_C, U_B, W, THETA_Y, G_X)}
"""What a simple support holds of the nodes on an edge of constant x or y."""
_WHOLE = 1e-9
"""Share of the area that may be bare of a plate treated all over: rounding."""
_RIGID = 1e-9
"""Share of a rigid motion at held degrees of freedom, below which it is not held."""


class Plate:
    """The assembled specimen, held degrees of freedom removed.

    Attributes
    ----------
    M, K_substrate, K_constraining, K_1 : sparse (n, n), real symmetric
        Mass in kg; stiffness in N/m, the core's for G* = 1 Pa.
    K_0 : sparse (n, n)
        The faces' stiffness and the glue's, complex where they have a loss factor.
    free : (n,)
        Which of all nodes' degrees of freedom are free.
    """

    def __init__(self, specimen: PlateSpecimen) -> None:
        self.specimen = specimen
        self.mesh = mesh_of(specimen)
        self.cells = cells_of(specimen, self.mesh)
        self.free = np.flatnonzero(~self._held())
        self._assemble()

    @property
    def size(self) -> int:
        """How many degrees of freedom are free."""
        return len(self.free)

    @cached_property
    def _missing(self) -> NDArray[np.bool_]:
        """Motions that nothing has: of a layer that is missing, or does not stretch. Shape (nodes, dofs)."""
        s, found = self.specimen, np.zeros((self.mesh.nodes, self.mesh.dofs), dtype=bool)
        if s.core is None:
            found[:, [U_C, V_C]] = True
        if s.both_sides:
            found[:, [U_B, V_B]] = True
        if s.patches:
            bare = np.flatnonzero(~treated_nodes(s, self.mesh))
            found[bare[:, None], [U_C, V_C, *range(G_X, self.mesh.dofs)]] = True
        return found

    def _held(self) -> NDArray[np.bool_]:
        held = self._missing.copy()
        x, y = self.mesh.node_positions().T
        nodes = (x == 0, y == 0, x == self.mesh.length_m, y == self.mesh.width_m)
        for edge, on, constant in zip(self.specimen.edges, nodes, ("x", "y", "x", "y"), strict=True):
            if edge == "clamped":
                held[on] = True
            elif edge == "simply-supported":
                dofs = [dof for dof in _SUPPORTED[constant] if dof < self.mesh.dofs]
                held[np.flatnonzero(on)[:, None], dofs] = True
        return held.ravel()

    @cached_property
    def rigid(self) -> Array:
        """Motions that strain nothing and are not held, at most six. Shape (n, motions)."""
        s = self.specimen
        x, y = (self.mesh.node_positions() / max(s.length_m, s.width_m)).T
        apart = s.apart_m
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
        R = np.zeros((self.mesh.nodes, self.mesh.dofs, len(motions)))
        for k, motion in enumerate(motions):
            for dof, values in motion.items():
                R[:, dof, k] = values
        # A substrate that does not stretch is held; a layer that is not there moves with nobody.
        R[:, [U_C, V_C]] *= ~self._missing[:, [U_C, V_C], None]
        each = R.reshape(-1, len(motions))
        held = np.delete(each, self.free, axis=0)
        values, vectors = np.linalg.eigh(held.T @ held)
        return each[self.free] @ vectors[:, values < _RIGID * max(1.0, values[-1])]

    def _assemble(self) -> None:
        s = self.specimen
        each = [(cell.elements, element_matrices(s, self.mesh, cell)) for cell in self.cells]
        self.M, self.K_substrate, self.K_constraining, self.K_1 = (
            _sum([self.scatter(getattr(e, name), of) for of, e in each])
            for name in ("M", "K_substrate", "K_constraining", "K_1")
        )
        loss_b = s.substrate.loss_factor
        loss_c = s.constraining.loss_factor if s.constraining is not None else 0.0
        faces = self.K_substrate + self.K_constraining
        if loss_b or loss_c:
            faces = faces + 1j * (loss_b * self.K_substrate + loss_c * self.K_constraining)
        if s.slips:
            faces = faces + _sum([self.scatter(np.asarray(e.K_slip), of) for of, e in each])
        if any(s.axial_pa):
            faces = faces + _sum([self.scatter(np.asarray(e.K_pulled), of) for of, e in each])
        if s.lacks_edge_twist:
            faces = faces - self.edge_twist
        self.K_0 = faces.tocsc()

    @cached_property
    def edge_twist(self) -> sp.csr_array:
        """Stiffness that the faces' free edges lack in twist. Shape (n, n).

        An edge along s gives way until no moment twists it, over a width of `EDGE_WIDTH` h: that takes
        `EdgeTwist.stiffness` int (w_ns + coupling w_ss)^2 ds of twice the energy. Patches have edges of their
        own; a foil's share is its thickness to the fourth power, and left out.
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
        found = sp.csr_array((mesh.size,) * 2)
        faces = [face for face in (s.substrate, s.constraining) if face is not None]
        if s.treated_m2 < s.length_m * s.width_m * (1 - _WHOLE):
            faces = faces[:1]
        elif s.both_sides:
            faces += faces[1:]
        for edge, (nodes, across, step) in zip(s.edges, along, strict=True):
            if edge != "free":
                continue
            # The rotations are w_y and -w_x.
            own, other = (self._turns(nodes, dof) for dof in (across, THETA_X + THETA_Y - across))
            lost = [EdgeTwist.of(face, along_x=across == THETA_X) for face in faces]
            side = a if across == THETA_Y else b
            left = [edge_twist_left(face, side) if s.faces_shear else 1.0 for face in faces]
            for coupling in dict.fromkeys(e.coupling for e in lost):
                turn = own - coupling * other
                each = zip(lost, left, strict=True)
                stiffness = sum(e.stiffness * share for e, share in each if e.coupling == coupling)
                found = found + stiffness / step * (turn.T @ turn)
        return sp.csr_array(found[self.free][:, self.free])

    def _turns(self, nodes: NDArray[np.intp], dof: int) -> sp.csr_array:
        """By how much a rotation changes from each node to the next. Shape (nodes - 1, all dofs)."""
        each = sp.csr_array(
            (np.ones(len(nodes)), (np.arange(len(nodes)), nodes * self.mesh.dofs + dof)),
            shape=(len(nodes), self.mesh.size),
        )
        return sp.csr_array(each[1:] - each[:-1])

    def scatter(self, Ae: Array, elements: NDArray[np.intp] | slice = slice(None)) -> sp.csc_array:
        """An element's matrix (4 dofs, 4 dofs) assembled over some elements. Shape (n, n)."""
        dofs = self.mesh.element_dofs()[elements]
        rows = np.repeat(dofs, dofs.shape[1], axis=1).ravel()
        columns = np.tile(dofs, (1, dofs.shape[1])).ravel()
        n = self.mesh.size
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
        r = np.zeros((self.mesh.nodes, self.mesh.dofs))
        r[:, W] = 1.0
        # The held nodes move with the base too: their inertia couples to their neighbours.
        dofs = self.mesh.element_dofs()
        inertia = np.zeros(self.mesh.size)
        for cell in self.cells:
            its = dofs[cell.elements]
            np.add.at(inertia, its, r.ravel()[its] @ element_matrices(self.specimen, self.mesh, cell).M)
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
        """Vectors over the free degrees of freedom, node by node, held ones zero. Shape (nodes, dofs, k)."""
        full = np.zeros((self.mesh.size, V.shape[1]))
        full[self.free] = V
        return full.reshape(self.mesh.nodes, self.mesh.dofs, -1)

    def on_elements(self, V: Array) -> Array:
        """Vectors over the free degrees of freedom, by elements. Shape (elements, 4 dofs, k)."""
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
        if self.specimen.alike_in_y:
            return (self.even, self.odd)
        return (sp.eye_array(self.size, format="csc"),)

    def _of_parity(self, parity: float) -> sp.csc_array:
        # In an even motion u_b, u_c, w and theta_y repeat at the mirrored node, v_b, v_c and theta_x turn.
        node = np.arange(self.mesh.nodes)
        i, j = np.divmod(node, self.mesh.n_y + 1)
        mirror = i * (self.mesh.n_y + 1) + self.mesh.n_y - j
        sign = np.full(self.mesh.dofs, parity)
        sign[[V_C, V_B, THETA_X, *range(G_Y, self.mesh.dofs)]] *= -1
        kept = np.repeat(node <= mirror, self.mesh.dofs)
        twin = (mirror[:, None] * self.mesh.dofs + np.arange(self.mesh.dofs)).ravel()[kept]
        signs = np.tile(sign, self.mesh.nodes)[kept]
        column = np.arange(len(twin))
        shape = (self.mesh.size, len(twin))
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
        row = self.observe(*self.specimen.pickup_m, "pickup")
        if self.specimen.reads == "relative" and np.abs(row).max() < _STILL:
            x, y = (1e3 * v for v in self.specimen.pickup_m)
            raise OutsideModel(f"pickup ({x:g}, {y:g}) mm lies on a held edge, expected a point that moves")
        return row

    @cached_property
    def further(self) -> Array:
        """Rows that read w at the further spots; unit forces there too. Shape (n, spots)."""
        return (
            np.array([self.observe(*at) for at in self.specimen.further_pickups_m]).reshape(-1, self.size).T
        )

    def observe(self, x_m: float, y_m: float, what: str = "point") -> Array:
        """The row that reads w at a point, by the shape functions; a unit force there too. Shape (n,).

        `what` is there, for people. Raises `OutsideModel` for a point off the plate.
        """
        L, B = self.mesh.length_m, self.mesh.width_m
        if not (0 <= x_m <= L and 0 <= y_m <= B):
            raise OutsideModel(
                f"{what} ({x_m * 1e3:g}, {y_m * 1e3:g}) mm is off the plate, "
                f"expected 0 to {L * 1e3:g} mm and 0 to {B * 1e3:g} mm"
            )
        a, b = self.mesh.sides_m
        i = min(int(x_m / a), self.mesh.n_x - 1)
        j = min(int(y_m / b), self.mesh.n_y - 1)
        row = np.zeros(self.mesh.size)
        dofs = self.mesh.element_dofs()[i * self.mesh.n_y + j]
        row[dofs] = self.mesh.shape.deflection(x_m - i * a, y_m - j * b)
        return row[self.free]


def _sum(each: list[sp.csc_array]) -> sp.csc_array:
    found = each[0]
    for more in each[1:]:
        found = found + more
    return sp.csc_array(found)
