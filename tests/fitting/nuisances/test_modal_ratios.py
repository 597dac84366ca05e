"""Modal ratios are so many times what is stated, each of its own mode."""

import numpy as np
import pytest

from fitting.nuisances.modal_ratios import StatedRatios
from fitting.nuisances.nuisance import Nuisance

RATIOS = StatedRatios(
    (
        Nuisance("damping_3", "damping", 0.2),
        Nuisance("length", "length", 3e-4),
        Nuisance("damping_1", "damping", 0.4),
    )
)
Z = np.array([1.5, -2.0, -0.5])


def test_a_number_moves_its_own_mode_in_the_logarithm():
    np.testing.assert_allclose(np.log(RATIOS.factor(4, Z)), [-0.2, 0.0, 0.3, 0.0], atol=1e-15)


def test_derivatives_are_those_of_the_factor():
    by, h = RATIOS.by(4, Z), 1e-5
    assert {k: mode for k, (mode, _) in by.items()} == {0: 2, 2: 0}
    for k, (mode, slope) in by.items():
        step = h * np.eye(3)[k]
        up, down = (RATIOS.factor(4, Z + s)[mode] for s in (step, -step))
        assert slope == pytest.approx((up - down) / (2 * h), rel=1e-8)
