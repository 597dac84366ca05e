"""The plate on all its degrees of freedom, the clamp's too: where what effects change is assembled."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar, cast

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.damping import ViscousDamping
from fitting.direct import direct_solver
from fitting.element import DOFS, THETA_Y, U_C, W
from fitting.plate import Plate
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
T = TypeVar("T")


class FullPlate:
    """A held plate and the same plate with its root let go; `n` counts the latter's degrees of freedom."""

    def __init__(self, plate: Plate, damping: ViscousDamping) -> None:
        self.held, self.damping = plate, damping
        specimen = plate.specimen
        self.loose = Plate(_loose(specimen)) if specimen.boundary == "cantilever" else plate
        self.lift = _lift(plate, self.loose)
        self._made: dict[str, Any] = {}

    def once(self, name: str, make: Callable[[], T]) -> T:
        """What `make` returns, made when first asked for: assembling takes longer than solving."""
        if name not in self._made:
            self._made[name] = make()
        return cast(T, self._made[name])

    @property
    def specimen(self) -> Specimen:
        """As stated."""
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
        r = np.zeros((self.loose.mesh.nodes, DOFS))
        r[:, W] = self.loose.mesh.node_positions()[:, 0] if pitch else 1.0
        if pitch and s.core is not None and s.constraining is not None:
            r[:, U_C] = -(s.core.thickness_m + (s.substrate.thickness_m + s.constraining.thickness_m) / 2)
        if pitch:
            r[:, THETA_Y] = -1.0
        return np.asarray(r.ravel()[self.loose.free])

    @cached_property
    def scale(self) -> sp.csc_array:
        """Inner product of motions: stiffness at 1 MPa and inertia at 50 Hz. Shape (n, n)."""
        p = self.loose
        return sp.csc_array(p.K_0.real + 1e6 * p.K_1 + (2 * np.pi * 50) ** 2 * p.M)

    def snapshot(self, omega: float, G: complex) -> "Snapshot":
        """Responses to base and pickup at a point of the domain."""
        halves = []
        for P in (self.held.even, self.held.odd):
            A = P.T @ self.held.dynamic_stiffness(omega, G) @ P
            halves.append((P, direct_solver(A, omega, self.damping.projected(P))))

        def solve(forces: NDArray[np.float64] | Complex, *, odd: bool) -> Complex:
            f = self.lift.T @ forces
            parts = halves if odd else halves[:1]
            return np.asarray(sum(self.lift @ (P @ half(P.T @ f)) for P, half in parts), dtype=complex)

        # -M r of the held plate carries the inertia of its root too.
        loads = np.column_stack([-(self.loose.M @ self.heave), self.loose.observe(*self.pickup_m)])
        X = solve(loads, odd=False)
        Z = solve(loads[:, 1:], odd=True)
        return Snapshot(omega, G, X[:, 0], Z[:, 0], solve)

    @property
    def pickup_m(self) -> tuple[float, float]:
        """Of the specimen."""
        assert self.specimen.pickup_m is not None
        return self.specimen.pickup_m


@dataclass(frozen=True)
class Snapshot:
    """One point of frequency and modulus, the plate unchanged."""

    omega: float
    G: complex
    x: Complex
    """Response to a unit base acceleration. Shape (n,)."""
    z: Complex
    """Response to a unit force at the pickup, odd motions too. Shape (n,)."""
    solve: Callable[..., Complex]
    """Forces (n, m) to responses of the held plate; `odd` for motions odd in y too."""

    @property
    def both(self) -> Complex:
        """X and z side by side, z of the size of x. Shape (n, 2)."""
        return np.column_stack([self.x, self.z * (np.linalg.norm(self.x) / np.linalg.norm(self.z))])


def _loose(specimen: Specimen) -> Specimen:
    return replace(specimen, boundary="free", elements=specimen.mesh)


def _lift(held: Plate, loose: Plate) -> sp.csc_array:
    """Motions of the held plate as motions of the loose one. Shape (n, held)."""
    place = np.full(loose.mesh.nodes * DOFS, -1)
    place[loose.free] = np.arange(len(loose.free))
    rows = place[held.free]
    return sp.csc_array((np.ones(len(rows)), (rows, np.arange(len(rows)))), (len(loose.free), len(rows)))
