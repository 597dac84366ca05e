"""What is diagnosed, apart from how."""

from dataclasses import replace

import numpy as np
from shear_pair_problem import GAIN, HIGH, MASS, PAIR, ShearPairProblem

from fitting.diagnosis.diagnose import DiagnosisOptions, diagnose_problem
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.verdict.case import DiagnosisCase


def test_one_case_is_searched_or_taken_on_trust_as_the_options_say():
    high = ShearPairProblem(HIGH)
    case = DiagnosisCase(high.problem, [GAIN, MASS], high.noise, PAIR.core.law)
    searched = diagnose_problem(case)
    trusted = diagnose_problem(case, options=DiagnosisOptions(accepted_by_hand=["added_mass"]))
    assert ([e.name for e in searched.effects], searched.by_hand) == (["gain_error"], False)
    assert ([e.name for e in trusted.effects], trusted.by_hand) == (["added_mass"], True)


def test_a_case_that_can_be_made_of_fewer_points_is_searched_again_without_effects():
    high = ShearPairProblem(HIGH)
    halves = replace(high.sweep, segment=np.repeat([1, 2], 30))
    given = (SmallProblem.of_small(halves, PAIR), [GAIN], high.noise, PAIR.core.law)
    again = DiagnosisCase(*given, remade=lambda sweep: SmallProblem.of_small(sweep, PAIR))
    found = diagnose_problem(again, options=DiagnosisOptions(resamples=3))
    assert (found.p_value, found.resamples) == (1 / 4, 3)
    assert 0 < found.nested_held_out_rms_percent < 1
    assert diagnose_problem(DiagnosisCase(*given)).p_value is None
