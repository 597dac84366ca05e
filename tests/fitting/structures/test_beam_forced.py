"""A beam that a force drives at a point yields there as by Euler's equation, between its modes too."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.stated.layers import Face
from fitting.structures.beam import Beam
from fitting.structures.beam_parts import parts_of
from fitting.structures.beam_section import PARTS

STEEL = Face(2e-3, 200e9, 0.3, 7850.0)
FREE = Beam(0.3, 0.006, "free-free", STEEL, slender=True, exact=True)
EI = 200e9 * 0.006 * 2e-3**3 / 12
MASS = 7850.0 * 0.006 * 2e-3
BETWEEN_HZ = (300.0, 900.0, 1800.0)


def exactly(force, pickup, f_hz):
    """Receptance in m/N by w'''' = k^4 w on either side of the force. Places in shares of the length."""
    k = (MASS * (2 * np.pi * f_hz) ** 2 / EI) ** 0.25 * 0.3

    def row(x, d):
        c, s, e = np.cos(k * x), np.sin(k * x), np.exp(k * (x - 1))
        g = np.exp(-k * x)
        turned = [(c, s), (-s, c), (-c, -s), (s, -c)][d]
        return k**d * np.array([*turned, e, (-1) ** d * g])

    A, b, none = np.zeros((8, 8)), np.zeros(8), np.zeros(4)
    A[0], A[1] = np.r_[row(0, 2), none], np.r_[row(0, 3), none]
    A[2], A[3] = np.r_[none, row(1, 2)], np.r_[none, row(1, 3)]
    for d in range(4):
        A[4 + d] = np.r_[-row(force, d), row(force, d)]
    b[7] = 0.3**3 / EI
    size = np.abs(A).max(axis=1)
    c = np.linalg.solve(A / size[:, None], b / size)
    return row(pickup, 0) @ (c[4:] if pickup >= force else c[:4])


def receptance(section, force, pickup, f_hz):
    parts = parts_of(section, pickup, force)
    K, M = (
        np.tensordot(section.coefficients[PARTS[n]], getattr(parts, n), axes=1)[
            np.ix_(parts.group == "plate", parts.group == "plate")
        ]
        for n in ("K_0", "M")
    )
    own = parts.group == "plate"
    size = 1 / np.sqrt(np.diag(M))
    D = (K - (2 * np.pi * f_hz) ** 2 * M) * np.outer(size, size)
    return (parts.observe[own] * size) @ np.linalg.solve(D, size * parts.load[0][own])


@pytest.mark.parametrize(("force", "pickup"), [(0.4, 0.9), (0.9, 0.4), (0.03, 0.9)])
@pytest.mark.parametrize("f_hz", BETWEEN_HZ)
def test_its_receptance_from_one_place_to_another_is_the_exact_one(force, pickup, f_hz):
    section = replace(FREE, force_m=0.3 * force, pickup_m=0.3 * pickup).section
    exact = exactly(force, pickup, f_hz)
    assert receptance(section, force, pickup, f_hz) == pytest.approx(exact, rel=4e-4)


@pytest.mark.parametrize("f_hz", BETWEEN_HZ)
def test_at_the_force_s_own_place_it_lacks_a_fiftieth_of_a_micrometre_a_newton(f_hz):
    section = replace(FREE, force_m=0.12, pickup_m=0.12).section
    lacking = exactly(0.4, 0.4, f_hz) - receptance(section, 0.4, 0.4, f_hz)
    assert lacking == pytest.approx(2.0e-8, rel=0.05)


def test_modes_alone_lack_what_all_the_others_do_together():
    section, f_hz = replace(FREE, force_m=0.12, pickup_m=0.27).section, 1800.0
    off = [
        receptance(one, 0.4, 0.9, f_hz) / exactly(0.4, 0.9, f_hz) - 1
        for one in (replace(section, forced_at=()), section)
    ]
    assert abs(off[0]) > 20 * abs(off[1])


def test_a_base_drives_what_it_drove():
    section = replace(FREE, boundary="clamped-free", pickup_m=0.27).section
    assert section.forced_at == ()
    assert section.order == 18
