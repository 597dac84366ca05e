import numpy as np
import pytest
from scipy.linalg import eigh

from drivers.simulated.plant.law import ZN1
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.sandwich import sandwich


@pytest.fixture(scope="module")
def plate():
    return sandwich().structure


def test_frequencies_with_a_constant_core_are_those_of_the_converged_solid(plate):
    lam = eigh(plate.K + 0.5e6 * plate.branches[0].K, plate.M, eigvals_only=True)
    known = [20.68, 56.58, 100.93, 176.05, 242.57, 269.45]
    np.testing.assert_allclose(np.sqrt(lam[:6]) / (2 * np.pi), known, rtol=1e-3)


@one_thread
def test_modes_with_the_core_s_own_law(plate):
    known = [19.39, 55.53, 100.83, 179.02, 252.16, 276.25]
    losses = [0.1003, 0.0975, 0.1381, 0.1398, 0.1847, 0.1351]
    inverse = np.linalg.inv(plate.M)
    for r, (frequency_hz, loss) in enumerate(zip(known, losses, strict=True)):
        omega = 2 * np.pi * frequency_hz
        for _ in range(5):
            lam = np.linalg.eigvals(inverse @ (plate.K + complex(ZN1.modulus(omega)) * plate.branches[0].K))
            lam = lam[np.argsort(lam.real)]
            omega = np.sqrt(lam[r].real)
        assert omega / (2 * np.pi) == pytest.approx(frequency_hz, rel=2e-3)
        assert lam[r].imag / lam[r].real == pytest.approx(loss, rel=8e-3)


def test_velocity_at_the_spot_for_one_g(plate):
    frequency_hz = [18.4, 19.3, 20.2, 94.3, 100.5, 105.0, 264.8, 281.1, 295.2]
    known = [0.0631, 0.0869, 0.0696, 0.0191, 0.0271, 0.0246, 0.0097, 0.0114, 0.0092]
    omega = 2 * np.pi * np.array(frequency_hz)
    velocity = [9.81 * w * abs(plate.readings[0] @ plate.response(w)[:, 0]) for w in omega]
    np.testing.assert_allclose(velocity, known, atol=5e-5, rtol=6e-3)


def test_matrices_store_and_take_energy(plate):
    for A in (plate.M, plate.K, plate.branches[0].K):
        np.testing.assert_allclose(A, A.T, atol=1e-12 * np.abs(A).max())
        assert np.linalg.eigvalsh(A)[0] > 0
    assert np.linalg.eigvalsh(plate.C)[0] > -1e-9 * np.abs(plate.C).max()
