import numpy as np
import pytest

from instrument.files.rates import rate_of_step
from instrument.files.table import rate_of_times


@pytest.mark.parametrize("rate", [8192.0, 65536.0, 51200.0, 1000.0, 4096.0, 44100.0])
def test_a_step_of_six_digits_gives_the_rate_it_was_made_of(rate):
    assert rate_of_step(float(f"{1 / rate:.5e}"), 5e-6) == rate


def test_a_rate_that_is_not_round_stays_itself():
    assert rate_of_step(1 / 8191.7345, 1e-12) == pytest.approx(8191.7345, rel=1e-12)


@pytest.mark.parametrize("places", [5, 6, 7, 9])
def test_times_that_were_rounded_give_the_rate_they_were_made_of(places):
    assert rate_of_times(np.round(np.arange(4096) / 8192.0, places)) == 8192.0
