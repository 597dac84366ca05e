"""Factorising the plate's sparse symmetric matrices, the one costly step of a direct solve."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Any, cast

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu
from threadpoolctl import ThreadpoolController


@cache
def _threads() -> ThreadpoolController:
    return ThreadpoolController()


def _one_thread() -> AbstractContextManager[Any]:
    """SuperLU's blocks are too small to share: on a busy machine threads wait for each other."""
    return cast("AbstractContextManager[Any]", _threads().limit(limits=1, user_api="blas"))


def factorise(A: sp.sparray) -> Callable[[NDArray[Any]], NDArray[Any]]:
    """Sparse LU of a symmetric matrix; returns the solver of A x = b for b of shape (n,) or (n, k).

    Minimum degree on A^T + A with diagonal pivots: eight times faster here than the default ordering.
    """
    with _one_thread():
        lu = splu(
            A.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    is_complex = np.iscomplexobj(A.dtype.type(0))

    def solve(b: NDArray[Any]) -> NDArray[Any]:
        with _one_thread():
            return solve_here(b)

    def solve_here(b: NDArray[Any]) -> NDArray[Any]:
        if np.iscomplexobj(b) and not is_complex:
            return np.asarray(lu.solve(b.real.copy()) + 1j * lu.solve(b.imag.copy()))
        return np.asarray(lu.solve(b.astype(A.dtype, copy=False)))

    return solve


def times(A: sp.sparray, X: NDArray[Any]) -> NDArray[Any]:
    """A X for a real sparse matrix: complex columns as pairs of real ones, several times faster.

    Shapes (n, m), and (m,) or (m, columns).
    """
    if not np.iscomplexobj(X) or np.iscomplexobj(A.dtype.type(0)):
        return np.asarray(A @ X)
    pairs = np.ascontiguousarray(X).view(np.float64)
    found = np.asarray(A @ pairs.reshape(len(X), pairs.size // len(X)))
    return found.view(np.complex128).reshape(A.shape[0], *X.shape[1:])


@dataclass(frozen=True)
class Chain:
    """Symmetric matrices over unknowns that lie on lines, a line's coupled to the next one's alone.

    Such a matrix is a row of dense blocks: for every line its own, then that with the next line. With lines
    of a hundred unknowns its factors are as large as a sparse matrix's, and all work is in products.
    """

    sizes: tuple[int, ...]
    """Unknowns of each line, which are numbered line by line."""

    @cached_property
    def starts(self) -> list[int]:
        """The first unknown of each line, and one beyond the last."""
        return [0, *np.cumsum(self.sizes).tolist()]

    @cached_property
    def _places(self) -> list[tuple[int, int]]:
        """Where each line's own block begins, and that with the next line."""
        found, at = [], 0
        for k, n in enumerate(self.sizes):
            found.append((at, at + n * n))
            at += n * n + (n * self.sizes[k + 1] if k + 1 < len(self.sizes) else 0)
        return found

    def blocks(self, A: sp.sparray) -> NDArray[Any]:
        """The blocks of a sparse matrix, one after the other. Shape (values,)."""
        A = A.tocoo()
        sizes, starts = np.array(self.sizes), np.array(self.starts)
        line = np.repeat(np.arange(len(sizes)), sizes)
        row, column = A.coords
        apart = line[column] - line[row]
        upper = (apart == 0) | (apart == 1)
        row, column, apart = row[upper], column[upper], apart[upper]
        at = line[row]
        own, following = (np.array(p)[at] for p in zip(*self._places, strict=True))
        begin = np.where(apart == 0, own, following)
        inside = (row - starts[at]) * sizes[line[column]] + column - starts[line[column]]
        found = np.zeros(self._places[-1][1], A.dtype)
        found[begin + inside] = A.data[upper]
        return found

    def _own(self, A: NDArray[Any], k: int) -> NDArray[Any]:
        n, (at, end) = self.sizes[k], self._places[k]
        return A[at:end].reshape(n, n)

    def _next(self, A: NDArray[Any], k: int) -> NDArray[Any]:
        return A[self._places[k][1] : self._places[k + 1][0]].reshape(self.sizes[k], self.sizes[k + 1])

    def _lines(self, X: NDArray[Any]) -> list[NDArray[Any]]:
        return [X[a:b] for a, b in pairwise(self.starts)]

    def times(self, A: NDArray[Any], X: NDArray[Any]) -> NDArray[Any]:
        """A X of blocks and columns. Shape (n, m)."""
        x, found = self._lines(X), []
        for k in range(len(x)):
            y = self._own(A, k) @ x[k]
            if k > 0:
                y += self._next(A, k - 1).T @ x[k - 1]
            if k + 1 < len(x):
                y += self._next(A, k) @ x[k + 1]
            found.append(y)
        return np.concatenate(found)

    def factorise(self, A: NDArray[Any]) -> Callable[[NDArray[Any]], NDArray[Any]]:
        """Solver of A x = b for b of shape (n, m); as with `factorise`, no pivots from line to line."""
        inverse: list[NDArray[Any]] = []
        follow: list[NDArray[Any]] = []
        for k in range(len(self.sizes)):
            S = self._own(A, k)
            if k > 0:
                S = S - self._next(A, k - 1).T @ follow[-1]
            inverse.append(_inverse(S))
            if k + 1 < len(self.sizes):
                follow.append(inverse[-1] @ self._next(A, k))

        def solve(b: NDArray[Any]) -> NDArray[Any]:
            found = np.array(b, dtype=np.result_type(b, A))
            y = self._lines(found)
            for k in range(1, len(y)):
                y[k] -= follow[k - 1].T @ y[k - 1]
            y[-1][:] = inverse[-1] @ y[-1]
            for k in reversed(range(len(y) - 1)):
                y[k][:] = inverse[k] @ y[k] - follow[k] @ y[k + 1]
            return found

        return solve


def _inverse(A: NDArray[Any]) -> NDArray[Any]:
    """Half the time of `np.linalg.inv` on small matrices."""
    getrf, getri = la.get_lapack_funcs(("getrf", "getri"), (A,))
    lu, pivots, failed = getrf(A)
    found, singular = getri(lu, pivots, lwork=64 * len(A), overwrite_lu=True)
    if failed or singular:
        raise np.linalg.LinAlgError("a line of the plate moves freely at this frequency")
    return np.asarray(found)


def with_damping(
    solve: Callable[[NDArray[Any]], NDArray[Any]], omega: float, U: NDArray[Any], d: NDArray[Any]
) -> Callable[[NDArray[Any]], NDArray[Any]]:
    """The solver of A + i omega U diag(d) U^T from that of A, by the Woodbury identity.

    `U` of shape (n, modes), `d` (modes,).
    """
    if not d.size:
        return solve
    Z = solve(U)
    small = np.diag(1 / (1j * omega * d)) + U.T @ Z

    def damped(b: NDArray[Any]) -> NDArray[Any]:
        x = solve(b)
        x -= Z @ np.linalg.solve(small, U.T @ x)
        return x

    return damped
