"""Local scatter that was more than noise: each point's noise by what a fit leaves instead.

A resonance of a few points scatters about any local model of it, and so does a drift in a sweep that jumps
about. A fit that follows the readings leaves less, and what of that jumps from point to point is noise.
"""

from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.data.noise import Noise, scatter_of_left
from fitting.diagnosis.checks.structure import roughness
from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.usual_law import followed_to_convergence, polished
from fitting.diagnosis.thresholds import VERDICT
from fitting.sweep import Sweep


def is_overstated(sweep: Sweep, noise: Noise, evidence: Evidence, fitted: Refitted) -> bool:
    """Whether a fit leaves less of the readings than their local scatter."""
    return noise.source == "local scatter" and share_left(sweep, evidence, fitted) < VERDICT.overstated


def share_left(sweep: Sweep, evidence: Evidence, fitted: Refitted) -> float:
    """Variance of what a fit leaves, or of what of it jumps from point to point, over the noise's."""
    rough = roughness(sweep, fitted.residuals[: fitted.data], 2 if evidence.has_phase else 1)
    return float(np.nanmin([fitted.chi2_per_dof, rough]))


def with_noise_of_left(sweep: Sweep, evidence: Evidence, fitted: Refitted) -> Evidence:
    """The same readings with noise by what a fit leaves, its unknowns counted."""
    v = fitted.velocity_m_s if evidence.has_phase else np.abs(fitted.velocity_m_s)
    dof = max(1, fitted.data - fitted.parameter_count)
    left: Array = scatter_of_left(sweep, v - evidence.measured_m_s) * float(np.sqrt(fitted.data / dof))
    return evidence.with_noise(left)


def with_own_noise(begun: Begun, noise: Noise) -> Begun:
    """The same fit with the noise that it leaves, where local scatter is more."""
    sweep, none = begun.problem.sweep, begun.none
    if not is_overstated(sweep, noise, begun.evidence, none):
        return begun
    evidence = with_noise_of_left(sweep, begun.evidence, none)
    again = polished(begun.problem, (), evidence, none.law, none.u)
    return replace(begun, evidence=evidence, none=followed_to_convergence(begun.problem, evidence, again))
