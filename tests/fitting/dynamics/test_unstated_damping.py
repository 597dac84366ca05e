"""A plate of which nothing says how it rings without its core is given usual ratios, and a wide tolerance."""

from dataclasses import replace

import pytest

from fitting.dynamics.unstated_damping import MODES, RATIO, TOLERANCE, with_unstated_damping


@pytest.fixture
def unstated(zn1):
    return replace(zn1, modal_ratios=(), exact=False, tolerances={"damping": 0.1})


def test_what_nobody_states_is_usual_and_wide(unstated):
    given = with_unstated_damping(unstated)
    assert given.modal_ratios == (RATIO,) * MODES
    assert {given.tolerances[f"damping_{k + 1}"] for k in range(MODES)} == {TOLERANCE}
    assert given.tolerances["damping"] == 0.1


def test_a_mode_that_a_hammer_did_not_read_is_as_unknown(unstated):
    tested = replace(unstated, modal_ratios=(0.003, 0.0, 0.002))
    given = with_unstated_damping(tested, unstated)
    assert given.modal_ratios == (0.003, RATIO, 0.002, *(RATIO,) * (MODES - 3))
    assert "damping_1" not in given.tolerances
    assert given.tolerances["damping_2"] == TOLERANCE


def test_what_is_stated_is_all_there_is_zero_and_exact_too(unstated, zn1):
    for plate in (zn1, replace(zn1, modal_ratios=()), replace(unstated, modal_ratios=(0.0,))):
        assert with_unstated_damping(plate) is plate
    assert with_unstated_damping(replace(unstated, core=None, constraining=None)).modal_ratios == ()
