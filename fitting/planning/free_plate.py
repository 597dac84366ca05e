"""The treated plate hung free and struck at a corner, on a mesh good enough to compare explanations."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.dynamics.damping import viscous_damping
from fitting.effects.air_added_mass import Air
from fitting.laws import CoreLaw
from fitting.plate.plate import Plate
from fitting.reduced.domain import Domain
from fitting.reduced.reduced_plate import ReducedPlate, reduce_plate
from fitting.specimen import PlateSpecimen
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.enriching import enriched, reach_over
from fitting.widened.full_plate import FullPlate
from fitting.widened.span import Span

_ELEMENTS = 96
"""All explanations are asked on the same mesh: half a percent in a frequency is in all of them. A choice."""
_HIT, _READ = (0.95, 0.9), (0.05, 0.1)
"""Of length and width: near two corners, where every mode of a free plate moves."""
_ROOM, _LOSS = 1.5, 1.5
"""How far the modulus may be off the law's, as a factor, and the largest loss factor. Choices."""
_GRID = 9
"""Frequencies at which the law is asked how far it reaches."""


def free_specimen(stated: PlateSpecimen, length_m: float | None = None) -> PlateSpecimen:
    """The plate without its clamp, struck and read near two corners; what damps it but the core is left out.

    `length_m` is of all that hangs; None: as long as it stands out of its clamp.
    """
    size = np.array([length_m or stated.length_m, stated.width_m])
    along = np.sqrt(_ELEMENTS * size[0] / size[1])
    return replace(
        stated,
        length_m=float(size[0]),
        boundary="free",
        force_m=tuple((size * _HIT).tolist()),
        pickup_m=tuple((size * _READ).tolist()),
        further_pickups_m=(),
        masses=(),
        modal_ratios=(),
        elements=(max(4, round(along)), max(4, round(_ELEMENTS / along))),
    )


def free_plate(
    specimen: PlateSpecimen, law: CoreLaw, frequency_hz: Array, spans: Sequence[Span]
) -> tuple[EnrichedReducedPlate, ReducedPlate]:
    """Of a specimen that hangs free, for some effects' spans and moduli about a law's.

    It holds from the lowest of `frequency_hz` to the highest, shape (any,).
    """
    low, high = float(frequency_hz.min()), float(frequency_hz.max())
    size = np.abs(law.modulus(2 * np.pi * np.geomspace(low, high, _GRID)))
    moduli = float(size.min()) / _ROOM, float(size.max()) * _ROOM
    plate = Plate(specimen)
    damping = viscous_damping(plate)
    reduced = reduce_plate(plate, damping, Domain((2 * np.pi * low, 2 * np.pi * high), moduli, _LOSS))
    # It is made for at least one, of which a fit takes the columns of those that it needs.
    motions = plate.carried @ reduced.V
    return enriched(
        FullPlate(plate, damping), motions, spans or [Air()], reach_hz=reach_over(frequency_hz)
    ), reduced
