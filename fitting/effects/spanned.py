"""The reduced plate widened so that it can carry every effect: small matrices, columns in named groups.

The first columns are the unchanged plate's own (`ReducedPlate`, even in y). Each `Span` adds the few motions
that its effects need beside them. A fit takes the columns of its effects alone.
"""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.effects.base import Change, Span
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.element import DOFS, THETA_X, THETA_Y, Shape, W
from fitting.linear import factorise
from fitting.parts import load_part, projected_parts
from fitting.plate import Mesh
from fitting.reduced import ReducedPlate

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Names = NDArray[np.str_]

SNAPSHOTS = 12
TOLERANCE = 3e-3
"""Of a typical change, what may be missed; the reading's error goes with its square."""
CONDENSED = 1e-6
"""Of the largest singular value, what a condensed plate may leave out."""
_OVERLAP = 1e-6
"""Columns of two groups closer than this are one."""


@dataclass(frozen=True)
class SpannedPlate:
    """Matrices on k columns. Inputs: unit heave and pitch of the base; output: w at the pickup."""

    group: Names
    """Of every column: "plate" or a span's name, ending in "/odd" for motions odd in y."""
    M: Array
    K_0: Complex
    K_1: Array
    U: Array
    d: Array
    load: Array
    pitch: Array
    observe: Array
    gram: Array
    """Inner products of the columns."""
    names: Names
    """Of `matrices`."""
    matrices: Array
    """Shape (count, k, k)."""
    vector_names: Names
    vectors: Array
    """Shape (count, k)."""
    deflection: Array
    """w, dw/dy and -dw/dx of every column at every node. Shape (nodes, 3, k)."""
    size: Array
    """Length and width in m, elements along each."""
    pickup: Array
    """Position of the pickup in m. Shape (2,)."""
    parts: Array
    """By what is stated (`fitting.parts`). Shape (parts, k, k)."""
    load_part: Array
    """Shape (k,)."""

    def take(self, spans: Iterable[Span], *, wanted: Sequence[str] | None = None) -> "SpannedPlate":
        """The plate on its own columns and those of `spans`, matrices of other spans left out."""
        spans = list(spans)
        groups = {"plate", *(s.name for s in spans)}
        if any(s.odd for s in spans):
            groups |= {"plate/odd", *(f"{s.name}/odd" for s in spans)}
        columns = np.flatnonzero(np.isin(self.group, list(groups)))
        prefixes = tuple(f"{s.name}." for s in spans)
        kept = _starting(self.names, prefixes)
        kept_vectors = _starting(self.vector_names, prefixes)
        square = np.ix_(columns, columns)
        taken = replace(
            self,
            group=self.group[columns],
            **{name: getattr(self, name)[square] for name in ("M", "K_0", "K_1", "gram")},
            **{name: getattr(self, name)[columns] for name in ("U", "load", "pitch", "observe", "load_part")},
            parts=self.parts[:, columns][:, :, columns],
            names=self.names[kept],
            matrices=self.matrices[kept][:, columns][:, :, columns],
            vector_names=self.vector_names[kept_vectors],
            vectors=self.vectors[kept_vectors][:, columns],
            deflection=self.deflection[:, :, columns],
        )
        return taken._independent() if len(spans) > 1 else taken

    @classmethod
    def plain(cls, reduced: ReducedPlate, mesh: Mesh, pickup_m: tuple[float, float]) -> "SpannedPlate":
        """The reduced plate as one that carries no effects but what is stated."""
        k = len(reduced.load)
        none = np.zeros(0, dtype=str)
        return cls(
            group=np.full(k, "plate"),
            M=reduced.M,
            K_0=np.asarray(reduced.K_0, dtype=complex),
            K_1=reduced.K_1,
            U=reduced.U,
            d=reduced.d,
            load=reduced.load,
            pitch=np.zeros(k),
            observe=reduced.observe,
            gram=np.eye(k),
            names=none,
            matrices=np.zeros((0, k, k)),
            vector_names=none,
            vectors=np.zeros((0, k)),
            deflection=reduced.deflection,
            size=np.array([mesh.length_m, mesh.width_m, mesh.n_x, mesh.n_y], dtype=float),
            pickup=np.array(pickup_m),
            parts=reduced.parts,
            load_part=reduced.load_part,
        )

    def condensed(
        self,
        omega: Array,
        G: Complex,
        changes: Sequence[Change] = (),
        changed_omega: Array | None = None,
        changed_G: Complex | None = None,
    ) -> "SpannedPlate":
        """Its own even columns as far as they answer at some frequencies and moduli; others as they are.

        `changes` are of the plate, on its columns: answers with each of them at `changed_omega` and
        `changed_G` are kept too.
        """
        own = np.flatnonzero(self.group == "plate")
        found = [self._answers(own, omega, G, Change())]
        if changed_omega is not None and changed_G is not None:
            found += [self._answers(own, changed_omega, changed_G, c) for c in changes]
        X = np.concatenate(found, axis=1)
        V, size, _ = np.linalg.svd(np.hstack([X.real, X.imag]), full_matrices=False)
        V = V[:, size > CONDENSED * size[0]]
        rest = np.flatnonzero(self.group != "plate")
        T = np.zeros((len(self.group), V.shape[1] + len(rest)))
        T[own, : V.shape[1]] = V
        T[rest, V.shape[1] + np.arange(len(rest))] = 1.0
        return self._on(T, np.concatenate([np.full(V.shape[1], "plate"), self.group[rest]]))

    def _answers(self, own: NDArray[np.intp], omega: Array, G: Complex, change: Change) -> Complex:
        """Of its own columns to base, pickup and pitch, of unit size. Shape (k, any)."""
        square = np.ix_(own, own)
        K_0, K_1, M = (
            (getattr(self, a) + getattr(change, b))[square]
            for a, b in (("K_0", "K"), ("K_1", "K_1"), ("M", "M"))
        )
        C_1 = (self.U[own] * (self.d * change.damping)) @ self.U[own].T
        A = K_0 + G[:, None, None] * K_1
        A = A - (omega**2)[:, None, None] * M + 1j * omega[:, None, None] * C_1
        given = [self.load + change.load, self.observe + change.observe, self.pitch]
        sides = np.stack([side[own] for side in given if np.any(side)], axis=1).astype(complex)
        X = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
        return np.concatenate(X / np.linalg.norm(X, axis=1, keepdims=True), axis=1)

    def _independent(self) -> "SpannedPlate":
        """On an orthonormal basis of the same motions: two spans may share some."""
        values, vectors = la.eigh(self.gram)
        kept = values > _OVERLAP
        if kept.all() and values[0] > 0.01:
            return self
        T = vectors[:, kept] / np.sqrt(values[kept])
        return self._on(T, np.full(T.shape[1], "mixed"))

    def _on(self, T: Array, group: Names) -> "SpannedPlate":
        """On the combinations T of its columns. Shape (k, fewer)."""

        def square(A: Any) -> Any:
            return T.T @ A @ T

        return replace(
            self,
            group=group,
            M=square(self.M),
            K_0=square(self.K_0),
            K_1=square(self.K_1),
            gram=square(self.gram),
            matrices=square(self.matrices),
            parts=square(self.parts),
            load_part=T.T @ self.load_part,
            U=T.T @ self.U,
            load=T.T @ self.load,
            pitch=T.T @ self.pitch,
            observe=T.T @ self.observe,
            vectors=self.vectors @ T,
            deflection=self.deflection @ T,
        )

    @cached_property
    def _place(self) -> dict[str, int]:
        return {str(n): k for k, n in enumerate(self.names)}

    def matrix(self, name: str) -> Array:
        """A span's matrix. Shape (k, k)."""
        return np.asarray(self.matrices[self._place[name]])

    def stack(self, prefix: str) -> Array:
        """Matrices whose names begin so, in order. Shape (count, k, k)."""
        return np.asarray(self.matrices[[k for k, n in enumerate(self.names) if str(n).startswith(prefix)]])

    def vector(self, name: str) -> Array:
        """A span's vector. Shape (k,)."""
        return np.asarray(self.vectors[[str(n) for n in self.vector_names].index(name)])

    @property
    def length_m(self) -> float:
        """Along x."""
        return float(self.size[0])

    @property
    def width_m(self) -> float:
        """Along y."""
        return float(self.size[1])

    def row(self, x_m: float, y_m: float) -> Array:
        """Reads w at a point of the plate; beyond an edge the nearest point of it. Shape (k,)."""
        mesh = Mesh(self.length_m, self.width_m, int(self.size[2]), int(self.size[3]))
        a, b = mesh.sides_m
        x, y = np.clip(x_m, 0, mesh.length_m), np.clip(y_m, 0, mesh.width_m)
        i, j = min(int(x / a), mesh.n_x - 1), min(int(y / b), mesh.n_y - 1)
        first = i * (mesh.n_y + 1) + j
        corners = [first, first + mesh.n_y + 1, first + mesh.n_y + 2, first + 1]
        shape = Shape(a, b).deflection(x - i * a, y - j * b).reshape(4, DOFS)[:, [W, THETA_X, THETA_Y]]
        return np.einsum("cd,cdk->k", shape, self.deflection[corners])


def span_plate(
    full: FullPlate,
    basis: Array,
    spans: Sequence[Span],
    progress: Callable[[float], None] = lambda fraction: None,
) -> SpannedPlate:
    """Build it. `basis`: the unchanged plate's columns over the held degrees of freedom. Shape (held, k)."""
    own = _orthonormal(full.scale, full.lift @ basis)
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        found: list[list[Complex]] = []
        for answers in pool.map(lambda at: _responses(full, spans, at), _points()):
            found.append(answers)
            progress(0.8 * len(found) / SNAPSHOTS)
        even, odd = full.loose.even, full.loose.odd
        odd_own = _leading(
            full.scale, odd, np.empty((full.scale.shape[0], 0)), [f[0] for f in found], 1e-4, 40
        )
        columns: list[Array] = [own, odd_own]
        group = ["plate"] * own.shape[1] + ["plate/odd"] * odd_own.shape[1]
        for k, span in enumerate(spans):
            stirred = [f[k + 1] for f in found]
            columns.append(_leading(full.scale, even, own, stirred, TOLERANCE, span.columns))
            group += [span.name] * columns[-1].shape[1]
            if span.odd:
                columns.append(_leading(full.scale, odd, odd_own, stirred, TOLERANCE, span.columns))
                group += [f"{span.name}/odd"] * columns[-1].shape[1]
            progress(0.8 + 0.2 * (k + 1) / len(spans))
        return _project(full, np.hstack(columns), np.array(group), spans)


def _points() -> list[tuple[float, complex]]:
    """Frequencies from 12 to 420 Hz, moduli from 0.1 to 10 MPa, lossy; a low-discrepancy set."""
    s = (0.5 + np.arange(SNAPSHOTS) * 0.7549) % 1
    t = (0.5 + np.arange(SNAPSHOTS) * 0.5698) % 1
    omega = 2 * np.pi * 12 * 35.0**s
    return [(float(w), complex(1e5 * 100.0**m * (1 + 0.6j))) for w, m in zip(omega, t, strict=True)]


def _responses(full: FullPlate, spans: Sequence[Span], point: tuple[float, complex]) -> list[Complex]:
    at = full.snapshot(*point)
    size = np.sqrt(np.real(np.vdot(at.x, full.scale @ at.x)))
    at = Snapshot(at.omega, at.G, at.x / size, at.both[:, 1] / size, at.solve)
    return [at.both[:, 1:], *(span.responses(full, at) for span in spans)]


def _leading(
    scale: sp.csc_array, P: sp.csc_array, known: Array, responses: list[Complex], tolerance: float, most: int
) -> Array:
    """Orthonormal motions of one parity that the responses have beside `known`. Shape (n, few)."""
    X = np.hstack(responses)
    X = np.asarray(P @ (P.T @ np.hstack([X.real, X.imag])))
    for _ in range(2):
        X = X - known @ (known.T @ (scale @ X))
    values, vectors = np.linalg.eigh(X.T @ (scale @ X))
    few = np.argsort(values)[::-1][:most]
    few = few[values[few] > tolerance**2]
    V = X @ (vectors[:, few] / np.sqrt(values[few]))
    V = V - known @ (known.T @ (scale @ V))
    return _orthonormal(scale, V)


def _orthonormal(scale: sp.csc_array, V: Array) -> Array:
    for _ in range(2):
        R = np.linalg.cholesky(V.T @ (scale @ V))
        V = la.solve_triangular(R, V.T, lower=True).T
    return np.asarray(V)


def _project(full: FullPlate, V: Array, group: Names, spans: Sequence[Span]) -> SpannedPlate:
    loose = full.loose
    matrices: dict[str, Array] = {}
    vectors: dict[str, Array] = {}
    for span in spans:
        for name, A in span.matrices(full).items():
            matrices[f"{span.name}.{name}"] = _between(V, A)
        vectors |= {f"{span.name}.{name}": V.T @ v for name, v in span.vectors(full).items()}
    k = V.shape[1]
    s = full.specimen
    held_modes = full.lift @ _over_mass(full)
    return SpannedPlate(
        group=group,
        M=V.T @ (loose.M @ V),
        K_0=np.asarray(V.T @ (loose.K_0 @ V), dtype=complex),
        K_1=V.T @ (loose.K_1 @ V),
        U=V.T @ (loose.M @ held_modes),
        d=full.damping.d,
        load=-V.T @ (loose.M @ full.heave),
        pitch=-V.T @ (loose.M @ full.pitching),
        observe=V.T @ loose.observe(*full.pickup_m),
        gram=V.T @ (full.scale @ V),
        names=np.array(list(matrices), dtype=str),
        matrices=np.array(list(matrices.values())).reshape(-1, k, k),
        vector_names=np.array(list(vectors), dtype=str),
        vectors=np.array(list(vectors.values())).reshape(-1, k),
        deflection=loose.on_nodes(V)[:, [W, THETA_X, THETA_Y]],
        size=np.array([s.length_m, s.width_m, loose.mesh.n_x, loose.mesh.n_y], dtype=float),
        pickup=np.array(full.pickup_m),
        parts=projected_parts(loose, V),
        load_part=V.T @ load_part(s)[loose.free],
    )


def _between(V: Array, A: sp.sparray | Array) -> Array:
    """V^T A V; an array stands for L of A = L L^T."""
    if isinstance(A, np.ndarray):
        L = V.T @ A
        return L @ L.T
    # A strip touches few degrees of freedom.
    A = A.tocsr()
    touched = np.flatnonzero(np.diff(A.indptr))
    few = V[touched]
    return np.asarray(few.T @ (A[touched][:, touched] @ few))


def _over_mass(full: FullPlate) -> Array:
    """Phi of C_1 = M Phi diag(d) Phi^T M. Shape (held, modes)."""
    if not full.damping.d.size:
        return np.empty((full.held.size, 0))
    return factorise(full.held.M)(full.damping.U)


def _starting(names: Names, prefixes: tuple[str, ...]) -> NDArray[np.intp]:
    """Places of the names that begin with one of some prefixes."""
    found = [k for k, n in enumerate(names) if prefixes and str(n).startswith(prefixes)]
    return np.array(found, dtype=np.intp)
