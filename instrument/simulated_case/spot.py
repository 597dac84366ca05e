"""Where the published plate on the simulated rig is read."""

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file

_AIMED_M = 1e-3
"""As near a laser is aimed."""


def spot_elsewhere(stated: AnySpecimen) -> tuple[float, float] | None:
    """The stated spot in m, where it is another than the published plate's.

    None where it is that one as nearly as a laser is aimed: a file that is a little off moves no laser.
    """
    published = read_specimen(case_file("specimen.toml")).pickup_m
    if not isinstance(stated, PlateSpecimen) or stated.pickup_m is None or published is None:
        return None
    off = max(abs(a - b) for a, b in zip(published, stated.pickup_m, strict=True))
    return stated.pickup_m if off > _AIMED_M else None
