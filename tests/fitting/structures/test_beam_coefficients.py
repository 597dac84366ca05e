"""What a beam's layers weigh, and how they stretch, bend and shear."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.laws import LAWS
from fitting.specimen import PlacedMass
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.beam_coefficients import coefficients
from fitting.structures.beam_section import PARTS

B, C = Face(1.5e-3, 69e9, 0.33, 2700.0), Face(0.5e-3, 210e9, 0.3, 7800.0)
CORE = Core(0.3e-3, 0.49, 1000.0, LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6))
SANDWICH = Beam(0.25, 0.02, "clamped-free", B, C, CORE, pickup_m=0.25)
BARE = Beam(0.25, 0.02, "clamped-free", B, pickup_m=0.25)
FREE_LAYER = replace(BARE, core=CORE)


@pytest.mark.parametrize("beam", [SANDWICH, replace(SANDWICH, both_sides=True), BARE, FREE_LAYER])
def test_many_beams_at_once_are_each_by_itself(beam):
    many = {n: np.array([0.0, 1e-3, -2e-3]) for n in beam.numbers}
    found = coefficients(beam, many)
    for k in range(3):
        assert found[:, k] == pytest.approx(coefficients(beam, {n: x[k] for n, x in many.items()}))


def test_a_bare_beam_stretches_and_bends_by_its_modulus():
    K_0 = coefficients(BARE, {})[PARTS["K_0"]]
    assert K_0[0] == pytest.approx(69e9 * 1.5e-3 * 0.02 / 0.25)
    assert K_0[2] == pytest.approx(69e9 * 0.02 * (1.5e-3) ** 3 / 12 / 0.25**3)
    assert not coefficients(BARE, {})[PARTS["K_1"]].any()


def test_all_layers_are_weighed():
    def mass(beam):
        return coefficients(beam, {})[PARTS["M"]][0].real / (0.25 * 0.02)

    b, v, c = 2700 * 1.5e-3, 1000 * 0.3e-3, 7800 * 0.5e-3
    assert mass(SANDWICH) == pytest.approx(b + v + c)
    assert mass(replace(SANDWICH, both_sides=True)) == pytest.approx(b + 2 * (v + c))
    assert mass(FREE_LAYER) == pytest.approx(b + v)


def test_a_core_slips_by_the_lever_between_the_faces_middles():
    """gamma = (u_c - u_b + d w')/H: of L/H, d/H and d^2/(H L)."""
    slip = coefficients(SANDWICH, {})[PARTS["K_1"]][:3] / 0.02
    d, H, L = 0.3e-3 + 1e-3, 0.3e-3, 0.25
    assert slip == pytest.approx([L / H, d / H, d**2 / H / L])


def test_what_a_beam_carries_is_a_load_where_its_base_drives():
    carrying = replace(SANDWICH, masses=(PlacedMass(2e-3, 0.2, 0.0),))
    more = coefficients(carrying, {"mass": np.log(1.1), "place_1_x": 1e-3})[
        len(coefficients(SANDWICH, {})) - 1 :
    ]
    # As heavy as it is, then by how far it is off, and by the square of that.
    expected = 2.2e-3 * 1e-3 ** np.arange(3)
    assert more[:3] == pytest.approx(expected)
    assert more[4:] == pytest.approx(expected)
    pushed = replace(carrying, force_m=0.1)
    assert coefficients(pushed, {})[-1] == 1.0
