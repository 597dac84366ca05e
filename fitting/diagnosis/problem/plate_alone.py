"""What is a plate's own, wherever it is driven and read."""

from dataclasses import replace

from fitting.specimen import PlateSpecimen, StatedSpecimen


def plate_alone(specimen: StatedSpecimen) -> StatedSpecimen:
    """A plate without where it is driven and read; another structure as it is."""
    if not isinstance(specimen, PlateSpecimen):
        return specimen
    return replace(specimen, force_m=None, pickup_m=None, further_pickups_m=())
