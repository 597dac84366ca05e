"""An impact test's result and figures: what is read off its modes, and what is drawn where."""

from dataclasses import replace

import numpy as np
import pytest
from impact_cases import AMPLITUDES, BARE_HZ, TABLE_3, clean_hit, noisy_hits

from fitting.dynamics.bare_modes import CarriedSensor
from fitting.modal.frf import DampingEstimate, Frf, Refusal
from instrument.impact.damping import damping_of_frfs, damping_of_hits
from instrument.impact.figures import damping_figures, frf_figure, highest_hz, hits_figure, modes_figure
from instrument.impact.judge import judge
from instrument.impact.result import damping_from, sensor_from

TWO = slice(1, 3)
"""The second and the third mode of the bare plate."""


@pytest.fixture(scope="module")
def found():
    """Two good hits, and one that was not: of two modes."""
    clean = clean_hit(BARE_HZ[TWO], TABLE_3[TWO], AMPLITUDES[TWO], seconds=4.0)
    hits = [judge(h) for h in noisy_hits(clean, np.random.default_rng(1))]
    hits[1] = replace(hits[1], accepted=False, why="double hit")
    return damping_of_hits(hits, at_hz=tuple(BARE_HZ[TWO]))


def test_every_mode_has_what_each_method_says_and_what_is_adopted(found):
    result = damping_from(found)
    assert [m.frequency_hz for m in result.modes] == pytest.approx(BARE_HZ[TWO], rel=1e-4)
    assert [m.damping_ratio for m in result.modes] == pytest.approx(TABLE_3[TWO], rel=0.03)
    for made, mode in zip(result.modes, found.modes, strict=True):
        assert made.rational_fit.ratio == mode.rational_fit.ratio
        assert made.rational_fit.standard_error == mode.rational_fit.standard_error
        assert (made.channel, made.accepted, made.why) == (mode.channel, mode.accepted, mode.why)
        assert made.bandwidths_to_next == mode.bandwidths_to_next


def test_a_method_that_refused_has_no_value():
    silent = Refusal("one line in the bandwidth")
    one = replace(mode_of(), half_power=silent, lscf=silent)
    (made,) = damping_from(replace(plain(), modes=(one,))).modes
    assert (made.half_power, made.lscf) == (None, None)
    assert made.rational_fit is not None


def test_hits_are_listed_with_why_one_was_left_out(found):
    result = damping_from(found)
    assert [(h.source, h.accepted, h.why) for h in result.hits] == [
        ("hit 1", True, ""),
        ("hit 2", False, "double hit"),
        ("hit 3", True, ""),
    ]
    assert "hit 2 left out: double hit" in result.warnings


def test_a_sensor_on_the_plate_is_kept_with_its_place():
    assert sensor_from(CarriedSensor(6e-4, 0.27, 0.17)).as_json() == {
        "mass_kg": 6e-4,
        "x_m": 0.27,
        "y_m": 0.17,
    }


# Figures


def mode_of():
    return plain().modes[0]


def plain():
    """Of another instrument's FRF: neither hits nor coherence."""
    f = np.arange(0.0, 100.0, 0.125)
    w, w_r = 2 * np.pi * f, 2 * np.pi * 60.0
    H = -(w**2) / (w_r**2 - w**2 + 2j * 0.004 * w_r * w)
    return damping_of_frfs({"tip": Frf(f, H, "acceleration")}, at_hz=(60.0,))


def test_an_frf_is_drawn_to_a_quarter_beyond_its_highest_mode_with_coherence_below(found):
    above, below = frf_figure(found).axes
    frf = found.plain["acceleration_m_s2"]
    np.testing.assert_array_equal(above.lines[0].get_ydata(), np.abs(frf.H[1:]))
    assert above.get_xlim() == pytest.approx((0, 1.25 * BARE_HZ[2]), rel=1e-3)
    assert highest_hz(found) == pytest.approx(1.25 * BARE_HZ[2], rel=1e-3)
    marked = [line.get_xdata()[0] for line in above.lines[1:]]
    assert marked == pytest.approx(BARE_HZ[TWO], rel=1e-4)
    np.testing.assert_array_equal(below.lines[0].get_ydata(), found.coherence["acceleration_m_s2"])
    assert above.get_ylabel() == "Accelerance / (m/s²/N)"


def test_a_mode_that_is_not_accepted_has_another_colour():
    good, bad = plain().modes[0], replace(plain().modes[0], accepted=False)
    colours = [frf_figure(replace(plain(), modes=(m,))).axes[0].lines[1].get_color() for m in (good, bad)]
    assert colours[0] != colours[1]


def test_without_modes_the_whole_frf_is_drawn():
    nothing = replace(plain(), modes=())
    assert highest_hz(nothing) == 0
    (ax,) = frf_figure(nothing).axes
    assert ax.get_xlim()[1] > 99


def test_each_hit_has_its_blow_and_its_decay_and_says_why_it_was_left_out(found):
    axes = hits_figure(found).axes
    assert [ax.get_title() for ax in axes[::2]] == ["hit 1", "hit 2: left out", "hit 3"]
    assert [ax.get_title() for ax in axes[1::2]] == ["", "double hit", ""]
    blow, decay = axes[0].lines[0], axes[1].lines[0]
    hit = found.hits[0].hit
    assert blow.get_ydata().max() == hit.force_n.max()
    # The blow is a close look in milliseconds, the decay the whole record in seconds.
    assert np.ptp(blow.get_xdata()) < 50
    assert decay.get_xdata()[-1] == pytest.approx(hit.seconds, rel=1e-3)


def test_each_mode_has_its_lines_its_fit_and_its_half_power_marks(found):
    axes = modes_figure(found).axes
    assert axes
    for ax, mode in zip(axes, found.modes, strict=True):
        lines, fit, *marks = ax.lines
        np.testing.assert_allclose(fit.get_ydata(), np.abs(mode.fit.H))
        assert len(lines.get_xdata()) == len(mode.fit.H)
        assert bool(marks) == isinstance(mode.half_power, DampingEstimate)
        if not marks:
            continue
        low, high = marks
        width = high.get_xdata()[0] - low.get_xdata()[0]
        # The window of half power is counted in: it is no narrower than the mode.
        assert width > 2 * mode.damping_ratio * mode.frequency_hz * 0.97
        assert low.get_xdata()[0] < mode.frequency_hz < high.get_xdata()[0]


def test_only_what_there_is_to_draw_is_drawn(found):
    assert list(damping_figures(found)) == ["frf.png", "hits.png", "modes.png"]
    assert list(damping_figures(replace(plain(), modes=()))) == ["frf.png"]
