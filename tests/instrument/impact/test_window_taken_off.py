"""What an exponential window adds to a decay is taken off the ratio, and off the pole's modulus."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.modal.frf import DampingEstimate, corrected
from instrument.impact.damping import no_surer_than_apart


@given(st.floats(5, 500), st.floats(1e-4, 0.05), st.floats(0.1, 30))
def test_a_pole_comes_back_from_behind_a_window(frequency_hz, ratio, added_1_s):
    omega = 2 * np.pi * frequency_hz
    pole = omega * complex(-ratio, np.sqrt(1 - ratio**2)) - added_1_s
    found = corrected(abs(pole) / (2 * np.pi), -pole.real / abs(pole), added_1_s)
    assert found == pytest.approx((frequency_hz, ratio), rel=1e-9, abs=1e-9)


def test_without_a_window_nothing_changes():
    assert corrected(18.3, 0.0123, 0.0) == (18.3, 0.0123)


def test_a_width_that_a_neighbour_shares_is_no_surer_than_it_is_off():
    fit = DampingEstimate(104.0, 0.0065, 1e-5)
    shared = no_surer_than_apart(DampingEstimate(104.0, 0.0253, 7e-6), fit)
    assert shared.standard_error == pytest.approx(0.0188)
    near = DampingEstimate(104.0, 0.00652, 7e-6)
    assert no_surer_than_apart(near, fit) is near
