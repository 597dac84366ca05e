"""A core that stretches between faces of a beam: limits in closed form, and solids of bricks."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_apart import (
    APART_WITHIN,
    Squeezed,
    held_across,
    held_along,
    open_by_poisson,
    stiffness_across,
    stretched,
)
from fitting.structures.beam_section import PARTS
from fitting.structures.beam_width import PLACES
from fitting.structures.small_modes import small_modes

LEVEL = np.ones((1, len(PLACES)))


def of_steel(below_mm, above_mm, core_mm, width_m, G, eta, poisson=0.49):
    """A free beam of 250 mm."""
    steel = Face(1e-3, 210e9, 0.29, 7850.0)
    faces = [replace(steel, thickness_m=1e-3 * h) for h in (below_mm, above_mm)]
    core = Core(1e-3 * core_mm, poisson, 1100.0, ConstantModulus(G, eta))
    return Beam(0.25, width_m, "free-free", faces[0], constraining=faces[1], core=core)


# Solids of bricks, of fourth order along, across and through each layer, graded to all free edges: f in Hz
# and loss factor. The last number is what the faces' common w makes of that loss factor, in percent.
UNEVEN = of_steel(2.4, 1.6, 1.0, 0.02, 1e6, 0.6)
UNEVEN_SOLID = [
    *((191.69, 0.08448, 0.1), (498.39, 0.02482, -0.2), (967.80, 0.01359, -2.7), (1590.72, 0.00881, -12.7)),
    *((1822.05, 0.59881, 0.0), (2370.88, 0.00734, -34.9)),
]
SOFT = of_steel(3.0, 1.5, 1.0, 0.015, 3e5, 0.5, poisson=0.485)
SOFT_SOLID = [
    *((221.49, 0.01757, -0.8), (601.26, 0.00603, -22.6), (976.50, 0.49957, 0.0), (1171.47, 0.00780, -69.7)),
    (1914.63, 0.01734, -92.0),
]


@pytest.mark.parametrize(("beam", "solid"), [(UNEVEN, UNEVEN_SOLID), (SOFT, SOFT_SOLID)])
def test_modes_of_thick_faces_are_a_solid_s(beam, solid):
    modes = small_modes(beam, beam.core.law, len(solid))
    for mode, (f, eta, before_percent) in zip(modes, solid, strict=True):
        assert mode.frequency_hz == pytest.approx(f, rel=1.2e-3)
        # Of what stretch does, a thirtieth is left.
        assert mode.loss_factor == pytest.approx(eta, rel=4e-3 + abs(before_percent) / 3000)


def test_what_is_left_open_takes_the_faces_back_to_one_deflection():
    def losses(**stiffer):
        c = UNEVEN.coefficients(stiffer)
        assert (c != UNEVEN.coefficients({})).sum() == 1
        parts = UNEVEN.parts()
        K_0, K_1, M = (
            np.tensordot(c[PARTS[name]], P, axes=1)
            for name, P in (("K_0", parts.K_0), ("K_1", parts.K_1), ("M", parts.M))
        )
        own = parts.group == "plate"
        K, M = (A[np.ix_(own, own)] for A in (K_0 + 1e6 * (1 + 0.6j) * K_1, M))
        values = np.linalg.eigvals(np.linalg.solve(M.real, K))
        near = values[np.argmin(np.abs(values.real - (2 * np.pi * 1590) ** 2))]
        return near.imag / near.real

    assert losses(core_stretch=-4.0) == pytest.approx(0.00881 * (1 - 0.127), rel=0.02)
    assert losses(core_stretch=0.3) > 0.00881


def test_an_even_stretch_is_that_of_a_long_strip_between_plates():
    # Incompressible: 4 G (1 + S^2), S its width over twice its thickness (Gent and Lindley).
    assert stiffness_across(1e-3, 8e-3, 0.49999) == pytest.approx(4 * (1 + 4**2), rel=0.01)
    # Wide, it is held across everywhere.
    assert stiffness_across(1e-5, 1.0, 0.45) == pytest.approx(2 * 0.55 / 0.1, rel=1e-3)
    assert held_along(0.45) + held_across(0.45) == pytest.approx(2 * 0.55 / 0.1)


@pytest.mark.parametrize(("ends", "shut"), [("free-free", 2), ("clamped-free", 1), ("clamped-clamped", 0)])
def test_along_it_flows_out_at_free_ends_alone(ends, shut):
    core = Squeezed(2e-3, 0.1, 0.49, 0.3, ends)
    whole = stretched(LEVEL, 0 * LEVEL, core)[0, 0]
    reach = np.sqrt(held_across(0.49) * 2e-3**2 / 12)
    inside = stiffness_across(2e-3, 0.1, 0.49)
    assert whole == pytest.approx(inside - shut * reach * (inside - held_along(0.49)), rel=0.01)


def test_poisson_s_ratio_leaves_more_open_than_the_theory_where_a_core_cannot_flow_out():
    wide, narrow = (open_by_poisson(h, 0.02, 0.49, 0.01) for h in (1e-4, 1e-2))
    assert wide == pytest.approx(0.5, rel=0.2)
    assert narrow < 0.1
    assert open_by_poisson(1e-4, 0.02, 0.49, 0.0) == 0.0
    assert replace(UNEVEN, exact=True).tolerance("core_stretch") == pytest.approx(APART_WITHIN)
    assert UNEVEN.tolerance("core_stretch") > 0.4
