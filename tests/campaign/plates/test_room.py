"""Hidden rooms: up and down about a mean, or another one after a pause; asked for by name alone."""

import numpy as np
import pytest

from campaign.beams.run import ROTATION as BEAMS
from campaign.plant.schedule import draw_schedule
from campaign.plates.cases import KINDS
from campaign.plates.hidden.room import RoomCycles, RoomStep, arrhenius, draw_cycles, draw_step
from campaign.plates.run import ROTATION as PLATES


def test_it_goes_up_and_down_in_straight_lines_about_its_mean():
    room = RoomCycles(1.5, 600.0, 0.0, 0.25, 1e5)
    assert room.kelvin(np.array([0.0, 75.0, 150.0, 375.0, 600.0])) == pytest.approx([-1.5, 0, 1.5, 0, -1.5])
    assert room.kelvin(np.arange(0, 6000, 1.0)).mean() == pytest.approx(0.0, abs=1e-9)


def test_a_warm_core_is_read_at_lower_frequencies():
    # exp(E / R (1/T - 1/T_0)) of 100 kJ/mol, 2 K above 296 K.
    assert arrhenius(np.array([2.0, 0.0]), 1e5) == pytest.approx([0.7613, 1.0], abs=5e-4)


def test_a_drawn_room_cycles_at_least_once_in_the_sweep():
    for seed in range(50):
        swing, period, begun, up, _ = draw_cycles(np.random.default_rng(seed), 1200.0)
        assert 0.4 <= swing <= 1.5
        assert 120 <= period <= 1000
        assert 0 <= begun <= 1
        assert 0.3 <= up <= 0.7


def test_later_passes_come_after_the_pause_and_are_warmer():
    sweep = draw_schedule(np.random.default_rng(1), (1.0,))
    duration = float(sweep.time_s.max())
    for seed in range(20):
        room = RoomStep(*draw_step(np.random.default_rng(seed), duration, 3))
        time_s, later = room.paused(sweep).time_s, sweep.sweep > room.after_pass
        assert 0 < later.sum() < len(later)
        assert room.pause_s > duration
        assert time_s[~later] == pytest.approx(sweep.time_s[~later])
        assert np.all(room.warmed(time_s)[~later] == 1)
        assert np.all((room.warmed(time_s)[later] < 1) == (room.kelvin > 0))


@pytest.mark.parametrize("name", ["room_cycles", "room_step"])
def test_no_rotation_has_it(name):
    assert name in KINDS
    assert name not in (*BEAMS, *PLATES)
