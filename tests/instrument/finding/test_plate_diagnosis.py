"""What a diagnosis does with one plate read at one spot."""

import numpy as np
import pytest

from fitting.diagnosis.diagnose import DiagnosisOptions
from fitting.effects import CATALOGUE
from fitting.errors import OutsideModel
from instrument.finding.plate_diagnosis import PlateDiagnosis
from instrument.models.files import File
from instrument.progress import quiet


def diagnosis_of(sweep, plate, hammer=None):
    return PlateDiagnosis(File(sweep, plate), plate, [CATALOGUE["gain_error"]], hammer, 3)


def test_a_bare_plate_is_refused_before_anything_is_made(table5, coarse):
    with pytest.raises(OutsideModel, match=r"no core to diagnose, expected \[core\] and \[constraining\]"):
        diagnosis_of(table5, coarse.bare)


def test_what_is_traced_begins_with_the_stated_law_and_may_be_made_again_of_fewer_points(table5, coarse):
    way = diagnosis_of(table5, coarse)
    way.set_up(quiet)
    case, seen, options = way.traced(
        lambda *handed: handed, DiagnosisOptions(accepted_by_hand=["gain_error"])
    )
    assert case.start == coarse.core.law
    assert (options.resamples, options.accepted_by_hand) == (3, ["gain_error"])
    assert np.array_equal(seen.why_aside, [""] * len(table5))
    few = case.remade(table5.take(np.arange(len(table5)) < 5))
    assert len(few.sweep) == 5 < len(case.problem.sweep)
