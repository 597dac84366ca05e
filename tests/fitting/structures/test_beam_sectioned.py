"""A section's matrices: what its width does is in them, and they are one set wherever a force drives."""

from dataclasses import replace

import numpy as np

from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_sectioned import sectioned, summed
from fitting.structures.beam_shapes import matrices_of

FACE = Face(2e-3, 70e9, 0.3, 2700.0)
CORE = Core(0.3e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.5))
WIDE = Beam(0.2, 0.02, "free-free", FACE, constraining=FACE, core=CORE, pickup_m=0.15, force_m=0.05)


def test_one_set_serves_wherever_a_force_drives():
    elsewhere = replace(WIDE, force_m=0.1, pickup_m=0.02)
    assert elsewhere.section != WIDE.section
    assert sectioned(elsewhere.section) is sectioned(WIDE.section)
    assert sectioned(replace(WIDE, force_m=None).section) is not sectioned(WIDE.section)


def test_a_slender_beam_has_those_of_its_ends_alone_but_for_what_a_held_width_would_add():
    section = replace(WIDE, slender=True).section
    plain = matrices_of(section.ends, section.share, section.arms, section.order)
    np.testing.assert_array_equal(sectioned(section).M, plain.M)
    np.testing.assert_array_equal(sectioned(section).K_0[:4], plain.K_0[:4])
    assert not sectioned(section).K_0[4:8].any()


def test_summed_matrices_are_symmetric_and_store_energy():
    for which in ("K_0", "K_1", "M"):
        A = summed(WIDE.section, which)
        np.testing.assert_allclose(A, A.T, atol=1e-9 * np.abs(A).max())
        assert np.linalg.eigvalsh(A).min() > -1e-9 * np.abs(A).max()
