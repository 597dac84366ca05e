"""Tables of modes that are of something else are asked about."""

import numpy as np
import pytest

from instrument.mistakes.modal_look import modal_doubt, numbering_doubt

HZ = np.array([74.3, 365.6, 922.2, 1670.0])


@pytest.mark.parametrize("off", [1.0, 0.8, 1.2])
def test_modes_that_an_effect_moves_are_not_asked_about(off):
    assert modal_doubt(HZ, HZ * off) == ""
    assert modal_doubt(HZ, HZ * [off, 1.0, 1.0, 2.0]) == ""


@pytest.mark.parametrize("core", [0.4, 1.0, 1.5])
def test_kilohertz_are_named(core):
    assert modal_doubt(1e-3 * HZ, HZ * core) == "the frequencies are in kHz, expected Hz"


def test_modes_of_another_specimen_are_asked_about():
    assert "another specimen" in modal_doubt(HZ, np.array([43.0, 341.0, 440.0, 1308.0]))


def test_a_temperature_that_is_far_off_is_no_numbering_where_most_are_near():
    near, far = np.log([1.0, 1.05, 1.01]), np.log([1.0, 0.86, 1.01])
    assert numbering_doubt([near, near, far]) == ""
    assert (
        "nearer to these frequencies than 15 %, expected another specimen or mode numbers"
        in numbering_doubt([near, far, far])
    )
