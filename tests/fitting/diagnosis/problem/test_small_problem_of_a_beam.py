"""The task of a beam: its first sum on few motions, and what a fit answers with."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.small import displacement, system_of
from fitting.sweep import Sweep

ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
LAW = ConstantModulus(1e6, 0.5)
BEAM = Beam(
    *(0.2, 0.02, "clamped-free", ALUMINIUM),
    constraining=FOIL,
    core=Core(0.3e-3, 0.49, 1000.0, LAW),
    pickup_m=0.15,
)
F = np.geomspace(20, 2000, 80)


@pytest.fixture(scope="module")
def problem():
    one = np.ones(80, int)
    return SmallProblem.of_small(Sweep(F, np.ones(80, complex), 9.81 * one, one, one), BEAM)


@pytest.mark.parametrize("size_pa", [3e4, 1e6, 5e7])
@pytest.mark.parametrize("argument", [0.2, 1.0])
def test_its_first_sum_answers_as_all_of_the_beam_does_for_any_core(problem, size_pa, argument):
    G, omega = np.full(80, size_pa * np.exp(1j * argument)), 2 * np.pi * F
    whole = displacement(system_of(BEAM, BEAM.parts()), omega, G)
    off = np.abs(problem.rational.displacement(G) / whole - 1)
    assert off.max() < 2e-4
    assert np.median(off) < 1e-6
    assert problem.rational.mu.shape[1] < len(system_of(BEAM, BEAM.parts()).load)


@pytest.mark.parametrize("size_pa", [3e4, 1e6, 5e7])
def test_many_points_in_any_order_are_answered_band_by_band_on_fewer_motions_where_few_will_do(size_pa):
    f = np.random.default_rng(2).permutation(np.geomspace(20, 2000, 320))
    one = np.ones(320, int)
    rational = SmallProblem.of_small(Sweep(f, np.ones(320, complex), 9.81 * one, one, one), BEAM).rational
    G, omega = np.full(320, size_pa * np.exp(0.6j)), 2 * np.pi * f
    off = np.abs(rational.displacement(G) / displacement(system_of(BEAM, BEAM.parts()), omega, G) - 1)
    assert off.max() < 2e-4
    assert np.median(off) < 1e-6
    terms = np.count_nonzero(rational.c, axis=1)
    assert terms[f < 60].max() < 0.7 * terms[f > 700].min()


def test_condensed_to_a_law_it_keeps_what_effects_move(problem):
    few = problem.condensed(LAW)
    assert len(few.plate.load) < len(problem.plate.load)
    assert set(few.plate.group) == set(problem.plate.group)
    moved = few.plate.moved({"length": 1e-4})
    assert moved.K.shape == few.plate.K_0.shape


def test_what_its_theory_gets_wrong_is_asked_where_its_numbers_are_found(problem):
    assert problem.errs_as_found
    z = np.zeros(len(problem.nuisances))
    length = [n.name for n in problem.nuisances.each].index("length")
    z[length] = 20.0
    longer = replace(BEAM, length_m=BEAM.length_m + 20 * BEAM.tolerance("length"))
    one = np.ones(80, int)
    expected = SmallProblem.of_small(Sweep(F, np.ones(80, complex), 9.81 * one, one, one), longer)
    v = np.ones(80, complex)
    rows, own, stated = (p.model_error(LAW, v) for p in (problem.as_found(z), expected, problem))
    apart = np.linalg.norm(own - stated)
    # Another length is another width in shares of it, and another error: little beside another resonance.
    assert np.linalg.norm(rows - own) < 0.1 * apart
