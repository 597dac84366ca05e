"""Moduli at which a shear pair would resonate, beside determinants of its matrices."""

import numpy as np
from shear_pair_cases import LAW, pair, sweep

from fitting.diagnosis.problem.plate_answer import Asked
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.response.core_poles import away_from_poles, compliances
from fitting.dynamics.dynamic_stiffness import dynamic_stiffness
from fitting.effects import CATALOGUE

SWEEP = sweep(pair(0.2533), points=20)
PLATE = SmallProblem.of_small(SWEEP, pair(0.2533)).plate
CHANGE = CATALOGUE["added_mass"].on("shear-pair").change(PLATE, np.array([0.02]))
OMEGA = SWEEP.omega


def size(G):
    matrices = Asked(PLATE, OMEGA, G, CHANGE, None, with_pitch=False).matrices
    return np.abs(np.linalg.det(dynamic_stiffness(matrices, OMEGA, G)))


def test_the_distance_goes_as_the_determinant_of_what_the_core_is_part_of():
    by_G, k = compliances(PLATE, CHANGE, OMEGA), len(PLATE.load)
    G = LAW.modulus(OMEGA)
    for share in (0.6, 0.9, 1.2 - 0.1j):
        expected = size(share * G) / size(G) / np.abs(share) ** (k - 1)
        found = away_from_poles(by_G, share * G) / away_from_poles(by_G, G)
        np.testing.assert_allclose(found, expected, rtol=1e-8)


def test_it_is_none_where_nothing_is_lost_at_a_resonance():
    by_G = compliances(PLATE, CHANGE, OMEGA)
    at = -1 / by_G[np.arange(len(OMEGA)), np.argmin(np.abs(by_G), axis=1)]
    assert (away_from_poles(by_G, at) < 1e-9 * away_from_poles(by_G, 2 * at)).all()
