"""One element's matrix all over a plate, applied to motions without being assembled."""

from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.element import DOFS
from fitting.linear import times
from fitting.plate import Plate


class Assembly:
    """All elements of a plate, given its motions and asked for their forces."""

    def __init__(self, plate: Plate) -> None:
        dofs = plate.mesh.element_dofs().T
        place = (dofs.ravel(), np.arange(dofs.size))
        shape = (plate.mesh.nodes * DOFS, dofs.size)
        self._gather = sp.csr_array((np.ones(dofs.size), place), shape=shape)[plate.free]
        self._give = sp.csr_array(self._gather.T)

    def forces(self, A: NDArray[Any], X: NDArray[Any]) -> NDArray[Any]:
        """What the elements answer to motions X of the plate, (n, k), by a matrix A of all, (28, 28)."""
        each = times(self._give, X)
        return times(self._gather, (A @ each.reshape(4 * DOFS, -1)).reshape(each.shape))
