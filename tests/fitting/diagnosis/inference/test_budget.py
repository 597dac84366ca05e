"""The budget: its sources add up to the uncertainty of the law, each moved by what it is the source of."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.diagnosis.inference.budget import BEND, MODEL, NOISE, budget_of
from fitting.identification.uncertainty import Uncertainty
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File

AT = np.array([20.0, 100.0, 280.0])


@pytest.fixture(scope="module")
def sweep(coarse):
    whole = read_sweep(DATA / "practice-005.csv").sweep(coarse.base_acceleration_m_s2)
    return whole.take(np.arange(len(whole)) % 8 == 0)


@pytest.fixture(scope="module")
def found(coarse, sweep):
    return identify([File(sweep, replace(coarse, exact=False))])


def test_sources_add_up_to_the_first_order_error(found):
    begun = found.joint.begun
    budget = budget_of(begun, AT)
    law = begun.none.law
    n = len(law.names)
    whole = Uncertainty(begun.none.covariance[:n, :n], {}, 1.0)
    storage, eta = whole.law_band(law, 2 * np.pi * AT)
    G, _ = law.storage_and_loss(2 * np.pi * AT)
    np.testing.assert_allclose(budget.total(budget.storage_relative), storage / G, rtol=1e-6)
    np.testing.assert_allclose(budget.total(budget.loss_factor), eta, rtol=1e-6)


def test_every_tolerance_is_a_source(found):
    budget = budget_of(found.joint.begun, AT)
    assert {NOISE, MODEL, BEND, "core_thickness", "substrate_young", "gain"} <= set(budget.storage_relative)
    # A thicker core of the same compliance is stiffer in proportion: the law cannot tell.
    assert budget.storage_relative["core_thickness"].max() > 0.005


def test_a_number_that_is_exact_is_no_source(coarse, sweep):
    exact = replace(coarse, exact=False, tolerances={"core_thickness": 0.0})
    budget = budget_of(identify([File(sweep, exact)]).joint.begun, AT)
    assert "core_thickness" not in budget.storage_relative
