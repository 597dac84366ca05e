"""A loose strip made stronger by a first look's linear step."""

import numpy as np
import pytest

from fitting.effects.partial_debond import PartialDebondEffect


@pytest.mark.parametrize("times", [0.5, 3.0])
def test_a_strip_grows_and_shrinks_about_its_middle(times):
    begin, width = PartialDebondEffect("y").scaled(np.array([0.10, 0.02]), times)
    assert begin + width / 2 == pytest.approx(0.11)
    assert width == pytest.approx(0.02 * times)


def test_a_strip_at_an_edge_keeps_its_edge():
    assert PartialDebondEffect("y", at_edge=True).scaled(np.array([0.2, 0.02]), 3.0) == pytest.approx(
        [0.2, 0.06]
    )


def test_no_step_leaves_a_strip_of_less_than_nothing():
    assert PartialDebondEffect("x").scaled(np.array([0.10, 0.02]), -1.0)[1] == 0
