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
from fitting.effects.full_plate import FullPlate
from fitting.effects.leading import Motions, Stirred
from fitting.element import DOFS, THETA_X, THETA_Y, Shape, W
from fitting.linear import times
from fitting.parts import (
    CORE,
    STIFFNESS,
    Coefficients,
    coefficients,
    layers_of,
    load_part,
    projected_parts,
    specimen_of,
)
from fitting.plate import Mesh
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Names = NDArray[np.str_]

SNAPSHOTS = 12
TOLERANCE = 3e-3
"""Of a typical change, what may be missed; the reading's error goes with its square."""
CONDENSED = 1e-4
"""Of the largest singular value, what a condensed plate may leave out; its reading is then off by 1e-5."""
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
    layers: Array
    """What is stated of them (`fitting.parts.layers_of`), zero for a plate that carries no effects."""

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
            layers=np.zeros((3, 5)),
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
    def specimen(self) -> Specimen:
        """As stated, as far as `parts` go."""
        return specimen_of(self.size, self.layers)

    @cached_property
    def coefficients(self) -> Coefficients:
        """Of its `parts`, as stated."""
        return coefficients(self.specimen, self.specimen)

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

    @cached_property
    def pickup_row(self) -> Array:
        """`row` where it is stated to be read. Shape (k,)."""
        return self.row(*self.pickup)

    @property
    def length_m(self) -> float:
        """Along x."""
        return float(self.size[0])

    @property
    def width_m(self) -> float:
        """Along y."""
        return float(self.size[1])

    def row(self, x_m: float, y_m: float, dx: int = 0, dy: int = 0) -> Array:
        """Reads w, or its derivative, at a point of the plate; beyond an edge the nearest one. Shape (k,)."""
        mesh = Mesh(self.length_m, self.width_m, int(self.size[2]), int(self.size[3]))
        a, b = mesh.sides_m
        x, y = np.clip(x_m, 0, mesh.length_m), np.clip(y_m, 0, mesh.width_m)
        i, j = min(int(x / a), mesh.n_x - 1), min(int(y / b), mesh.n_y - 1)
        first = i * (mesh.n_y + 1) + j
        corners = [first, first + mesh.n_y + 1, first + mesh.n_y + 2, first + 1]
        shape = (
            Shape(a, b).deflection(x - i * a, y - j * b, dx, dy).reshape(4, DOFS)[:, [W, THETA_X, THETA_Y]]
        )
        return np.einsum("cd,cdk->k", shape, self.deflection[corners])


def span_plate(
    full: FullPlate,
    basis: Array,
    spans: Sequence[Span],
    progress: Callable[[float], None] = lambda fraction: None,
) -> SpannedPlate:
    """Build it. `basis`: the unchanged plate's columns over the held degrees of freedom. Shape (held, k)."""
    halves = Motions(full, odd=False), Motions(full, odd=True)
    even, odd = halves
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        found: list[tuple[dict[str, Stirred], dict[str, Stirred]]] = []
        for answers in pool.map(lambda at: _responses(full, halves, spans, at), _points()):
            found.append(answers)
            progress(0.8 * len(found) / SNAPSHOTS)
        own = even.orthonormal(even.of(full.lift @ basis))
        odd_own = odd.leading([by_name["plate"] for _, by_name in found], None, 1e-4, 40)
        even.groups["plate"], odd.groups["plate/odd"] = own, odd_own

        def motions(span: Span) -> list[Array]:
            beside = ((even, own), (odd, odd_own)) if span.odd else ((even, own),)
            return [
                half.leading([both[n][span.name] for both in found], known, TOLERANCE, span.columns)
                for n, (half, known) in enumerate(beside)
            ]

        for span, V in zip(spans, pool.map(motions, spans), strict=True):
            even.groups[span.name] = V[0]
            if span.odd:
                odd.groups[f"{span.name}/odd"] = V[1]
            progress(0.8 + 0.1 * len(even.groups) / len(spans))
        return _project(full, even, odd, spans, pool)


def _points() -> list[tuple[float, complex]]:
    """Frequencies from 12 to 420 Hz, moduli from 0.1 to 10 MPa, lossy; a low-discrepancy set."""
    s = (0.5 + np.arange(SNAPSHOTS) * 0.7549) % 1
    t = (0.5 + np.arange(SNAPSHOTS) * 0.5698) % 1
    omega = 2 * np.pi * 12 * 35.0**s
    return [(float(w), complex(1e5 * 100.0**m * (1 + 0.6j))) for w, m in zip(omega, t, strict=True)]


def _responses(
    full: FullPlate, halves: tuple[Motions, Motions], spans: Sequence[Span], point: tuple[float, complex]
) -> tuple[dict[str, Stirred], dict[str, Stirred]]:
    """To the pickup and of each span, by its name: even motions, and odd ones where it has any."""
    even, odd = halves
    at = full.snapshot(*point)
    size = np.sqrt(np.real(np.vdot(at.x, times(full.scale, at.x))))
    at = replace(at, x=at.x / size, z=at.both[:, 1] / size)
    forces = [span.forces(full, at) for span in spans]
    answers = at.answers(forces, [span.odd for span in spans])
    found = {span.name: span.responses(full, at, X) for span, X in zip(spans, answers, strict=True)}
    twisting = {span.name: found[span.name] for span in spans if span.odd} | {"plate": at.both[:, 1:]}
    return (
        dict(zip(found, even.stirred(list(found.values())), strict=True)),
        dict(zip(twisting, odd.stirred(list(twisting.values())), strict=True)),
    )


def _project(
    full: FullPlate, even: Motions, odd: Motions, spans: Sequence[Span], pool: ThreadPoolExecutor
) -> SpannedPlate:
    loose, s = full.loose, full.specimen
    V = np.hstack([half.half.P @ half.columns for half in (even, odd)])
    matrices: dict[str, Array] = {}
    vectors: dict[str, Array] = {}
    of_spans = [(f"{span.name}.{name}", A) for span in spans for name, A in span.matrices(full).items()]
    projected = pool.map(lambda named: _between(V, named[1]), of_spans)
    parts = [
        pool.submit(projected_parts, loose, half.half.P @ half.columns, one_parity=True)
        for half in (even, odd)
    ]
    for span in spans:
        vectors |= {f"{span.name}.{name}": V.T @ v for name, v in span.vectors(full).items()}
    for (name, _), A in zip(of_spans, projected, strict=True):
        matrices[name] = A
    k = V.shape[1]
    both = _in_blocks([found.result() for found in parts])
    stated = coefficients(s, s)
    # The inertia of held nodes loads their neighbours.
    of_load = V.T @ load_part(s)[loose.free]
    K_0, K_1, M = np.split(both, np.cumsum([len(STIFFNESS), len(CORE)]))
    return SpannedPlate(
        group=np.array(even.names + odd.names),
        M=np.tensordot(stated.M, M, axes=1),
        K_0=np.tensordot(stated.K_0, K_0, axes=1),
        K_1=np.tensordot(stated.K_1, K_1, axes=1),
        U=V.T @ (loose.M @ _over_mass(full)),
        d=full.damping.d,
        load=-stated.load * of_load,
        pitch=-V.T @ (loose.M @ full.pitching),
        observe=V.T @ loose.observe(*full.pickup_m),
        gram=la.block_diag(even.gram, odd.gram),
        names=np.array(list(matrices), dtype=str),
        matrices=np.array(list(matrices.values())).reshape(-1, k, k),
        vector_names=np.array(list(vectors), dtype=str),
        vectors=np.array(list(vectors.values())).reshape(-1, k),
        deflection=loose.on_nodes(V)[:, [W, THETA_X, THETA_Y]],
        size=np.array([s.length_m, s.width_m, loose.mesh.n_x, loose.mesh.n_y], dtype=float),
        pickup=np.array(full.pickup_m),
        parts=both,
        load_part=of_load,
        layers=layers_of(s),
    )


def _in_blocks(parts: Sequence[Array]) -> Array:
    """Stacks of matrices along the diagonal. Shape (count, k, k)."""
    k = sum(p.shape[1] for p in parts)
    found, at = np.zeros((len(parts[0]), k, k)), 0
    for p in parts:
        there = slice(at, at + p.shape[1])
        found[:, there, there] = p
        at = there.stop
    return found


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
    """Phi of C_1 = M Phi diag(d) Phi^T M, on the loose plate. Shape (n, modes)."""
    found = np.zeros((full.loose.size, len(full.damping.d)))
    for held in full.halves:
        half = held.half
        found += held.up @ half.chain.factorise(half.M)(half.down @ full.damping.U)
    return found


def _starting(names: Names, prefixes: tuple[str, ...]) -> NDArray[np.intp]:
    """Places of the names that begin with one of some prefixes."""
    found = [k for k, n in enumerate(names) if prefixes and str(n).startswith(prefixes)]
    return np.array(found, dtype=np.intp)
