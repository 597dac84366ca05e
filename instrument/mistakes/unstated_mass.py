"""A sensor that sits on a beam and is not stated: how heavy it would be for the data to be this beam's."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import minimize_scalar

from fitting.digits import two_digits
from fitting.specimen import PlacedMass
from fitting.structures.beam import Beam

_SHARES = np.geomspace(0.005, 0.4, 8)
"""Of the beam's mass, that are tried first: from a miniature accelerometer on."""
_NEARER = 10
"""Further masses about the best of them."""


def unstated_mass(beam: Beam, distance: Callable[[Beam], float]) -> tuple[float, str]:
    """The least distance of data from the beam with a mass at its spot, and what that is, in a phrase."""
    assert beam.pickup_m is not None
    whole, x_m = mass_kg(beam), beam.pickup_m

    def with_share(log_share: float) -> float:
        carried = PlacedMass(float(np.exp(log_share)) * whole, x_m, 0.0)
        return distance(replace(beam, masses=(*beam.masses, carried)))

    logs = np.log(_SHARES)
    best = logs[int(np.argmin([with_share(x) for x in logs]))]
    step = logs[1] - logs[0]
    bounds = best - step, best + step
    found = minimize_scalar(with_share, bounds=bounds, method="bounded", options={"maxiter": _NEARER})
    grams = 1e3 * whole * float(np.exp(found.x))
    # A question is followed by how one goes on all the same, in a terminal or the window.
    said = (
        f"some {two_digits(grams)} g sat at the pickup that are not stated: [[mass]] states a sensor, and "
        "a diagnosis made all the same finds one"
    )
    return float(found.fun), said


def mass_kg(beam: Beam) -> float:
    """Of one piece, by its layers."""
    coating = 2 if beam.both_sides else 1
    layers = [(1, beam.substrate), (coating, beam.core), (coating, beam.constraining)]
    area = sum(n * x.thickness_m * x.density_kg_m3 for n, x in layers if x is not None)
    return float(area * beam.width_m * beam.span_m)
