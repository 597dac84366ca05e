"""A mistake in one segment of several."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases

from instrument.mistakes.any_core import any_core
from instrument.mistakes.mistake_in_part import mistake_in_a_segment
from instrument.mistakes.response_mistakes import response_of
from instrument.progress import quiet

PAIR = shear_pair_cases.pair(0.573)
WHOLE = shear_pair_cases.sweep(PAIR)
SWEEP = replace(WHOLE, segment=1 + np.arange(len(WHOLE)) * 4 // len(WHOLE))
MODEL = any_core(PAIR, SWEEP.frequency_hz, quiet)


def said_of(factor, segment=3):
    sweep = replace(SWEEP, velocity_m_s=np.where(SWEEP.segment == segment, factor, 1.0) * SWEEP.velocity_m_s)
    as_is = MODEL.nearest(response_of(sweep), has_phase=True, free=False)
    return mistake_in_a_segment(sweep, MODEL, as_is, "base")


@pytest.mark.parametrize(("factor", "words"), [(1e3, "read in mm"), (-1.0, "the sign is turned")])
def test_a_segment_in_another_unit_or_sign_is_named(factor, words):
    said = said_of(factor)
    assert said.startswith("in segment 3 (")
    assert words in said


def test_a_gain_of_one_segment_is_left_to_the_diagnosis():
    assert said_of(1.6) == ""


def test_what_is_wrong_in_every_segment_is_not_one_of_them():
    sweep = replace(SWEEP, velocity_m_s=1e3 * SWEEP.velocity_m_s)
    as_is = MODEL.nearest(response_of(sweep), has_phase=True, free=False)
    assert mistake_in_a_segment(sweep, MODEL, as_is, "base") is None
