"""How long a hammer record lasts where that is left to the program."""

from dataclasses import replace

import numpy as np

from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate
from instrument.session.setup import record_length_s


def test_a_record_lasts_until_the_slowest_stated_mode_has_decayed_to_one_per_cent(zn1):
    ratios = (0.003, 0.0005, 0.003)
    plate = replace(zn1, modal_ratios=ratios)
    f = real_modes(Plate(plate.bare), 0.0, 3).omega / (2 * np.pi)
    slowest = min(f * ratios)
    T = record_length_s(plate)
    assert np.exp(-2 * np.pi * slowest * T) <= 0.01 < np.exp(-2 * np.pi * slowest * (T - 1))
    # As the templates and the documents say it.
    assert abs(T - 0.73 / slowest) < 1


def test_a_record_lasts_a_minute_at_most_and_eight_seconds_where_no_ratio_is_stated(zn1):
    assert record_length_s(replace(zn1, modal_ratios=(1e-5,))) == 60.0
    assert record_length_s(replace(zn1, modal_ratios=(0.0,))) == 8.0
