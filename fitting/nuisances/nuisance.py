"""Which stated numbers of a specimen a fit may move: those that its sweep can feel."""

from dataclasses import dataclass

import numpy as np

from fitting.plate.plate_numbers import plate_numbers, tolerance
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import NUMBERS, OF_CHANNELS, Unit
from fitting.widened.enriched_plate import EnrichedReducedPlate

_UNHEARD = 1e-6
"""A mode whose motion on the reduced plate is below this share of the largest one's is not felt: its damping
ratio is no unknown of a fit."""


@dataclass(frozen=True)
class Nuisance:
    """A stated number that a fit may move within its tolerance."""

    name: str
    """As results list it: `pickup_x`, `damping_1`."""
    kind: str
    """A key of `fitting.stated.tolerances.NUMBERS`."""
    sigma: float
    """Relative, m or s."""
    stated: float | None = None
    """In SI, of a number that no specimen states."""

    @property
    def unit(self) -> Unit:
        """Unit that `sigma` is stated in."""
        return NUMBERS[self.kind].unit


def channels_felt(*, has_phase: bool) -> tuple[str, ...]:
    """Kinds of numbers of the channel that readings can feel."""
    return OF_CHANNELS if has_phase else OF_CHANNELS[:1]


def felt(specimen: PlateSpecimen, plate: EnrichedReducedPlate, *, has_phase: bool) -> tuple[Nuisance, ...]:
    """All stated numbers of a specimen that a sweep of it can feel: delay and phase only with phasors."""
    found = [Nuisance(n, kind, tolerance(specimen, kind)) for n, kind in plate_numbers(specimen)]
    found += [Nuisance(f"pickup_{axis}", "pickup", tolerance(specimen, "pickup")) for axis in "xy"]
    if specimen.force_m is not None:
        found += [Nuisance(f"force_{axis}", "force", tolerance(specimen, "force")) for axis in "xy"]
    share = np.linalg.norm(plate.U, axis=0)
    heard = share > _UNHEARD * share.max(initial=0.0)
    damping = tolerance(specimen, "damping")
    found += [
        Nuisance(f"damping_{r + 1}", "damping", specimen.tolerances.get(f"damping_{r + 1}", damping))
        for r, ratio in enumerate(specimen.modal_ratios[: len(heard)])
        if ratio > 0 and heard[r] and plate.d[r] > 0
    ]
    weighed = tolerance(specimen, "mass")
    found += [Nuisance(f"mass_{k + 1}", "mass", weighed) for k in range(len(specimen.masses))]
    laid = tolerance(specimen, "place")
    found += [
        Nuisance(f"place_{k + 1}_{axis}", "place", laid) for k in range(len(specimen.masses)) for axis in "xy"
    ]
    found += [Nuisance(n, n, tolerance(specimen, n)) for n in channels_felt(has_phase=has_phase)]
    return tuple(n for n in found if n.sigma > 0)
