"""Cases of struck plates: what blows scatter by, and what a lab is handed."""

import numpy as np
import pytest

from campaign.plates import kept
from campaign.plates.blows import draw_blows
from campaign.plates.geometry import plate_named
from campaign.plates.grid import Fineness, grid_of
from campaign.plates.struck_cases import draw_struck


def test_a_pulse_has_its_first_zero_beyond_the_band():
    for seed in range(5):
        blows = draw_blows(np.random.default_rng(seed), 1000.0)
        f = np.linspace(1.0, 1000.0, 500)
        size = blows.force(f)
        assert size[0] == pytest.approx(1.0, abs=1e-3)
        assert np.all(np.diff(size) < 0)
        assert 0.05 < size[-1] < 0.65
        at_half = np.array([0.5 / blows.pulse_s])
        assert blows.force(at_half)[0] == pytest.approx(np.pi / 4, rel=1e-6)


def test_what_is_read_scatters_by_what_is_said():
    f = np.linspace(50.0, 1000.0, 2000)
    over = []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        blows = draw_blows(rng, 1000.0)
        hits = len(blows.strength)
        clean = np.ones((hits, len(f)), complex)
        found = blows.read(rng, f, clean)
        steps = np.diff(found.H) / np.sqrt(2)
        over.append(np.median(np.abs(steps) / found.std[1:]) / np.sqrt(2 * np.log(2)))
    # A bounce and hits that are not square scatter from hit to hit, not from line to line.
    assert 0.3 < np.median(over) < 1.2


def test_a_far_end_is_resolved_as_the_root_is():
    plate = plate_named("P2")
    even = (0.3, 1.2)
    grid = grid_of(plate, Fineness(8, 6, even, even, even), np.array([]), np.array([]))
    assert grid.x == pytest.approx(plate.length_m - grid.x[::-1], abs=1e-12)


@pytest.mark.long
def test_a_case_is_the_same_twice_and_says_no_truth(monkeypatch):
    coarse = Fineness(6, 4, (0.5,), (0.5,), (0.5,))
    monkeypatch.setattr(kept, "WHERE_FREE", coarse)
    one, two = (draw_struck(3, plate="P2", free=True) for _ in range(2))
    assert np.array_equal(one.sweep.velocity_m_s, two.sweep.velocity_m_s)
    assert one.specimen.boundary == "free"
    assert one.specimen.drive == "force"
    assert one.specimen.substrate.thickness_m != one.truth.plate.substrate.thickness_m
    assert len(one.truth.resonances_hz) == 5
    assert one.sweep.frequency_hz.max() <= 1.08 * 1250
