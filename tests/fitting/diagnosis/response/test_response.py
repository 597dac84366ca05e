"""Sweeps, several of them, and modes answer what a fit asks in the same way."""

from beam_tables import BEAM, LAW, read
from shear_pair_problem import GAIN, HIGH, MASS, ShearPairProblem

from fitting.diagnosis.response.response import Response
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.several.several_response import SeveralResponse
from fitting.mode_tables.fit import begin_modal, problem_of


def test_every_response_has_all_that_a_fit_asks_for():
    one = ShearPairProblem(1.0).problem
    both = SeveralProblem.of_members([one, ShearPairProblem(HIGH).problem], [None, None])
    modes = begin_modal(problem_of([read(BEAM)], [BEAM]), LAW).problem
    for response in (SweepResponse(one, [MASS]), SeveralResponse(both, [GAIN]), modes.response()):
        assert isinstance(response, Response)
        assert len(response.parameters) >= len(response.nuisances)


def test_an_answer_with_derivatives_is_dearer_for_phasors_and_not_for_modes():
    one = ShearPairProblem(1.0).problem
    assert SweepResponse(one, []).derivatives_cost_extra
    modes = begin_modal(problem_of([read(BEAM)], [BEAM]), LAW).problem
    assert not modes.response().derivatives_cost_extra
