"""How plainly what is hidden in a beam shows beside law and tolerances, in units of the noise."""

from campaign.beams.cases import BeamCase
from campaign.plates.visible import silent
from fitting.arrays import Complex
from fitting.errors import OutsideModel
from instrument.finding.identification import identify
from instrument.models.files import File


def visible_chi2(case: BeamCase) -> float | None:
    """Chi-square that the joint fit leaves of the sweep without its noise, beyond that of no effect.

    As of a plate. None where nothing is hidden, and where the theory holds for no law that fits.
    """
    if not case.truth.effects:
        return None
    try:
        return _left(case, case.clean_m_s) - _left(case, case.without_m_s)
    except OutsideModel:
        return None


def _left(case: BeamCase, velocity_m_s: Complex) -> float:
    """Chi-square, what the stated numbers are moved counted in."""
    found = identify([File(silent(case.sweep, velocity_m_s), case.specimen)])
    assert found.joint is not None
    return found.joint.begun.none.chi2
