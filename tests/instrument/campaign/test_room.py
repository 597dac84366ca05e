"""A hidden room: up and down about its mean, asked for by name alone."""

import numpy as np
import pytest

from instrument.campaign.beams.run import ROTATION as BEAMS
from instrument.campaign.plates.cases import KINDS
from instrument.campaign.plates.run import ROTATION as PLATES
from instrument.campaign.room import RoomCycles, arrhenius, draw_cycles


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


def test_no_rotation_has_it():
    assert "room_cycles" in KINDS
    assert "room_cycles" not in (*BEAMS, *PLATES)
