"""What a law's file says of its shift, and of its curve as a whole."""

import numpy as np
import pytest
from found_law_cases import ERRORS, HIGH, LOW, said_of_curve
from paper_law import TABLE_4
from pydantic import ValidationError

from fitting.identification.known_curve import known_curve
from instrument.material.found_shift import FoundShift
from instrument.material.knowledge import known_curve_of

KNOWN = {
    "wlf": ({"c1": 10.0, "c2_k": 100.0}, "log10 a_T = -10 (T - 20) / (100 + T - 20), T in degrees C"),
    "arrhenius": (
        {"activation_energy_j_mol": 1e5},
        "ln a_T = 100000 / 8.314463 (1/T - 1/293.15), T in K",
    ),
    "free": ({}, "log10 a_T = 0.5000 at 10 degrees C, -0.4000 at 30 degrees C"),
}


def shift(kind="wlf", *, simple=True):
    at = [{"temperature_c": t, "log10_shift": s} for t, s in ((10.0, 0.5), (30.0, -0.4))]
    return FoundShift.model_validate(
        {
            "shift": kind,
            "reference_c": 20.0,
            "shift_parameters": KNOWN[kind][0],
            "temperatures": at,
            "simple": simple,
        }
    )


@pytest.mark.parametrize("kind", KNOWN)
def test_a_shift_is_a_formula_with_the_range_it_was_measured_over(kind):
    assert shift(kind).words == f"{KNOWN[kind][1]}; measured from 10 to 30 degrees C"


@pytest.mark.parametrize(
    ("simple", "verdict"), [(True, "thermorheologically simple"), (False, "unknown"), (None, "unknown")]
)
def test_a_law_that_may_not_be_simple_is_not_called_so(simple, verdict):
    assert shift(simple=simple).verdict == verdict


@pytest.mark.parametrize("kind", ["wlf", "arrhenius"])
def test_a_shift_without_its_parameters_is_none(kind):
    with pytest.raises(ValidationError, match="shift_parameters without"):
        FoundShift.model_validate(shift(kind).model_dump() | {"shift_parameters": {}})


def test_what_a_file_says_of_the_curve_is_what_the_fit_knew():
    C = np.diag([*ERRORS**2, 1.0])
    C[0, 4] = C[4, 0] = 0.01
    known = known_curve(TABLE_4, C, ["core_thickness"], LOW, HIGH)
    read = known_curve_of({"law_known": said_of_curve(TABLE_4, C, ["core_thickness"])})
    for name in ("frequency_hz", "covariance", "of_another_measurement", "by_stated"):
        np.testing.assert_allclose(getattr(read, name), getattr(known, name), rtol=1e-12, atol=1e-15)
    assert read.stated == known.stated


DAMAGED = {
    "nothing": lambda _: None,
    "a number": lambda _: 3.0,
    "a row is lost": lambda said: said | {"covariance": said["covariance"][:-1]},
    "frequencies fall": lambda said: said | {"frequency_hz": said["frequency_hz"][::-1]},
    "a column is short": lambda said: said | {"stated": {"core_thickness": [0.1]}},
    "not a number": lambda said: said | {"frequency_hz": [None, *said["frequency_hz"][1:]]},
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_what_says_nothing_that_can_be_read_says_nothing(damage):
    said = said_of_curve(TABLE_4, np.diag(ERRORS**2), ())
    assert known_curve_of({"law_known": DAMAGED[damage](said)}) is None
