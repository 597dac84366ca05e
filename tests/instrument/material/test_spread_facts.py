"""A spread as JSON has it: percent, and absolute errors of the common law."""

import numpy as np
import pytest

from instrument.material.spread import FREQUENCIES, Curves, spread_of_curves
from instrument.material.spread_facts import spread_result

F = np.geomspace(20.0, 300.0, FREQUENCIES)
STIFFER = np.array([-0.004, 0.0, 0.004, 0.003, 0.6])


def curves():
    """Five specimens that are alike, but for the last: G' 1 MPa, loss factor 0.5, known to a percent."""
    logs = np.tile(
        np.concatenate([np.full(FREQUENCIES, np.log(1e6)), np.full(FREQUENCIES, np.log(0.5))]), (5, 1)
    )
    logs[:, :FREQUENCIES] += STIFFER[:, None]
    errors = np.full_like(logs, 0.01)
    return Curves(tuple("abcde"), F, logs, errors, 0.5 * errors, (None,) * 5, 0 * errors)


def test_of_some_specimens_everything_is_theirs():
    four = curves().those(STIFFER < 0.5)
    assert four.names == ("a", "b", "c", "d")
    assert four.logs.shape == four.errors.shape == four.stated.shape == (4, 2 * FREQUENCIES)
    assert len(four.same) == 4


def test_a_spread_is_said_with_and_without_what_is_apart():
    found = spread_of_curves(curves())
    said = spread_result(found)
    (apart,) = said.apart
    assert apart.name == "e"
    assert apart.storage_modulus_difference_percent == pytest.approx(100 * np.expm1(0.6), abs=1.0)
    assert apart.loss_factor_difference_percent == pytest.approx(0.0, abs=1e-6)
    whole, left = said.frequencies[3], said.without_apart[3]
    assert whole.storage_modulus_spread.percent > 20 > 1 > left.storage_modulus_spread.percent
    assert left.storage_modulus_pa == pytest.approx(1e6, rel=0.005)
    assert left.storage_modulus_standard_error_pa == pytest.approx(
        left.storage_modulus_pa * found.without.storage_error[3]
    )
    assert [one.frequency_hz for one in said.frequencies] == pytest.approx(F.tolist())
