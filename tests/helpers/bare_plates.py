"""The published plate on a coarse mesh, and the modes of its bare sheet."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.bare_modes import (
    bare_modes,
)
from fitting.plate.plate import Plate


@pytest.fixture(scope="module")
def zn1(zn1):
    """On a coarse mesh: where both the test and the fit are of the same plate, its mesh says nothing."""
    return replace(zn1, elements=(10, 10))


def frequencies_hz(specimen, sensor=None):
    modes, edge = bare_modes(Plate(specimen.bare), 12, sensor)
    return (modes.omega * (1 - edge))[:8] / (2 * np.pi)
