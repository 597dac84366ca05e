"""What a section says of its faces."""

import pytest

from fitting.structures.beam_section import BeamSection
from fitting.structures.beam_width import reach

SECTION = BeamSection(
    ends="free-free",
    length_m=0.2,
    width_m=0.02,
    copies=1,
    thickness_m=(2e-3, 1e-4, 1e-3),
    both_sides=False,
    coefficients=(),
    rigidity=(3.0, 1.0),
    poisson=(0.3, 0.49, 0.26),
)


def test_the_stiffer_face_has_the_greater_say_in_how_both_curve_across():
    assert SECTION.faces_poisson == pytest.approx(0.29)


def test_a_layer_s_reach_is_counted_in_lengths_of_the_beam():
    assert SECTION.reach(0) == pytest.approx(reach(0.1, 0.01, 0.3))
    assert SECTION.reach(2) == pytest.approx(reach(0.1, 0.005, 0.26))
