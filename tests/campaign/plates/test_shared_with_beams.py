"""What plates and beams hide alike: scaled layers, a fixture that swings; a channel within its tolerance."""

import numpy as np
import pytest

from campaign.beams.geometry import BEAMS
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import PLATES
from campaign.plates.hidden import sizes
from campaign.plates.hidden.fixture import FixtureResonance
from campaign.plates.hidden.scaled import ConstrainingThickness, SubstrateStiffness
from campaign.plates.stated import CAREFUL


@pytest.mark.parametrize("true", [PLATES[0], BEAMS[0]], ids=["plate", "beam"])
def test_one_number_of_one_layer_is_scaled(true):
    stiffer, thicker = SubstrateStiffness(1.05).scaled(true), ConstrainingThickness(0.9).scaled(true)
    assert stiffer.substrate.young_pa == pytest.approx(1.05 * true.substrate.young_pa)
    assert thicker.constraining.thickness_m == pytest.approx(0.9 * true.constraining.thickness_m)
    assert (stiffer.core, stiffer.constraining) == (true.core, true.constraining)
    assert thicker.substrate == true.substrate


def test_a_fixture_is_stiff_far_below_its_resonance_and_lets_go_far_above():
    fixture = FixtureResonance(100.0, 0.02, 0.03, 0.1)
    slow, fast = 2 * np.pi * np.array([0.1, 1e5])
    assert fixture.root(slow) == pytest.approx(1.0, abs=1e-6)
    assert abs(fixture.pitch(slow)) < 1e-6
    assert fixture.root(fast) == pytest.approx(0.97, abs=1e-4)
    assert fixture.pitch(fast) == pytest.approx(-0.1 / 0.97, abs=1e-4)


def test_a_channel_is_off_by_so_many_tolerances():
    omega = 2 * np.pi * np.array([50.0, 500.0])
    assert ChannelError.within(CAREFUL, (0, 0, 0)) == ChannelError()
    off = ChannelError.within(CAREFUL, (2.0, -1.0, 3.0)).factor(omega)
    np.testing.assert_allclose(np.abs(off), np.exp(2 * 0.003))
    np.testing.assert_allclose(np.angle(off), np.deg2rad(0.3) + omega * 3e-6)


def test_what_is_hidden_matters_beside_what_a_careful_laboratory_knows():
    assert min(sizes.CLAMP_LINE_M) >= 5 * CAREFUL.length_m
    assert min(SubstrateStiffness.sizes) >= 4 * CAREFUL.young
