"""What sets files of shear pairs apart, and what is wrong in all of them alike."""

from dataclasses import replace

import numpy as np
from shear_pair_cases import LAW, pair, sweep

from fitting.diagnosis.problem.small_problem import LEVEL, SmallProblem
from fitting.diagnosis.several.errors_between_files import alike, of_one_rig, own_cores, own_temperatures
from fitting.diagnosis.several.of_files import Place

MASSES_KG, POINTS = (0.3, 0.6), 20
MEMBERS = [SmallProblem.of_small(sweep(pair(m), points=POINTS), pair(m)) for m in MASSES_KG]
V = np.concatenate([m.sweep.response_m_s for m in MEMBERS])
TWO, ONE = [Place(1), Place(2)], [Place(1, 0), Place(1, 1)]


def test_each_file_has_a_core_and_a_temperature_of_its_own():
    feels = np.concatenate([m.feels(LAW, m.sweep.response_m_s) for m in MEMBERS])
    first = np.arange(2 * POINTS) < POINTS
    np.testing.assert_allclose(own_cores(MEMBERS, LAW, V), LEVEL * feels * np.array([first, ~first]))
    warmer = own_temperatures(MEMBERS, TWO, LAW, V)
    assert np.all((warmer != 0) == [first, ~first])
    assert own_temperatures(MEMBERS, ONE, LAW, V).shape == (0, 2 * POINTS)


def test_one_rig_reads_two_files_alike_and_one_has_it_in_its_law():
    assert of_one_rig(MEMBERS, TWO).shape == (2, 2 * POINTS)
    assert of_one_rig(MEMBERS, ONE).shape == (0, 2 * POINTS)
    off = [replace(m, misfit=0.02) for m in MEMBERS]
    assert (alike(off, TWO), alike(off, ONE), alike(MEMBERS, TWO)) == (0.02, 0.0, 0.0)
