"""Rows that read a plate's deflection at its points, by the shape functions of its elements."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from fitting.arrays import Array
from fitting.plate.element import Shape
from fitting.plate.mesh import Mesh

_MOST_ROWS = 256
"""Rows that are kept: those of an evaluation, and of the places that effects are looked for at. A choice."""


@dataclass(frozen=True, eq=False)
class RowReader:
    """Rows over the columns of one reduced plate."""

    deflection: Array
    """w, dw/dy and -dw/dx of every column at every node. Shape (nodes, 3, k)."""
    size: Array
    """Length and width in m, elements along each."""
    _known: dict[tuple[float, float, int, int], Array] = field(default_factory=dict, repr=False)

    def row(self, x_m: float, y_m: float, dx: int = 0, dy: int = 0) -> Array:
        """Reads w, or its derivative, at a point of the plate; beyond an edge the nearest one. Shape (k,).

        The latest are kept: a step along one unknown of an effect leaves its other places where they are.
        """
        key, known = (float(x_m), float(y_m), dx, dy), self._known
        if key not in known:
            while len(known) >= _MOST_ROWS:
                del known[next(iter(known))]
            known[key] = self._row(*key)
        return known[key]

    def _row(self, x_m: float, y_m: float, dx: int, dy: int) -> Array:
        mesh = self._mesh
        a, b = mesh.sides_m
        x, y = min(max(x_m, 0.0), mesh.length_m), min(max(y_m, 0.0), mesh.width_m)
        i, j = min(int(x / a), mesh.n_x - 1), min(int(y / b), mesh.n_y - 1)
        first = i * (mesh.n_y + 1) + j
        corners = [first, first + mesh.n_y + 1, first + mesh.n_y + 2, first + 1]
        shape = Shape(a, b).deflection_by_corners(x - i * a, y - j * b, dx, dy)
        found = np.asarray(shape.ravel() @ self.deflection[corners].reshape(shape.size, -1))
        found.setflags(write=False)
        return found

    @cached_property
    def _mesh(self) -> Mesh:
        return Mesh(float(self.size[0]), float(self.size[1]), int(self.size[2]), int(self.size[3]))
