"""A loose strip made stronger by a first look's linear step."""

from dataclasses import replace

import numpy as np
import pytest
from solved_in_full import Full

from fitting.effects import CATALOGUE
from fitting.effects.partial_debond import LEFT, PartialDebondEffect, joined, strips
from fitting.stated.patches import Patch
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file

PATCH = Patch(0.0, 0.25, 0.05, 0.12)


@pytest.mark.parametrize("times", [0.5, 3.0])
def test_a_strip_grows_and_shrinks_about_its_middle(times):
    begin, width = PartialDebondEffect("y").scaled(np.array([0.10, 0.02]), times)
    assert begin + width / 2 == pytest.approx(0.11)
    assert width == pytest.approx(0.02 * times)


def test_a_strip_at_an_edge_keeps_its_edge():
    assert PartialDebondEffect("y", at_edge=True).scaled(np.array([0.2, 0.02]), 3.0) == pytest.approx(
        [0.2, 0.06]
    )


def test_no_step_leaves_a_strip_of_less_than_nothing():
    assert PartialDebondEffect("x").scaled(np.array([0.10, 0.02]), -1.0)[1] == 0


def test_strips_of_a_patch_are_the_shear_of_its_core(patched):
    """What the core carries by stretching and bending is little beside it."""
    K_1 = patched.full.loose.K_1
    motion = np.linalg.eigh((K_1 / K_1.max()).toarray())[1][:, -5:]
    for along in ("x", "y"):
        of_strips = sum(strips(patched.full, along))
        assert np.trace(motion.T @ of_strips @ motion) == pytest.approx(
            np.trace(motion.T @ K_1 @ motion), rel=1e-2
        )


@pytest.fixture(scope="module")
def patched():
    return Full(("partial_debond",), patches=(PATCH,))


def on_patch(full):
    return CATALOGUE["partial_debond"].standing_on(full.specimen)


def test_a_patch_loose_at_its_end_is_a_shorter_one_that_carries_the_rest(patched):
    """What is loose keeps its mass and a hundredth of its shear; its last row is half empty."""
    loose = patched.specimen.length_m * 11 / 14
    (end,) = [e for e in on_patch(patched).variants() if e.edge_m == PATCH.to_x_m]
    lost = strips(patched.full, "x")[11]
    expected = patched.direct(K_1=-(1 - LEFT) * lost)
    assert np.abs(expected / patched.direct() - 1).max() > 0.05
    assert patched.error(end, [PATCH.to_x_m, PATCH.to_x_m - loose], K_1=-(1 - LEFT) * lost) < 2e-3


def test_every_edge_of_a_patch_is_looked_at_by_itself(patched):
    edges = [(e.along, e.edge_m) for e in on_patch(patched).variants() if e.at_edge]
    assert edges == [("x", 0.0), ("x", 0.25), ("y", 0.05), ("y", 0.12)]


def test_a_strip_is_looked_for_where_the_plate_is_treated(patched):
    anywhere = on_patch(patched).variants()[1]
    places = [u[0] + u[1] / 2 for u in anywhere.starts(patched.taken(anywhere), None)]
    assert places
    assert min(places) >= PATCH.from_y_m
    assert max(places) <= PATCH.to_y_m


def test_treatments_on_both_sides_have_no_strip():
    zn1 = read_specimen(case_file("zn1.toml"))
    assert CATALOGUE["partial_debond"].standing_on(zn1) is not None
    assert CATALOGUE["partial_debond"].standing_on(replace(zn1, both_sides=True)) is None


def test_patches_that_touch_are_one_where_they_are_loose():
    assert joined([(0.1, 0.2), (0.0, 0.05), (0.15, 0.3), (0.3, 0.31)]) == [(0.0, 0.05), (0.1, 0.31)]
