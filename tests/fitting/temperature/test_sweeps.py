"""Sweeps of several temperatures as members of one fit."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases as cases
from shear_pair_temperatures import PAIR, POINTS, alone, begun, shifted

from fitting.data.noise import noise_of
from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.effects import CATALOGUE
from fitting.temperature.members import Joined
from fitting.temperature.sweeps import Sweeps


@pytest.fixture(scope="module")
def each():
    pair = cases.pair(0.2533)
    return [begun(k, law, pair=pair) for k, law in enumerate(shifted())]


def test_one_pair_s_numbers_are_counted_once_and_two_pairs_have_their_own_mass(each):
    one: Joined = Sweeps.of(each)
    names = [n.name for n in one.each]
    assert names.count("mass") == names.count("area") == 1
    assert [n for n in names if n.startswith("gain")] == ["gain [1]", "gain [2]", "gain [3]"]
    two = [n.name for n in Sweeps.of(each, [1, 2, 1]).each]
    assert [n for n in two if n.startswith("mass")] == ["mass [1, 3]", "mass [2]"]
    # Stated alike, the rubber between them is one.
    assert "area" in two


def test_lengths_and_bands_are_those_of_the_sweeps_in_their_order(each):
    joined = Sweeps.of(each)
    assert joined.lengths == POINTS
    f = [b.problem.sweep.frequency_hz for b in each]
    assert joined.bands_hz == [(one.min(), one.max()) for one in f]
    assert joined.modes(np.ones(3))[0].size == 0
    assert [one.frequency_hz.size for one in alone(each)] == list(POINTS)


def test_a_gain_is_the_leading_cause_of_a_sweep_and_beside_it_the_sweep_is_explained():
    true = replace(PAIR, core=replace(PAIR.core, law=shifted()[1]))
    sweep, stated = cases.sweep(true), PAIR
    louder = replace(sweep, velocity_m_s=1.05 * sweep.velocity_m_s)
    loud = begin(SmallProblem.of_small(louder, stated), None, noise_of(louder), None, cases.LAW)
    one = alone([loud])[0]
    forms = [CATALOGUE[name].on("shear-pair") for name in ("gain_error", "added_mass")]
    leading = one.leading([form for form in forms if form is not None], ALONE)
    assert leading[0].name == "gain_error"
    beside = one.beside(leading[0]).begun.none
    assert beside.of(beside.effects[0])[0] == pytest.approx(1.05, abs=0.01)
    assert beside.chi2 < loud.none.chi2 / 2


def test_a_gain_a_delay_and_an_angle_that_all_sweeps_have_in_common_are_left_open(each):
    B, own = Sweeps.of(each).evidence.B, sum(b.evidence.B.shape[1] for b in each)
    gain, delay, phase = B[:, own:].T
    assert B.shape[1] == own + 3
    first, last = slice(0, POINTS[0]), slice(sum(POINTS[:2]), sum(POINTS))
    for part, b in ((first, each[0]), (last, each[2])):
        v, sigma = b.none.velocity_m_s, b.evidence.sigma_m_s
        np.testing.assert_allclose(gain[part], 0.005 * v.real / sigma)
        np.testing.assert_allclose(delay[part], 2e-6 * b.problem.sweep.omega * v.imag / sigma)
        np.testing.assert_allclose(phase[part], np.radians(0.5) * -v.imag / sigma)
    exact = begun(0, shifted()[0])
    assert Sweeps.of([exact]).evidence.B.shape == exact.evidence.B.shape
