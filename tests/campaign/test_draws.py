"""How campaigns draw."""

import numpy as np
import pytest

from campaign.draws import either_sign, log_uniform, order_of_time


def test_a_decade_is_as_likely_as_any_other():
    rng = np.random.default_rng(1)
    drawn = np.array([log_uniform(rng, 1e-2, 1e2) for _ in range(4000)])
    assert np.histogram(np.log10(drawn), (-2, -1, 0, 1, 2))[0] == pytest.approx(1000, abs=120)


def test_both_signs_come_and_nothing_smaller():
    rng = np.random.default_rng(2)
    drawn = np.array([either_sign(rng, 1.0, 2.0) for _ in range(400)])
    assert 150 < (drawn > 0).sum() < 250
    assert (np.abs(drawn) >= 1).all()
    assert (np.abs(drawn) <= 2).all()


@pytest.mark.parametrize("along", ["up", "down", "random"])
def test_every_point_is_read_once(along):
    order = order_of_time(np.random.default_rng(3), 20, along)
    assert sorted(order.tolist()) == list(range(20))
    assert (np.diff(order) == {"up": 1, "down": -1}.get(along, np.diff(order))).all()
