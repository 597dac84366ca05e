"""One element's matrix all over a plate, applied to motions without being assembled."""

from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.numerics.linear import times
from fitting.plate.plate import Plate


class Assembly:
    """All elements of a plate, given its motions and asked for their forces."""

    def __init__(self, plate: Plate) -> None:
        dofs = plate.mesh.element_dofs().T
        place = (dofs.ravel(), np.arange(dofs.size))
        shape = (plate.mesh.size, dofs.size)
        self._gather = sp.csr_array((np.ones(dofs.size), place), shape=shape)[plate.free]
        self._give = sp.csr_array(self._gather.T)
        self._cells = [cell.elements for cell in plate.cells]

    def forces(self, A: NDArray[Any], X: NDArray[Any]) -> NDArray[Any]:
        """What the elements answer to motions X of the plate, (n, k), by a matrix A of all, (4 dofs, 4 dofs).

        Or by one of each of its cells, (cells, 4 dofs, 4 dofs).
        """
        each = times(self._give, X)
        of_elements = each.reshape(A.shape[-1], -1)
        if A.ndim == 2:
            return times(self._gather, (A @ of_elements).reshape(each.shape))
        found = np.zeros((A.shape[-1], of_elements.shape[1] // X.shape[1], X.shape[1]), np.result_type(A, X))
        for B, its in zip(A, self._cells, strict=True):
            some = of_elements.reshape(found.shape)[:, its]
            found[:, its] = (B @ some.reshape(len(B), -1)).reshape(some.shape)
        return times(self._gather, found.reshape(each.shape))
