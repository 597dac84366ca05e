"""A layered beam as a 3D solid: bricks of third order along it, of second across and through each layer.

Half its width, the plane in its middle a plane of symmetry: a base in heave and pitch stirs nothing else, nor
does a force on its middle line. It shares nothing with the beam that is fitted.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from drivers.arrays import Array
from drivers.simulated.plant.layered_solid import LayeredSolid, Sheet
from drivers.simulated.plant.lines import Line

Ends = Literal["clamped-free", "free-free", "clamped-clamped", "centre-driven"]

PIECES = 20
"""Along the beam, besides the fine ones at a clamp."""
_NEAR_ROOT = (0.4, 1.5)
"""Of the stack's height: where fine pieces end."""
_SLIVER = 0.3
"""Of a piece: its end so near to one that is asked for gives way to it."""
_GONE = 1e-5
"""Of stiffness and mass, what stands for nothing: alike, so that what is left vibrates no lower."""


@dataclass(frozen=True)
class BeamStated:
    """Size, ends and layers of a beam that is built as a solid."""

    length_m: float
    """Free length; of both halves where it is driven in its centre."""
    width_m: float
    ends: Ends
    sheets: tuple[Sheet, ...]
    """From below."""
    cores: tuple[int, ...]
    """Which of them are viscoelastic."""
    spot_x_m: float
    """From a clamped end, or from the centre."""
    axial_pa: float = 0.0
    """That the layers which are not viscoelastic are pulled along by."""

    @property
    def span_m(self) -> float:
        """What vibrates as one piece."""
        return self.length_m / 2 if self.ends == "centre-driven" else self.length_m

    @property
    def substrate(self) -> int:
        """Its sheet: the lowest or, of a beam alike on both sides, the one in the middle."""
        return len(self.sheets) // 2 if len(self.cores) > 1 else 0

    def heights_m(self, sheet: int) -> tuple[float, float]:
        """Where a sheet begins and ends."""
        edges = np.cumsum([0.0, *(s.thickness_m for s in self.sheets)])
        return float(edges[sheet]), float(edges[sheet + 1])


@dataclass(frozen=True)
class RootSprings:
    """Springs between the face of a clamped end and the base, per area."""

    along_x_n_m3: float
    along_y_n_m3: float
    along_z_n_m3: float
    from_m: float = 0.0
    """Height above the lower face from which they hold; as bolts or a jaw's edge would."""
    to_m: float = np.inf


@dataclass(frozen=True)
class BeamBuild:
    """What the solid has that a beam in a rigid clamp has not."""

    springs: RootSprings | None = None
    """None: what is gripped does not move."""
    gripped_m: tuple[float, float] | None = None
    """Heights between which a rigid clamp holds; None: all of it."""
    core_factor: Callable[[Array], Array] | None = None
    """On the core's moduli, of x."""
    treatment_from_m: float | None = None
    """How far from a clamp all but the substrate begins; None: at it."""
    lines_x_m: tuple[float, ...] = ()
    """Where pieces shall end."""


class SolidBeam(LayeredSolid):
    """A beam as a solid with all its degrees of freedom, before it is reduced."""

    def __init__(self, stated: BeamStated, pieces: int = PIECES, build: BeamBuild | None = None) -> None:
        self.stated, self.build = stated, build or BeamBuild()
        height = sum(s.thickness_m for s in stated.sheets)
        L, near = stated.span_m, np.array(_NEAR_ROOT) * height
        near = near[near < L / pieces]
        fine = [near] if stated.ends != "free-free" else []
        if stated.ends == "clamped-clamped":
            fine.append(L - near)
        ends = np.unique(np.concatenate([np.linspace(0, L, pieces + 1), *fine]))
        lines = self.build.lines_x_m
        if self.build.treatment_from_m:
            begin = self.build.treatment_from_m
            lines = (*lines, begin, *((L - begin,) if stated.ends == "clamped-clamped" else ()))
        asked = np.array([x for x in lines if 0 < x < L])
        if asked.size:
            apart = np.abs(ends[:, None] - asked).min(axis=1) > _SLIVER * L / pieces
            ends = np.unique(np.concatenate([ends[apart | (ends == 0) | (ends == L)], asked]))
        half = stated.width_m / 2
        x, y = Line(tuple(ends.tolist()), 3), Line((0.0, half / 2, half), 2)
        # Both halves of the width, and of a beam that is driven in its centre.
        super().__init__(stated.sheets, x, y, times=4.0 if stated.ends == "centre-driven" else 2.0)

    def deflection(self, x_m: float) -> Array:
        """Row that reads w on the middle of the upper face. Shape (size,)."""
        return self.row(x_m, 0.0)

    def face(self, sheet: int) -> sp.csr_array:
        """Stiffness of a layer that is not viscoelastic, pulled along as it is. Shape (size, size)."""
        own = self.stiffness(sheet, along_x=self.there(sheet))
        return own + self.stated.axial_pa * self.turned(sheet) if self.stated.axial_pa else own

    def there(self, sheet: int) -> Callable[[Array], Array] | None:
        """How much of a layer is there, a function of x, shape of x; None: all of it."""
        begin, end = self.build.treatment_from_m, self.stated.span_m
        if not begin or sheet == self.stated.substrate:
            return None
        if self.stated.ends == "clamped-clamped":
            end -= begin
        return lambda x: np.where((x > begin) & (x < end), 1.0, _GONE)

    @cached_property
    def core(self) -> sp.csr_array:
        """Stiffness of all cores for unit modulus, as it varies along the beam. Shape (size, size)."""
        return self.core_times(lambda x: np.ones_like(x))

    def core_times(self, factor: Callable[[Array], Array]) -> sp.csr_array:
        """Stiffness as `core` has it, times a further factor of x. Shape (size, size)."""
        own = self.build.core_factor
        both = factor if own is None else lambda x: own(x) * factor(x)
        parts = [self.stiffness(k, along_x=_product(both, self.there(k))) for k in self.stated.cores]
        return sum(parts[1:], parts[0])

    @cached_property
    def root(self) -> sp.csr_array:
        """Stiffness of the springs at the clamped ends; zero where there are none. Shape (size, size)."""
        springs = self.build.springs
        nx = len(self.x.nodes)
        out = sp.csr_array((3 * nx * len(self.y.nodes) * len(self.z.nodes),) * 2)
        if springs is None:
            return out
        face = sp.kron(self.y.integral(0, 0), self.z.integral(0, 0, (springs.from_m, springs.to_m)))
        along = np.diag([springs.along_x_n_m3, springs.along_y_n_m3, springs.along_z_n_m3])
        for node in self._clamped:
            at = sp.coo_array(([1.0], ([node], [node])), shape=(nx, nx))
            out = out + self._times * sp.kron(at, sp.kron(face, along))
        return out.tocsr()

    @property
    def _clamped(self) -> tuple[int, ...]:
        """Nodes along x at which it is clamped."""
        known: dict[str, tuple[int, ...]] = {"free-free": (), "clamped-clamped": (0, -1 + len(self.x.nodes))}
        return known.get(self.stated.ends, (0,))

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """Degrees of freedom that move. Shape (n,)."""
        nx, ny, nz = self.shape
        held = np.zeros((nx, ny, nz, 3), bool)
        if self.build.springs is None:
            low, high = self.build.gripped_m or (0.0, np.inf)
            reach = 1e-9 * self.z.ends[-1]
            gripped = (self.z.nodes > low - reach) & (self.z.nodes < high + reach)
            for node in self._clamped:
                held[node, :, gripped] = True
        held[:, 0, :, 1] = True
        return np.flatnonzero(~held.ravel())


def _product(
    one: Callable[[Array], Array], other: Callable[[Array], Array] | None
) -> Callable[[Array], Array]:
    return one if other is None else lambda x: one(x) * other(x)
