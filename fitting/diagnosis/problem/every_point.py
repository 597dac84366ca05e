"""Nodes that are the points themselves: what is small is solved at every one, and nothing is interpolated."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.nodes import Nodes


@dataclass(frozen=True)
class EveryPoint(Nodes):
    """One node a point, in the points' order."""

    @classmethod
    def at(cls, omega: Array) -> "EveryPoint":
        """Of a sweep's points in rad/s. Shape (points,)."""
        same = sp.eye_array(len(omega), format="csr")
        none = np.empty(0, dtype=np.intp)
        return cls(omega, omega, same, np.zeros(len(omega), np.intp), np.empty(0, complex), none)

    def around(self, poles: Callable[[float, float], Complex]) -> "EveryPoint":
        """No pole matters where nothing is interpolated."""
        return self

    def spread(self, values: Complex, first: Complex, second: Complex) -> Complex:
        """The values as they are. Shape (points,) at the end."""
        return values
