"""A small structure: full matrices of the equation, by what is stated, for unit coefficients.

    (-omega^2 M + i omega C_1 + K_0 + G* K_1) X = load,   K_0 = sum of c_p P_p,   so K_1, M, load

It needs no reduced basis, and answers at every frequency by itself. What fits and effects are given is the
same kind of object as the widened reduced plate (`fitting.effects.enriched_plate`): its columns are the
unknowns themselves, in groups where some are for an effect alone.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Complex, Mask
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate, Names
from fitting.errors import OutsideModel
from fitting.model_error import ModelError
from fitting.nuisance import Nuisance
from fitting.nuisances import Nuisances, Spot
from fitting.placed import Placed
from fitting.rational import RationalSweep
from fitting.specimen import StatedSpecimen

_ROUNDED = 1e-13
"""Of the largest: smaller eigenvalues are rounding."""
_NEAR = 1e4
"""Of g/|g - G|, G the nearest modulus of a resonance without losses."""
_SHARED, _BANDS = 100, 4
"""Points from which on two threads share them, a millisecond's work, and the bands that they share."""
_STILL = 1e-9
"""A reading below this reads nothing but rounding."""
_WIDE, _STEP = 0.1, 1e-3
"""Relative tolerance beyond which derivatives are taken where a number is, and their step in tolerances."""
_LOSSY = 0.8
"""Argument of the modulus that a rational sum is made about, rad: far from every resonance."""


@dataclass(frozen=True)
class Parts:
    """Matrices and loads for unit coefficients. Shapes (parts, k, k), the load's (parts, k)."""

    K_0: Array
    K_1: Array
    M: Array
    load: Array
    observe: Array
    """Reads the displacement relative to the base. Shape (k,)."""
    matrices: Mapping[str, Array]
    """What effects may ask for, by name. Shape (k, k) each."""
    deflection: Array
    """w, dw/dy and -dw/dx of every unknown at every node of a strip one element wide. Shape (nodes, 3, k)."""
    size: tuple[float, float, int, int]
    """Length and width in m, elements along each."""
    pickup_m: tuple[float, float]
    group: Names | None = None
    """Of every unknown, as `EnrichedReducedPlate` has it; None: all are its own. Shape (k,)."""
    gram: Array | None = None
    """Inner products of the unknowns; None: one. Shape (k, k)."""
    pitch: Array | None = None
    """Load of a turning base; None: none turns it. Shape (k,)."""
    vectors: Mapping[str, Array] = field(default_factory=dict)
    """What else effects may ask for. Shape (k,) each."""

    @property
    def unknowns(self) -> int:
        """How many there are."""
        return len(self.observe)


class SmallSpecimen(StatedSpecimen, Protocol):
    """What a specimen says of itself so that it can be fitted."""

    @property
    def numbers(self) -> tuple[str, ...]:
        """Kinds of stated numbers that move its matrices."""

    @property
    def places(self) -> Mapping[str, float]:
        """Points along it that are stated in m: `pickup`, `force`. None where it has no length."""

    def parts(self) -> Parts:
        """Its matrices for unit coefficients."""

    def coefficients(self, by: Mapping[str, float]) -> Complex:
        """Of the parts of K_0, K_1, M and the load in this order, its numbers moved. Shape (parts,).

        `by` gives changes of the numbers, relative ones in the logarithm.
        """

    def tolerance(self, name: str) -> float:
        """Standard deviation of a stated number."""

    def theory_error(self, frequency_hz: Array, G: Complex) -> ModelError | None:
        """What its theory gets wrong around some frequencies, the core's modulus given; None: nothing.

        Shape (points,) each.
        """

    def stated_number(self, kind: str) -> tuple[float, float, str]:
        """A number in SI, the factor to the unit of results, and that unit."""


@dataclass(frozen=True)
class SmallNuisances(Nuisances):
    """The stated numbers of a small structure as unknowns."""

    specimen: SmallSpecimen  # type: ignore[assignment]
    parts: Parts | None = None
    """What their coefficients multiply."""

    @property
    def reads_at_a_place(self) -> bool:
        """Whether the row that reads it moves with stated numbers."""
        return "pickup" in self.specimen.places

    @property
    def counts(self) -> tuple[int, int, int]:
        """How many parts K_0, K_1 and M have."""
        assert self.parts is not None
        return len(self.parts.K_0), len(self.parts.K_1), len(self.parts.M)

    @cached_property
    def _of_plate(self) -> list[int]:
        return [k for k, n in enumerate(self.each) if n.kind in self.specimen.numbers]

    @cached_property
    def _stated(self) -> Array:
        return np.asarray(_real_where_it_is(self.specimen.coefficients({})))

    def _coefficients(self, z: Array) -> Array:
        by = {self.each[k].name: float(self._sigma[k] * z[k]) for k in self._of_plate}
        return np.asarray(_real_where_it_is(self.specimen.coefficients(by)))

    def _by_coefficients(self, z: Array) -> Array:
        found = super()._by_coefficients(z)
        for k in self._of_plate:
            # A number that may be off by much is no longer nearly linear.
            if self._sigma[k] > _WIDE and self.each[k].unit == "1":
                found = found.copy()
                up, down = z.copy(), z.copy()
                up[k], down[k] = z[k] + _STEP, z[k] - _STEP
                found[k] = (self._coefficients(up) - self._coefficients(down)) / (2 * _STEP)
        return found

    def _load(self, plate: EnrichedReducedPlate, c: Array) -> Array:
        # Their sign is in the parts.
        return np.asarray(c[sum(self.counts) :].real @ plate.load_part)

    def _by_load(self, plate: EnrichedReducedPlate, adjoint: Complex, z: Array) -> Complex:
        return np.asarray(
            -self.by_coefficients(z)[:, sum(self.counts) :].real @ (plate.load_part @ adjoint.T)
        )

    def _row_change(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        return super()._row_change(plate, z) if self.reads_at_a_place else np.zeros(len(plate.observe))

    def rows_by(self, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        """As `Nuisances.rows_by`; none where no place is stated. Of `z`, shape (numbers,)."""
        return super().rows_by(plate, z) if self.reads_at_a_place else {}

    def _force_change(self, plate: EnrichedReducedPlate, z: Array) -> Array | float:
        if "force" not in self.specimen.places:
            return 0.0
        (x, _), (y, _) = self._spot("force", z)
        return plate.row(x, y) - plate.row(self.specimen.places["force"], 0.0)

    def placed(self, plate: EnrichedReducedPlate, z: Array) -> EnrichedReducedPlate:
        """The same, read and driven where these numbers say. `z` of shape (numbers,)."""
        observe, load = self._row_change(plate, z), self._force_change(plate, z)
        return replace(plate, observe=plate.observe + observe, load=plate.load + load)

    def _spot(self, spot: Spot, z: Array) -> Placed:
        return self._points.at((self.specimen.places[spot], 0.0), spot, z)


def _real_where_it_is(c: Complex) -> Complex | Array:
    return c if np.any(np.imag(c)) else np.real(c)


def nuisances_of(specimen: SmallSpecimen, parts: Parts, *, has_phase: bool) -> SmallNuisances:
    """All its stated numbers, and those of the channels."""
    kinds = {n: n for n in (*specimen.numbers, "gain", *(["delay"] if has_phase else []))}
    kinds |= {f"{n}_x": n for n in specimen.places}
    each = [Nuisance(name, kind, specimen.tolerance(kind)) for name, kind in kinds.items()]
    return SmallNuisances(specimen, tuple(n for n in each if n.sigma > 0), None, parts)


@dataclass(frozen=True)
class SmallSystem(EnrichedReducedPlate):
    """As fits and effects take it; it knows how its stated numbers change it."""

    stated: SmallSpecimen | None = None
    counts: tuple[int, int, int] = (0, 0, 0)
    """How many parts K_0, K_1 and M have."""

    def moved(self, by: Mapping[str, float]) -> Change:
        """What it becomes with some numbers moved, as `SmallSpecimen.coefficients` takes them."""
        s = self.stated
        assert s is not None
        c = s.coefficients(by) - s.coefficients({})
        n_0, n_1, n_M = self.counts
        K, K_1, M = (
            np.tensordot(c[a:b], self.parts[a:b], axes=1)
            for a, b in ((0, n_0), (n_0, n_0 + n_1), (n_0 + n_1, n_0 + n_1 + n_M))
        )
        load = c[n_0 + n_1 + n_M :].real @ self.load_part
        return Change(K=_real_where_it_is(K), K_1=K_1.real, M=M.real, load=load)


def system_of(
    specimen: SmallSpecimen, parts: Parts, by: Mapping[str, float] | None = None
) -> EnrichedReducedPlate:
    """As stated, or its numbers moved (`SmallSpecimen.coefficients`), on its own unknowns alone."""
    return widened_system_of(specimen, parts, by).take([])


def widened_system_of(
    specimen: SmallSpecimen, parts: Parts, by: Mapping[str, float] | None = None
) -> SmallSystem:
    """The same with the unknowns that effects need."""
    n_0, n_1, n_M = len(parts.K_0), len(parts.K_1), len(parts.M)
    c = specimen.coefficients(by or {})
    k = parts.unknowns
    return SmallSystem(
        group=np.full(k, "plate") if parts.group is None else parts.group,
        M=_sum(c[n_0 + n_1 : n_0 + n_1 + n_M], parts.M, k).real,
        K_0=_sum(c[:n_0], parts.K_0, k),
        K_1=_sum(c[n_0 : n_0 + n_1], parts.K_1, k).real,
        U=np.zeros((k, 0)),
        d=np.zeros(0),
        load=c[n_0 + n_1 + n_M :].real @ parts.load,
        pitch=np.zeros(k) if parts.pitch is None else parts.pitch,
        observe=parts.observe,
        gram=np.eye(k) if parts.gram is None else parts.gram,
        names=np.array(list(parts.matrices), dtype=str),
        matrices=np.array(list(parts.matrices.values())).reshape(-1, k, k),
        vector_names=np.array(list(parts.vectors), dtype=str),
        vectors=np.array(list(parts.vectors.values())).reshape(-1, k),
        deflection=parts.deflection,
        size=np.array(parts.size, dtype=float),
        pickup=np.array(parts.pickup_m),
        parts=np.concatenate([parts.K_0, parts.K_1, parts.M]),
        load_part=parts.load,
        layers=np.zeros((3, 5)),
        stated=specimen,
        counts=(n_0, n_1, n_M),
    )


def check_driven(parts: Parts, specimen: SmallSpecimen) -> None:
    """Raise `OutsideModel` where nothing drives it, or nothing is read."""
    # What effects let go moves where the specimen as stated is held.
    own = slice(None) if parts.group is None else parts.group == "plate"
    if not np.any(np.abs(parts.load[..., own]) > _STILL):
        if specimen.drive == "force":
            raise OutsideModel("[excitation] lies on a held end, expected x_mm of a point that moves")
        raise OutsideModel(f"a free {specimen.kind} has no base to be excited by, expected another boundary")
    if not np.any(np.abs(parts.observe[own]) > _STILL):
        raise OutsideModel("[pickup] is missing or lies on a held end, expected x_mm of a point that moves")


def _sum(c: Complex, P: Array, k: int) -> Complex:
    return np.asarray(np.tensordot(c, P, axes=1)) if len(P) else np.zeros((k, k), complex)


def rational_of(
    system: EnrichedReducedPlate,
    omega: Array,
    size_pa: float,
    condensed: Callable[[EnrichedReducedPlate, Array], EnrichedReducedPlate] | None = None,
) -> RationalSweep:
    """The same system at some frequencies (rad/s) as a sum in G*, about a modulus of a size. Shape (n,).

    `condensed` gives what answers in a band, from the system and the band's frequencies: over many points few
    bands are each answered by fewer motions than all of them need together.
    """
    omega = np.asarray(omega, dtype=float)
    G_ref = complex(size_pa * np.exp(1j * _LOSSY))

    def terms(band: NDArray[np.intp]) -> tuple[Complex, Complex]:
        own = condensed(system, omega[band]) if condensed else system
        return _terms(own, omega[band], G_ref)

    if len(omega) < _SHARED:
        return RationalSweep(omega, G_ref, *terms(np.arange(len(omega))))
    bands = np.array_split(np.argsort(omega, kind="stable"), _BANDS)
    # The upper ones take longest: they come first.
    bands.reverse()
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        found = list(pool.map(terms, bands))
    c, mu = (np.zeros((len(omega), max(mu.shape[1] for _, mu in found)), complex) for _ in range(2))
    for band, (some_c, some_mu) in zip(bands, found, strict=True):
        c[band, : some_c.shape[1]], mu[band, : some_mu.shape[1]] = some_c, some_mu
    return RationalSweep(omega, G_ref, c, mu)


def _terms(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    """Terms c and mu of the sum at each frequency. Shape (n, any) each."""
    try:
        B = _only_core_loses(system, omega, G_ref)
        if B is None:
            return _complex_terms(system, omega, G_ref)
        c, mu, near = _real_terms(system, B, omega, G_ref)
    except np.linalg.LinAlgError:
        # A resonance to the last digit.
        return _complex_terms(system, omega, G_ref)
    if near.any():
        # Beside a resonance of real numbers these are of no use.
        c[near], mu[near] = 0.0, 0.0
        c[near, 1:], mu[near, 1:] = _complex_terms(system, omega[near], G_ref)
    return c, mu


def _complex_terms(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    """Whatever loses energy. Shape (n, k) each."""
    w = omega[:, None, None]
    C_1 = (system.U * system.d) @ system.U.T
    A = system.K_0 + G_ref * system.K_1 - w**2 * system.M + 1j * w * C_1
    sides = np.concatenate([system.K_1, system.load[:, None]], axis=1).astype(complex)
    solved = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
    mu, Y = np.linalg.eig(solved[:, :, :-1])
    weights = np.linalg.solve(Y, solved[:, :, -1:])[:, :, 0]
    return (system.observe @ Y) * weights, mu


def _only_core_loses(system: EnrichedReducedPlate, omega: Array, G_ref: complex) -> Array | None:
    """B with K_1 = B B^T, where K_0 is real and nothing damps; else None. Shape (k, k)."""
    if np.any(np.imag(system.K_0)) or np.any(system.d):
        return None
    # In units of all that moves: sizes of unknowns differ by orders, and what is small counts as much.
    whole = np.real(system.K_0) + abs(G_ref) * system.K_1 + omega.max() ** 2 * system.M
    L = np.linalg.cholesky(whole)
    values, Q = np.linalg.eigh(
        la.solve_triangular(L, la.solve_triangular(L, system.K_1, lower=True).T, lower=True)
    )
    if values[0] < -_ROUNDED * values[-1]:
        return None
    return np.asarray(L @ Q * np.sqrt(np.maximum(values, 0.0)))


def _real_terms(
    system: EnrichedReducedPlate, B: Array, omega: Array, G_ref: complex
) -> tuple[Complex, Complex, Mask]:
    """The same in real numbers, and where they are near a resonance. Shapes (n, k + 1) twice, (n,).

    About g = |G_ref| A = K_0 + g K_1 - w^2 M is real and symmetric.

    With H = B^T A^-1 B = Z diag(h) Z^T the response o^T (A + (G - g) B B^T)^-1 f is, by Woodbury's identity,
    o^T A^-1 f - sum p q (G - g) / (1 + (G - g) h), p = Z^T B^T A^-1 o, q = Z^T B^T A^-1 f.
    """
    g = abs(G_ref)
    A = np.real(system.K_0) + g * system.K_1 - omega[:, None, None] ** 2 * system.M
    sides = np.concatenate([B, system.load[:, None]], axis=1)
    solved = np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape)))
    h, Z = np.linalg.eigh(B.T @ solved[:, :, :-1])
    p, q = ((v[:, None, :] @ Z)[:, 0] for v in (system.observe @ solved[:, :, :-1], solved[:, :, -1] @ B))
    # What hardly depends on G is left to the term without it.
    moves = np.abs(h) > _ROUNDED * np.abs(h).max(axis=1, keepdims=True)
    c = np.where(moves, p * q / np.where(moves, h, 1.0), 0.0)
    rest = solved[:, :, -1] @ system.observe - c.sum(axis=1)
    # About the modulus wanted: 1 + (G - g) h = s (1 + (G - G_ref) h / s).
    s = 1 + (G_ref - g) * h
    c, mu = np.column_stack([rest, c / s]), np.column_stack([np.zeros(len(omega)), h / s])
    return c.astype(complex), mu.astype(complex), g * np.abs(h).max(axis=1) > _NEAR


def displacement(system: EnrichedReducedPlate, omega: Array, G: Complex) -> Complex:
    """Relative displacement at the reading for a unit load, by a full solve. Shape (points,)."""
    w = np.asarray(omega, dtype=float)[:, None, None]
    C_1 = (system.U * system.d) @ system.U.T
    A = system.K_0 + np.asarray(G)[:, None, None] * system.K_1 - w**2 * system.M + 1j * w * C_1
    load = np.broadcast_to(system.load.astype(complex)[:, None], (len(omega), len(system.load), 1))
    return np.asarray(np.linalg.solve(A, load)[:, :, 0] @ system.observe)
