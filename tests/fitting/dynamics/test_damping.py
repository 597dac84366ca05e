"""Ratios of the bare plate's modes on the treated plate."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.damping import REFERENCE_MODULUS_PA, paired_modes, viscous_damping
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate

RATIOS = (0.01, 0.02, 0.0, 0.03, 0.04, 0.05)


@pytest.fixture(scope="module")
def wide(zn1):
    """A plate whose fourth and fifth mode change places under the treatment."""
    return replace(zn1, width_m=0.27, elements=(20, 14), pickup_m=(0.2, 0.03), modal_ratios=RATIOS)


def test_a_ratio_follows_its_shape(wide):
    plate = Plate(wide)
    modes = real_modes(plate, REFERENCE_MODULUS_PA, len(RATIOS))
    assert list(paired_modes(plate, modes, len(RATIOS))) == [0, 1, 2, 4, 3, 5]
    damping = viscous_damping(plate)
    assert list(damping.mode) == [0, 1, 3, 4, 5]
    np.testing.assert_allclose(damping.d, 2 * np.array([1, 2, 3, 4, 5]) / 100 * modes.omega[[0, 1, 4, 3, 5]])
    # phi^T C phi is diagonal: each of the plate's modes has the ratio of its shape.
    projected = modes.shapes.T @ damping.U
    found = np.diag((projected * damping.d) @ projected.T) / (2 * modes.omega)
    np.testing.assert_allclose(found, [0.01, 0.02, 0.0, 0.04, 0.03, 0.05], atol=1e-9)


def test_where_the_order_is_the_same_nothing_is_paired_anew(zn1):
    plate = Plate(replace(zn1, elements=(20, 14)))
    count = len(zn1.modal_ratios)
    modes = real_modes(plate, REFERENCE_MODULUS_PA, count)
    assert list(paired_modes(plate, modes, count)) == list(range(count))
