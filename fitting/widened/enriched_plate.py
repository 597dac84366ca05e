"""The reduced plate widened so that it can carry every effect: small matrices, columns in named groups.

A column is one motion of the plate; motions are sums of columns. The first columns are the unchanged
plate's own (`ReducedPlate`). Each `Span` adds the few motions that its effects need beside them. A fit takes
the plate's own columns and those of its effects alone.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, as_slice
from fitting.plate.layers_array import specimen_of
from fitting.plate.mesh import Mesh
from fitting.plate.parts import Coefficients, coefficients
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.widened.combined_columns import AllCombined, OwnCombined, own_and_beside
from fitting.widened.plate_rows import RowReader
from fitting.widened.span import Span

Names = NDArray[np.str_]
Place = tuple[float, float]
"""On the plate, in m."""

ROUGHLY = 1e-3
"""Of the largest singular value, what a plate to choose between starts leaves out: it is off by 3e-4 with
stated numbers two tolerances off."""
_LEADING = 0.7
"""Of the motions that an effect adds, which come the largest first, those that such a plate keeps: its nodes
are too few to tell what the rest does. A choice."""
_MIXED = "mixed"
"""Group of columns that are of several spans, in no order."""
_PART = "part"
"""Group of the motion of a part on the plate."""
_MOST_TAKEN = 12
"""Plates with some spans' columns that are kept. A bound on memory: one takes up to 6 MB."""
_MADE_ANEW = ("_taken", "_stacks", "_reader", "roughly", "with_part")
"""Another process makes these anew."""


@dataclass(frozen=True)
class EnrichedReducedPlate:
    """Matrices on k columns. Inputs: unit heave and pitch of the base; output: w at the pickup.

    A x = load a + pitch h a, w = observe x, A = -omega^2 M + i omega U diag(d) U^T + K_0 + G K_1.
    """

    group: Names
    """Of every column: "plate" or a span's name, ending in "/odd" for motions odd in y."""
    M: Array
    """Mass in kg. Shape (k, k)."""
    K_0: Complex
    """Stiffness without the core's shear modulus in N/m, with the faces' loss. Shape (k, k)."""
    K_1: Array
    """Stiffness for a core modulus of one, in N/m per Pa. Shape (k, k)."""
    U: Array
    """Damped modes, times the mass: M Phi in kg^1/2; a narrow resonance's too. Shape (k, modes)."""
    d: Array
    """2 zeta omega of each of these modes in rad/s, zero of a narrow resonance. Shape (modes,)."""
    load: Array
    """Force in N for a base acceleration of 1 m/s^2, or for a force of 1 N. Shape (k,)."""
    pitch: Array
    """Force in N for a base that pitches with 1 rad/s^2; zero where a force drives. Shape (k,)."""
    observe: Array
    """The row that reads the deflection w at the pickup, m per m of each column. Shape (k,)."""
    gram: Array
    """Inner products of the columns."""
    names: Names
    """Names of `matrices`, in order."""
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
    """By what is stated (`fitting.plate.parts`). Shape (parts, k, k)."""
    load_part: Array
    """Shape (k,); of a small structure, and of a plate not treated all over, (parts, k)."""
    layers: Array
    """What is stated of them (`layers_array.layers_of`), zero for a plate that carries no effects."""
    shares: Array = field(default_factory=lambda: np.empty(0))
    """Singular values of its own columns, which are the first then. Shape (own,); empty if not condensed."""

    def take(self, spans: Iterable[Span]) -> "EnrichedReducedPlate":
        """The plate on its own columns and those of `spans`, matrices of other spans left out.

        The latest are kept: a search comes back to the same few.
        """
        spans = list(spans)
        key = frozenset(s.name for s in spans)
        if key not in self._taken:
            while len(self._taken) >= _MOST_TAKEN:
                del self._taken[next(iter(self._taken))]
            self._taken[key] = self._take(spans)
        return self._taken[key]

    @cached_property
    def _taken(self) -> dict[frozenset[str], "EnrichedReducedPlate"]:
        return {}

    def __getstate__(self) -> dict[str, object]:
        # Another process takes what it needs itself.
        return {name: value for name, value in vars(self).items() if name not in _MADE_ANEW}

    def _take(self, spans: Sequence[Span]) -> "EnrichedReducedPlate":
        groups = {"plate", *(s.name for s in spans)}
        if any(s.odd for s in spans):
            groups |= {"plate/odd", *(f"{s.name}/odd" for s in spans)}
        prefixes = tuple(f"{s.name}." for s in spans)
        kept = _starting(self.names, prefixes)
        kept_vectors = _starting(self.vector_names, prefixes)
        on_fewer = replace(
            self,
            names=self.names[kept],
            matrices=self.matrices[kept],
            vector_names=self.vector_names[kept_vectors],
            vectors=self.vectors[kept_vectors],
        )
        taken = on_fewer._keeping(np.flatnonzero(np.isin(self.group, list(groups))))
        overlap = len(spans) > 1 or any(s.overlaps for s in spans)
        return taken._independent() if overlap else taken

    @cached_property
    def roughly(self) -> "EnrichedReducedPlate":
        """The same without those columns that matter least; itself where it was not condensed."""
        if not len(self.shares):
            return self
        kept = np.ones(len(self.load), dtype=bool)
        kept[: len(self.shares)] = self.shares > ROUGHLY * self.shares[0]
        for name in {*self.group} - {"plate", _MIXED}:
            beside = np.flatnonzero(self.group == name)
            kept[beside[int(np.ceil(_LEADING * len(beside))) :]] = False
        return replace(self._keeping(np.flatnonzero(kept)), shares=np.empty(0))

    @cached_property
    def with_part(self) -> "EnrichedReducedPlate":
        """The same with one motion more, that of a part on it: vector `part` is that motion.

        Nothing moves it and it moves nothing, until an effect couples it; it is held by a unit spring.
        """
        k = len(self.load)
        part = np.eye(k + 1)[k]
        held = np.outer(part, part)
        beside = self._on(np.eye(k, k + 1), np.append(self.group, _PART))
        return replace(
            beside,
            K_0=beside.K_0 + held,
            gram=beside.gram + held,
            vector_names=np.append(self.vector_names, "part"),
            vectors=np.vstack([beside.vectors, part]),
        )

    def _keeping(self, columns: NDArray[np.intp]) -> "EnrichedReducedPlate":
        """On some of its columns."""
        square = np.ix_(columns, columns)
        return replace(
            self,
            group=self.group[columns],
            **{name: getattr(self, name)[square] for name in ("M", "K_0", "K_1", "gram")},
            **{name: getattr(self, name)[columns] for name in ("U", "load", "pitch", "observe")},
            load_part=self.load_part[..., columns],
            parts=_squares(self.parts, columns),
            matrices=_squares(self.matrices, columns),
            vectors=self.vectors[:, columns],
            deflection=self.deflection[:, :, columns],
        )

    @classmethod
    def plain(
        cls, reduced: ReducedPlate, mesh: Mesh, pickup_m: tuple[float, float]
    ) -> "EnrichedReducedPlate":
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

    def _independent(self) -> "EnrichedReducedPlate":
        """Its own columns, and an orthonormal basis of what is beside them: two spans may share some."""
        own = self.group == "plate"
        T = own_and_beside(self.gram, own)
        if T is None:
            return self
        return self._on(T, np.where(np.arange(T.shape[1]) < own.sum(), "plate", _MIXED))

    def _on(self, T: Array, group: Names) -> "EnrichedReducedPlate":
        """On the combinations T of its columns. Shape (k, fewer)."""
        return self.combined(AllCombined(T), group)

    def combined(self, on: AllCombined | OwnCombined, group: Names) -> "EnrichedReducedPlate":
        """On some combinations of its columns, which `group` names. Shape (fewer,)."""
        square, along = on.square, on.along
        return replace(
            self,
            group=group,
            M=square(self.M),
            K_0=square(self.K_0),
            K_1=square(self.K_1),
            gram=square(self.gram),
            matrices=square(self.matrices),
            parts=square(self.parts),
            load_part=along(self.load_part),
            U=along(self.U.T).T,
            load=along(self.load),
            pitch=along(self.pitch),
            observe=along(self.observe),
            vectors=along(self.vectors),
            deflection=along(self.deflection),
        )

    @cached_property
    def specimen(self) -> PlateSpecimen:
        """As stated, as far as `parts` go."""
        return specimen_of(self.size, self.layers)

    @cached_property
    def coefficients(self) -> Coefficients:
        """Of its `parts`, as stated."""
        return coefficients(self.specimen, self.specimen)

    @cached_property
    def _place(self) -> dict[str, int]:
        return {str(n): k for k, n in enumerate(self.names)}

    def viscous(self, factor: Array | float = 1.0) -> Array:
        """C_1, its modes' damping times a factor: one, or one of each. Shape (k, k)."""
        return np.asarray((self.U * (self.d * factor)) @ self.U.T)

    def matrix(self, name: str) -> Array:
        """A span's matrix. Shape (k, k)."""
        return np.asarray(self.matrices[self._place[name]])

    def stack(self, prefix: str) -> Array:
        """Matrices whose names begin so, in order. Shape (count, k, k)."""
        if prefix not in self._stacks:
            self._stacks[prefix] = self.matrices[as_slice(_starting(self.names, (prefix,)))]
        return self._stacks[prefix]

    @cached_property
    def _stacks(self) -> dict[str, Array]:
        return {}

    def vector(self, name: str) -> Array:
        """A span's vector. Shape (k,)."""
        return np.asarray(self.vectors[[str(n) for n in self.vector_names].index(name)])

    @cached_property
    def pickup_row(self) -> Array:
        """`row` where it is stated to be read. Shape (k,)."""
        return self.row(*self.pickup)

    def at(self, force_m: Place | None, pickup_m: Place) -> "EnrichedReducedPlate":
        """The same driven by a force at a point, or as it is, and read at another point."""
        observe = self.row(*pickup_m)
        load = self.load if force_m is None else self.row(*force_m)
        return replace(self, load=load, observe=observe, pickup=np.array(pickup_m))

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
        return self._reader.row(x_m, y_m, dx, dy)

    @cached_property
    def _reader(self) -> RowReader:
        return RowReader(self.deflection, self.size)


def _squares(stack: Array, columns: NDArray[np.intp]) -> Array:
    """Some rows and columns of every matrix of a stack.

    Taken at once: one by one they would lie across, and every sum set them right again. Shape (count, k, k).
    """
    k, n = stack.shape[-1], len(columns)
    places = (k * columns[:, None] + columns).ravel()
    return np.asarray(np.take(stack.reshape(-1, k * k), places, axis=1).reshape(-1, n, n))


def _starting(names: Names, prefixes: tuple[str, ...]) -> NDArray[np.intp]:
    """Places of the names that begin with one of some prefixes."""
    found = [k for k, n in enumerate(names) if prefixes and str(n).startswith(prefixes)]
    return np.array(found, dtype=np.intp)
