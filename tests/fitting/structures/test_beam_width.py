"""Forms of what a width does, against closed forms of one field."""

import numpy as np
import pytest

from fitting.structures.beam_width import (
    PLACES,
    WEIGHT,
    at_the_middle,
    curved_across,
    followed,
    give_of_face,
    give_of_layer,
    narrowed,
    reach,
    sheared,
)

WAVE = np.cos(2 * np.pi * PLACES)[None]
LEVEL = np.ones((1, len(PLACES)))
FREE, CLAMPED, BRIDGE = "free-free", "clamped-free", "clamped-clamped"


def test_a_bend_that_varies_twists_it_and_an_even_one_does_not():
    assert curved_across(LEVEL, 0.05, FREE, held=False)[0, 0] == pytest.approx(0.0, abs=1e-9)
    # V = w''/(1 + l^2 k^2) under a wave, its slope zero at both ends.
    x = (0.05 * 2 * np.pi) ** 2
    assert curved_across(WAVE, 0.05, FREE, held=False)[0, 0] == pytest.approx(0.5 * x / (1 + x), rel=1e-6)
    assert followed(WAVE, 0.05, FREE) == pytest.approx(WAVE / (1 + x), abs=1e-6)


def test_the_middle_of_a_width_rises_as_it_curves_across():
    x = (0.05 * 2 * np.pi) ** 2
    there = np.array([0.1, 0.5, 0.83])
    higher, rising = at_the_middle(WAVE, 0.05, FREE, there)
    wave = np.cos(2 * np.pi * there)
    assert higher[0] == pytest.approx(wave / (1 + x), abs=1e-6)
    assert rising[0] == pytest.approx(-2 * np.pi * np.sin(2 * np.pi * there) / (1 + x), abs=1e-5)
    held, _ = at_the_middle(LEVEL, 0.04, CLAMPED, np.array([0.0, 0.04, 1.0]))
    assert held[0] == pytest.approx([0, 1 - np.exp(-1), 1], abs=1e-4)


def test_a_clamp_that_holds_it_stiffens_a_stretch_as_long_as_its_reach():
    # V = 1 - cosh((1 - x)/l)/cosh(1/l).
    one, both = (curved_across(LEVEL, 0.04, ends, held=True)[0, 0] for ends in (CLAMPED, BRIDGE))
    assert one == pytest.approx(0.04, rel=1e-4)
    assert both == pytest.approx(2 * one, rel=1e-3)
    assert curved_across(LEVEL, 0.04, CLAMPED, held=False)[0, 0] == pytest.approx(0.0, abs=1e-9)


def test_a_reach_is_a_third_of_the_width_of_a_thin_strip_of_metal():
    assert reach(0.1, 1e-6, 0.3) == pytest.approx(0.1 * np.sqrt(0.7 / 6), rel=1e-4)
    assert reach(0.1, 0.02, 0.3) < reach(0.1, 0.01, 0.3)


def test_a_face_that_stretches_narrows_freely_far_from_a_clamp():
    # Its sections bow as far as an even narrowing asks: what is left goes with the fourth power of the width.
    far = [narrowed(WAVE, b, 0.3, FREE, held=False)[0, 0] for b in (0.05, 0.1)]
    assert far[1] / far[0] == pytest.approx(16, rel=0.1)
    assert 0.1 < narrowed(LEVEL, 0.1, 0.3, CLAMPED, held=True)[0, 0] / 0.1 < 0.4


def test_what_shears_gives_way_as_a_wave_does_by_timoshenko():
    give = give_of_face(0.03, 0.3)
    assert give == pytest.approx(0.03**2 / 12 * 2 * 1.3 / (5 / 6))
    # w'' = sin: the angle of shear is zero at both ends.
    sine = np.sin(2 * np.pi * PLACES)[None]
    x = give * (2 * np.pi) ** 2
    free = sheared(sine, sine, give, FREE)[0, 0]
    assert free == pytest.approx(0.5 * x / (1 + x), rel=1e-2)
    assert float(WEIGHT @ sine[0] ** 2) == pytest.approx(0.5)
    assert give_of_layer(0.03, 0.4) == pytest.approx(2.8 * 0.03**2 / 3)
