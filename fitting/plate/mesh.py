"""The plate's regular mesh, and which parts of its elements are treated."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Indices
from fitting.plate.element import CORNERS, DOFS, WITH_SLIP, Rectangles, Shape
from fitting.specimen import PlateSpecimen
from fitting.stated.patches import Patch, shifts_of

_SLIVER = 0.02
"""Of an element's side: a narrower strip of treatment on it is left out, it would hardly hold its nodes."""
_DECIMALS = 12
"""Of a metre: elements that are covered alike to that are one cell."""


@dataclass(frozen=True)
class Mesh:
    """A regular grid of elements; node (i, j) has number i (n_y + 1) + j."""

    length_m: float
    width_m: float
    n_x: int
    n_y: int
    dofs: int = DOFS
    """Degrees of freedom of a node: `DOFS`, or `WITH_SLIP` where glue slips or faces shear.

    Shapes of the plate's arrays call it dofs: all nodes have (nodes, dofs), a matrix of an element, which has
    four nodes, (4 dofs, 4 dofs).
    """

    @property
    def nodes(self) -> int:
        """How many nodes there are."""
        return (self.n_x + 1) * (self.n_y + 1)

    @property
    def sides_m(self) -> tuple[float, float]:
        """Sides of an element."""
        return self.length_m / self.n_x, self.width_m / self.n_y

    @property
    def shape(self) -> Shape:
        """Shape functions of its elements."""
        return Shape(*self.sides_m, self.dofs)

    @property
    def size(self) -> int:
        """How many degrees of freedom there are, held ones too."""
        return self.nodes * self.dofs

    def element_dofs(self) -> Indices:
        """Degrees of freedom of every element, corners in the element's order.

        Shape (elements, 4 dofs).
        """
        i, j = np.meshgrid(np.arange(self.n_x), np.arange(self.n_y), indexing="ij")
        stride = self.n_y + 1
        corners = [(i + int(cx)) * stride + j + int(cy) for cx, cy in CORNERS]
        nodes = np.stack([c.ravel() for c in corners], axis=1)
        dofs = nodes[:, :, None] * self.dofs + np.arange(self.dofs)
        return np.asarray(dofs.reshape(len(nodes), -1), dtype=np.intp)

    def node_positions(self) -> Array:
        """Positions (x, y) of every node in m. Shape (nodes, 2)."""
        x, y = np.meshgrid(
            np.linspace(0, self.length_m, self.n_x + 1),
            np.linspace(0, self.width_m, self.n_y + 1),
            indexing="ij",
        )
        return np.stack([x.ravel(), y.ravel()], axis=1)


def mesh_of(specimen: PlateSpecimen) -> Mesh:
    """Of a plate as stated."""
    dofs = WITH_SLIP if specimen.slips else DOFS
    return Mesh(specimen.length_m, specimen.width_m, *specimen.mesh, dofs)


@dataclass(frozen=True)
class Cell:
    """Elements that are treated alike."""

    elements: Indices | slice
    over: Rectangles | None = None
    """Their treated parts; None: all of them, or nothing is patched."""
    shifts: tuple[tuple[Rectangles, Rectangles], ...] = ()
    """Of `Shift`s that touch them, in order: what is treated more, and less, as a patch moves both ways."""

    def stretched(self, along_x: float, along_y: float) -> "Cell":
        """On a mesh stretched by such factors."""
        if self.over is None:
            return self
        over = tuple((along_x * a, along_x * b, along_y * c, along_y * d) for a, b, c, d in self.over)
        return replace(self, over=over)

    @property
    def treated(self) -> bool:
        """Whether core and constraining layer are there."""
        return self.over is None or bool(self.over)


SHIFT_M = 1e-4
"""How far patches are moved either way for what a shift does to first order."""


def is_turned(specimen: PlateSpecimen) -> bool:
    """Whether a face's own axes are not the plate's."""
    faces = (f for f in (specimen.substrate, specimen.constraining) if f is not None)
    return any(f.rolled is not None and not f.rolled.aligned for f in faces)


def cells_of(specimen: PlateSpecimen, mesh: Mesh) -> tuple[Cell, ...]:
    """The mesh's elements by how they are treated. `mesh` may be stretched: patches are the specimen's."""
    if not specimen.patches:
        return (Cell(slice(None)),)
    return _cells(
        specimen.patches,
        tuple(
            (shift.of(specimen, SHIFT_M)[shift.patch], shift.of(specimen, -SHIFT_M)[shift.patch])
            for shift in shifts_of(specimen)
        ),
        (specimen.length_m, specimen.width_m),
        (mesh.n_x, mesh.n_y),
    )


@lru_cache(maxsize=16)
def _cells(
    patches: tuple[Patch, ...],
    shifted: tuple[tuple[Patch, Patch], ...],
    sides_m: tuple[float, float],
    counts: tuple[int, int],
) -> tuple[Cell, ...]:
    a, b = (side / n for side, n in zip(sides_m, counts, strict=True))
    found: dict[tuple[Rectangles, tuple[tuple[Rectangles, Rectangles], ...]], list[int]] = {}
    for element in range(counts[0] * counts[1]):
        i, j = divmod(element, counts[1])
        corner = (i * a, j * b, a, b)
        over = tuple(r for p in patches for r in _part(p, corner, _SLIVER))
        moves = tuple((_part(up, corner, 0.0), _part(down, corner, 0.0)) for up, down in shifted)
        moves = tuple(m if m[0] != m[1] else ((), ()) for m in moves)
        found.setdefault((over, moves), []).append(element)
    return tuple(Cell(np.array(e, dtype=np.intp), over, moves) for (over, moves), e in found.items())


def _part(patch: Patch, element: tuple[float, float, float, float], least: float) -> Rectangles:
    """What a patch covers of an element at (x, y) of two sides; nothing below a share of a side."""
    x, y, a, b = element
    x_0, x_1 = max(patch.from_x_m - x, 0.0), min(patch.to_x_m - x, a)
    y_0, y_1 = max(patch.from_y_m - y, 0.0), min(patch.to_y_m - y, b)
    if x_1 - x_0 <= least * a or y_1 - y_0 <= least * b:
        return ()
    x_0, x_1, y_0, y_1 = (round(x, _DECIMALS) for x in (x_0, x_1, y_0, y_1))
    return ((x_0, x_1, y_0, y_1),)


def treated_nodes(specimen: PlateSpecimen, mesh: Mesh) -> NDArray[np.bool_]:
    """Which nodes are of a treated element. Shape (nodes,)."""
    found = np.zeros(mesh.nodes, dtype=bool)
    node = mesh.element_dofs()[:, :: mesh.dofs] // mesh.dofs
    for cell in cells_of(specimen, mesh):
        if cell.treated:
            found[node[cell.elements]] = True
    return found
