"""What a law's file says of its shift, and of its curve as a whole."""

import numpy as np
import pytest
from conftest import TABLE_4
from found_law_cases import ERRORS, facts
from pydantic import ValidationError

from instrument.material.found_shift import FoundShift
from instrument.material.knowledge import posterior_of

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


def test_the_covariance_of_a_curve_is_that_of_laws_drawn():
    f = np.array([20.0, 100.0, 250.0])
    known = posterior_of(facts(TABLE_4, errors=0.1 * ERRORS))
    rng = np.random.default_rng(5)
    curves = []
    for _ in range(2000):
        law = TABLE_4.with_values(TABLE_4.values * np.exp(0.1 * ERRORS * rng.standard_normal(4)))
        storage, eta = law.storage_and_loss(2 * np.pi * f)
        curves.append([*np.log(storage), *eta])
    drawn, said = np.cov(np.array(curves).T), known.curve(f)
    sizes = np.sqrt(np.diag(said))
    assert np.sqrt(np.diag(drawn)) == pytest.approx(sizes, rel=0.08)
    assert np.abs((drawn - said) / np.outer(sizes, sizes)).max() < 0.12


def test_without_what_relates_the_parameters_nothing_is_said_of_the_curve():
    assert posterior_of(facts(TABLE_4, posterior=False)) is None
    assert posterior_of({"law_kind": "no such law"}) is None
