import numpy as np

from fitting.dynamics.dynamic_stiffness import dynamic_stiffness, stacked


def matrices(seed, k=3):
    rng = np.random.default_rng(seed)
    K_0, K_1, M, C_1 = (rng.normal(size=(k, k)) for _ in range(4))
    return stacked(K_0 + 0.1j * K_1, K_1, M, C_1)


def test_it_is_the_sum_of_the_equation_of_motion_at_every_frequency():
    K_0, K_1, M, C_1 = plate = matrices(1)
    omega, G = np.array([10.0, 200.0]), np.array([1.0 + 0.2j, 3.0 + 2.0j])
    found = dynamic_stiffness(plate, omega, G)
    for A, w, g in zip(found, omega, G, strict=True):
        np.testing.assert_allclose(A, K_0 + g * K_1 + 1j * w * C_1 - w**2 * M, rtol=1e-12)


def test_beside_a_pole_only_the_square_is_another_one():
    K_0, K_1, M, C_1 = plate = matrices(2)
    p, G = np.array([50.0 + 1.0j]), np.array([2.0 + 1.0j])
    (found,) = dynamic_stiffness(plate, p, G, p**2 * 1.01)
    expected = K_0 + G[0] * K_1 + 1j * p[0] * C_1 - 1.01 * p[0] ** 2 * M
    np.testing.assert_allclose(found, expected, rtol=1e-12)
