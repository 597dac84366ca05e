"""The joint fit of a sweep, with the plate and the readings that ways to look at it many times need."""

from dataclasses import dataclass

from fitting.depth.task import DepthTask
from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.joint_problem import JointProblem
from fitting.diagnosis.several.responses import response_of


@dataclass(frozen=True)
class SweepTask(DepthTask):
    """The fit that a sweep, or several under one law, begin with: without effects."""

    begun: Begun

    @classmethod
    def begun_with(cls, begun: Begun) -> "SweepTask":
        """Make it from the fit that `identify` begins and ends with."""
        none = begun.none
        response = response_of(begun.problem, ())
        return cls(JointProblem(response, begun.evidence, none.law, none.u, None), none, begun)
