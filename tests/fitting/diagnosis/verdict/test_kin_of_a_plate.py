"""What is akin to an effect on a plate: its resonances elsewhere, its segments read by another gain."""

from types import SimpleNamespace

import numpy as np
import pytest
from supported_plate import supported

from fitting.data.noise import Noise
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.search.catalogue_search import Search
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.thresholds import KIN
from fitting.diagnosis.verdict.kin import kin_of
from fitting.effects import CATALOGUE
from fitting.laws import LAWS
from fitting.sweep import Sweep
from instrument.models.set_up import set_up

LAW = LAWS["fractional-zener"](0.4e6, 4e6, 1.4e-4, 0.9)
PLATE = supported(LAW, (8, 6))
NOISE, DELAY_S = 0.003, 4e-5
ODDS = KIN.chance / (1 - KIN.chance)
GAIN = CATALOGUE["channel_delay"]


def sweep_of(f, segment, v):
    one = np.ones(len(f))
    return Sweep(f, v, one, segment, one.astype(np.intp), std_m_s=NOISE * np.abs(v))


@pytest.fixture(scope="module")
def ready():
    f = np.concatenate([np.linspace(130, 190, 30), np.linspace(290, 360, 30), np.linspace(420, 520, 30)])
    segment = np.repeat(np.arange(1, 4), 30)
    return set_up(sweep_of(f, segment, np.ones(90, complex)), PLATE, with_effects=False)


def late(ready, gains=(1.0, 1.0, 1.0), delay=DELAY_S, seed=0):
    """A sweep read late, and segments by other gains; with noise."""
    sweep = ready.problem.sweep
    v = response_of(ready.problem, ()).velocity(LAW, np.zeros(0))
    v = v * np.exp(-1j * sweep.omega * delay) * np.array(gains)[sweep.segment - 1]
    rng = np.random.default_rng(seed)
    v = v + NOISE * np.abs(v) * (rng.standard_normal(len(v)) + 1j * rng.standard_normal(len(v)))
    return ready.remade(sweep_of(sweep.frequency_hz, sweep.segment, v))


def explained(task, reduced):
    """The search and the fit with a delay."""
    begun = begin(task, reduced, Noise(task.sweep.std_m_s, "stated"), None, LAW)
    search = Search(begun.problem, begun.evidence, begun.none, [], None)
    none = begun.none
    u = np.concatenate([none.u, [DELAY_S]])
    return search, refit(response_of(begun.problem, [GAIN]), begun.evidence, none.law, u)


def odds(task, reduced):
    return kin_of(*explained(task, reduced), 1.0).odds / ODDS


def test_a_delay_that_fits_has_little_kin_and_the_less_the_plainer_it_is(ready):
    plain, weak = (odds(late(ready, delay=d), ready.reduced) for d in (4e-5, 1e-6))
    assert plain < 0.6
    assert plain < weak < 2


def test_what_is_no_delay_but_like_one_has_much(ready):
    assert odds(late(ready, gains=(1.02, 0.98, 1.02)), ready.reduced) > 100


def test_kin_makes_the_law_wider_and_never_narrower(ready):
    search, fitted = explained(late(ready, gains=(1.02, 0.98, 1.02)), ready.reduced)
    kin = kin_of(search, fitted, 1.0)
    assert np.linalg.eigvalsh(kin.wider).min() > -1e-12 * np.abs(kin.wider).max()
    n = len(LAW.names)
    assert np.trace(kin.wider[:n, :n]) > 0.1 * np.trace(fitted.covariance[:n, :n])
    low, high = fitted.law.log_limits
    logs = np.log(kin.law(fitted).values)
    assert np.all((logs >= low) & (logs <= high))


def test_readings_that_say_less_leave_more_kin(ready):
    search, fitted = explained(late(ready), ready.reduced)
    sharp, blunt = (kin_of(search, fitted, temper).odds for temper in (1.0, 100.0))
    assert sharp < blunt < 1.2 * ODDS


def test_within_the_error_of_an_effects_own_formula_kin_is_the_effect_itself(ready, monkeypatch):
    task = late(ready, gains=(1.004, 0.996, 1.004))
    much = odds(task, ready.reduced)
    monkeypatch.setattr(type(GAIN), "unexplained_share", 0.1)
    # Differing by all of it alone is left.
    few = odds(task, ready.reduced)
    assert few != pytest.approx(much)
    monkeypatch.setattr(type(GAIN), "unexplained_share", 1.0)
    assert kin_of(*explained(task, ready.reduced), 1.0) is None


def test_where_the_noise_is_not_known_there_is_none(ready):
    search, fitted = explained(late(ready), ready.reduced)
    search.evidence = SimpleNamespace(scale_known=False)
    assert kin_of(search, fitted, 1.0) is None


def test_files_of_one_plate_have_their_resonances_in_common(ready):
    """Two files that are off alike speak for it together."""
    tasks = [late(ready, gains=(1.01, 0.99, 1.01), seed=k) for k in (1, 2)]
    alone = [odds(task, ready.reduced) for task in tasks]
    both = SeveralProblem.of_members(tasks, [ready.reduced] * 2)
    assert odds(both, None) > max(alone)


def test_what_it_leaves_is_noise_where_it_is_what_is_there(ready):
    search, fitted = explained(late(ready, gains=(1.1, 0.9, 1.1)), ready.reduced)
    dof = fitted.data - fitted.parameter_count
    assert fitted.chi2_per_dof > 1.5
    assert kin_of(search, fitted, 1.0).leaves / dof == pytest.approx(1.0, abs=0.3)
