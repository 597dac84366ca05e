"""What every law's parameters are: limits, keys of files, and how a wrong one is refused."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, fixed, quantity


@dataclass(frozen=True)
class Springs(CoreLaw):
    kind: ClassVar[str] = "springs"
    source: ClassVar[str] = "made for this test"

    g_pa: tuple[float, ...] = quantity("g_mpa", to_si=1e6, lower=1e3, upper=1e9, search=(1e5, 1e8))
    loss: float = quantity("loss", lower=1e-3, upper=2.0, search=(0.1, 1.0), zero_allowed=True)
    base_s: float = fixed("base_ms", to_si=1e-3)


LAW = Springs((1e6, 2e6), 0.5, 1e-3)


def test_a_list_s_items_are_parameters_of_their_own_and_what_is_fixed_is_none():
    assert LAW.names == ["g_1_pa", "g_2_pa", "loss"]
    assert LAW.values == pytest.approx([1e6, 2e6, 0.5])
    moved = LAW.with_logs(np.log([3e6, 4e6, 0.25]))
    assert moved.g_pa == pytest.approx((3e6, 4e6))
    assert (moved.loss, moved.base_s) == (pytest.approx(0.25), 1e-3)


def test_files_say_what_is_fixed_too_a_fit_moves_it_not():
    assert set(Springs.file_fields()) == {"g_pa", "loss", "base_s"}
    assert set(Springs.quantities()) == {"g_pa", "loss"}


def test_what_is_outside_its_limits_is_refused_in_the_unit_of_files():
    with pytest.raises(OutsideModel, match=r"springs: g_mpa = 5000 \(g_2_pa\), expected 0.001 to 1000"):
        Springs((1e6, 5e9), 0.5, 1e-3)


def test_zero_is_a_value_only_where_it_is_allowed():
    assert Springs((1e6,), 0.0, 1e-3).loss == 0.0
    with pytest.raises(OutsideModel, match="g_mpa = 0"):
        Springs((0.0,), 0.5, 1e-3)


def test_what_ran_below_what_is_searched_may_be_anything_from_zero_up():
    within, below = LAW, Springs((1e3, 2e6), 0.5, 1e-3)
    np.testing.assert_array_equal(within.open_widths, within.search_widths)
    np.testing.assert_allclose(
        below.open_widths * below.values, [1e8, *(within.search_widths * LAW.values)[1:]]
    )
