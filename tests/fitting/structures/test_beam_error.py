from dataclasses import replace

import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_error import HELD_WIDTH, HELD_WIDTH_WITHIN, shortened_m
from fitting.structures.small import nuisances_of
from fitting.structures.small_modes import small_modes

LAW = ConstantModulus(1e6, 0.5)
STEEL = Face(1e-3, 210e9, 0.29, 7850.0)
SANDWICH = Beam(
    0.2,
    0.02,
    "clamped-free",
    STEEL,
    constraining=replace(STEEL, thickness_m=0.5e-3),
    core=Core(0.2e-3, 0.49, 1000.0, LAW),
)
OBERST = replace(SANDWICH, constraining=None, core=Core(1e-3, 0.49, 1000.0, ConstantModulus(3e8, 0.8)))


def test_a_clamp_holds_the_width_as_if_the_beam_were_shorter():
    assert shortened_m(0.02, 0.29) == pytest.approx(HELD_WIDTH * 0.29**2 * 0.02)
    assert SANDWICH.held_width_m == pytest.approx(5.55e-4, rel=0.01)
    both = replace(SANDWICH, boundary="clamped-clamped")
    assert both.held_width_m == pytest.approx(2 * SANDWICH.held_width_m)
    assert replace(SANDWICH, boundary="free-free").held_width_m == 0.0


def test_where_it_is_counted_every_mode_is_higher_the_first_one_as_if_it_were_so_much_shorter():
    bare = replace(SANDWICH, core=None, constraining=None)
    counted = replace(bare, held_width=True)
    pairs = zip(small_modes(bare, None, 4), small_modes(counted, None, 4), strict=True)
    higher = [b.frequency_hz / a.frequency_hz - 1 for a, b in pairs]
    # f of a bare one goes with 1/L^2. Short waves curve across in its reach.
    assert higher[0] == pytest.approx(2 * 5.55e-4 / 0.2, rel=0.1)
    assert np.all(np.diff(higher) < 0)
    assert 0.3 < higher[3] / higher[0] < 0.6
    open_yet = bare.tolerance("held_width")
    assert open_yet == pytest.approx(bare.held_width_m)
    assert counted.tolerance("held_width") == pytest.approx(HELD_WIDTH_WITHIN * open_yet)


def test_a_fit_may_move_it_however_exact_the_beam_is():
    each = nuisances_of(replace(SANDWICH, exact=True, pickup_m=0.15), SANDWICH.parts(), has_phase=True).each
    assert [n.name for n in each] == ["held_width", "core_stretch"]
    free = replace(SANDWICH, boundary="free-free")
    assert "held_width" not in free.numbers
    assert "held_width" not in replace(SANDWICH, slender=True).numbers
    moved = SANDWICH.coefficients({"held_width": SANDWICH.held_width_m})
    assert moved == pytest.approx(replace(SANDWICH, held_width=True).coefficients({}))


def test_of_halves_about_a_driven_centre_it_is_that_of_one_clamp():
    halves = replace(SANDWICH, boundary="centre-driven", length_m=0.4)
    assert halves.held_width_m == pytest.approx(SANDWICH.held_width_m)
    for a, b in zip(
        small_modes(replace(halves, held_width=True), LAW, 3),
        small_modes(replace(SANDWICH, held_width=True), LAW, 3),
        strict=True,
    ):
        assert a.frequency_hz == pytest.approx(b.frequency_hz, rel=1e-7)


def test_the_theory_is_the_less_certain_the_shorter_the_wave():
    f, G = np.array([30.0, 300.0, 3000.0]), np.full(3, 1e6 + 5e5j)
    error = SANDWICH.theory_error(f, G)
    assert np.all(np.diff(np.hypot(error.frequency, error.together[0])) > 0)
    assert error.frequency[0] < 1e-3
    # Where the faces no longer move together the loss is another one by percents.
    assert np.all(np.diff(error.loss) > 0)
    assert np.all((error.loss > 0.0029) & (error.loss < 0.05))


def test_a_free_layer_s_loss_is_that_of_the_composite():
    (mode,) = small_modes(OBERST, OBERST.core.law, 1)
    error = OBERST.theory_error(np.array([mode.frequency_hz]), OBERST.core.law.modulus(np.ones(1)))
    assert error.modal_loss[0] == pytest.approx(mode.loss_factor, rel=1e-3)


@pytest.mark.parametrize(
    ("width_m", "modulus_pa", "off"), [(0.004, 446e6, 0.004), (0.02, 446e6, 0.026), (0.04, 446e6, 0.07)]
)
def test_how_far_the_loss_of_a_wide_beam_with_a_stiff_core_is_open(width_m, modulus_pa, off):
    """2 and 1.5 mm of aluminium about 0.3 mm: theory too low by so much against bricks, all modes alike."""
    aluminium = Face(2e-3, 70e9, 0.33, 2700.0)
    core = Core(0.3e-3, 0.4, 1200.0, ConstantModulus(modulus_pa, 0.07))
    beam = Beam(0.22, width_m, "free-free", aluminium, replace(aluminium, thickness_m=1.5e-3), core)
    found = beam.theory_error(np.array([500.0, 1500.0]), np.full(2, modulus_pa + 0j))
    assert np.all(found.loss > 0.7 * off)
    assert np.all(found.loss < 2.0 * off + 0.003)
