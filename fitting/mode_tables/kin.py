"""Kin (`fitting.diagnosis.verdict.kin`) of an explanation of mode tables: modes elsewhere, and lossier."""

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.verdict.kin import FREQUENCY, HAVE_MODES, LOSS, Kin, kin_along
from fitting.mode_tables.fit import BegunModal


def kin_of_modes(begun: BegunModal, fitted: Refitted, temper: float) -> Kin | None:
    """Of an explanation with effects; None where the tables' errors are not known, and on shear pairs.

    `temper` as `marginal.cost` takes it.
    """
    problem, evidence = begun.problem, begun.evidence
    if not evidence.scale_known or problem.members[0].specimen.kind not in HAVE_MODES:
        return None

    def directions() -> Array:
        kappa = np.concatenate([m.kappa for m in problem.members])
        by_place, by_loss = FREQUENCY * np.eye(len(kappa)), LOSS * np.diag(1j * kappa)
        return evidence.jacobian(fitted.velocity_m_s, np.vstack([by_place, by_loss]))

    plate = problem.response(fitted.effects).plate
    return kin_along(begun.none, fitted, plate, directions, temper)
