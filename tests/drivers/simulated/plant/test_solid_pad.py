"""The solid disc against what is known of rubber in shear without it."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

from drivers.simulated.plant.lines import Line
from drivers.simulated.plant.solid_pad import PairStated, SolidPad
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core
from fitting.structures.shear_pair import EDGE, ShearPair, disc


def pair(thickness_m: float) -> PairStated:
    return PairStated(0.5, 2, thickness_m, 33.5e-3, 11.8e-3, 1100.0)


def shear_share(stated: PairStated, pieces=(8, 6), order: int = 3) -> float:
    """Static stiffness over that of plain shear, G A / t."""
    solid = SolidPad(stated, pieces, order)
    K = (solid.moves.T @ solid.K_1 @ solid.moves).tocsc()
    force = np.zeros(K.shape[0])
    force[0] = 1.0
    return 1 / spsolve(K, force)[0] * stated.thickness_m**2 / stated.volume_m3


def test_a_thin_disc_shears_and_a_thick_one_gives_way_at_its_edges():
    thin, thick = shear_share(pair(0.5e-3)), shear_share(pair(6e-3))
    assert 0.993 < thin < 1
    assert thick == pytest.approx(0.936, abs=2e-3)


def test_a_finer_mesh_says_the_same():
    assert shear_share(pair(6e-3)) == pytest.approx(shear_share(pair(6e-3), (10, 8), 4), rel=1e-3)


def test_it_weighs_what_it_is_made_of_and_shakes_as_one():
    solid = SolidPad(PairStated(0.5, 2, 6e-3, 33.5e-3, 11.8e-3, 1100.0))
    rigid = solid.rigid
    assert rigid @ solid.M @ rigid == pytest.approx(solid.stated.volume_m3 * 1100.0)
    assert rigid @ solid.K_1 @ rigid == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(solid.K_1 @ rigid, 0, atol=1e-9 * abs(solid.K_1).max())


@pytest.mark.parametrize(
    ("thickness", "outer", "inner"), [(2, 33.5, 11.8), (6, 33.5, 11.8), (5, 20, 0), (5, 40, 0)]
)
def test_what_a_fit_counts_for_free_edges_is_what_the_solid_gives_way(thickness, outer, inner):
    stated = PairStated(0.5, 1, 1e-3 * thickness, 1e-3 * outer, 1e-3 * inner, 1100.0)
    area, gyration = disc(stated.outer_m, stated.inner_m)
    core = Core(stated.thickness_m, 0.4999, 1100.0, ConstantModulus(1e6, 0.1))
    counted = 1 - ShearPair(0.5, 1, area, core, gyration, edges=True).softer_by_edges
    assert counted == pytest.approx(shear_share(stated), rel=4e-3)


@pytest.mark.parametrize(
    ("inner", "times", "off"), [(0, 1.0, 0.013), (10, 1.0, 0.0045), (0, 1.5, 0.041), (0, 2.0, 0.091)]
)
def test_thick_discs_give_way_by_more_than_is_counted(inner, times, off):
    """Up to a thickness of r_o - r_i by no more than its square, which every fit leaves open."""
    outer = 30 if inner else 20
    stated = PairStated(0.5, 1, 1e-3 * times * (outer - inner) / 2, 1e-3 * outer, 1e-3 * inner, 1100.0)
    area, gyration = disc(stated.outer_m, stated.inner_m)
    core = Core(stated.thickness_m, 0.4999, 1100.0, ConstantModulus(1e6, 0.1))
    softer = ShearPair(0.5, 1, area, core, gyration, edges=True).softer_by_edges
    assert (1 - softer) / shear_share(stated) - 1 == pytest.approx(off, abs=1e-3)
    assert (off < 1.05 * softer**2) is (times <= 1)


def test_an_edges_share_is_that_of_a_long_strip():
    """The plane problem: 12 thicknesses long, faces held, one moved along the other; both ends free."""
    length = 12.0
    graded = (0.0, 0.02, 0.1, 0.3, 0.8, 2.0, 6.0)
    x = Line((*graded, *(length - a for a in graded[-2::-1])), 3)
    z = Line((0.0, 0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1.0), 3)
    lame = 2 * 0.4995 / (1 - 2 * 0.4995)

    def product(i, j):
        (a, b), (c, d) = ((int(k == 0), int(k == 1)) for k in (i, j))
        return sp.kron(x.integral(a, c), z.integral(b, d))

    laplace = product(0, 0) + product(1, 1)
    blocks = [
        [lame * product(i, j) + product(j, i) + (laplace if i == j else 0 * laplace) for j in (0, 1)]
        for i in (0, 1)
    ]
    K = sp.block_array(blocks).tocsr()
    count = len(x.nodes) * len(z.nodes)
    u = np.zeros(2 * count)
    u[:count] = np.tile(z.nodes, len(x.nodes))
    free = np.tile((z.nodes > 0) & (z.nodes < 1), 2 * len(x.nodes))
    u[free] -= spsolve(K[free][:, free].tocsc(), (K @ u)[free])
    assert (1 - u @ K @ u / length) * length / 2 == pytest.approx(EDGE, abs=1e-3)
