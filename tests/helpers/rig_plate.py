"""The simulated rig's plate on a mesh half as fine as its own.

A model of it for a diagnosis is made in a third of the time, and its practice sweeps, a 3D solid's, are told
apart as well.
"""

from dataclasses import replace

from fitting.specimen import PlateSpecimen
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file

MESH = (20, 12)


def plate_of_the_rig() -> PlateSpecimen:
    """Its numbers exact; `replace(..., exact=False)`: each within its typical tolerance."""
    return replace(read_specimen(case_file("specimen.toml")), tolerances={}, elements=MESH)
