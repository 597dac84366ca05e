"""What is held out of a sweep without segments."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig
from rivals import all_but

from instrument.files.sweep_file import read_sweep
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File


@pytest.fixture(scope="module")
def whole():
    """A practice sweep, a spot stated wrongly: three segments."""
    return read_sweep(DATA / "practice-005.csv").sweep(9.81)


def as_one(sweep):
    return replace(sweep, segment=np.ones(len(sweep), int))


def test_a_stretch_about_each_resonance_is_predicted_from_the_others_as_a_segment_is(whole):
    by_segments = identify([File(whole, plate_of_the_rig())]).result
    result = identify([File(as_one(whole), plate_of_the_rig())]).result
    held = result.validation.held_out
    assert [h.segment for h in held] == [1, 2, 3]
    for one, other in zip(held, by_segments.validation.held_out, strict=True):
        # Slow drift runs on from one to the next here: readings weigh otherwise, with a spot that is wrong.
        assert 0.5 < one.rms_percent / other.rms_percent < 2
    assert result.validation.held_out_rms_percent > 1
    (said,) = (w for w in result.warnings if "in one piece" in w)
    assert said.endswith(f" to {whole.frequency_hz.max():.3g} Hz")
    assert not any("in one piece" in w for w in by_segments.warnings)


def test_the_error_before_and_after_is_on_data_held_out(whole):
    some = as_one(whole.take(np.arange(0, len(whole), 3)))
    found = diagnose([File(some, plate_of_the_rig())], without=all_but("spot_offset", "added_mass")).result
    assert [e.name for e in found.effects] == ["spot_offset"]
    before, after = (s.validation.held_out_rms_percent for s in (found.before, found.after))
    assert after < 0.2 * before
    assert "on segments held out" in " ".join(found.explanation)
    assert any("in one piece" in w for w in found.warnings)
