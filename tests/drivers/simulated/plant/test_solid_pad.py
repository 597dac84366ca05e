"""The solid disc against what is known of rubber in shear without it."""

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from drivers.simulated.plant.solid_pad import PairStated, SolidPad


def shear_share(thickness_m: float, pieces=(8, 6), order: int = 3) -> float:
    """Static stiffness over that of plain shear, G A / t."""
    stated = PairStated(0.5, 2, thickness_m, 33.5e-3, 11.8e-3, 1100.0)
    solid = SolidPad(stated, pieces, order)
    K = (solid.moves.T @ solid.K_1 @ solid.moves).tocsc()
    force = np.zeros(K.shape[0])
    force[0] = 1.0
    return 1 / spsolve(K, force)[0] * thickness_m**2 / stated.volume_m3


def test_a_thin_disc_shears_and_a_thick_one_gives_way_at_its_edges():
    thin, thick = shear_share(0.5e-3), shear_share(6e-3)
    assert 0.993 < thin < 1
    assert thick == pytest.approx(0.936, abs=2e-3)


@pytest.mark.long
def test_a_finer_mesh_says_the_same():
    assert shear_share(6e-3) == pytest.approx(shear_share(6e-3, (10, 8), 4), rel=1e-3)


def test_it_weighs_what_it_is_made_of_and_shakes_as_one():
    solid = SolidPad(PairStated(0.5, 2, 6e-3, 33.5e-3, 11.8e-3, 1100.0))
    rigid = solid.rigid
    assert rigid @ solid.M @ rigid == pytest.approx(solid.stated.volume_m3 * 1100.0)
    assert rigid @ solid.K_1 @ rigid == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(solid.K_1 @ rigid, 0, atol=1e-9 * abs(solid.K_1).max())
