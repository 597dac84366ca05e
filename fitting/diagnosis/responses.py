"""The response that belongs to a task: of one specimen, or of several under one law."""

from collections.abc import Sequence

from fitting.diagnosis.problem import DiagnosisProblem, Grid
from fitting.diagnosis.response import Response
from fitting.diagnosis.several import SeveralProblem, SeveralResponse
from fitting.effects.base import Effect


def response_of(problem: DiagnosisProblem, effects: Sequence[Effect], grid: Grid | None = None) -> Response:
    """Under some effects; `grid` is the task's coarse one for a first look."""
    if isinstance(problem, SeveralProblem):
        return SeveralResponse(problem, effects, coarse=grid is not None)
    return Response(problem, effects, grid)
