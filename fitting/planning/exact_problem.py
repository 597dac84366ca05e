"""Points that may be measured as a problem of the joint inference, the plate solved at each of them.

A diagnosis interpolates between a few nodes of each dense segment. Candidates lie too far apart for that, and
are few.
"""

import numpy as np

from fitting.arrays import Array, Integers
from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid, points_of
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.nuisances.nuisances import nuisances_of
from fitting.reduced.rational import rational_sweep
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate


def exact_problem(
    frequency_hz: Array,
    region: Integers,
    level_m_s2: float,
    specimen: PlateSpecimen,
    plate: EnrichedReducedPlate,
    reduced: ReducedPlate,
    time_s: Array | None = None,
) -> DiagnosisProblem:
    """Of distinct, ascending frequencies; `plate` and `reduced` are of `specimen`. Shapes (points,)."""
    count = len(frequency_hz)
    sweep = Sweep(
        frequency_hz=frequency_hz,
        velocity_m_s=np.ones(count, dtype=complex),
        commanded_m_s2=np.full(count, level_m_s2),
        segment=region,
        sweep=np.ones(count, dtype=np.intp),
        time_s=time_s,
    )
    rational = rational_sweep(reduced, sweep.omega)
    nodes = EveryPoint.at(sweep.omega)
    grid = NodeGrid(nodes, rational)
    return DiagnosisProblem(
        sweep=sweep,
        specimen=specimen,
        plate=plate,
        points=points_of(sweep, specimen),
        rational=rational,
        fine=grid,
        coarse=grid,
        dense=nodes,
        nuisances=nuisances_of(specimen, plate, has_phase=True),
    )
