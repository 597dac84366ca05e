"""What a hidden effect does to plate, base and channels, against formulas; how large one is drawn."""

from dataclasses import replace

import numpy as np
import pytest
from coarse_solid import P2
from hypothesis import given
from hypothesis import strategies as st

from campaign.plates.hidden.base import Setting
from campaign.plates.hidden.base_motion import (
    HiddenBaseRocking,
    HiddenBaseRoll,
    HiddenFixtureResonance,
)
from campaign.plates.hidden.channels import (
    HiddenAbsoluteVelocity,
    HiddenAcCoupling,
    HiddenChannelDelay,
    HiddenGainError,
    HiddenPhaseScale,
    HiddenSensorLowpass,
    HiddenSpotOffset,
    HiddenViscousDamping,
)
from campaign.plates.hidden.layers import (
    HiddenConstrainingStiffness,
    HiddenConstrainingThickness,
    HiddenCoreThickness,
    HiddenMissingPiece,
    HiddenOrthotropicSubstrate,
    HiddenSubstrateStiffness,
)
from campaign.plates.hidden.strange import (
    HiddenCrackedSubstrate,
    HiddenStiffener,
    HiddenWrinkledConstraining,
)
from campaign.plates.response import BaseMotion
from campaign.plates.solid import Build

AT = Setting(P2, (20.0, 60.0, 110.0), 600.0)
F = np.array([1.0, 50.0, 100.0, 400.0])
OMEGA = 2 * np.pi * F
V = np.array([1.0, 1j, -0.5 + 0.2j, -1j])
STILL = BaseMotion(np.zeros(4, complex), np.zeros(4, complex))
L, B = P2.length_m, P2.width_m


def drawn(of):
    return lambda seed: of.draw(np.random.default_rng(seed), AT)


# The base


@given(st.builds(drawn(HiddenBaseRocking), st.integers(0, 9999)))
def test_a_base_rocks_by_so_much_over_the_plate_s_length(rocking):
    assert 0.01 <= abs(rocking.pitch_rad_m * L) <= 0.06
    twice = rocking.motion(rocking.motion(STILL, OMEGA), OMEGA)
    np.testing.assert_allclose(twice.pitch_rad_m, 2 * rocking.pitch_rad_m)
    np.testing.assert_array_equal(twice.roll_rad_m, 0)


@given(st.builds(drawn(HiddenBaseRoll), st.integers(0, 9999)))
def test_a_base_rolls_about_the_plate_s_axis(roll):
    assert 0.08 <= abs(roll.roll_rad_m * B) <= 0.4
    moved = roll.motion(STILL, OMEGA)
    np.testing.assert_allclose(moved.roll_rad_m, roll.roll_rad_m)
    np.testing.assert_array_equal(moved.pitch_rad_m, 0)


@given(st.builds(drawn(HiddenFixtureResonance), st.integers(0, 9999)))
def test_a_fixture_moves_its_root_and_pitch_by_one_resonance(fixture):
    assert 30.0 <= fixture.frequency_hz <= 176.0
    # What the plate's root does per reading of the reference; the reading is of the base before it.
    root = 1 / fixture.reference(np.ones(4, complex), OMEGA)
    r = F / fixture.frequency_hz
    swing = r**2 / (1 - r**2 + 2j * fixture.damping_ratio * r)
    np.testing.assert_allclose(root, 1 + fixture.gain * swing)
    # The pitch is told per acceleration of the root.
    pitch = fixture.motion(STILL, OMEGA).pitch_rad_m
    np.testing.assert_allclose(pitch * root, fixture.pitch_rad_m * swing)


def test_at_its_own_frequency_a_fixture_swings_by_one_over_twice_its_damping():
    fixture = HiddenFixtureResonance(100.0, 0.02, 0.05, 0.0)
    (root,) = 1 / fixture.reference(np.ones(1, complex), 2 * np.pi * np.array([100.0]))
    assert root == pytest.approx(1 - 1j * 0.05 / 0.04)


# Channels


CHANNELS = [
    (HiddenAbsoluteVelocity(), lambda base: V + base),
    (HiddenChannelDelay(1e-4), lambda base: V * np.exp(-2j * np.pi * F * 1e-4)),
    (HiddenGainError(1.03), lambda base: 1.03 * V),
    (HiddenSensorLowpass(2e3), lambda base: V / (1 + 1j * F / 2e3)),
    (HiddenAcCoupling(1.0), lambda base: V * F / (F - 1j)),
    # Phases 0, 90, 158.2 and 270 degrees, each counted 1.04 times.
    (HiddenPhaseScale(1.04), lambda base: np.abs(V) * np.exp(1.04j * (np.angle(V) % (2 * np.pi)))),
]


@pytest.mark.parametrize(("hidden", "expected"), CHANNELS, ids=lambda x: getattr(x, "name", ""))
def test_the_velocity_channel_makes_of_a_velocity_what_its_fault_does(hidden, expected):
    base = 1 / (1j * OMEGA)
    np.testing.assert_allclose(hidden.channel(V, OMEGA, base), expected(base))
    np.testing.assert_array_equal(hidden.reference(V, OMEGA), V)


def test_a_coupling_halves_the_power_at_its_corner_and_leaves_what_is_fast():
    slow, fast = HiddenAcCoupling(1.0).channel(np.ones(2), 2 * np.pi * np.array([1.0, 1e4]), np.zeros(2))
    assert abs(slow) == pytest.approx(np.sqrt(0.5))
    assert np.degrees(np.angle(slow)) == pytest.approx(45)
    assert fast == pytest.approx(1.0, abs=2e-4)


DRAWN = {
    HiddenChannelDelay: ("delay_s", 30e-6, 150e-6),
    HiddenSensorLowpass: ("corner_hz", 1e3, 5e3),
    HiddenAcCoupling: ("corner_hz", 0.3, 2.0),
    HiddenPhaseScale: ("factor", 1.02, 1.05),
    HiddenViscousDamping: ("scale", 1.5, 3.0),
}
TWO_SIDED = {
    HiddenGainError: ("factor", 0.015, 0.04),
    HiddenConstrainingStiffness: ("scale", 0.05, 0.1),
    HiddenConstrainingThickness: ("scale", 0.05, 0.1),
    HiddenSubstrateStiffness: ("scale", 0.04, 0.08),
    HiddenCoreThickness: ("scale", 0.1, 0.15),
}


@pytest.mark.parametrize("of", [*DRAWN, *TWO_SIDED], ids=lambda of: of.name)
def test_severities_matter_and_stay_plausible(of):
    key, low, high = (DRAWN | TWO_SIDED)[of]
    values = np.array([drawn(of)(seed).facts[key] for seed in range(60)])
    size = np.abs(values - 1) if of in TWO_SIDED else values
    assert size.min() >= low * (1 - 1e-9)
    assert size.max() <= high * (1 + 1e-9)
    # Not all alike, and of either sign where there are two.
    assert np.ptp(size) > 0.5 * (high - low)
    assert of in DRAWN or (np.any(values > 1) and np.any(values < 1))


@given(st.builds(drawn(HiddenSpotOffset), st.integers(0, 9999)))
def test_a_spot_is_off_by_some_millimetres_and_stays_on_the_plate(offset):
    assert 2e-3 <= np.hypot(offset.dx_m, offset.dy_m) <= 6e-3
    x, y = offset.spot((0.5 * L, 0.5 * B), P2)
    assert (x - 0.5 * L, y - 0.5 * B) == pytest.approx((offset.dx_m, offset.dy_m))
    for corner in ((0.0, 0.0), (L, B)):
        x, y = offset.spot(corner, P2)
        assert 0 <= x <= L
        assert 0 <= y <= B


def test_remaining_damping_is_as_many_times_that_of_the_bare_plate():
    np.testing.assert_allclose(HiddenViscousDamping(2.0).ratios(np.array(P2.ratios)), 2 * np.array(P2.ratios))


# Layers


LAYERS = [
    (HiddenConstrainingStiffness(1.1), "constraining", "young_pa", False),
    (HiddenConstrainingThickness(0.9), "constraining", "thickness_m", False),
    (HiddenCoreThickness(1.15), "core", "thickness_m", False),
    (HiddenSubstrateStiffness(1.05), "substrate", "young_pa", True),
]


@pytest.mark.parametrize(
    ("hidden", "layer", "number", "struck"), LAYERS, ids=lambda x: getattr(x, "name", "")
)
def test_one_number_of_one_layer_is_off_and_the_hammer_feels_the_substrate_alone(
    hidden, layer, number, struck
):
    off = hidden.plate(P2)
    assert getattr(getattr(off, layer), number) == pytest.approx(
        hidden.scale * getattr(getattr(P2, layer), number)
    )
    assert replace(off, **{layer: getattr(P2, layer)}) == P2
    assert (hidden.at_hammer(P2.bare, Build())[0] != P2.bare) is struck


def test_a_rolled_sheet_is_rolled_for_the_hammer_too():
    hidden = drawn(HiddenOrthotropicSubstrate)(3)
    assert 0.03 <= abs(hidden.rolled) <= 0.06
    for plate in (hidden.plate(P2), hidden.at_hammer(P2.bare, Build())[0]):
        assert plate.substrate.rolled == hidden.rolled


# What no catalogue has


@given(st.builds(drawn(HiddenCrackedSubstrate), st.integers(0, 9999)))
def test_a_crack_is_a_soft_line_from_one_edge_that_the_hammer_feels(crack):
    plate, struck = crack.at_hammer(P2.bare, Build())
    assert plate == P2.bare
    for build in (crack.build(Build(), P2), struck):
        x = np.array([crack.x_m, crack.x_m, crack.x_m + 2 * crack.half_width_m])
        y = np.array([0.9, 1.1, 0.9]) * crack.reaches_m
        np.testing.assert_allclose(build.substrate_factor(x, y), [crack.left, 1.0, 1.0])
        # Bricks end at the crack's edges and at its tip.
        assert np.mean(build.lines_x_m) == pytest.approx(crack.x_m)
        assert np.ptp(build.lines_x_m) == pytest.approx(2 * crack.half_width_m)
        assert build.lines_y_m == (crack.reaches_m,)
    assert 0.15 <= crack.left <= 0.4


def test_two_cracks_make_both_lines_soft():
    one, other = HiddenCrackedSubstrate(0.05, 0.1, 1e-3, 0.3), HiddenCrackedSubstrate(0.09, 0.1, 1e-3, 0.2)
    both = other.build(one.build(Build(), P2), P2)
    factor = both.substrate_factor(np.array([0.05, 0.09, 0.07]), np.full(3, 0.01))
    np.testing.assert_allclose(factor, [0.3, 0.2, 1.0])
    assert len(both.lines_x_m) == 4


@given(st.builds(drawn(HiddenWrinkledConstraining), st.integers(0, 9999)))
def test_a_wrinkle_stretches_most_in_its_middle_and_the_hammer_feels_none(wrinkled):
    factor = wrinkled.build(Build(), P2).constraining_factor
    x, y, s = wrinkled.x_m, wrinkled.y_m, wrinkled.size_m
    middle, along, across, far = factor(np.array([x, x + s, x, x + 20 * s]), np.array([y, y, y + 2 * s, y]))
    assert middle == pytest.approx(1 - wrinkled.lost)
    # As far as one standard deviation, which across is twice as far as along.
    assert along == pytest.approx(across) == pytest.approx(1 - wrinkled.lost * np.exp(-0.5))
    assert far == pytest.approx(1.0)
    assert wrinkled.at_hammer(P2.bare, Build()) == (P2.bare, Build())
    assert not wrinkled.in_catalogue


@given(st.builds(drawn(HiddenStiffener), st.integers(0, 9999)))
def test_a_stiffener_is_stiff_and_heavy_where_it_is_stuck_on(stiffener):
    build = stiffener.build(Build(), P2)
    (x_0, y_0), (x_1, y_1) = stiffener.from_m, stiffener.to_m
    assert 0 <= x_0 < x_1 <= L
    assert 0 <= y_0 < y_1 <= B
    factor = build.constraining_factor(np.array([(x_0 + x_1) / 2, x_0 - 1e-3]), np.full(2, (y_0 + y_1) / 2))
    np.testing.assert_allclose(factor, [stiffener.factor, 1.0])
    assert sum(p.mass_kg for p in build.patches) == pytest.approx(stiffener.mass_kg)
    for p in build.patches:
        half = p.side_m / 2 - 1e-9
        assert x_0 <= p.x_m - half
        assert p.x_m + half <= x_1
        assert y_0 <= p.y_m - half
        assert p.y_m + half <= y_1


@given(st.builds(drawn(HiddenMissingPiece), st.integers(0, 9999)))
def test_next_to_nothing_is_left_of_a_chipped_corner(chipped):
    build, side = chipped.build(Build(), P2), chipped.side_m
    x, y = np.array([L - side / 2, L - 2 * side]), np.full(2, side / 2)
    np.testing.assert_allclose(build.whole_factor(x, y), [chipped.left, 1.0])
    assert build.lines_x_m == (L - side,)
    assert build.lines_y_m == (side,)
