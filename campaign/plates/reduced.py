"""A solid plate on a basis that spans its motion for any core modulus of a range, G* still outside.

The basis holds, at a few moduli g: the first modes, or one step of inverse iteration from those of the middle
modulus; static responses to the base, to points and to the air; and K^-1 K_1 of the modes, which is how they
change with the modulus. Checked against solutions on every degree of freedom in `tests/instrument`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from campaign.plates.grid import interpolation
from campaign.plates.solid import Solid, factorised
from drivers.simulated.plant import air
from drivers.simulated.plant.one_thread import one_thread
from fitting.arrays import Array

MODES = 14
"""Found at the middle modulus: beyond the third resonance of any plate of the campaign."""
REFERENCE_MODULUS_PA = 0.5e6
"""The core modulus whose real modes carry the remaining damping."""
MODULI_PA = (0.2e6, 0.8e6, 2.2e6, 6e6)
"""Of clean plates, for any law of the campaign."""
_INDEPENDENT = 1e-6
"""A direction whose share of strain energy is below the square of this adds nothing."""
_FREE_RAD_S = 2 * np.pi * 50.0
"""A choice: a free plate is measured by stiffness and by inertia at this frequency, below its first mode."""
_AIR_PANELS = 1400


@dataclass(frozen=True)
class ReducedSolid:
    """A plate's motion relative to its base on k vectors."""

    M: Array
    K_0: Array
    K_1: Array
    """Of the core for unit modulus, by group of bricks. Shape (groups, k, k)."""
    volume_m3: Array
    """Of each group of the core."""
    group_x_m: Array
    """Middle of each group."""
    group_y_m: Array
    load: Array
    """M times the base's heave, pitch and roll. Shape (k, 3)."""
    ends_x_m: Array
    """Of the bricks."""
    ends_y_m: Array
    top: Array
    """Deflection of the upper face's nodes. Shape (nodes x, nodes y, k)."""
    rubbing: Array
    """Imaginary part of the stiffness at the root. Shape (k, k)."""

    def reading(self, x_m: float, y_m: float) -> Array:
        """The row that reads the deflection at a point. Shape (k,). Raises `ValueError` off the plate."""
        length, width = self.ends_x_m[-1], self.ends_y_m[-1]
        if not (0 <= x_m <= length and 0 <= y_m <= width):
            raise ValueError(
                f"point ({1e3 * x_m:.1f}, {1e3 * y_m:.1f}) mm is off the plate "
                f"(0 to {1e3 * length:.1f} by 0 to {1e3 * width:.1f} mm): choose one on it"
            )
        x, y = interpolation(self.ends_x_m, x_m), interpolation(self.ends_y_m, y_m)
        return np.einsum("x,y,xyk->k", x, y, self.top)

    @property
    def whole_core(self) -> Array:
        """K_1 of all groups together. Shape (k, k)."""
        return np.asarray(self.K_1.sum(axis=0))

    def modes(self, modulus_pa: float, count: int) -> tuple[Array, Array]:
        """omega_r^2 and mass-normalised shapes at a real modulus. Shapes (count,), (k, count)."""
        lam, phi = eigh(self.K_0 + modulus_pa * self.whole_core, self.M)
        return lam[:count], phi[:, :count]


@one_thread
def reduced(
    solid: Solid,
    moduli_pa: Sequence[float] = MODULI_PA,
    *,
    groups: str = "whole",
    points_m: Sequence[tuple[float, float]] = (),
    air_density_kg_m3: float = 0.0,
    stirred: Sequence[sp.csr_array] = (),
    modes: int = MODES,
) -> ReducedSolid:
    """The plate on its basis.

    Parameters
    ----------
    solid
        The unreduced model.
    moduli_pa
        Where the basis is made, ascending; the middle one gives the modes.
    groups
        Of the core, whose moduli may differ: "whole", "columns" (across x) or "bricks".
    points_m
        Where something may be attached.
    air_density_kg_m3
        Of still air on both faces; it joins the mass.
    stirred
        Further matrices whose forces the basis shall answer, such as a core that is softer in places.
    modes
        How many are taken.
    """
    plate = _Moving.of(solid, points_m, air_density_kg_m3, stirred)
    middle = moduli_pa[len(moduli_pa) // 2]
    first, *further = sorted(moduli_pa, key=lambda g: abs(np.log(g / middle))) if plate.has_core else [0.0]
    K = plate.stiffness(first)
    solve = factorised(K).solve
    shapes = plate.modes(K, solve, modes)
    columns = [solid.rigid[solid.free], shapes] if solid.build.free else [shapes]
    columns.append(solve(plate.forces(shapes, [plate.loads, plate.points])))
    # M times the modes: a step of inverse iteration.
    again = [plate.loads, plate.M @ shapes, *([plate.points] if solid.build.free else [])]
    for g in further:
        columns.append(factorised(plate.stiffness(g)).solve(plate.forces(shapes, again)))
    basis = _independent(np.hstack(columns), K)
    V = np.zeros((solid.size, basis.shape[1]))
    V[solid.free] = basis
    out = _projected(solid, V, groups)
    return plate.air.added(out, V) if plate.air is not None else out


@dataclass(frozen=True)
class _Moving:
    """A solid's degrees of freedom that move, and what its basis answers."""

    solid: Solid
    M: sp.csr_array
    K_0: sp.csr_array
    """Of a free plate, whose six motions strain nothing, on a soft ground."""
    K_1: sp.csr_array | None
    """None without a core."""
    loads: Array
    """M times the base's motions. Shape (n, 3)."""
    points: Array
    """A force at each point. Shape (n, points)."""
    stirred: list[sp.csr_array]
    air: "_Air | None"

    @classmethod
    def of(
        cls,
        solid: Solid,
        points_m: Sequence[tuple[float, float]],
        air_density_kg_m3: float,
        stirred: Sequence[sp.csr_array],
    ) -> "_Moving":
        free = solid.free
        loads, points = _loads(solid, points_m)
        M, K_0 = solid.M[free][:, free], solid.K_0[free][:, free]
        return cls(
            solid=solid,
            M=M,
            K_0=K_0 + _FREE_RAD_S**2 * M if solid.build.free else K_0,
            K_1=solid.K_1[free][:, free] if solid.plate.core is not None else None,
            loads=loads[free],
            points=points[free],
            stirred=[A[free][:, free] for A in stirred],
            air=_Air.of(solid, air_density_kg_m3) if air_density_kg_m3 else None,
        )

    @property
    def has_core(self) -> bool:
        return self.K_1 is not None

    def stiffness(self, modulus_pa: float) -> sp.csr_array:
        """At a real modulus of the core. Shape (n, n)."""
        return self.K_0 if self.K_1 is None else (self.K_0 + modulus_pa * self.K_1).tocsr()

    def modes(self, K: sp.csr_array, solve: Callable[[Array], Array], count: int) -> Array:
        """The first shapes, of a free plate beside its six rigid motions. Shape (n, count or count + 6)."""
        operator = LinearOperator(K.shape, matvec=solve, dtype=float)
        start = np.sin(np.arange(1, K.shape[0] + 1))
        every = count + (6 if self.solid.build.free else 0)
        return np.asarray(eigsh(K, every, self.M, sigma=0.0, OPinv=operator, v0=start)[1])

    def forces(self, shapes: Array, outer: list[Array]) -> Array:
        """Those from outside, and what core, `stirred` and air exert on the modes. Shape (n, forces)."""
        forces = list(outer)
        forces += [self.K_1 @ shapes] if self.K_1 is not None else []
        forces += [A @ shapes for A in self.stirred]
        forces += [self.air.force(shapes, self.solid.free)] if self.air is not None else []
        return np.ascontiguousarray(np.hstack(forces))


def _loads(solid: Solid, points_m: Sequence[tuple[float, float]]) -> tuple[Array, Array]:
    rows = [solid.displacement(x, y) for x, y in points_m]
    points = sp.vstack(rows).T.toarray() if rows else np.zeros((solid.size, 0))
    return np.asarray(solid.M @ solid.rigid), points


def _independent(columns: Array, K: sp.csr_array) -> Array:
    """An orthonormal basis, in strain energy, of the columns."""
    columns = columns / np.sqrt(np.einsum("ij,ij->j", columns, K @ columns))
    for _ in range(2):
        lam, u = eigh(columns.T @ (K @ columns))
        kept = lam > lam[-1] * _INDEPENDENT**2
        columns = columns @ (u[:, kept] / np.sqrt(lam[kept]))
    return columns


def _projected(solid: Solid, V: Array, groups: str) -> ReducedSolid:
    K_1, volume, x, y = _core(solid, V, groups)
    return ReducedSolid(
        M=V.T @ (solid.M @ V),
        K_0=V.T @ (solid.K_0 @ V),
        K_1=K_1,
        volume_m3=volume,
        group_x_m=x,
        group_y_m=y,
        load=V.T @ (solid.M @ solid.rigid),
        ends_x_m=solid.grid.x,
        ends_y_m=solid.grid.y,
        top=solid.face(V),
        rubbing=V.T @ (solid.rubbing @ V),
    )


def _core(solid: Solid, V: Array, groups: str) -> tuple[Array, Array, Array, Array]:
    """K_1, volume and middle of each group."""
    k = V.shape[1]
    if solid.plate.core is None:
        return np.zeros((1, k, k)), np.zeros(1), np.zeros(1), np.zeros(1)
    area = np.outer(np.diff(solid.grid.x), np.diff(solid.grid.y)) * solid.treated
    volume = area * solid.plate.core.thickness_m
    x, y = (a.ravel() for a in np.meshgrid(*solid.grid.middles, indexing="ij"))
    if groups == "whole":
        K_1 = V.T @ (solid.K_1 @ V)
        return K_1[None], volume.sum()[None, None].ravel(), x.mean()[None], y.mean()[None]
    dofs, bricks = solid.dofs(1), solid.core_bricks
    each = np.array([V[d].T @ (K @ V[d]) for d, K in zip(dofs, bricks, strict=True)])
    if groups == "bricks":
        return each, volume.ravel(), x, y
    if groups == "columns":
        columns = each.reshape(*area.shape, k, k).sum(axis=1)
        return columns, volume.sum(axis=1), solid.grid.middles[0], np.full(area.shape[0], y.mean())
    raise ValueError(f"groups {groups!r}, expected whole, columns or bricks")


@dataclass(frozen=True)
class _Air:
    """Still air on both faces, by the lattice of vortex rings of the simulated rig's plant."""

    solid: Solid
    mass: Array
    """Of the panels. Shape (panels, panels), kg."""
    rows: sp.csr_array

    @classmethod
    def of(cls, solid: Solid, density_kg_m3: float) -> "_Air":
        length, width = solid.plate.length_m, solid.plate.width_m
        along_x = round((_AIR_PANELS * length / width) ** 0.5)
        panels = (along_x, round(_AIR_PANELS / along_x))
        x, y = air.centres(length, width, panels)
        rows = sp.vstack([solid.displacement(float(a), float(b), top=False) for a in x for b in y])
        return cls(solid, density_kg_m3 * air.mass_per_density(length, width, panels), rows.tocsr())

    def force(self, shapes: Array, free: NDArray[np.intp]) -> Array:
        w = self.rows[:, free]
        return np.asarray(w.T @ (self.mass @ (w @ shapes)))

    def added(self, plate: ReducedSolid, V: Array) -> ReducedSolid:
        w = self.rows @ V
        M, load = w.T @ self.mass @ w, w.T @ self.mass @ (self.rows @ self.solid.rigid)
        return replace(plate, M=plate.M + M, load=plate.load + load)
