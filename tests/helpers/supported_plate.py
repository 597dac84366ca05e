"""A simply supported sandwich of aluminium, struck at a point and read at another; exact."""

from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face

ALUMINIUM = (70e9, 0.33, 2700.0)


def supported(law, elements):
    """With a core of this law. `elements` along each side."""
    return PlateSpecimen(
        0.3,
        0.22,
        "simply-supported",
        Face(2e-3, *ALUMINIUM),
        Face(0.5e-3, *ALUMINIUM),
        Core(0.5e-3, 0.49, 1000.0, law),
        exact=True,
        pickup_m=(0.2, 0.09),
        force_m=(0.1, 0.13),
        elements=elements,
    )
