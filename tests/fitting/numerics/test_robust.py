"""A scatter by the median is that of the noise, whatever a few readings do."""

import numpy as np
import pytest

from fitting.numerics.robust import robust_scatter


@pytest.mark.parametrize("wild", [0, 50])
def test_a_few_wild_values_do_not_move_the_scatter(wild):
    values = np.random.default_rng(4).normal(3.0, 0.2, 2000)
    values[:wild] = 1e6
    assert robust_scatter(values) == pytest.approx(0.2, rel=0.06)
