"""Layers and laws of a specimen file as the plant takes them."""

import numpy as np
import pytest

from fitting.laws.fractional_zener import FractionalZener
from instrument.simulated_case.layers import series_of


def test_the_series_follows_the_law():
    law = FractionalZener(0.4e6, 4e6, 1.5e-4, 0.8)
    omega = 2 * np.pi * np.geomspace(10.0, 600.0, 12)
    series = series_of(law)
    found = np.array([complex(series.modulus(w)) for w in omega])
    assert found == pytest.approx(law.modulus(omega), rel=0.02)
