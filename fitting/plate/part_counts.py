"""Where the parts of K_0, K_1, M and the load lie in arrays that hold one after another."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex


@dataclass(frozen=True)
class PartCounts:
    """How many parts K_0, K_1 and M have, one after another along an axis; those of the load follow."""

    of_K_0: int = 0
    of_K_1: int = 0
    of_M: int = 0

    @property
    def each(self) -> tuple[int, int, int]:
        """Of K_0, K_1 and M."""
        return self.of_K_0, self.of_K_1, self.of_M

    @property
    def K_0(self) -> slice:
        """Where those of K_0 lie."""
        return slice(self.of_K_0)

    @property
    def K_1(self) -> slice:
        """Where those of K_1 lie."""
        return slice(self.of_K_0, self.of_K_0 + self.of_K_1)

    @property
    def M(self) -> slice:
        """Where those of M lie."""
        return slice(self.of_K_0 + self.of_K_1, sum(self.each))

    @property
    def matrices(self) -> slice:
        """Where those of all three lie."""
        return slice(sum(self.each))

    @property
    def load(self) -> slice:
        """Where those of the load lie."""
        return slice(sum(self.each), None)

    def summed(self, c: Array | Complex, parts: Array) -> tuple[Complex, Complex, Complex]:
        """K_0, K_1 and M of coefficients and parts of all three. Shapes (parts or more,), (parts, k, k)."""
        K_0, K_1, M = (
            np.asarray(np.tensordot(c[at], parts[at], axes=1)) for at in (self.K_0, self.K_1, self.M)
        )
        return K_0, K_1, M

    def weigh(self, each: Complex, of_K_1: Complex, of_M: Array | Complex) -> None:
        """Multiply in place what belongs to the parts of K_1, and of M. Shape of `each` (parts, ...)."""
        each[self.K_1] *= of_K_1
        each[self.M] *= of_M
