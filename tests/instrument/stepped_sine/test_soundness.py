"""A sine that is off its frequency, and one with a flat top."""

import numpy as np
import pytest

from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stepped_sine.soundness import distorted, frequency_off, is_flat

RATE, F = 8192.0, 20.3
T = np.arange(8000) / RATE


def flat(x):
    x = np.vstack([np.zeros(len(x)), x])
    return is_flat(x, sine_fit(x, 0, RATE, F), 1)


@pytest.mark.parametrize("off", [-3e-3, 0.0, 5e-4, 1e-2])
def test_how_far_a_sine_is_off_is_read_from_its_two_halves(off):
    noise = 1e-3 * np.random.default_rng(1).standard_normal(len(T))
    found, std = frequency_off(np.sin(2 * np.pi * F * (1 + off) * T + 0.4) + noise, 0, RATE, F)
    assert found == pytest.approx(off, rel=0.02, abs=5 * std)
    assert std < 1e-3


def test_it_does_not_matter_where_the_record_begins():
    first = 12345
    t = (first + np.arange(8000)) / RATE
    assert frequency_off(np.sin(2 * np.pi * F * 1.001 * t), first, RATE, F)[0] == pytest.approx(
        1e-3, rel=0.02
    )


def test_silence_is_at_no_frequency():
    off, std = frequency_off(np.zeros(8000), 0, RATE, F)
    assert off == 0.0
    assert np.isfinite(std)


@pytest.mark.parametrize(("low", "high"), [(-0.9, 0.9), (-1.0, 0.85), (-0.5, 0.5)])
def test_a_cut_sine_is_flat(low, high):
    assert flat(np.clip(np.sin(2 * np.pi * F * T), low, high))


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("turned", [0.0, np.pi / 2, np.pi])
def test_a_harmonic_of_seven_percent_is_not(order, turned):
    angle = 2 * np.pi * F * T
    assert not flat(np.sin(angle) + 0.07 * np.sin(order * angle + turned))
    assert not flat(np.sin(angle))


@pytest.mark.parametrize(
    ("harmonic", "noise", "marked"), [(0.0, 0.03, False), (0.25, 0.03, True), (0.03, 0.0, False)]
)
def test_noise_is_no_distortion(harmonic, noise, marked):
    """Noise of each part of the fundamental; five harmonics of it together look like 8 %."""
    angle, rng = 2 * np.pi * F * T, np.random.default_rng(4)
    found = 0
    for _ in range(20):
        x = np.sin(angle) + harmonic * np.sin(3 * angle)
        x = x + noise * np.sqrt(len(T) / 2) * rng.standard_normal(len(T))
        found += distorted(sine_fit(x[None], 0, RATE, F))[0]
    assert found == (20 if marked else 0)
