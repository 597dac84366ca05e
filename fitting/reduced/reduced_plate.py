"""The reduced model: the plate projected once on a few certified vectors, G* still outside.

The basis holds responses to what drives it and to the pickup (the adjoint), of further spots too, over a
whole domain of frequency and modulus, so one basis serves every law. What is missed is judged by
the residuals of both: the pickup's error is r_adjoint^T A^-1 r, quadratic in what the basis lacks.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Complex
from fitting.dynamics.damping import LowRankDamping
from fitting.dynamics.half_plate import HalfPlate
from fitting.numerics.linear import times
from fitting.plate.assembly import Assembly
from fitting.plate.element import THETA_X, THETA_Y, W
from fitting.plate.part_matrices import moving_part, on_motions, projected_parts, stated_steps
from fitting.plate.plate import Plate
from fitting.progress import Report, unheard
from fitting.reduced.domain import Domain
from fitting.reduced.resonance_parts import Answers
from fitting.specimen import PlateSpecimen

Point = tuple[float, complex]

TOLERANCE = 1e-6
"""Relative error of the pickup's reading that the basis is built for."""
LARGEST_BASIS = 60
"""A bound on time and memory: `estimated_error` says what was reached."""
FOLLOWING, MOST_FOLLOWING = 5e-4, 20
"""What further vectors may leave of the answers' change by a typical tolerance of a stated number, and how
many there may be: two tolerances off, answers are then good to 1e-4."""
_OF_A_FACE = ("young", "thickness", "poisson")
_FACES = tuple(f"{layer}_{n}" for layer in ("substrate", "constraining") for n in _OF_A_FACE)
"""What the basis does not follow by itself: it spans moduli of the core and frequencies."""
_SPREAD, _STIRRED = 8, 6
"""Points over the domain that a basis begins with, and those of them where stated numbers are followed."""


def _followed(specimen: PlateSpecimen) -> tuple[str, ...]:
    """Stated numbers whose tolerances move it as moduli and frequencies do not."""
    return (*_FACES, *(f"axial_{a}" for a in specimen.pulled_along))


@dataclass(frozen=True)
class ReducedPlate:
    """The plate on its basis of k vectors, for a unit of what drives it, read at the pickup.

    A x = load, w = observe x, with A as `matrices` has it and C_1 = U diag(d) U^T.
    """

    M: Array
    """Mass in kg. Shape (k, k)."""
    K_0: Complex
    """Stiffness without the core's shear modulus in N/m, with the faces' loss. Shape (k, k)."""
    K_1: Array
    """Stiffness for a core modulus of one, in N/m per Pa. Shape (k, k)."""
    U: Array
    """Damped modes, times the mass: M Phi in kg^1/2. Shape (k, damped modes)."""
    d: Array
    """2 zeta omega of each damped mode in rad/s. Shape (damped modes,)."""
    mode: NDArray[np.intp]
    """Which of the stated ratios each column of U has, from 0."""
    load: Array
    """Force in N for a base acceleration of 1 m/s^2, or for a force of 1 N. Shape (k,)."""
    observe: Array
    """The row that reads the deflection w at the pickup, m per m of each vector. Shape (k,)."""
    further: Array
    """Rows of the specimen's further spots, forces there too. Shape (spots, k)."""
    domain: Domain
    parts: Array
    """Of K_0, K_1 and M by what is stated (`fitting.plate.parts`), one after another. Shape (parts, k, k)."""
    load_part: Array
    """Shape (k,); where not all of the plate is treated (loads, k)."""
    deflection: Array
    """w, dw/dy and -dw/dx of every vector at every node. Shape (nodes, 3, k)."""
    gram: Array
    """Inner products, in the inverse stiffness, of `sides`, M V, K_0' V, K_0'' V, K_1 V and U."""
    V: Array
    """The basis over `Plate.carried`. Shape (carried, k)."""

    def matrices(self, omega: Array, G: Complex) -> Complex:
        """A = -omega^2 M + i omega C_1 + K_0 + G K_1. Shape (points, k, k)."""
        w, g = np.asarray(omega, dtype=float), np.asarray(G, dtype=complex)
        C_1 = (self.U * self.d) @ self.U.T
        factors = np.stack([np.ones_like(g), g, -(w**2), 1j * w], axis=1)
        # One product: several times faster than sums of stacks of matrices.
        each = np.stack([self.K_0, self.K_1, self.M, C_1]).astype(complex).reshape(4, -1)
        return np.asarray((factors @ each).reshape(len(w), *self.M.shape))

    @property
    def sides(self) -> Array:
        """What drives it, the pickup and the further spots. Shape (2 + spots, k)."""
        return np.vstack([self.load, self.observe, self.further])

    def between(self, driven: int, read: int) -> "ReducedPlate":
        """The same on one of `sides`, read at another."""
        sides, count = self.sides, 2 + len(self.further)
        kept = np.array([driven, read, *range(count, len(self.gram))])
        return replace(
            self,
            load=sides[driven],
            observe=sides[read],
            further=self.further[:0],
            gram=self.gram[np.ix_(kept, kept)],
        )

    def displacement(self, omega: Array, G: Complex) -> Complex:
        """Relative displacement at the pickup for a base acceleration of 1 m/s^2 or a force of 1 N, in m.

        Shape (points,).
        """
        return np.asarray(self._solve(omega, G)[0])

    def estimated_error(self, omega: Array, G: Complex) -> Array:
        """Estimated relative error of `displacement`, the largest between any two of `sides`, by residuals.

        Shape (points,).
        """
        return np.asarray(self._solve(omega, G)[1])

    def answers(self, omega: Array, G: Complex) -> Answers:
        """To what drives it and to the pickup. Shape (points,) of `omega` and `G`."""
        rhs = np.stack([self.load, self.observe], axis=1).astype(complex)
        both = np.broadcast_to(rhs, (len(omega), *rhs.shape))
        q, z = np.moveaxis(np.linalg.solve(self.matrices(omega, G), both), 2, 0)
        return Answers(self.K_0, self.K_1, self.M, self.observe, q, z, G)

    def _solve(self, omega: Array, G: Complex) -> tuple[Complex, Array]:
        displacement, error = [], []
        sides = self.sides
        for start in range(0, len(omega), 256):
            w, g = np.asarray(omega)[start : start + 256], np.asarray(G)[start : start + 256]
            rhs = sides.T.astype(complex)
            both = np.broadcast_to(rhs, (len(w), *rhs.shape))
            q: Complex = np.linalg.solve(self.matrices(w, g), both).astype(complex, copy=False)
            x = q[:, :, 0] @ self.observe
            displacement.append(x)
            norms = [self._residual_norm(w, g, q[:, :, side], side) for side in range(len(sides))]
            worst = norms[0] * norms[1] / np.abs(x)
            for i, k in combinations(range(len(sides)), 2):
                if k > 1:
                    worst = np.maximum(worst, norms[i] * norms[k] / np.abs(q[:, :, i] @ sides[k]))
            error.append(worst)
        return np.concatenate(displacement), np.concatenate(error)

    def _residual_norm(self, omega: Array, G: Complex, q: Complex, side: int) -> Array:
        """Norm of one of `sides` minus A V q in the inverse stiffness."""
        w, g = omega[:, None], G[:, None]
        given = np.zeros((len(omega), 2 + len(self.further)))
        given[:, side] = 1.0
        C_1q = 1j * w * (q @ self.U) * self.d
        c = np.concatenate([given, w**2 * q, -q, -1j * q, -g * q, -C_1q], axis=1)
        return np.sqrt(np.abs(((c.conj() @ self.gram) * c).sum(axis=1)))


def reduce_plate(
    plate: Plate,
    damping: LowRankDamping,
    domain: Domain,
    progress: Report = unheard,
) -> ReducedPlate:
    """Build the basis: a few spread snapshots, then two at a time where the residual is worst.

    Stops at `TOLERANCE` or at `LARGEST_BASIS` vectors; `estimated_error` says what was reached. Then a few
    more, for plates that are not quite as stated.
    """
    builder = _Builder(plate, damping, domain)
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        points = builder.spread
        while True:
            for snapshot in pool.map(builder.snapshot, points):
                builder.extend(snapshot)
            reduced = builder.project()
            points, worst = builder.worst_points(reduced)
            size = builder.V.shape[1]
            progress(min(1.0, size / builder.most))
            if worst < TOLERANCE or size + 4 > builder.most:
                builder.follow(np.hstack(list(pool.map(builder.stirred, builder.spread[:_STIRRED]))))
                return builder.project(final=True)


_GIVEN, _M, _K_0, _LOSS, _K_1, _DAMPED = range(6)
"""Kinds of columns of `ReducedPlate.gram`, in their order."""


class _Builder:
    """The growing basis and its products, all on the motions that are excited."""

    def __init__(self, plate: Plate, damping: LowRankDamping, domain: Domain) -> None:
        half = HalfPlate(plate, "carried")
        self.plate, self.half, self.domain = plate, half, domain
        self.damping = damping.projected(half.P)
        self.given = np.column_stack([half.down @ plate.load, half.down @ plate.pickup])
        if plate.further.shape[1]:
            self.given = np.hstack([self.given, half.down @ plate.further])
        self.most = LARGEST_BASIS if plate.specimen.only_even else 2 * LARGEST_BASIS
        self.most = self.most * self.given.shape[1] // 2
        self.stiffness = half.K_0.real + np.sqrt(domain.modulus[0] * domain.modulus[1]) * half.K_1
        if plate.rigid.shape[1]:
            # What moves freely has no stiffness to be measured by.
            self.stiffness += domain.omega[0] * domain.omega[1] * half.M
        self.unload = half.chain.factorise(self.stiffness)
        self.spread = [
            domain.point((0.5 + k * 0.7549) % 1, (0.5 + k * 0.5698) % 1, 0.5) for k in range(_SPREAD)
        ]
        self.V = np.empty((len(self.given), 0))
        # What residuals are made of, the inverse stiffness on it, and of which kind each column is.
        self.columns = self.unloaded = np.empty((len(self.given), 0))
        self.kind = np.empty(0, dtype=np.intp)
        self._keep(_GIVEN, self.given)
        self._keep(_DAMPED, self.damping.U)
        self.training = domain.grid(40, 7, (0.02, 0.2, 1.0))
        self.steps, self.everywhere = stated_steps(plate.specimen, _followed(plate.specimen)), Assembly(plate)
        self.kept: dict[Point, Callable[[Array | Complex], Complex]] = {}

    def solver(self, point: Point) -> Callable[[Array | Complex], Complex]:
        """Loads to responses at a point; those to be stirred are asked twice."""
        if point in self.kept:
            return self.kept[point]
        found = self.half.solver(*point, self.damping)
        if point in self.spread[:_STIRRED]:
            self.kept[point] = found
        return found

    def snapshot(self, point: Point) -> Complex:
        """Responses to what drives it, pickup and further spots, in full. Shape (n, 2 + spots)."""
        return self.solver(point)(self.given)

    def stirred(self, point: Point) -> Complex:
        """What tolerances of the faces change of the responses, over their size. Shape (n, any)."""
        omega, G = point
        X = self.snapshot(point)
        size = np.real(np.einsum("ij,ij->j", X.conj(), self.half.chain.times(self.stiffness, X)))
        X = times(self.half.P, X / np.sqrt(size))
        K_0, K_1, M = self.steps
        forces = [self.everywhere.forces(A, X) for A in K_0 + G * K_1 - omega**2 * M]
        return self.solver(point)(times(self.half.down, np.hstack(forces)))

    def follow(self, X: Complex) -> None:
        """Add the leading ones of some changes of responses, orthonormal in the stiffness."""
        W = np.hstack([X.real, X.imag])
        for _ in range(2):
            W = W - self.V @ (self.V.T @ self._stiff(W))
        values, vectors = np.linalg.eigh(W.T @ self._stiff(W))
        few = np.argsort(values)[::-1][:MOST_FOLLOWING]
        few = few[values[few] > FOLLOWING**2]
        V = W @ (vectors[:, few] / np.sqrt(values[few]))
        self._add(V - self.V @ (self.V.T @ self._stiff(V)))

    def extend(self, X: Complex) -> None:
        """Add real and imaginary parts, orthonormal in the stiffness."""
        W = np.hstack([X.real, X.imag])
        for _ in range(2):
            W = W - self.V @ (self.V.T @ self._stiff(W))
            size = np.sqrt(np.einsum("ij,ij->j", W, self._stiff(W)))
            # A lossless plate's response has no imaginary part.
            W = W[:, size > 0] / size[size > 0]
        values, vectors = np.linalg.eigh(W.T @ self._stiff(W))
        keep = values > 1e-10
        self._add(W @ (vectors[:, keep] / np.sqrt(values[keep])))

    def _stiff(self, W: Array) -> Array:
        return np.asarray(self.half.chain.times(self.stiffness, W))

    def _add(self, W: Array) -> None:
        half = self.half
        self.V = np.hstack([self.V, W])
        for kind, A in ((_M, half.M), (_K_0, half.K_0.real), (_LOSS, half.K_0.imag), (_K_1, half.K_1)):
            self._keep(kind, half.chain.times(A, W))

    def _keep(self, kind: int, columns: Array) -> None:
        self.columns = np.hstack([self.columns, columns])
        self.unloaded = np.hstack([self.unloaded, self.unload(columns)])
        self.kind = np.append(self.kind, np.full(columns.shape[1], kind))

    def project(self, *, final: bool = False) -> ReducedPlate:
        """The reduced plate of the present basis; with its parts when `final`."""
        V, U = self.V, self.damping.U
        order = np.argsort(self.kind, kind="stable")
        gram = self.columns[:, order].T @ self.unloaded[:, order]
        M, K_0, loss, K_1 = (V.T @ self.columns[:, self.kind == k] for k in (_M, _K_0, _LOSS, _K_1))
        parts, load_part, deflection = self._parts() if final else (np.empty(0),) * 3
        load, observe, *further = (V.T @ np.ascontiguousarray(side) for side in self.given.T)
        return ReducedPlate(
            M=M,
            K_0=K_0 + 1j * loss,
            K_1=K_1,
            U=V.T @ U,
            d=self.damping.d,
            mode=self.damping.mode,
            load=load,
            observe=observe,
            further=np.array(further).reshape(-1, V.shape[1]),
            domain=self.domain,
            parts=parts,
            load_part=load_part,
            deflection=deflection,
            gram=(gram + gram.T) / 2,
            V=V[self.half.place],
        )

    def _parts(self) -> tuple[Array, Array, Array]:
        """As in `ReducedPlate`."""
        plate = self.plate
        V = self.half.P @ self.V
        return (
            projected_parts(plate, V, one_parity=plate.specimen.only_even),
            on_motions(moving_part(plate.specimen)[..., plate.free], V),
            plate.on_nodes(V)[:, [W, THETA_X, THETA_Y]],
        )

    def worst_points(self, reduced: ReducedPlate) -> tuple[list[tuple[float, complex]], float]:
        """The worst training point and the worst one away from it, and the worst estimate."""
        omega, G = self.training
        error = reduced.estimated_error(omega, G)
        first = int(np.argmax(error))
        far = np.abs(omega - omega[first]) > 0.1 * (omega.max() - omega.min())
        second = int(np.argmax(np.where(far, error, 0)))
        return [(float(omega[k]), complex(G[k])) for k in (first, second)], float(error[first])
