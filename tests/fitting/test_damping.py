"""Ratios of the bare plate's modes on the treated plate."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.damping import REFERENCE_MODULUS_PA, viscous_damping
from fitting.plate import Plate
from fitting.real_modes import real_modes

RATIOS = (0.01, 0.02, 0.0, 0.03, 0.04, 0.05)


@pytest.fixture(scope="module")
def wide(zn1):
    """A plate whose fourth and fifth mode change places under the treatment."""
    return replace(zn1, width_m=0.27, elements=(20, 14), pickup_m=(0.2, 0.03), modal_ratios=RATIOS)


def test_ratios_and_modes_are_paired_in_the_order_of_frequency(wide):
    plate = Plate(wide)
    modes = real_modes(plate, REFERENCE_MODULUS_PA, len(RATIOS))
    damping = viscous_damping(plate)
    assert list(damping.mode) == [0, 1, 3, 4, 5]
    np.testing.assert_allclose(damping.d, 2 * np.array([1, 2, 3, 4, 5]) / 100 * modes.omega[[0, 1, 3, 4, 5]])
    # phi^T C phi is diagonal: the ratios come back.
    projected = modes.shapes.T @ damping.U
    found = np.diag((projected * damping.d) @ projected.T) / (2 * modes.omega)
    np.testing.assert_allclose(found, RATIOS, atol=1e-9)
