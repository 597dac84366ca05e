"""Everything about one set of data that does not change from candidate to candidate."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.nodes import Nodes
from fitting.diagnosis.plate_poles import PlatePoles
from fitting.effects.base import Points
from fitting.effects.spanned import SpannedPlate
from fitting.laws import CoreLaw
from fitting.rational import RationalSweep
from fitting.specimen import Specimen
from fitting.sweep import Sweep

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

FINE, COARSE = 16, 7
"""Nodes a cluster of frequencies: for fits, and for a first look."""
_SIZES = (0.25, 0.5, 1.0, 2.0, 4.0)
_ANGLES = (0.2, 0.6, 1.0)
"""Of the modulus' argument, rad."""
_SECONDS_A_POINT = 10.0
"""Pace assumed where no time is kept."""


@dataclass(frozen=True)
class Grid:
    """Nodes and the unchanged plate's exact answer there."""

    nodes: Nodes
    rational: RationalSweep


@dataclass(frozen=True)
class Task:
    """A sweep with the plate it was measured on."""

    sweep: Sweep
    specimen: Specimen
    plate: SpannedPlate
    points: Points
    rational: RationalSweep
    """The unchanged plate's exact answer at every point."""
    fine: Grid
    coarse: Grid
    passes: Grid | None
    """As fine, every pass of a segment for itself; None where each is swept once."""

    @classmethod
    def of(
        cls,
        sweep: Sweep,
        specimen: Specimen,
        plate: SpannedPlate,
        rational: Callable[[Array], RationalSweep],
    ) -> "Task":
        """`rational` gives the unchanged plate's sum on an ascending grid in rad/s."""
        grids = [Nodes.of(sweep.omega, least) for least in (FINE, COARSE)]
        apart = Nodes.of(sweep.omega, FINE, sweep.sweep)
        if len(np.unique(apart.cluster)) > len(np.unique(grids[0].cluster)):
            grids.append(apart)
        omega = np.unique(np.concatenate([sweep.omega, *(g.omega for g in grids)]))
        whole = rational(omega)

        def at(some: Array) -> RationalSweep:
            return whole.at(np.searchsorted(omega, some * (1 - 1e-12)))

        fine, coarse, *rest = (Grid(g, at(g.omega)) for g in grids)
        passes = rest[0] if rest else None
        return cls(sweep, specimen, plate, points_of(sweep, specimen), at(sweep.omega), fine, coarse, passes)

    @property
    def stated_law(self) -> CoreLaw:
        """The specimen's: where identification starts."""
        assert self.specimen.core is not None
        return self.specimen.core.law.lifted()

    def condensed(self, law: CoreLaw) -> "Task":
        """The same, its plate condensed to moduli within a decade or so about a law."""
        omega = self.coarse.nodes.omega
        size = np.abs(law.modulus(omega))
        factors = [s * np.exp(1j * angle) for s in _SIZES for angle in _ANGLES]
        G = np.concatenate([size * f for f in factors])
        return replace(self, plate=self.plate.condensed(np.tile(omega, len(factors)), G))

    def around(self, law: CoreLaw) -> "Task":
        """The same, its grids made for the poles that the plate has under a law."""
        found = PlatePoles(self.plate, law)

        def made_for(grid: Grid) -> Grid:
            return replace(grid, nodes=grid.nodes.around(found.near, found.frozen))

        passes = made_for(self.passes) if self.passes is not None else None
        return replace(self, fine=made_for(self.fine), coarse=made_for(self.coarse), passes=passes)


def points_of(sweep: Sweep, specimen: Specimen) -> Points:
    """What effects may ask of a sweep's points."""
    if sweep.time_s is not None:
        time = sweep.time_s - sweep.time_s.min()
    else:
        time = _SECONDS_A_POINT * np.argsort(np.argsort(sweep.frequency_hz, kind="stable")).astype(float)
    return Points(
        omega=sweep.omega,
        acceleration_m_s2=sweep.commanded_m_s2,
        time_s=time,
        timed=sweep.time_s is not None,
        has_phase=sweep.has_phase,
        reads=specimen.reads,
    )
