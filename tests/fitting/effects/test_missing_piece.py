"""A piece of the plate that is gone: a mass less, spread over a square."""

import numpy as np
import pytest
import scipy.sparse as sp

from fitting.effects.missing_piece import MissingPieceEffect

PIECE = MissingPieceEffect()


def kg_m2(full):
    s = full.specimen
    return sum(k.thickness_m * k.density_kg_m3 for k in (s.substrate, s.core, s.constraining))


@pytest.mark.parametrize("place", [(0.3, 0.0), (0.15, 0.1)])
def test_it_takes_the_mass_of_a_square(full, place):
    m, s = 3e-3, full.specimen
    half = np.sqrt(m / kg_m2(full)) / 2
    middle = half + (1 - 2 * half / np.array([s.length_m, s.width_m])) * place
    # Midpoints of many small squares, where the effect has Gauss's nine.
    n = 12
    at = half * ((np.arange(n) + 0.5) / n * 2 - 1)
    rows = np.array([full.loose.observe(middle[0] + a, middle[1] + b) for a in at for b in at])
    M = -m * sp.csc_array(rows.T @ rows) / n**2
    load = m * rows.mean(axis=0)
    assert full.error(PIECE, (m, *place), M=M, load=load) < 1e-3
    assert np.abs(full.reduced(PIECE, (m, *place)) / full.direct() - 1).max() > 5e-3
    assert full.error(PIECE, (0.0, *place)) < 1e-5


@pytest.mark.parametrize("n", range(3))
def test_a_missing_pieces_derivatives_are_those_of_differences(full, n):
    by, difference = full.slope(PIECE, (3e-3, 0.27, 0.02), n)
    np.testing.assert_allclose(by, difference, rtol=1e-4, atol=1e-4 * np.abs(by).max())


def test_what_is_left_has_mass_everywhere(full):
    plate = full.spanned.take(PIECE.spans)
    _, upper = PIECE.limits(plate)
    for x, y in ((upper[1], 0.0), (upper[1] / 2, upper[2] / 2), (0.9 * upper[1], 0.1 * upper[2])):
        left = plate.M + PIECE.change(plate, np.array([upper[0], x, y])).M
        assert np.linalg.eigvalsh(left).min() > 0
    assert upper[0] == pytest.approx(0.05 * kg_m2(full) * plate.length_m * plate.width_m)


def test_a_missing_piece_is_told_with_its_mass_and_place():
    assert "3 g of the plate are gone near (285, 12) mm" in PIECE.story(
        {"mass": 3e-3, "x": 0.285, "y": 0.012}
    )
