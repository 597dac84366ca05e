"""What channels make of a velocity."""

import numpy as np
import pytest

from fitting.effects import CATALOGUE, Points
from fitting.effects.ac_coupling import AcCouplingEffect
from fitting.effects.phase_offset import PhaseOffsetEffect
from fitting.effects.phase_scale import continuous_phase

F = np.concatenate([np.linspace(19, 23, 21), np.linspace(92, 106, 31), np.linspace(270, 290, 21)])
LOWPASS, PHASE, GAIN, DELAY = (
    CATALOGUE[n] for n in ("sensor_lowpass", "phase_scale", "gain_error", "channel_delay")
)
HIGHPASS, OFFSET = AcCouplingEffect(), PhaseOffsetEffect()


def points(f=F):
    omega = 2 * np.pi * f
    return Points(omega, np.full(len(f), 9.81), np.arange(len(f)), True, True, "relative")


def velocity(f=F, signs=(-1, 1, -1)):
    """Three modes; a plate's lag its base by half a turn below the first."""
    modes = zip(signs, (21.0, 99.0, 281.0), (0.05, 0.08, 0.06), strict=True)
    x = sum(s / (p**2 * (1 + 1j * eta) - f**2) for s, p, eta in modes)
    return 1j * f * x


@pytest.mark.parametrize("tau_s", [2e-4, -2e-4])
def test_a_delay_lags_in_proportion_to_frequency(tau_s):
    """Below zero it leads. By less than half a turn up to 290 Hz."""
    omega = 2 * np.pi * F
    ratio = DELAY.reading(velocity(), points(), np.array([tau_s])) / velocity()
    assert np.angle(ratio) == pytest.approx(-omega * tau_s)
    assert np.abs(ratio) == pytest.approx(np.ones(len(F)))
    assert DELAY.story({"delay": tau_s}).endswith(f"lags by {1e6 * tau_s:.3g} microseconds")


def test_a_gain_is_a_factor_on_every_reading():
    for factor in (0.8, 1.0, 1.25):
        assert GAIN.reading(velocity(), points(), np.array([factor])) == pytest.approx(factor * velocity())


def test_a_low_pass_lags_and_takes_half_the_power_at_its_corner():
    v = LOWPASS.reading(velocity(), points(), np.array([100.0]))
    ratio = v / velocity()
    assert np.abs(ratio[F[np.argmin(np.abs(F - 100))] == F]) == pytest.approx(np.sqrt(0.5), rel=5e-3)
    assert (np.angle(ratio) < 0).all()
    assert LOWPASS.reading(velocity(), points(), np.array([np.inf])) == pytest.approx(velocity())
    stronger = LOWPASS.scaled(np.array([3000.0]), 2.0)
    assert stronger == pytest.approx([1500.0])


def test_a_high_pass_leads_and_blocks_what_is_slow():
    f = np.array([1e-3, 2.0, 2e3])
    ratio = HIGHPASS.reading(np.ones(3, complex), points(f), np.array([2.0]))
    assert np.abs(ratio) == pytest.approx([5e-4, np.sqrt(0.5), 1.0], rel=1e-3)
    assert np.angle(ratio[1]) == pytest.approx(np.pi / 4)
    assert HIGHPASS.reading(velocity(), points(), np.array([0.0])) == pytest.approx(velocity())


def test_phases_run_on_through_every_resonance():
    phase = continuous_phase(velocity(), 2 * np.pi * F)
    assert np.exp(1j * phase) == pytest.approx(velocity() / np.abs(velocity()))
    for low, high, middle in ((0, 25, -np.pi), (90, 110, 0.0), (260, 300, -np.pi)):
        here = phase[(low < F) & (high > F)]
        assert np.abs(np.diff(here)).max() < 0.8
        assert here[len(here) // 2] == pytest.approx(middle, abs=0.6)


def test_phases_do_not_ask_for_the_order_of_points():
    order = np.random.default_rng(0).permutation(len(F))
    shuffled = continuous_phase(velocity()[order], 2 * np.pi * F[order])
    assert shuffled == pytest.approx(continuous_phase(velocity(), 2 * np.pi * F)[order])


def test_a_wrong_scale_of_phase_leaves_amplitudes():
    v = PHASE.reading(velocity(), points(), np.array([1.03, 0.0]))
    assert np.abs(v) == pytest.approx(np.abs(velocity()))
    first = np.argmin(np.abs(F - 21.0))
    assert np.angle(v[first] / velocity()[first]) == pytest.approx(-0.03 * np.pi, abs=0.02)
    for counted in (0.0, 1.0, 2.0):
        assert PHASE.reading(velocity(), points(), np.array([1.0, counted])) == pytest.approx(velocity())


def test_phases_are_counted_as_the_meter_does():
    turn, half = (PHASE.reading(velocity(), points(), np.array([1.03, counted])) for counted in (1.0, 2.0))
    lag = np.angle(velocity())
    assert np.angle(turn / velocity()) == pytest.approx(0.03 * (lag % (2 * np.pi)))
    assert np.angle(half / velocity()) == pytest.approx(0.03 * lag)


def test_an_offset_of_phase_is_one_angle_at_every_frequency():
    ratio = OFFSET.reading(velocity(), points(), np.radians([1.5])) / velocity()
    assert ratio == pytest.approx(np.exp(1j * np.radians(1.5)))
    assert OFFSET.reading(velocity(), points(), np.array([0.0])) == pytest.approx(velocity())
    assert OFFSET.story({"phase": np.radians(1.5)}) == (
        "the velocity channel leads by +1.5 degrees at every frequency"
    )


@pytest.mark.parametrize("effect", [PHASE, OFFSET, DELAY])
def test_phases_are_not_judged_by_amplitudes(effect):
    no_phase = Points(2 * np.pi * F, np.ones(len(F)), F, True, False, "relative")
    assert effect.objection(no_phase, None)
    assert effect.objection(points(), None) is None


@pytest.mark.parametrize(
    ("effect", "at"),
    [
        (LOWPASS, [2e3]),
        (HIGHPASS, [0.5]),
        (PHASE, [1.02, 0.0]),
        (OFFSET, [0.02]),
        (DELAY, [1e-4]),
        (GAIN, [1.02]),
    ],
)
def test_readings_are_smooth_in_their_unknown(effect, at):
    h = 1e-4 * at[0]
    first = np.eye(len(at))[0]
    v = [effect.reading(velocity(), points(), at + k * h * first) for k in (-2, -1, 0, 1, 2)]
    wide, narrow = (v[4] - v[0]) / (4 * h), (v[3] - v[1]) / (2 * h)
    assert np.abs(wide - narrow).max() < 1e-6 * np.abs(narrow).max()
