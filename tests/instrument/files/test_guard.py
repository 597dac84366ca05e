"""What other programs' files may hold, and how a reader's troubles are said."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fitting.modal.frf import Frf
from instrument.errors import BadInput
from instrument.files.guard import checked_frf, checked_hits, said_of
from instrument.impact.record import Hit, ResponseChannel

PATH = Path("foreign.uff")
F = np.array([10.0, 20.0, 30.0])
GOOD = np.array([1.0 + 1j, 2.0, 3.0])


def hit(force, response=None, rate=1024.0):
    response = np.ones(len(force)) if response is None else response
    return Hit("hit 1", rate, force, (ResponseChannel("acceleration_m_s2", "acceleration", response),))


@pytest.mark.parametrize(
    "compute",
    [
        lambda x: x * np.inf * 0,
        lambda x: x * 1e308 * 10,
        lambda x: 1 / (x - x),
        lambda x: 1j * (x * np.array([np.inf])),
    ],
    ids=["none", "overflow", "by zero", "complex"],
)
def test_numbers_that_cannot_be_computed_with_are_refused_instead_of_warned_of(compute):
    with pytest.raises(BadInput, match=r"foreign\.uff: values that are none, or beyond"), said_of(PATH):
        compute(np.ones(3))


def test_a_reader_s_trouble_is_said_in_one_line_and_its_own_refusal_kept():
    with pytest.raises(BadInput, match="not as its format has it: KeyError: 'x_values'"), said_of(PATH):
        {}["x_values"]
    with pytest.raises(BadInput, match=r"^mine$"), said_of(PATH):
        raise BadInput("mine")


def test_numpy_warns_again_behind_a_reader():
    before = np.geterr()
    with said_of(PATH):
        pass
    assert np.geterr() == before


@pytest.mark.parametrize(
    ("frequency_hz", "H", "said"),
    [
        (F[::-1], GOOD, "ascending"),
        (F, np.zeros(3), "zero everywhere"),
        (F, GOOD[:2], "2 values beside 3"),
        (F, np.array([1.0, np.nan, 1.0]), "expected finite numbers"),
        (F, np.array([1.0, 1e31, 1.0]), "expected finite numbers"),
    ],
)
def test_an_frf_that_is_none_is_refused(frequency_hz, H, said):
    with pytest.raises(BadInput, match=said):
        checked_frf(PATH, "H1", Frf(frequency_hz, H, "velocity"))


def test_an_frf_passes_unchanged():
    frf = Frf(F, GOOD, "velocity")
    assert checked_frf(PATH, "H1", frf) is frf


@pytest.mark.parametrize(
    ("one", "said"),
    [
        (hit(np.ones(4)), "4 samples, expected 8 or more"),
        (hit(np.ones(16), np.ones(15)), "15 values beside 16"),
        (hit(np.ones(16), np.ones(16, complex)), "expected one row of numbers"),
        (hit(np.ones(16), rate=0.0), "0 samples/s"),
    ],
)
def test_a_record_that_is_none_is_refused(one, said):
    with pytest.raises(BadInput, match=said):
        checked_hits(PATH, [one])


def test_a_file_that_its_reader_names_too_is_named_once():
    with pytest.raises(BadInput, match=r"^foreign\.uff: 2 values beside 3"):
        checked_frf(PATH, "foreign.uff", Frf(F, GOOD[:2], "velocity"))
    with pytest.raises(BadInput, match=r"^foreign\.uff hit 1: channel force: 2 samples"):
        checked_hits(PATH, [replace(hit(np.ones(2)), source="foreign.uff hit 1")])
