"""Sums that derivatives to stated numbers are made of, and results kept from call to call."""

from collections.abc import Callable

import numpy as np

from fitting.arrays import Array, Complex

_MOST_KEPT = 64
"""Changes at places just asked for: one search asks for the same few again and again."""


def between(parts: Array, q: Complex, adjoint: Complex) -> Complex:
    """Adjoint . P q for every part at every point. Shape (parts, points)."""
    k, n = q.shape[1], len(q)
    # One real product: a third of the time of a complex one part by part.
    sides = np.vstack([q.real, q.imag]) @ parts.transpose(1, 0, 2).reshape(k, -1)
    real, imag = (side.reshape(n, len(parts), k) for side in (sides[:n], sides[n:]))
    moved = (real + 1j * imag) @ adjoint[:, :, None]
    return np.asarray(moved[:, :, 0].T.copy())


class Kept:
    """Results of a few functions, the latest of each."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, bytes], Array] = {}

    def get(self, name: str, z: Array, make: Callable[[], Array]) -> Array:
        """What `make` returns for this z, shape (numbers,)."""
        key = name, z.tobytes()
        if key not in self._known:
            while len(self._known) >= _MOST_KEPT:
                del self._known[next(iter(self._known))]
            self._known[key] = make()
        return self._known[key]
