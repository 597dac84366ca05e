"""Mobility from blows, its scatter, and the lines that are kept of it."""

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.impact.judge import judge
from instrument.impact.mobility import Mobility, lines_about, mobility_of, peaks_of
from instrument.impact.record import Hit, ResponseChannel

RATE, SECONDS, BLOW_S = 4096.0, 2.0, 0.1
MODES = ((80.0, 0.05, 1.0), (140.0, 0.04, -0.6))
SWAY_HZ, SWAY = 0.7, 1.5
WIDTH_S = 2e-3


def modal(s):
    """In m/s per N: modes, and a plate that sways as one."""
    found = SWAY * s / (s**2 + (2 * np.pi * SWAY_HZ) ** 2)
    for f, z, a in MODES:
        w = 2 * np.pi * f
        found = found + a * s / (s**2 + 2 * z * w * s + w**2)
    return found


def response(t):
    """To a unit impulse at zero."""
    t = np.maximum(t, 0)
    found = SWAY * np.cos(2 * np.pi * SWAY_HZ * t)
    for f, z, a in MODES:
        w, d = 2 * np.pi * f, 2 * np.pi * f * np.sqrt(1 - z**2)
        found = found + a * np.exp(-z * w * t) * (np.cos(d * t) - z * w / d * np.sin(d * t))
    return found


def hit(number, noise=0.0, size=1.0, factor=1.0):
    """The plate sways before it is struck, too."""
    random = np.random.default_rng(number)
    t = np.arange(round(RATE * SECONDS)) / RATE
    force = np.where(
        abs(t - BLOW_S) < WIDTH_S / 2, size * (1 + np.cos(2 * np.pi * (t - BLOW_S) / WIDTH_S)), 0
    )
    # The response to each sample of force, exact to the rule of the midpoint.
    v = np.zeros_like(t)
    for k in np.flatnonzero(force):
        v += np.where(t >= t[k], force[k] / RATE * response(t - t[k]), 0) * np.where(t == t[k], 0.5, 1.0)
    v = (
        factor * v
        + 0.01 * size * np.sin(2 * np.pi * SWAY_HZ * t + number)
        + noise * random.normal(size=len(t))
    )
    return judge(Hit(f"hit {number}", RATE, force, (ResponseChannel("velocity", "velocity", v),)))


def test_it_is_exact_though_the_plate_still_sways_at_the_records_end():
    found = mobility_of([hit(1), hit(2, size=1.3)])
    inside = (found.frequency_hz > 40) & (found.frequency_hz < 200)
    true = modal(2j * np.pi * found.frequency_hz[inside])
    off = np.abs(found.H[inside] - true)
    assert (off / np.abs(true).max()).max() < 3e-3


def test_its_standard_deviation_is_what_repeated_tests_scatter_by():
    tests = [mobility_of([hit(10 * k + n, noise=2e-5) for n in range(4)]) for k in range(1, 9)]
    inside = (tests[0].frequency_hz > 60) & (tests[0].frequency_hz < 180)
    H = np.array([m.H[inside] for m in tests])
    scatter = np.sqrt((np.var(H.real, axis=0, ddof=1) + np.var(H.imag, axis=0, ddof=1)).mean() / 2)
    said = np.sqrt(np.mean([m.std[inside] ** 2 for m in tests]))
    assert said == pytest.approx(scatter, rel=0.1)


def test_blows_that_differ_by_a_percent_say_so_in_proportion_to_the_reading():
    found = mobility_of([hit(n, factor=1 + 0.01 * (-1) ** n) for n in range(4)])
    inside = (found.frequency_hz > 60) & (found.frequency_hz < 180)
    share = (found.std / np.abs(found.H))[inside]
    # Of each of two parts, of a mean of four.
    assert np.median(share) == pytest.approx(0.01 * np.sqrt(4 / 3) / np.sqrt(2) / np.sqrt(4), rel=0.2)


def test_one_blow_does_not_say_what_it_is_worth():
    with pytest.raises(BadInput, match="1 good hit, expected two or more"):
        mobility_of([hit(1)])


def smooth():
    f = np.arange(1, 400) / 2
    H = modal(2j * np.pi * f)
    return Mobility(f, H, np.full(len(f), 1e-6 * np.abs(H).max()))


def test_resonances_are_found_with_their_widths():
    (first, half), (second, _) = peaks_of(smooth(), 40.0, 200.0)
    assert (first, second) == pytest.approx((80.0, 140.0), abs=2.5)
    assert half == pytest.approx(0.05 * 80.0, rel=0.2)


def test_lines_lie_about_the_lowest_resonances_inside_the_band():
    found = smooth()
    places, segment = lines_about(found, 40.0, 200.0, 2, 40)
    f = found.frequency_hz[places]
    assert (np.diff(f) > 0).all()
    assert set(segment.tolist()) == {1, 2}
    assert len(f) <= 40
    assert abs(f[segment == 1] - 80.0).max() < 20.0
    only, one = lines_about(found, 40.0, 200.0, 1, 40)
    assert set(one.tolist()) == {1}
    assert found.frequency_hz[only].max() < 100.0


def test_where_nothing_stands_out_the_whole_band_is_read():
    found = smooth()
    places, _ = lines_about(found, 100.0, 115.0, 6, 120)
    f = found.frequency_hz[places]
    assert (f.min(), f.max()) == (100.0, 115.0)
