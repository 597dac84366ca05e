"""The plate on all its degrees of freedom, the clamp's too: where what effects change is assembled."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from threading import RLock
from typing import Any, TypeVar, cast

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.dynamics.damping import LowRankDamping
from fitting.dynamics.half_plate import HalfPlate, Parity
from fitting.numerics.linear import times
from fitting.plate.assembly import Assembly
from fitting.plate.element import THETA_Y, U_C, W
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen

_COMPARED_PA, _COMPARED_HZ = 1e6, 50
"""Modulus of the core and frequency at which motions are compared in size. A choice."""

T = TypeVar("T")
Solver = Callable[[Array | Complex], Complex]


class FullPlate:
    """A held plate and the same with its clamps let go, if any; `n` counts the latter's unknowns."""

    def __init__(self, plate: Plate, damping: LowRankDamping) -> None:
        self.held, self.damping = plate, damping
        specimen = plate.specimen
        self.loose = Plate(_loose(specimen)) if "clamp" in specimen.offers else plate
        self.lift = _lift(plate, self.loose)
        self._made: dict[str, Any] = {}
        self._making = RLock()

    def once(self, name: str, make: Callable[[], T]) -> T:
        """What `make` returns, made when first asked for: assembling takes longer than solving."""
        with self._making:
            if name not in self._made:
                self._made[name] = make()
            return cast(T, self._made[name])

    @property
    def halves(self) -> "tuple[HeldHalf, HeldHalf | None]":
        """The held plate's even and odd motions; all together where its long edges are not alike."""

        def make() -> tuple[HeldHalf, HeldHalf | None]:
            if len(self.held.sides) == 1 and not self.only_even:
                return HeldHalf(self, "carried"), None
            return HeldHalf(self, "even"), HeldHalf(self, "odd")

        return self.once("halves", make)

    @property
    def only_even(self) -> bool:
        """Whether what drives it stirs no motion odd in y."""
        return self.specimen.only_even

    @property
    def elements(self) -> Assembly:
        """The elements of the loose plate, for products with their matrices."""
        return self.once("elements", lambda: Assembly(self.loose))

    @property
    def specimen(self) -> PlateSpecimen:
        """The plate as its file states it."""
        return self.held.specimen

    @cached_property
    def heave(self) -> Array:
        """Rigid motion w = 1. Shape (n,)."""
        return self._rigid(pitch=False)

    @cached_property
    def pitching(self) -> Array:
        """Rigid turn about the root, w = x; the layers above the substrate move along. Shape (n,)."""
        return self._rigid(pitch=True)

    def _rigid(self, *, pitch: bool) -> Array:
        s = self.specimen
        r = np.zeros((self.loose.mesh.nodes, self.loose.mesh.dofs))
        r[:, W] = self.loose.mesh.node_positions()[:, 0] if pitch else 1.0
        if pitch:
            r[:, U_C] = -s.apart_m
        if pitch:
            r[:, THETA_Y] = -1.0
        return np.asarray(r.ravel()[self.loose.free])

    @cached_property
    def scale(self) -> sp.csc_array:
        """Inner product of motions: stiffness and inertia at one modulus and frequency. Shape (n, n)."""
        p = self.loose
        return sp.csc_array(p.K_0.real + _COMPARED_PA * p.K_1 + (2 * np.pi * _COMPARED_HZ) ** 2 * p.M)

    def unit(self, X: Complex) -> Complex:
        """Columns scaled to unit size; a push at a held edge moves nothing. Shape (n, any), as `X`."""
        size = np.sqrt(np.real(np.einsum("ij,ij->j", X.conj(), times(self.scale, X))))
        return np.asarray(X / np.where(size > 0, size, 1.0))

    def snapshot(self, omega: float, G: complex) -> "Snapshot":
        """Responses to what drives it and to the pickup at a point of the domain."""
        first, second = self.halves
        even = first.solver(omega, G)
        odd = second.solver(omega, G) if second is not None else _nothing
        X, Z = even(self.loads), odd(self.loads[:, 1:] if self.only_even else self.loads)
        x = X[:, 0] if self.only_even else X[:, 0] + Z[:, 0]
        spots = self.loads.shape[1] - 1
        return Snapshot(omega, G, x, X[:, 1:] + Z[:, -spots:], even, odd)

    @property
    def loads(self) -> Array:
        """Of a unit of what drives it, and a unit force at each spot. Shape (n, 1 + spots)."""

        def make() -> Array:
            return np.column_stack([self.drive, *(self.loose.observe(*at) for at in self.specimen.pickups_m)])

        return self.once("loads", make)

    @property
    def drive(self) -> Array:
        """Of a unit base acceleration, or of a unit force at a point. Shape (n,)."""
        if self.specimen.force_m is not None:
            return self.loose.observe(*self.specimen.force_m)
        # -M r of the held plate carries the inertia of its root too.
        return -(self.loose.M @ self.heave)

    @property
    def pickup_m(self) -> tuple[float, float]:
        """Where the specimen is read, in m."""
        assert self.specimen.pickup_m is not None
        return self.specimen.pickup_m


class HeldHalf:
    """The held plate's motions of one parity, or all, among the loose plate's."""

    def __init__(self, full: FullPlate, parity: Parity) -> None:
        self.half = HalfPlate(full.held, parity)
        self.damping = full.damping.projected(self.half.P)
        self.up = sp.csr_array(full.lift @ self.half.P)
        self.down = sp.csr_array(self.up.T)
        for name in ("M", "K_0", "K_1"):
            getattr(self.half, name)

    def solver(self, omega: float, G: complex) -> Solver:
        """Forces on the loose plate to its responses. Shape (n, m) both."""
        solve = self.half.solver(omega, G, self.damping)
        return lambda forces: np.asarray(times(self.up, solve(times(self.down, forces))))


@dataclass(frozen=True)
class Snapshot:
    """One point of frequency and modulus, the plate unchanged."""

    omega: float
    G: complex
    x: Complex
    """Response to a unit of what drives it. Shape (n,)."""
    z: Complex
    """Response to a unit force at each spot, odd motions too. Shape (n, spots)."""
    even: Solver
    """Forces, (n, m), to even responses of the held plate; to all where its long edges are not alike."""
    odd: Solver

    def solve(self, forces: Array | Complex, *, odd: bool) -> Complex:
        """The held plate's responses; `odd` for motions odd in y too. Shape (n, m)."""
        found = self.even(forces)
        if odd:
            found += self.odd(forces)
        return found

    def answers(self, forces: Sequence[Array | Complex], odd: Sequence[bool]) -> list[Complex]:
        """As `solve`, for many at once: far quicker. Shape (n, m) each, as its forces."""
        found = _side_by_side(self.even, forces)
        twisting = [k for k, wanted in enumerate(odd) if wanted]
        for k, more in zip(twisting, _side_by_side(self.odd, [forces[k] for k in twisting]), strict=True):
            found[k] += more
        return found

    @cached_property
    def both(self) -> Complex:
        """X and z side by side, each z of the size of x. Shape (n, 1 + spots)."""
        size = np.linalg.norm(self.x)
        return np.column_stack([self.x, *(z * (size / np.linalg.norm(z)) for z in self.z.T)])


def _side_by_side(solve: Solver, forces: Sequence[Array | Complex]) -> list[Complex]:
    if not forces:
        return []
    ends = np.cumsum([f.shape[1] for f in forces])[:-1]
    return list(np.split(solve(np.asarray(np.hstack(forces), dtype=complex)), ends, axis=1))


def _nothing(forces: Array | Complex) -> Complex:
    return np.zeros(forces.shape, complex)


def _loose(specimen: PlateSpecimen) -> PlateSpecimen:
    edges = ("free" if edge == "clamped" else edge for edge in specimen.edges)
    return replace(specimen, boundary="-".join(edges), elements=specimen.mesh)


def _lift(held: Plate, loose: Plate) -> sp.csc_array:
    """Motions of the held plate as motions of the loose one. Shape (n, held)."""
    place = np.full(loose.mesh.size, -1)
    place[loose.free] = np.arange(len(loose.free))
    rows = place[held.free]
    return sp.csc_array((np.ones(len(rows)), (rows, np.arange(len(rows)))), (len(loose.free), len(rows)))
