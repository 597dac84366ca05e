from dataclasses import replace

import numpy as np

from fitting.sweep import Sweep
from instrument.finding.methods import PaperMethod
from instrument.models.files import File
from instrument.models.specimen_models import Models
from instrument.progress import quiet

F = np.repeat([19.3, 101.0, 280.0], 4) * np.tile([0.97, 0.99, 1.01, 1.03], 3)


def paper_method(specimen):
    sweep = Sweep(
        frequency_hz=F,
        velocity_m_s=np.exp(1j * F),
        commanded_m_s2=np.full(len(F), specimen.base_acceleration_m_s2),
        segment=np.repeat([1, 2, 3], 4),
        sweep=np.ones(len(F), dtype=np.intp),
    )
    return PaperMethod(File(sweep, specimen), specimen, None, quiet)


def test_the_papers_method_says_that_tolerances_have_no_part_in_it(coarse):
    assert paper_method(coarse).remarks_on_stated() == ()
    (said,) = paper_method(replace(coarse, exact=False)).remarks_on_stated()
    assert "tolerances are not in its band" in said


def test_models_are_certified_anew_for_a_law_that_ended_outside(coarse):
    way = paper_method(coarse)
    assert isinstance(way.set_up(), Models)
    stiff = coarse.core.law.with_logs(np.log(coarse.core.law.values) + np.array([7.0, 7.0, 0.0, 0.0]))
    within = way.models.domain.modulus[1]
    way.widen(stiff)
    assert way.set_up().domain.modulus[1] > np.abs(stiff.modulus(2 * np.pi * F)).max() > within


def test_the_papers_method_holds_segments_out(coarse):
    way = paper_method(coarse)
    assert np.array_equal(way.parts(), way.sweep.segment)
