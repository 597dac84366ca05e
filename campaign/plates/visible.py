"""How plainly what is hidden shows beside law and tolerances, in units of the noise.

An effect is named for what nothing else explains: being rare costs some 6 of chi-square, the numbers that it
brings as much. What law, tolerances and the model's own error take up of it no method sees in one sweep.
"""

from dataclasses import replace

import numpy as np

from campaign.plates.cases import PlateCase
from campaign.plates.judged import models_of
from fitting.arrays import Complex
from fitting.data.noise import noise_of
from fitting.errors import OutsideModel
from fitting.sweep import Sweep
from instrument.finding.identification import identify
from instrument.models.files import File


def visible_chi2(case: PlateCase) -> float | None:
    """Chi-square that the joint fit leaves of the sweep without its noise, beyond that of no effect.

    The fit is that of `identify`: any smooth law, stated numbers within their tolerances, the hammer test.
    Where the struck bare plate has the effect too, it has it in both fits: the difference then says too
    little, and may be negative.
    None where nothing is hidden, of a case from files, and where the theory holds for no law that fits.
    """
    if case.silent is None or not case.truth.effects:
        return None
    try:
        return _left(case, case.silent.with_effects_m_s) - _left(case, case.silent.without_m_s)
    except OutsideModel:
        return None


def silent(sweep: Sweep, velocity_m_s: Complex) -> Sweep:
    """A sweep that reads these at the level asked for, weighed by the noise that it has. Shape (points,)."""
    return replace(
        sweep,
        velocity_m_s=velocity_m_s,
        base_m_s2=sweep.commanded_m_s2.astype(complex),
        std_m_s=np.asarray(noise_of(sweep).std_m_s),
    )


def _left(case: PlateCase, velocity_m_s: Complex) -> float:
    """Chi-square, what the stated numbers are moved counted in."""
    sweep = silent(case.sweep, velocity_m_s)
    like = None if case.exact else models_of(case.truth.plate.name)
    found = identify([File(sweep, case.specimen, like=like)], hammer=case.hammer)
    assert found.joint is not None
    return found.joint.begun.none.chi2
