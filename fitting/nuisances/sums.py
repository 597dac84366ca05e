"""Sums that derivatives to stated numbers are made of, and results kept from call to call."""

from collections.abc import Callable

import numpy as np

from fitting.arrays import Array, Complex

_MOST_KEPT = 64
"""Changes at places just asked for: one search asks for the same few again and again."""

_MOST_PLATES = 12
"""A bound on memory: parts of one plate take up to 3 MB."""


def between(side_by_side: Array, q: Complex, adjoint: Complex) -> Complex:
    """Adjoint . P q for every part at every point. Shape (parts, points).

    The parts `side_by_side`, shape (k, parts times k).
    """
    k, n = q.shape[1], len(q)
    # One real product: a third of the time of a complex one part by part.
    sides = np.vstack([q.real, q.imag]) @ side_by_side
    moved = np.empty((n, side_by_side.shape[1] // k, k), complex)
    moved.real, moved.imag = sides[:n].reshape(moved.shape), sides[n:].reshape(moved.shape)
    return np.asarray((moved @ adjoint[:, :, None])[:, :, 0].T.copy())


class SideBySide:
    """Parts of the latest plates as `between` takes them: a fit asks for the same ones at every step."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[Array, Array]] = {}

    def of(self, parts: Array) -> Array:
        """Shape (parts, k, k) to (k, parts times k)."""
        known = self._known.get(id(parts))
        if known is None or known[0] is not parts:
            while len(self._known) >= _MOST_PLATES:
                del self._known[next(iter(self._known))]
            # Kept with what it is of: an array that is gone leaves its number to another.
            known = parts, np.ascontiguousarray(parts.transpose(1, 0, 2)).reshape(parts.shape[1], -1)
            self._known[id(parts)] = known
        return known[1]

    def __reduce__(self) -> tuple[type["SideBySide"], tuple[()]]:
        # Another process makes its own.
        return SideBySide, ()


class Kept:
    """Results of a few functions, the latest of each."""

    def __init__(self, most: int = _MOST_KEPT) -> None:
        self._most = most
        self._known: dict[tuple[str, bytes], Array] = {}

    def get(self, name: str, z: Array, make: Callable[[], Array]) -> Array:
        """What `make` returns for this z, shape (numbers,)."""
        key = name, z.tobytes()
        if key not in self._known:
            while len(self._known) >= self._most:
                del self._known[next(iter(self._known))]
            self._known[key] = make()
        return self._known[key]


class KeptOfLatest:
    """`Kept` results that depend on one thing more, of the latest such thing."""

    def __init__(self) -> None:
        self._latest: tuple[object, Kept] | None = None

    def of(self, thing: object) -> Kept:
        """Its own."""
        if self._latest is None or self._latest[0] is not thing:
            self._latest = thing, Kept()
        return self._latest[1]

    def __reduce__(self) -> tuple[type["KeptOfLatest"], tuple[()]]:
        # Another process makes its own.
        return KeptOfLatest, ()
