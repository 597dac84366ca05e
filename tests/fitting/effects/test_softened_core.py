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


@dataclass(frozen=True)
class Resonant:
    """A strain at places across a resonance that goes down as the core softens: it folds, and may jump."""

    loss_factor: float

    def __call__(self, softened, gained=None):
        more = 0.0 if gained is None else gained * np.sqrt(self.loss_factor)
        square = np.linspace(0.7, 1.3, POINTS) ** 2
        return 0.4 / np.abs(1 - softened - square + 1j * (self.loss_factor * (1 - softened) + more))


def least_at_rest(curve, strain):
    """By walking up from nothing, for a core of which nothing stays."""
    walk = np.geomspace(1e-4, 60, 40_000)
    found = np.zeros(POINTS)
    for s in walk[::-1]:
        found = np.where(
            strain(curve.lost(np.full(POINTS, s)), curve.gained(np.full(POINTS, s))) <= s, s, found
        )
    return found


@pytest.mark.parametrize("loss_factor", [0.05, 0.2])
@pytest.mark.parametrize("curve", [Kraus(0.05), Kraus(0.2), Kraus(0.4, 1.0), Kraus(0.3, 0.0, -0.02)])
def test_beside_a_fold_it_comes_to_rest_at_the_least_strain(curve, loss_factor):
    strain = Resonant(loss_factor)
    here = SoftenedCore(curve, strain, POINTS, 0.0, TIME_S)
    s = strain(here.lost, here.gained if curve.loss else None)
    np.testing.assert_allclose(curve.lost(s), here.lost, atol=1e-6)
    far = np.abs(s / least_at_rest(curve, strain) - 1) > 0.02
    assert not far.any()


@pytest.mark.parametrize("loss_factor", [0.05, 0.2])
def test_beside_a_fold_it_comes_to_rest_where_some_of_it_stays(loss_factor):
    curve, kept, strain = Kraus(0.4, 1.0), 0.6, Resonant(loss_factor)
    here = SoftenedCore(curve, strain, POINTS, kept, TIME_S)
    s, order = strain(here.lost), np.argsort(TIME_S)
    largest = np.empty(POINTS)
    largest[order] = np.maximum.accumulate(s[order])
    np.testing.assert_allclose(here.lost, kept * curve.lost(largest) + (1 - kept) * curve.lost(s), atol=1e-6)


def test_where_nothing_strains_it_nothing_moves():
    here = SoftenedCore(Kraus(0.3), lambda softened, gained=None: 0.0 * softened, POINTS, 0.0, TIME_S)
    assert not here.lost.any()
    assert not np.array(here.along(ways())).any()


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
