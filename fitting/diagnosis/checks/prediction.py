"""What a fit says of data it has not seen."""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.responses import response_of
from fitting.identification.result import differences_percent
from fitting.identification.validation import Validation, validate


def held_out(
    problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted, parts: NDArray[np.intp]
) -> Validation:
    """Every part predicted by a law and effects fitted to the others; few points one by one.

    `parts` as `parts_held_out` gives them. Shape (points,).
    """
    size = np.abs(problem.sweep.response_m_s)
    response = response_of(problem.around(fitted.law), fitted.effects)

    def differences(points: Mask) -> Array:
        learnt = refit(response, evidence, fitted.law, fitted.u, points=points)
        return differences_percent(problem.sweep, learnt.velocity_m_s)

    return validate(
        segment=parts,
        points_needed=-(-fitted.parameter_count // (2 if evidence.has_phase else 1)),
        differences_percent=differences,
        noise_percent=100 * evidence.noise_m_s / size if evidence.scale_known else np.full(len(size), np.nan),
    )


def over_noise(validation: Validation) -> float:
    """Median over the parts of error over noise; NaN where there are no parts or no noise."""
    ratios = [s.rms_percent / s.noise_percent for s in validation.held_out]
    return float(np.median(ratios)) if ratios else float("nan")
