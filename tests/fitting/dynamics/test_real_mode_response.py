import numpy as np
import pytest
from paper_law import TABLE_4

from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.dynamics.real_mode_response import real_mode_plate
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate


@pytest.fixture(scope="module")
def paper_plate(coarse_plate):
    return real_mode_plate(coarse_plate, (1e4, 2e7))


def test_paper_response_on_the_papers_mesh(paper_plate, table5):
    x = paper_plate.displacement(table5.omega, TABLE_4.modulus(table5.omega))
    prototype = [0.0658, 0.0857, 0.0650, 0.0200, 0.0261, 0.0227, 0.0085, 0.0108, 0.0093]
    np.testing.assert_allclose(np.abs(table5.omega * x * 9.81), prototype, rtol=1e-2)


def test_direct_response_on_the_papers_mesh(coarse_plate, table5):
    w = table5.omega
    x = displacement_direct(coarse_plate, viscous_damping(coarse_plate), w, TABLE_4.modulus(w))
    prototype = [0.0632, 0.0872, 0.0700, 0.0189, 0.0270, 0.0247, 0.0095, 0.0115, 0.0093]
    np.testing.assert_allclose(np.abs(w * x * 9.81), prototype, rtol=1e-2)


@pytest.mark.parametrize("G", [2e4, 3e5, 1.5e6, 1e7])
def test_spanned_modes_are_those_of_the_plate(paper_plate, coarse_plate, G):
    spanned = np.concatenate(
        [span.modes(np.array([G]))[0][0] for span in (paper_plate.even, paper_plate.odd)]
    )
    np.testing.assert_allclose(np.sqrt(np.sort(spanned)[:8]), real_modes(coarse_plate, G, 8).omega, rtol=1e-5)


def test_superposition_follows_eq_12_to_14(coarse, paper_plate, coarse_plate):
    f = np.array([33.0])
    w, G = 2 * np.pi * f, TABLE_4.modulus(2 * np.pi * f)
    modes = real_modes(coarse_plate, float(G[0].real), 8)
    expected = 0
    for r in range(8):
        phi, w_r, zeta = modes.shapes[:, r], modes.omega[r], coarse.modal_ratios[r]
        eta = G[0].imag * (phi @ (coarse_plate.K_1 @ phi)) / w_r**2
        f_N = phi @ coarse_plate.base_load
        x_N = f_N / (w_r**2 * (1 + 1j * eta) + 2j * w[0] * zeta * w_r - w[0] ** 2)
        expected += (coarse_plate.pickup @ phi) * x_N
    assert paper_plate.displacement(w, G)[0] == pytest.approx(expected, rel=1e-5)


def test_both_responses_agree_where_damping_is_small(coarse):
    light = Plate(coarse.with_law(TABLE_4))
    w = 2 * np.pi * np.array([15.0, 30.0, 95.0])
    G = np.full(3, 0.4e6 * (1 + 0.01j))
    paper = real_mode_plate(light, (1e5, 1e6)).displacement(w, G)
    np.testing.assert_allclose(paper, displacement_direct(light, viscous_damping(light), w, G), rtol=2e-2)
