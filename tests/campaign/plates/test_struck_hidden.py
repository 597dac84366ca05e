"""What is hidden where plates are struck: against formulas, and in the solid."""

from dataclasses import replace

import numpy as np
import pytest
from coarse_solid import COARSE, MODULI, P2

from campaign.law import TrueLaw
from campaign.plates.blows import draw_blows
from campaign.plates.hidden import HIDDEN
from campaign.plates.hidden.attached import plate_mass_kg
from campaign.plates.hidden.struck import (
    NONE,
    PLACES,
    STRUCK_KINDS,
    HiddenCable,
    HiddenDoubleHit,
    HiddenExponentialWindow,
    HiddenGainOfASpot,
    HiddenHitElsewhere,
    HiddenPads,
    HiddenSpotElsewhere,
    draw_hidden_in_struck,
)
from campaign.plates.reduced import reduced
from campaign.plates.solid import Build, Solid
from campaign.plates.struck_readings import (
    aimed,
    mobilities,
    on_plate,
    places_on,
    plate_of,
    struck_so,
    through_channels,
)

LAW = TrueLaw("fractional-zener", (0.4e6, 8e6, 2e-4, 0.7))
OF = 110.0, 260.0, 380.0
F = np.array([2.0, 60.0, 150.0, 310.0])
HITS, SPOTS = [(0.03, 0.02)], [(0.27, 0.03), (0.05, 0.15)]


@pytest.fixture(scope="module")
def solid():
    places = [*HITS, *SPOTS, *cords().points()]
    return reduced(Solid(P2, Build(free=True), COARSE), MODULI, points_m=places)


def cords():
    return HiddenPads(800.0, 0.2, tuple((x, y) for x in (0.04, 0.28) for y in (0.02, 0.158)))


def test_a_weighted_record_is_what_its_spectrum_folded_with_the_window_s_gives(solid):
    """Y_w(omega) = integral of Y(omega') / (1/tau + i (omega - omega')) / 2 pi, whatever the plate is."""
    tau, held = 0.12, HiddenPads(4e4, 0.0, cords().corners_m)
    asked = F[1:3]
    near = [f + np.arange(-30.0, 30.0, 0.05) for f in asked]
    f = np.unique(np.concatenate([np.geomspace(0.02, 2e5, 4000), *near]))
    own = mobilities(solid, LAW, f, HITS, SPOTS[:1], (held,))[0, 0]
    omega = 2 * np.pi * np.concatenate([-f[::-1], f])
    Y = np.concatenate([own[::-1].conj(), own])
    kernel = 1 / (1 / tau + 1j * (2 * np.pi * asked[:, None] - omega))
    folded = np.trapezoid(Y * kernel, omega) / (2 * np.pi)
    window = HiddenExponentialWindow(tau, 0)
    found = mobilities(solid, LAW, asked, HITS, SPOTS[:1], (held, window))[0, 0]
    plain = mobilities(solid, LAW, asked, HITS, SPOTS[:1], (held,))[0, 0]
    assert np.abs(found / plain - 1).min() > 0.05
    np.testing.assert_allclose(found, folded, rtol=8e-3)


def test_every_kind_is_drawn_the_same_twice():
    for kind in STRUCK_KINDS:
        one, two = (draw_hidden_in_struck(kind, np.random.default_rng(5), P2, OF) for _ in range(2))
        assert one == two
        assert [h.name for h in one] == ([] if kind == NONE else [kind])


def test_points_are_off_by_millimetres_and_of_one_spot_or_of_all():
    at = (0.1, 0.09)
    every = set()
    for seed in range(20):
        spot = HiddenSpotElsewhere.draw(np.random.default_rng(seed), None)
        every.add(spot.every)
        assert 4e-3 <= np.hypot(*np.subtract(aimed(P2, at, 0.0, (spot,), 0), at)) <= 7e-3
        assert (aimed(P2, at, 0.0, (spot,), 1) == at) != spot.every
        assert aimed(P2, at, 0.0, (spot,)) == at
        hit = HiddenHitElsewhere.draw(np.random.default_rng(seed), None)
        assert aimed(P2, at, 0.0, (hit,), 0) == at
        assert 4e-3 <= np.hypot(*np.subtract(aimed(P2, at, 0.0, (hit,)), at)) <= 7e-3
    assert every == {True, False}


def test_a_line_that_bites_elsewhere_moves_spots_and_blows():
    line = HIDDEN["clamp_line"](2e-3)
    assert plate_of(P2, (line,)).length_m == pytest.approx(P2.length_m + 2e-3)
    assert aimed(P2, (0.1, 0.09), 0.0, (line,), 0) == pytest.approx((0.102, 0.09))
    assert aimed(P2, (0.1, 0.09), 0.0, (line,)) == pytest.approx((0.102, 0.09))


def test_no_point_is_off_the_plate():
    assert on_plate(P2, (P2.length_m, 0.0), (1e-3, -1e-3)) == (P2.length_m, 0.0)
    assert places_on(P2)[2] == pytest.approx((PLACES[2][0] * P2.length_m, PLACES[2][1] * P2.width_m))


def test_a_gain_of_one_spot_leaves_the_others_and_a_delay_none():
    v, omega = np.ones(3, complex), 2 * np.pi * np.array([1.0, 10.0, 100.0])
    gain, delay = HiddenGainOfASpot(1.05), HIDDEN["channel_delay"](1e-4)
    assert through_channels(v, omega, (gain, delay), 0) == pytest.approx(1.05 * np.exp(-1e-4j * omega))
    assert through_channels(v, omega, (gain,), 1) == pytest.approx(1.0)


def test_a_second_blow_ripples_the_mean_by_its_share():
    f = np.linspace(50.0, 800.0, 4000)
    blows = draw_blows(np.random.default_rng(3), 800.0)
    n = len(blows.strength)
    blows = replace(blows, strength=(1.0,) * n, bounce=(0.0,) * n, floor=1e-9, force_floor=1e-9)
    twice = HiddenDoubleHit(0.3, 0.01)
    found = [
        struck_so(blows, hidden).read(np.random.default_rng(0), f, np.ones((n, len(f)), complex)).H
        for hidden in ((), (twice,))
    ]
    # Hits that are not square are alike in both.
    assert np.ptp(np.abs(found[0])) < 1e-3
    off = found[1] / found[0] - 1
    assert off == pytest.approx(0.3 / n * np.exp(-2j * np.pi * f * 0.01), abs=1e-2 * 0.3 / n + 1e-3)


def test_pads_and_cables_answer_as_springs_do(solid):
    free, held = (mobilities(solid, LAW, F, HITS, SPOTS, hidden) for hidden in ((), (cords(),)))
    # Far below the first resonance it is a rigid plate on four springs, that bends a little.
    k, m = 4 * 800 * (1 + 0.2j), plate_mass_kg(P2)
    middle = [(P2.length_m / 2, P2.width_m / 2)]
    w = 2 * np.pi * F[:1]
    (((one,),),) = mobilities(solid, LAW, F[:1], middle, middle, (cords(),))
    assert one == pytest.approx(1j * w[0] / (k - w[0] ** 2 * m), rel=6e-2)
    assert np.abs(held / free - 1)[..., 0].min() > 0.5
    assert np.abs(held / free - 1)[..., -1].max() < 0.1
    # A spring at one point: H - H_a H_b k / (1 + k H_c), exactly, of receptances.
    at = cords().points()[0]
    cable = HiddenCable(500.0, 0.1, *at, to_floor=True)
    found = mobilities(solid, LAW, F, HITS, SPOTS, (cable,))
    iw = 2j * np.pi * F
    whole = mobilities(solid, LAW, F, [*HITS, at], [*SPOTS, at]) / iw
    spring = 500.0 + 0.1 * iw
    taken = whole[:2, 1] * whole[2, 0] * spring / (1 + spring * whole[2, 1])
    assert found[:, 0] == pytest.approx(iw * (whole[:2, 0] - taken), rel=1e-6)


def test_a_clamped_plate_s_own_damping_is_counted(solid):
    ratios = [0.0] * 6 + [0.05] * 4
    without, damped = (mobilities(solid, LAW, F, HITS, SPOTS, (), r) for r in ((), ratios))
    assert np.abs(damped / without - 1).max() > 0.02
