"""How soft a core is under its own strain, and how that moves, beside solving for it again."""

from dataclasses import dataclass

import numpy as np
import pytest

from fitting.effects.softened_core import SoftenedCore, softened_core
from fitting.laws.kraus import Kraus

POINTS = 60
TIME_S = np.random.default_rng(4).permutation(POINTS).astype(float)
PEAK = 1 / (1 + np.linspace(-4, 4.31, POINTS) ** 2)


@dataclass(frozen=True)
class Falling:
    """A strain over a resonance that falls as the core softens, or rises, and falls as it rubs."""

    rises: float
    more: float = 0.0
    way: int = 0

    def __call__(self, softened, gained=None):
        rubs = 0.0 if gained is None else 0.7 * gained
        return PEAK * np.exp(self.rises * softened - rubs + self.more * ways()[self.way])


def ways():
    return np.array([np.ones(POINTS), np.linspace(-1, 1, POINTS), np.cos(np.arange(POINTS))])


def core(curve, rises, kept, **moved):
    return SoftenedCore(curve, Falling(rises, **moved), POINTS, kept, TIME_S)


@pytest.mark.parametrize("rises", [-2.0, 0.0, 0.8])
@pytest.mark.parametrize("kept", [0.0, 0.6])
@pytest.mark.parametrize("curve", [Kraus(0.3), Kraus(0.4, 1.5, 0.2, 0.6)])
def test_it_is_at_rest_under_its_own_strain_and_moves_as_if_it_were_solved_again(curve, rises, kept):
    h, here = 1e-5, core(curve, rises, kept)
    s = here.strain(here.lost, here.gained if curve.loss else None)
    np.testing.assert_allclose(here.gained, curve.gained(s), atol=1e-9)
    if not kept:
        np.testing.assert_allclose(here.lost, curve.lost(s), atol=1e-9)
    else:
        # What came before has been strained more, and something of that stays.
        assert (here.lost > curve.lost(s) - 1e-9).all()
        assert (here.lost > curve.lost(s) + 0.01).any()
    lost, gained = here.along(ways())
    for n in range(len(ways())):
        up, down = (core(curve, rises, kept, more=s * h, way=n) for s in (1, -1))
        np.testing.assert_allclose(lost[n], (up.lost - down.lost) / (2 * h), atol=1e-5)
        np.testing.assert_allclose(gained[n], (up.gained - down.gained) / (2 * h), atol=1e-5)


def test_a_core_about_to_jump_moves_far_and_not_without_bound():
    curve = Kraus(0.5)
    for rises in np.linspace(1.8, 6.0, 40):
        lost, _ = core(curve, rises, 0.0).along(ways())
        assert np.isfinite(lost).all()
        assert np.abs(lost).max() < 0.5 / 0.05


def test_the_latest_is_known_again():
    asked = Kraus(0.2), Falling(0.1), POINTS, 0.0, b""
    assert softened_core(*asked) is softened_core(*asked)
    assert softened_core(Kraus(0.21), *asked[1:]) is not softened_core(*asked)
