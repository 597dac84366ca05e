"""A core of two bricks that soften each by itself: the state they settle at, on a plate of three motions."""

from types import SimpleNamespace

import numpy as np
import pytest

from campaign.plates.hidden.core import HiddenAmplitudeSoftening
from campaign.plates.reduced import ReducedSolid
from campaign.plates.response import BaseMotion, Shaken
from campaign.plates.softening import softened, strains
from fitting.gravity import PUBLISHED_G_M_S2

POINTS, LEVEL_G = 24, 0.5
G = 1e6 * (1 + 0.5j)


def random_core(dice, motions):
    rows = dice.standard_normal((2, 2, motions))
    return np.einsum("gai,gaj->gij", rows, rows)


def plate(seed=1, motions=3):
    """Unit masses on springs of 60 Hz and more, two bricks of core between them."""
    dice = np.random.default_rng(seed)
    K_0 = np.diag((2 * np.pi * np.linspace(60.0, 300.0, motions)) ** 2)
    none = np.zeros((motions, motions))
    load = np.zeros((motions, 3))
    load[:, 0] = 1 / np.arange(1, motions + 1)
    return ReducedSolid(
        np.eye(motions), K_0, 0.01 * random_core(dice, motions), np.array([2e-6, 5e-6]), np.zeros(2),
        np.zeros(2), load, np.zeros(2), np.zeros(2), np.zeros((1, 1, motions)), none,
    )  # fmt: skip


@pytest.fixture(scope="module", params=[3, 30])
def shaken(request):
    omega = 2 * np.pi * np.linspace(40, 200, POINTS)
    still = np.zeros(POINTS, complex)
    whole = plate(motions=request.param)
    return Shaken(whole, np.zeros_like(whole.M), omega, BaseMotion(still, still))


def schedule(level=LEVEL_G):
    segment = np.repeat([1, 2], POINTS // 2)
    return SimpleNamespace(level_g=np.full(POINTS, level), segment=segment)


def test_a_brick_s_strain_is_that_of_its_energy():
    p = plate()
    q = np.array([[1.0, 2j, 0.5 - 0.5j]])
    for k, volume in enumerate(p.volume_m3):
        energy = (q.conj() @ p.K_1[k] @ q.T).real.item()
        assert strains(p, q)[0, k] == pytest.approx(np.sqrt(energy / volume))
    # A brick without core has no strain.
    hollow = SimpleNamespace(K_1=np.zeros((1, 3, 3)), volume_m3=np.zeros(1))
    assert strains(hollow, q).tolist() == [[0.0]]


@pytest.mark.parametrize("rubbing", [0.0, 0.2])
@pytest.mark.parametrize("level", [0.1, 1.0])
def test_every_point_settles_where_strain_and_modulus_agree(shaken, level, rubbing):
    soft = HiddenAmplitudeSoftening(0.2, 0.5, rubbing=rubbing)
    q = softened(shaken, np.full(POINTS, G), soft, schedule(level))
    hard = shaken.displacements(np.full(POINTS, G))
    p, first = shaken.plate, slice(0, POINTS // 2)
    rms = np.sqrt((strains(p, hard[first]) ** 2) @ p.volume_m3 / p.volume_m3.sum())
    reference = rms.max() * PUBLISHED_G_M_S2
    factor = soft.factor(strains(p, q) * level * PUBLISHED_G_M_S2, reference)
    np.testing.assert_allclose(shaken.displacements(factor * G), q, rtol=1e-4, atol=1e-7 * np.abs(q).max())
    assert factor.real.min() < 0.99
    assert (factor.imag.max() > 0.01) == bool(rubbing)
    # Softer bricks move otherwise than hard ones, the more the higher the level.
    assert np.abs(q / hard - 1).max() > 0.02 * level


def test_bricks_that_soften_by_nothing_move_as_hard_ones_do(shaken):
    q = softened(shaken, np.full((POINTS, 2), G), HiddenAmplitudeSoftening(1e-12, 0.5), schedule())
    np.testing.assert_allclose(q, shaken.displacements(np.full(POINTS, G)), rtol=1e-6)


def test_at_the_reference_strain_so_much_is_lost_as_is_said():
    soft = HiddenAmplitudeSoftening(0.1, 0.5)
    assert soft.factor(np.array([0.0, 3.0, 1e9]), 3.0) == pytest.approx([1.0, 0.9, 0.5], abs=1e-6)


def test_half_of_what_can_be_lost_being_lost_a_core_gains_most_loss():
    soft = HiddenAmplitudeSoftening(0.25, 0.5, rubbing=0.2)
    gained = soft.factor(np.geomspace(0.01, 100.0, 201), 1.0).imag
    assert gained.max() == pytest.approx(gained[100])
    assert gained[100] == pytest.approx(0.5 * 0.2)


def test_what_finds_no_steady_state_is_refused(shaken):
    class Jumps(HiddenAmplitudeSoftening):
        def factor(self, strain, reference):
            jumps.append(0)
            return np.full(strain.shape, 0.5 + 0.4 * (len(jumps) % 2))

    jumps = []
    with pytest.raises(ArithmeticError, match=r"k = 0\.3 finds no steady state: use a smaller k"):
        softened(shaken, np.full(POINTS, G), Jumps(0.3, 0.5), schedule())
