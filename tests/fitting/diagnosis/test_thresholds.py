"""What a diagnosis is decided by is what its page says: verdicts on both sides of each published boundary."""

import re
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from fitted_by_hand import FittedByHand

from fitting.data.readings import Readings
from fitting.diagnosis import thresholds
from fitting.diagnosis.checks.predictive import checks
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.search.stand_in import unsized
from fitting.diagnosis.thresholds import KIN
from fitting.diagnosis.verdict.judgement import judge
from fitting.diagnosis.verdict.kin import Kin, weighed
from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus
from fitting.sweep import Sweep

PAGE = (Path(__file__).parents[3] / "docs" / "diagnosis-method.md").read_text()
NAMES = sorted(n for n, e in CATALOGUE.items() if not e.replaces_law and e.causes == 1)
COUNT = 400
SWEEP = Sweep(
    frequency_hz=np.linspace(14.0, 300.0, COUNT),
    velocity_m_s=np.ones(COUNT) + 0j,
    commanded_m_s2=np.full(COUNT, 9.81),
    segment=np.ones(COUNT, int),
    sweep=np.ones(COUNT, int),
)
ONES = np.ones(COUNT)
EVIDENCE = Evidence(Readings(SWEEP.velocity_m_s), ONES, ONES, np.zeros((2 * COUNT, 1)), True)


def explanation(*names, probability=1.0, weakest=0.5, tolerances=0.5, stands_in=""):
    fitted = SimpleNamespace(effects=tuple(CATALOGUE[name] for name in names))
    found = {"size": weakest, "tolerances": tolerances}
    return ScoredFit(fitted, -2 * float(np.log(probability)), found, stands_in)


REFUSED_NONE = explanation(probability=1e-200, weakest=1e-20)


def judged(none, *others, off=None, kin=None):
    def akin(one):
        return None if kin is None else Kin(kin, np.zeros(1), np.zeros((1, 1)), np.zeros(1))

    held_out = (off or {}).get
    return judge(none, others, held_out=lambda one: held_out(one.names, 1.0), kin=akin).verdict


@pytest.mark.parametrize(("of_none", "verdict"), [(0.19, "ambiguous"), (0.21, "none")])
def test_an_effect_is_named_where_none_has_at_most_a_fifth(of_none, verdict):
    # Twelve share the rest: none is far likelier than each.
    others = [explanation(name, probability=(1 - of_none) / 12) for name in NAMES[:12]]
    assert judged(explanation(probability=of_none), *others) == verdict


@pytest.mark.parametrize(("times", "verdict"), [(1.3, "ambiguous"), (1.5, "none")])
def test_an_effect_is_named_where_none_is_hardly_likelier(times, verdict):
    assert judged(explanation(probability=times), explanation("gain_error")) == verdict


@pytest.mark.parametrize(("of_other", "verdict"), [(0.04, "effect"), (0.06, "ambiguous")])
def test_an_effect_is_certain_where_all_others_have_less_than_a_twentieth(of_other, verdict):
    rivals = explanation("gain_error", probability=1 - of_other), explanation("tether", probability=of_other)
    assert judged(REFUSED_NONE, *rivals) == verdict
    none = explanation(probability=of_other)
    assert judged(none, rivals[0]) == verdict


@pytest.mark.parametrize(
    ("odds", "verdict"),
    [(0.04 / 0.96, "effect"), (0.06 / 0.94, "ambiguous"), (1.9, "ambiguous"), (2.1, "unknown")],
)
def test_kin_leaves_an_effect_certain_up_to_a_twentieth_and_named_up_to_twice_as_likely(odds, verdict):
    assert judged(REFUSED_NONE, explanation("gain_error"), kin=odds) == verdict


def test_what_may_stand_in_keeps_three_fifths_beside_what_passes_all_checks():
    sure, other = explanation("gain_error", stands_in="not seen"), explanation("tether", probability=1e-9)
    said = judge(REFUSED_NONE, [sure, other], held_out=lambda one: 1.0)
    assert said.of_effect("gain_error") == pytest.approx(0.6)
    assert said.of_effect("tether") == pytest.approx(0.4)


@pytest.mark.parametrize(("tail", "verdict"), [(0.9e-4, "unknown"), (1.1e-4, "effect")])
def test_an_explanation_is_refused_below_one_in_ten_thousand(tail, verdict):
    assert judged(REFUSED_NONE, explanation("gain_error", weakest=tail)) == verdict


@pytest.mark.parametrize(("tail", "verdict"), [(0.009, "ambiguous"), (0.011, "effect")])
def test_an_explanation_that_strains_the_tolerances_is_certain_from_one_in_a_hundred(tail, verdict):
    assert judged(REFUSED_NONE, explanation("gain_error", tolerances=tail)) == verdict


@pytest.mark.parametrize(
    ("off", "none_off", "verdict"),
    [(2.9, 1.0, "effect"), (3.1, 1.0, "unknown"), (4.9, 10.0, "effect"), (5.1, 10.0, "unknown")],
)
def test_another_law_predicts_to_three_times_the_noise_or_half_the_error_of_no_effect(off, none_off, verdict):
    law = explanation("core_law")
    assert judged(REFUSED_NONE, law, off={("core_law",): off, (): none_off}) == verdict


def fitted(*, chi2_per_dof, z=0.0, took=0.5):
    """White residuals of a given size; one stated number, of whose variance the data take a share."""
    law, r = ConstantModulus(5e5, 0.5), np.random.default_rng(1).normal(size=2 * COUNT)
    names = len(law.names)
    r *= np.sqrt(chi2_per_dof * (len(r) - names) / (r @ r))
    J = np.zeros((len(r) + 1, names + 1))
    J[0, names], J[-1, names] = np.sqrt(took / (1 - took)), 1.0
    whole, free = np.append(r, z), np.ones(1, bool)
    return Refitted((), law, np.array([z]), SWEEP.velocity_m_s, whole, J, len(r), free, 1, True)


def checked(one):
    return dict(checks(SWEEP, EVIDENCE, one, one))


def test_noise_is_known_to_eight_percent():
    # Of its variance that is 16 %, beside 5 % that so many readings scatter: 3.7 times both.
    assert checked(fitted(chi2_per_dof=1.82))["size"] > 1e-4
    assert checked(fitted(chi2_per_dof=1.92))["size"] < 1e-4


def test_a_stated_number_is_asked_where_the_data_take_three_tenths_of_its_variance():
    assert checked(fitted(chi2_per_dof=1.0, z=6.0, took=0.29))["tolerances"] == 1.0
    assert checked(fitted(chi2_per_dof=1.0, z=6.0, took=0.31))["tolerances"] < 1e-9


@pytest.mark.parametrize(("errors", "nothing"), [(2.1, False), (1.9, True)])
def test_beside_another_an_effect_has_a_size_from_two_standard_errors_on(errors, nothing):
    gain, delay = CATALOGUE["gain_error"], CATALOGUE["channel_delay"]
    one = FittedByHand(
        effects=(gain, delay),
        u=np.array([1.0 + errors * 1e-3, 1e-3]),
        stated=0,
        free=np.ones(2, bool),
        law=SimpleNamespace(names=()),
        covariance=np.diag([1e-6, 1e-12]),
    )
    assert unsized(one) == nothing


def test_kin_has_an_eighth_where_no_reading_tells_it_from_the_explanation():
    nothing = np.zeros((1, 1))
    found = weighed(np.eye(1), nothing, nothing, np.zeros(1), 100.0, KIN.shares)
    assert found.odds / (1 + found.odds) == pytest.approx(1 / 8)
    # Two of four shares that are as likely as each other, 30 and 100 %, are another cause.
    assert found.another_cause == pytest.approx(0.5)


def published():
    """Of the page's table: name and number, or numbers."""
    rows = re.findall(r"^\|[^|]*\| `(\w+)\.(\w+)` \| ([^|]*) \|$", PAGE, re.MULTILINE)
    return [(kind, name, [float(x) for x in numbers.split(",")]) for kind, name, numbers in rows]


def test_the_page_has_a_row_for_each():
    kinds = {kind: one for kind, one in vars(thresholds).items() if is_dataclass(type(one))}
    decide = [(kind, field.name) for kind, one in kinds.items() for field in fields(one)]
    assert len(kinds) >= 7
    assert sorted(decide) == sorted((kind, name) for kind, name, _ in published())


@pytest.mark.parametrize(("kind", "name", "numbers"), published())
def test_the_page_on_the_method_gives_the_numbers_that_decide(kind, name, numbers):
    assert np.atleast_1d(getattr(getattr(thresholds, kind), name)) == pytest.approx(numbers, rel=1e-3)
