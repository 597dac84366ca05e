"""Whether the reduced model of one specimen may serve another that differs in stated values."""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.errors import OutsideModel
from fitting.nuisances.moved_plate import moved_plate
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.models.cache import cached
from instrument.models.set_up import check_like, set_up
from instrument.progress import Progress, quiet

SHARED = 1e-3
"""Relative error of a borrowed model above which a specimen gets its own: well below what a careful reading
scatters by, and of the size that moving a model by its tolerances costs anyway."""
_PROBES = 3
"""Frequencies at which a borrowed model is compared with a full solve: both ends and the middle."""


@dataclass(frozen=True)
class _Probed:
    """The certificate as the cache keeps it."""

    error: Array


def may_be_like(specimen: PlateSpecimen, like: PlateSpecimen) -> bool:
    """Whether it is worth asking: both with tolerances, of one mesh, a few percent apart."""
    if specimen.exact or like.exact or specimen.core is None or like.core is None:
        return False
    if (specimen.mesh, specimen.reads) != (like.mesh, like.reads):
        return False
    try:
        check_like(specimen, like)
    except OutsideModel:
        return False
    return True


def serves(like: PlateSpecimen, specimen: PlateSpecimen, sweep: Sweep, progress: Progress = quiet) -> bool:
    """Compare the moved model with full solves at a few points of the sweep, under the specimen's law."""
    if specimen.core is None or not may_be_like(specimen, like):
        return False
    f = np.geomspace(float(sweep.frequency_hz.min()), float(sweep.frequency_hz.max()), _PROBES)
    omega = 2 * np.pi * f
    G = specimen.core.law.modulus(omega)

    def probe() -> _Probed:
        ready = set_up(sweep, specimen, None, progress, with_effects=False, like=like)
        nuisances = ready.problem.nuisances
        moved = moved_plate(ready.reduced, nuisances, ready.problem.plate, np.zeros(len(nuisances)))
        plate = Plate(specimen)
        with progress("solving in full, to check a borrowed model"):
            full = displacement_direct(plate, viscous_damping(plate), omega, G)
        return _Probed(np.abs(moved.displacement(omega, G) / full - 1))

    depends_on = [replace(specimen, tolerances={}), replace(like, tolerances={}), f]
    modules = (
        "fitting.reduced.reduced_plate", "fitting.nuisances.nuisance", "fitting.nuisances.nuisances",
        "fitting.plate.parts", "fitting.dynamics.direct", "fitting.dynamics.damping",
    )  # fmt: skip
    return bool(np.max(cached("shared", depends_on, _Probed, probe, modules).error) <= SHARED)
