"""Where G' of a free layer is hardly known, its loss factor is told by an interval that is no normal one."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from beam_tables import BEAM, read

from fitting.depth.profile import profile
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.fit import begin_modal, modal_fit_of, problem_of, start_of
from fitting.mode_tables.standing import standing
from fitting.stated.layers import Core
from instrument.finding.modal import diagnose_tables, identify_tables
from instrument.remarks.free_layers import remark_on_free_layers

TRUE = ConstantModulus(1e8, 0.3)
BAND_HZ = (30.0, 1000.0)
NOT_ASKED = None


def free(thickness_m):
    """Stated within tolerances, as its layer lies on 2 mm of aluminium."""
    return replace(BEAM, constraining=None, exact=False, core=Core(thickness_m, 0.49, 1000.0, TRUE))


def table_of(stated, *, thicker=1.0):
    """Modes of the beam whose metal is so many times as thick as stated."""
    face = replace(stated.substrate, thickness_m=thicker * stated.substrate.thickness_m)
    return read(replace(stated, substrate=face, exact=True), law=TRUE)


def fitted(stated, *, thicker=1.0):
    tables = [table_of(stated, thicker=thicker)]
    return begin_modal(problem_of(tables, [stated]), start_of(tables, [stated]))


def said(stated, begun):
    fit = modal_fit_of(begun)
    return remark_on_free_layers([stated], fit.law, fit.uncertainty.covariance, BAND_HZ, begun.quantities)


def test_metal_two_tolerances_thicker_leaves_the_loss_factor_inside_the_interval_that_is_told():
    stated = free(1.5e-3)
    begun = fitted(stated, thicker=1.01)
    intervals = profile(begun.quantities(np.array([100.0])), only=[-1])
    (low, high), (_, linear) = intervals.bounds[95][-1], intervals.linear[95][-1]
    assert linear < TRUE.loss_factor < high
    assert low < intervals.found[-1] < high
    (words,) = said(stated, begun)
    assert words.startswith("G' of a free layer is hardly known: at ")
    assert "by profile likelihood" in words
    assert "a thicker layer, thinner metal, or the metal's stiffness measured bare" in words


def test_a_law_from_tables_says_so_and_so_does_their_diagnosis():
    stated = free(1.5e-3)
    tables = [table_of(stated, thicker=1.01)]
    (identified,) = (r for r in identify_tables(tables, [stated]).remarks if "of a free layer" in r)
    others = frozenset(e.name for e in standing([stated])) - {"added_mass"}
    (diagnosed,) = (r for r in diagnose_tables(tables, [stated], others).remarks if "of a free layer" in r)
    assert "with 95 % " in identified
    assert "with 95 % " in diagnosed


def test_nothing_is_said_of_a_thick_layer():
    stated = free(6e-3)
    assert said(stated, fitted(stated)) == ()


def with_errors(storage, loss, specimen):
    """Of ln G' and ln eta, the errors of ln G' and ln G'' being independent."""
    covariance = np.array([[storage**2, -(storage**2)], [-(storage**2), storage**2 + loss**2]])
    return remark_on_free_layers([specimen], TRUE, covariance, BAND_HZ, NOT_ASKED)


@pytest.mark.parametrize(("storage", "loss"), [(0.1, 0.02), (0.25, 0.2), (np.nan, np.nan)])
def test_nothing_is_said_where_g_prime_is_known_well_or_no_worse_than_g_double_prime_or_not(storage, loss):
    assert with_errors(storage, loss, free(2e-3)) == ()


def test_nothing_is_said_of_a_constrained_core():
    assert with_errors(0.25, 0.05, BEAM) == ()


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        ((0.1, np.nan), "with 95 % above 0.1 by"),
        ((np.nan, 0.4), "with 95 % below 0.4 by"),
        ((np.nan, np.nan), "with 95 % without an upper bound by"),
        ((0.1, 0.4), "with 95 % 0.1 to 0.4 by"),
    ],
)
def test_an_interval_that_chi_square_leaves_open_is_said_to_be(bounds, words, monkeypatch):
    found = SimpleNamespace(bounds={95: np.array([bounds])})
    monkeypatch.setattr("instrument.remarks.free_layers.profile", lambda quantities, only: found)
    covariance = np.diag([0.25**2, 0.25**2]) + np.array([[0.0, -(0.25**2)], [-(0.25**2), 0.0]])
    (told,) = remark_on_free_layers([free(2e-3)], TRUE, covariance, BAND_HZ, lambda frequency_hz: None)
    assert words in told
