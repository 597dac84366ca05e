"""The joint fit without any effect: law, stated numbers, model error and hammer test in one posterior.

`identify` reports it, `diagnose` begins with it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.bent_law import BentLaw
from fitting.diagnosis.candidates import polished
from fitting.diagnosis.evidence import BareModes, Evidence
from fitting.diagnosis.model_error import model_error
from fitting.diagnosis.refit import Fitted
from fitting.diagnosis.task import Task
from fitting.identification.direct import fit_direct
from fitting.identification.fit import Fit
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.laws import CoreLaw
from fitting.noise import Noise
from fitting.reduced import ReducedPlate

Array = NDArray[np.float64]

_FAR = 0.1
"""Relative change of the modulus from which the grids and the model's error are made anew."""
_ROUNDS = 3


@dataclass(frozen=True)
class Begun:
    """Where everything starts."""

    task: Task
    """Its grids made for the law found."""
    evidence: Evidence
    none: Fitted
    first: Fit
    """By the law alone, the plate as stated: how the start was found."""


def begin(task: Task, reduced: ReducedPlate, noise: Noise, bare: BareModes | None, start: CoreLaw) -> Begun:
    """The fit without any effect, and the evidence all candidates are judged by."""
    sweep = task.sweep
    model = SweepModel(task.rational, np.arange(len(sweep)), sweep.commanded_m_s2, task.specimen.reads)
    first = fit_direct(Residuals.of(sweep, noise, model), start)
    law: CoreLaw = first.law
    if not task.specimen.exact:
        law = BentLaw.over(law, sweep.frequency_hz)
    u = task.as_stated
    for _ in range(_ROUNDS):
        here = task.condensed(law).around(law)
        v = model.velocity(law)
        evidence = Evidence.of(sweep, noise, model_error(task, reduced, law, v), v, bare)
        if not noise.is_known and len(u):
            # Tolerances weigh against readings: those need a size, and their misfit is all there is.
            dof = max(1, evidence.count - len(law.names))
            evidence = evidence.scaled(float(np.linalg.norm(first.residuals) / np.sqrt(dof)))
        none = polished(here, (), evidence, law, u)
        omega = task.coarse.nodes.omega
        moved = np.max(np.abs(none.law.modulus(omega) / law.modulus(omega) - 1))
        law, u = none.law, none.u
        if moved < _FAR:
            break
    return Begun(here, evidence, none, first)
