import numpy as np
import pytest

from drivers.simulated.plant.lines import Line

LINE = Line((0.0, 0.2, 0.7, 1.0), 3)


def test_a_cubic_is_its_values_at_the_nodes():
    def p(x):
        return 1 - 2 * x + 3 * x**3

    for x in (0.0, 0.1, 0.2, 0.55, 1.0):
        assert LINE.at(x) @ p(LINE.nodes) == pytest.approx(p(x))
    s = LINE.sampled
    np.testing.assert_allclose(s.values @ p(LINE.nodes), p(s.x))
    np.testing.assert_allclose(s.slopes @ p(LINE.nodes), -2 + 9 * s.x**2)


def test_integrals_of_products_are_exact():
    x, x3 = LINE.nodes, LINE.nodes**3
    assert x @ LINE.integral(0, 0) @ x3 == pytest.approx(1 / 5)
    assert x @ LINE.integral(1, 1) @ x3 == pytest.approx(1.0)
    assert x @ LINE.integral(0, 1) @ x3 == pytest.approx(3 / 4)
    assert x @ LINE.integral(0, 0, (0.2, 0.7)) @ x == pytest.approx((0.7**3 - 0.2**3) / 3)
