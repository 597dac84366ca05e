"""Where on the plate to point the laser: the same sweep, read at spots of a grid.

The reduced plate is made for the stated spot. At others its answers are good to first order, 1e-3 and better:
enough to compare, not to fit.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.planning.aims import Aims
from fitting.planning.choice import choose
from fitting.plate.mesh import Mesh
from fitting.plate.plate import Plate
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.planning.levels import at_level
from instrument.planning.outlook import At, Outlook
from instrument.planning.wish import Wish

_ALONG = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.97)
_ACROSS = (0.05, 0.2, 0.35, 0.5)
"""Of length and width. A base that heaves moves the plate evenly: the other half of the width reads the
same."""
_NEVER = 1e-9
"""A target that ends no plan before its time is used."""


@dataclass(frozen=True)
class Spot:
    """One spot, with a plan of its own."""

    x_m: float
    y_m: float
    worst: float
    """Worst relative standard error in the rig time of the plan at the stated spot."""
    steps: int
    seconds: float
    """Of its own plan to the target, or to the least it can reach."""
    reached: bool
    limit: float
    stated: bool = False
    """Whether it is the specimen's own."""


def spots_of(
    outlook: Outlook,
    aims: Aims,
    wish: Wish,
    level_g: float,
    budget_s: float,
    report: Callable[[float], None] = lambda share: None,
) -> list[Spot]:
    """The stated spot and those of a grid over the plate, best first."""
    s, mesh = outlook.specimen, outlook.setup.models.plate.mesh
    grid = [(x * s.length_m, y * s.width_m) for x in _ALONG for y in _ACROSS]
    found = [replace(_spot(outlook, outlook.here, aims, wish, level_g, budget_s), stated=True)]
    for done, spot in enumerate(grid):
        report(done / len(grid))
        found.append(_spot(outlook, _read_at(outlook, mesh, spot), aims, wish, level_g, budget_s))
    return sorted(found, key=lambda f: (not f.reached, f.seconds if f.reached else f.worst))


def _spot(outlook: Outlook, at: At, aims: Aims, wish: Wish, level_g: float, budget_s: float) -> Spot:
    s = at_level(outlook.sensitivity(1.0, wish.noise, at), outlook, wish, level_g)
    seconds = outlook.candidates.seconds
    whole = choose(s, aims, seconds, wish.target)
    same_time = choose(s, aims, seconds, _NEVER, budget_s=budget_s)
    return Spot(
        *at.spot_m,
        worst=float(same_time.worst[-1]),
        steps=len(whole.taken),
        seconds=float(whole.seconds[-1]),
        reached=whole.reached,
        limit=whole.limit,
    )


def _read_at(outlook: Outlook, mesh: Mesh, spot_m: tuple[float, float]) -> At:
    reduced = outlook.setup.reduced
    row = spot_row(outlook.setup.models.plate, reduced.V, spot_m)
    moved = replace(reduced, observe=row)
    plate = EnrichedReducedPlate.plain(moved, mesh, spot_m)
    own = outlook.setup.problem.plate
    k = np.flatnonzero(own.group == "plate")
    return At(replace(plate, U=own.U[k], d=own.d), moved, spot_m)


def spot_row(plate: Plate, V: Array, spot_m: tuple[float, float]) -> Array:
    """What a spot at x, y in m reads of the motions of a basis.

    `V` has shape (carried, motions): what the plate carries of each motion. Shape (motions,).
    """
    return np.asarray((plate.carried.T @ plate.observe(*spot_m)) @ V)
