"""The response that belongs to a problem: of one specimen, or of several under one law."""

from collections.abc import Sequence

from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.several.several_response import SeveralResponse
from fitting.effects.base import Effect


def response_of(
    problem: DiagnosisProblem, effects: Sequence[Effect], grid: NodeGrid | None = None
) -> SweepResponse | SeveralResponse:
    """Under some effects; `grid` is the problem's coarse one for a first look."""
    if isinstance(problem, SeveralProblem):
        return SeveralResponse(problem, effects, coarse=grid is not None)
    return SweepResponse(problem, effects, grid)
