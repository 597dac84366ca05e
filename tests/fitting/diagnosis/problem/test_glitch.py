"""Stretches of a shear pair's sweep where a fixture resonates: what is set aside, and what is not."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import LAW, pair, sweep

from fitting.diagnosis.problem.glitch import glitches
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.joining import joined

PAIR = pair(0.2533)
NOISE = 5e-4
GUESS = replace(LAW, g0_pa=LAW.g0_pa / 1.5, ginf_pa=LAW.ginf_pa / 1.5)


def looked_at(changed=lambda f: 1.0, points=160, *, phase=True):
    """Its readings times what `changed` makes of them, looked at from a law a third too soft."""
    s = sweep(PAIR, points=points, noise=NOISE)
    read = s.velocity_m_s * changed(s.frequency_hz)
    s = type(s)(**{**vars(s), "velocity_m_s": read if phase else np.abs(read)})
    return s.frequency_hz, *glitches(SmallProblem.of_small(s, PAIR), GUESS)


def resonance(at_hz, size=0.05, width=0.01):
    return lambda f: 1 + size * width / ((f / at_hz) ** 2 - 1 + 1j * width)


def test_a_resonance_of_the_fixture_is_set_aside_as_far_as_it_shows():
    f, aside, (found,) = looked_at(resonance(300.0))
    assert found.low_hz < 300.0 < found.high_hz
    np.testing.assert_array_equal(aside, (f >= found.low_hz) & (f <= found.high_hz))
    assert found.points == aside.sum() < 0.2 * len(f)
    # What stays in is off by no more than readings scatter: three or four of their deviations.
    assert np.abs(resonance(300.0)(f[~aside]) - 1).max() < 4 * NOISE
    # Nearly all of it: the point next to the top reads that much too much.
    top = np.abs(resonance(300.0)(f) - 1).max()
    assert found.largest == pytest.approx(top, rel=0.15)


def test_a_stretch_up_to_where_the_curve_ends_says_so():
    def rises(f):
        return 1 + 0.15 * (f / f.max()) ** 12

    f, aside, (found,) = looked_at(rises)
    assert aside[-1]
    assert found.at_end
    assert found.high_hz == f.max()
    assert not looked_at(resonance(300.0))[2][0].at_end


def test_two_resonances_are_two_stretches():
    _, _, found = looked_at(lambda f: resonance(200.0)(f) * resonance(500.0)(f))
    assert [round(g.low_hz < at < g.high_hz) for g, at in zip(found, (200.0, 500.0), strict=True)] == [1, 1]


def test_lobes_of_one_disturbance_are_one_stretch():
    def lobes(f):
        # Off to either side of 280 Hz, by nothing at it.
        x = np.log(f / 280.0) / 0.08
        return 1 + 0.06 * x * np.exp(0.5 - x**2 / 2)

    _, _, (found,) = looked_at(lobes, points=400)
    assert found.low_hz < 240.0
    assert found.high_hz > 325.0


def test_what_law_gain_and_delay_may_leave_is_no_glitch():
    def smooth(f):
        return 1.03 * np.exp(-2j * np.pi * f * 5e-6) * (1 + 0.01 * (f / f.max()))

    for changed in (lambda f: 1.0, smooth):
        _, aside, found = looked_at(changed)
        assert not aside.any()
        assert found == ()
    _, aside, (one,) = looked_at(lambda f: smooth(f) * resonance(300.0)(f))
    assert one.low_hz < 300.0 < one.high_hz
    assert aside.mean() < 0.2


def test_single_outliers_are_of_another_kind():
    _, aside, found = looked_at(lambda f: 1 + 0.1 * (np.arange(len(f)) == 80))
    assert not aside.any()
    assert found == ()


def test_too_few_points_or_no_phase_say_nothing():
    for how in ({"points": 50}, {"phase": False}):
        _, aside, found = looked_at(resonance(300.0), **how)
        assert not aside.any()
        assert found == ()


def test_what_is_off_in_most_of_a_curve_is_not_local(monkeypatch):
    monkeypatch.setattr(
        "fitting.diagnosis.problem.glitch._stretches", lambda f, rest: [np.ones(len(f), bool)]
    )
    _, aside, found = looked_at(resonance(300.0))
    assert not aside.any()
    assert found == ()


@pytest.mark.parametrize("guess_pa", [0.8e6, 2e6, 4e6])
@pytest.mark.parametrize(
    "law", [(1.1e6, 8.8e6, 1e-7, 0.6), (1.1e6, 4.4e6, 1e-8, 0.3), (1.1e6, 33e6, 1e-7, 0.7)]
)
def test_the_narrow_resonance_of_a_rubber_of_low_loss_is_no_glitch(law, guess_pa):
    """Loss factors of 0.02 to 0.04, guessed from a law whose loss is ten times that."""
    low_loss = LAW.with_values(np.array(law))
    true = replace(PAIR, core=replace(PAIR.core, law=low_loss))
    s = sweep(true, points=120, noise=1e-3)
    guess = LAW.with_values(np.array([guess_pa, 30 * guess_pa, 1e-5, 0.6]))
    assert glitches(SmallProblem.of_small(s, true), guess)[1] == ()


def at_two_levels(low, high, level=0.981):
    """Sweeps at a tenth (or another `level`) and at one g in one, off by what each function makes of them."""
    each = [
        replace(s, velocity_m_s=s.velocity_m_s * changed(s.frequency_hz), sweep=np.full(160, k + 1))
        for k, (s, changed) in enumerate(
            ((sweep(PAIR, level=level, noise=NOISE), low), (sweep(PAIR, noise=NOISE, seed=1), high))
        )
    ]
    return glitches(SmallProblem.of_small(joined(each), PAIR), GUESS)[1]


def test_what_one_level_shows_and_another_does_not_is_no_fixture():
    def nothing(f):
        return np.ones(len(f))

    assert at_two_levels(nothing, resonance(300.0)) == ()
    assert len(at_two_levels(resonance(300.0), resonance(300.0))) == 2


def test_what_one_pass_shows_and_the_next_at_the_same_level_does_not_is_still_set_aside():
    assert len(at_two_levels(lambda f: np.ones(len(f)), resonance(300.0), level=9.81)) == 1


def test_a_stretch_in_which_the_pads_move_most_says_so():
    f, _, (elsewhere,) = looked_at(resonance(300.0))
    s = sweep(PAIR, points=160, noise=0.0)
    moves = np.abs(s.velocity_m_s - s.commanded_m_s2 / (1j * s.omega)) / s.omega
    _, _, (there,) = looked_at(resonance(float(f[np.argmax(moves)])))
    assert there.at_peak
    assert not elsewhere.at_peak
