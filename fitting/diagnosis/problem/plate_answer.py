"""Answers of the changed plate at a few frequencies, with their derivatives by the adjoint.

A q = load,   A z = observe,   x = observe . q,   dx = z . (dload - dA q) + dobserve . q
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.pole_following import KnownPoles
from fitting.dynamics.dynamic_stiffness import Matrices, dynamic_stiffness, stacked
from fitting.nuisances.nuisances import Nuisances
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


@dataclass(frozen=True)
class Asked:
    """What is to be solved: a plate as something changes it, at some nodes."""

    plate: EnrichedReducedPlate
    omega: Array
    """Shape (nodes,)."""
    G: Complex
    change: Change
    poles: KnownPoles | None
    """Those of the unchanged plate that are to be followed."""
    with_pitch: bool
    place: Array | None = None
    """The row that reads one place more, where something pulls at the plate. Shape (k,)."""

    @property
    def sides(self) -> dict[str, Array]:
        """Load, row that reads, the load of a turning base and the row of the place. Shape (k,) each."""
        found = {"q": self.plate.load + self.change.load, "z": self.plate.observe + self.change.observe}
        if self.with_pitch:
            found["p"] = self.plate.pitch
        return found if self.place is None else {**found, "c": self.place}

    @cached_property
    def matrices(self) -> Matrices:
        """The plate's matrices with everything that is changed of them."""
        plate, change = self.plate, self.change
        C_1 = plate.viscous(change.damping) + change.C
        return stacked(plate.K_0 + change.K, plate.K_1 + change.K_1, plate.M + change.M, C_1)

    def alike(self, other: "Asked") -> bool:
        """Whether another asks for the same matrix at the same nodes, but for what drives and reads it."""
        pairs = [(self.omega, other.omega), (self.G, other.G), (self.matrices, other.matrices)]
        if self.poles is None or other.poles is None:
            followed = self.poles is other.poles
        else:
            followed = self.poles.alike(other.poles)
        return (
            followed and self.with_pitch == other.with_pitch and all(np.array_equal(a, b) for a, b in pairs)
        )


@dataclass(frozen=True)
class Motions:
    """Of the plate asked for. Shape (nodes, k) each."""

    q: Complex
    """To its load."""
    z: Complex
    """To a unit force at its pickup."""
    poles: Complex
    """Where the poles that were asked for have gone, rad/s. Shape (poles,)."""
    p: Complex | None = None
    """To a turning base."""
    c: Complex | None = None
    """To a unit force at the place more."""


def motions(asked: Sequence[Asked]) -> list[Motions]:
    """Of each; those that differ in what drives or reads them are solved with one another."""
    found: dict[int, Motions] = {}
    for k, one in enumerate(asked):
        if k not in found:
            same = [n for n in range(k, len(asked)) if n not in found and (n == k or one.alike(asked[n]))]
            found |= dict(zip(same, _together([asked[n] for n in same]), strict=True))
    return [found[k] for k in range(len(asked))]


def _together(asked: Sequence[Asked]) -> list[Motions]:
    one = asked[0]
    A = dynamic_stiffness(one.matrices, one.omega, one.G)
    each: list[Array] = []
    places = []
    travel = -1 / one.omega**2
    for a in asked:
        rows = {name: np.broadcast_to(side, (len(a.omega), len(side))) for name, side in a.sides.items()}
        if np.any(a.change.travel_load):
            rows["q"] = rows["q"] + travel[:, None] * a.change.travel_load
        places.append({name: _place(row, each) for name, row in rows.items()})
    solved = np.asarray(np.linalg.solve(A, np.stack(each, axis=2).astype(complex)), dtype=np.complex128)
    poles = one.poles.followed(one.matrices)[0] if one.poles else np.empty(0, complex)
    return [Motions(poles=poles, **{name: solved[:, :, n] for name, n in at.items()}) for at in places]


def _place(row: Array, each: list[Array]) -> int:
    """Index of a right-hand side among those to be solved; appended if it is new. Shape (k,)."""
    for n, other in enumerate(each):
        if np.array_equal(row, other):
            return n
    each.append(row)
    return len(each) - 1


@dataclass(frozen=True)
class Receptance:
    """What is read at one side of a plate as another is driven, x = read . A^-1 load, and its derivatives.

    Per acceleration of the base, angular acceleration, or force, as what acts is.
    """

    asked: Asked
    driven: Complex
    """A^-1 load, the plate's motion. Shape (nodes, k)."""
    adjoint: Complex
    """A^-1 read. Shape (nodes, k)."""
    row: Array
    """What is read. Shape (k,)."""
    loads: bool
    """Whether it is the plate's own load that acts: others are the same whatever changes."""
    reads: bool
    """Whether it is the plate's own reading: the same."""
    slopes: Sequence[Change]
    """Derivatives of the change to every unknown."""
    nuisances: tuple[Nuisances, Array] | None
    """Nuisances and their values, which are already included in the change."""

    @cached_property
    def value(self) -> Complex:
        """Shape (nodes,)."""
        x = self.driven @ self.row
        return x - self.asked.change.travel / self.asked.omega**2 if self.loads and self.reads else x

    @cached_property
    def by_G(self) -> Complex:
        """Shape (nodes,)."""
        K_1 = self.asked.matrices[1]
        return np.asarray(-np.einsum("pi,pi->p", self.adjoint, self.driven @ K_1.T))

    @cached_property
    def by_u(self) -> Complex:
        """To each unknown. Shape (unknowns, nodes)."""
        return self._each([self._by(d) for d in self.slopes])

    @cached_property
    def by_z(self) -> Complex:
        """To each stated number, in standard deviations. Shape (count, nodes)."""
        if self.nuisances is None:
            return self._each([])
        (who, at), a = self.nuisances, self.asked
        return who.by_response(
            a.plate, a.omega, a.G, self.driven, self.adjoint, at, loads=self.loads, reads=self.reads
        )

    def _by(self, d: Change) -> Complex:
        step = _Step(self.asked.plate, self.asked.omega, self.asked.G, self.adjoint)
        if not self.reads:
            d = replace(d, observe=0.0, travel=0.0)
        found = step.by(d, self.driven)
        return found + step.by_base(d) if self.loads else found

    def _each(self, rows: list[Complex]) -> Complex:
        return np.array(rows) if rows else np.zeros((0, len(self.asked.omega)), complex)


@dataclass(frozen=True)
class PlateAnswer:
    """What is read of the motions of what was asked for, each worked out as it is asked for."""

    asked: Asked
    moved: Motions
    nearby: Sequence[tuple[Change, Change, float]] = ()
    """For every unknown the changes a step above and below, and the step between them."""
    nuisances: tuple[Nuisances, Array] | None = None
    """As `Receptance` has it."""

    @property
    def poles(self) -> Complex:
        """Where the poles that were asked for have gone, rad/s. Shape (poles,)."""
        return self.moved.poles

    @cached_property
    def heave(self) -> Receptance:
        """Of the load, at the pickup."""
        return self._between(self.moved.q, self.moved.z, self._observe, loads=True, reads=True)

    @cached_property
    def pitch(self) -> Receptance | None:
        """Of a turning base, at the pickup; None where it does not turn."""
        p = self.moved.p
        return None if p is None else self._between(p, self.moved.z, self._observe, reads=True)

    @cached_property
    def of_place(self) -> tuple[Receptance, ...]:
        """Of a force there, at the pickup and there; of the load, and of a base that turns, there."""
        z, c, p, row = self.moved.z, self.moved.c, self.moved.p, self.asked.place
        if c is None or row is None:
            return ()
        found = [
            self._between(c, z, self._observe, reads=True),
            self._between(c, c, row),
            self._between(self.moved.q, c, row, loads=True),
        ]
        return (*found, *([] if p is None else [self._between(p, c, row)]))

    def _between(
        self, driven: Complex, adjoint: Complex, row: Array, *, loads: bool = False, reads: bool = False
    ) -> Receptance:
        return Receptance(self.asked, driven, adjoint, row, loads, reads, self._slopes, self.nuisances)

    @cached_property
    def _observe(self) -> Array:
        return np.asarray(self.asked.plate.observe + self.asked.change.observe)

    @cached_property
    def _slopes(self) -> list[Change]:
        return [_between(up, down, 1 / h) for up, down, h in self.nearby]


def answer(
    plate: EnrichedReducedPlate,
    omega: Array,
    G: Complex,
    change: Change,
    nearby: Sequence[tuple[Change, Change, float]],
    *,
    with_pitch: bool,
    nuisances: tuple[Nuisances, Array] | None = None,
) -> PlateAnswer:
    """Solve the nodes, and read; no poles are followed. As `Asked` and `PlateAnswer` have it.

    Shape (nodes,) for `omega` and `G`.
    """
    asked = Asked(plate, omega, G, change, None, with_pitch)
    return PlateAnswer(asked, motions([asked])[0], nearby, nuisances)


def _between(up: Change, down: Change, per_step: float) -> Change:
    return Change(
        *(
            (getattr(up, n) - getattr(down, n)) * per_step
            for n in ("K", "K_1", "M", "load", "observe", "C", "damping", "travel_load", "travel")
        )
    )


@dataclass(frozen=True)
class _Step:
    plate: EnrichedReducedPlate
    omega: Array
    G: Complex
    z: Complex

    def by_base(self, d: Change) -> Complex:
        """Derivative of x along what the derivative `d` of a change makes of the base's motion."""
        travel = -1 / self.omega**2
        load = d.load + travel[:, None] * d.travel_load
        return np.asarray((self.z * load).sum(axis=1) + travel * d.travel, dtype=np.complex128)

    def by(self, d: Change, q: Complex) -> Complex:
        """And along what it makes of the plate's motion `q`. Shape (nodes,)."""
        found = np.zeros(len(self.omega), complex)
        parts: list[tuple[object, Complex | Array | float]] = [
            (d.K, 1.0),
            (d.K_1, self.G),
            (d.M, -(self.omega**2)),
            (d.C, np.asarray(1j * self.omega, dtype=complex)),
        ]
        for A, factor in parts:
            if isinstance(A, np.ndarray):
                found -= factor * np.einsum("pi,pi->p", self.z, q @ A.T)
        if np.any(d.damping):
            U, weights = self.plate.U, self.plate.d * d.damping
            found -= 1j * self.omega * np.einsum("pr,pr,r->p", self.z @ U, q @ U, weights)
        if isinstance(d.observe, np.ndarray):
            found += q @ d.observe
        return found


@dataclass(frozen=True, eq=False)
class StrainedCore:
    """How far the core of a plate shears, as something changes it, at some frequencies and moduli."""

    plate: EnrichedReducedPlate
    omega: Array
    """Shape (nodes,)."""
    G: Complex
    change: Change

    @cached_property
    def strain(self) -> Array:
        """Rms over the core of its shear strain for a base acceleration of 1 m/s^2. Shape (nodes,)."""
        q = self._motion
        square = np.real(np.einsum("pi,pi->p", q.conj(), q @ self._mean_square))
        return np.sqrt(np.maximum(square, 1e-300))

    def by(self, nearby: tuple[Change, Change, float]) -> Array:
        """Derivative of ln strain to an unknown; `nearby` as `PlateAnswer` has it of each. Shape (nodes,)."""
        up, down, h = nearby
        # What the pickup reads strains nothing.
        d = replace(_between(up, down, 1 / h), observe=0.0, travel=0.0)
        step = _Step(self.plate, self.omega, self.G, self._adjoint)
        return self._of_log(step.by(d, self._motion) + step.by_base(d))

    def by_stated(self, nuisances: Nuisances, z: Array) -> Array:
        """Derivatives of ln strain to the stated numbers, in standard deviations.

        Shapes (numbers,) to (numbers, nodes).
        """
        plate, q = self.plate, self._motion
        return self._of_log(
            nuisances.by_response(plate, self.omega, self.G, q, self._adjoint, z, reads=False)
        )

    def by_modulus(self, dG: Complex) -> Array:
        """Changes of ln strain along changes of the modulus, in Pa. Shape (any, nodes) each."""
        return self._of_log(dG * self._by_G)

    @cached_property
    def _by_G(self) -> Complex:
        K_1 = self._matrices[1]
        return np.asarray(-np.einsum("pi,pi->p", self._adjoint, self._motion @ K_1.T))

    def _of_log(self, along: Complex) -> Array:
        """Of ln strain, `along` being Z's product with what changes. Shape (..., nodes)."""
        return np.asarray(along.real / self.strain**2)

    @cached_property
    def _motion(self) -> Complex:
        """Q of A q = load. Shape (nodes, k)."""
        travel = -1 / self.omega**2
        return self._solved(self.plate.load + self.change.load + travel[:, None] * self.change.travel_load)

    @cached_property
    def _adjoint(self) -> Complex:
        """Z of A z = S conj(q), with S the mean square. Shape (nodes, k)."""
        return self._solved(self._motion.conj() @ self._mean_square)

    @property
    def _mean_square(self) -> Array:
        return self.plate.matrix("strain.mean_square")

    @cached_property
    def _matrices(self) -> Matrices:
        return Asked(self.plate, self.omega, self.G, self.change, None, with_pitch=False).matrices

    def _solved(self, sides: Complex | Array) -> Complex:
        A = dynamic_stiffness(self._matrices, self.omega, self.G)
        return np.asarray(np.linalg.solve(A, sides[:, :, None].astype(complex))[:, :, 0])
