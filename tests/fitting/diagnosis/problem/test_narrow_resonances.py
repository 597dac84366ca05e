"""Resonances hardly wider than they may be off: numbers of the fit, and the law's errors with them."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from supported_plate import supported

from fitting.data.noise import Noise
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem import narrow_resonances
from fitting.diagnosis.problem.model_error import own_errors
from fitting.diagnosis.problem.narrow_resonances import narrow_of
from fitting.diagnosis.several.responses import response_of
from fitting.discrepancy.model_error import model_error_at
from fitting.laws import LAWS
from fitting.laws.constant import ConstantModulus
from fitting.nuisances.narrow import THEORY
from fitting.reduced.resonance_parts import modes_between
from fitting.sweep import Sweep
from instrument.models.set_up import set_up

LAW = LAWS["fractional-zener"](50e6, 1e9, 3e-4, 0.5)
PLATE = supported(LAW, (16, 12))
NOISE = 0.003
ERRS = partial(model_error_at, PLATE)


def sweep_of(f, segment, v=None):
    v = np.ones(len(f), complex) if v is None else v
    one = np.ones(len(f))
    return Sweep(f, v, one, segment, one.astype(np.intp), std_m_s=NOISE * np.abs(v))


@pytest.fixture(scope="module")
def ready():
    """The task of four segments, each about a resonance."""
    asked = np.geomspace(150.0, 1000.0, 40)
    rough = set_up(sweep_of(asked, np.ones(40, np.intp)), PLATE, with_effects=False)
    modes = modes_between(rough.reduced, LAW, 150.0, 1000.0)[:4]
    f = np.concatenate([np.linspace(0.97, 1.03, 20) * m.frequency_hz for m in modes])
    segment = np.repeat(np.arange(1, 5), 20)
    order = np.argsort(f)
    return set_up(sweep_of(f[order], segment[order]), PLATE, with_effects=False)


def test_those_are_narrow_whose_width_is_not_much_more_than_they_may_be_off(ready, mesh_is_right):
    sweep, plate = ready.problem.sweep, ready.problem.plate
    narrow, moved = narrow_of(ERRS, plate, [sweep], LAW)
    assert len(narrow) >= 4
    assert all(1e-4 < one.by_itself < 1e-2 and one.loss < 0.02 for one in narrow.each)
    assert moved.U.shape[1] == plate.U.shape[1] + len(narrow)
    # A core that loses much has none, and then the plate is as it was.
    lossy = ConstantModulus(20e6, 1.0)
    wide, same = narrow_of(ERRS, plate, [sweep], lossy)
    assert len(wide) == 0
    assert same.U.shape == plate.U.shape


def test_a_number_moves_its_own_resonance_by_its_size_and_the_others_not(ready):
    problem = ready.problem.with_narrow(LAW)
    narrow = problem.nuisances.narrow.each
    names = [n.name for n in problem.nuisances.each]
    z = np.zeros(len(names))
    z[names.index(f"resonance_{narrow[1].number}")] = 3.0
    change = problem.nuisances.change(problem.plate, z)
    stiffer = replace(problem.plate, K_0=problem.plate.K_0 + change.K)
    before, after = (
        np.array([m.frequency_hz for m in modes_between(p, LAW, 150.0, 1000.0)[:4]])
        for p in (problem.plate, stiffer)
    )
    # The core is stiffer where it vibrates faster: a little more than the number says.
    moved = np.log(after / before) / (3 * narrow[1].by_itself)
    assert moved[1] == pytest.approx(1.0, abs=0.02)
    assert np.abs(np.delete(moved, 1)).max() < 1e-6


def test_derivatives_to_the_numbers_are_those_of_the_response(ready):
    problem = ready.problem.with_narrow(LAW).condensed(LAW).around(LAW)
    response = response_of(problem, ())
    z = np.linspace(-1.0, 1.0, len(problem.nuisances))
    v, by = response.with_derivatives(LAW, z)
    h = 1e-4
    for k in range(len(z)):
        step = h * np.eye(len(z))[k]
        slope = (response.velocity(LAW, z + step) - response.velocity(LAW, z - step)) / (2 * h)
        # What sits at a node of a mode reads next to nothing of it.
        off = np.abs(by[len(LAW.names) + k] - slope).max()
        assert off < 1e-3 * np.abs(slope).max() + 1e-6 * np.abs(v).max()


def test_what_is_a_number_of_the_fit_is_no_error_beside_it(ready):
    problem = ready.problem.with_narrow(LAW).around(LAW)
    v = response_of(problem, ()).velocity(LAW, problem.as_stated)
    before = own_errors(ready.problem, ready.reduced, LAW, v)
    after = own_errors(problem, ready.reduced, LAW, v)
    assert np.abs(before.of_plate).max() > 0.1 * np.abs(v).max()
    assert np.abs(after.of_plate).max() < 2e-3 * np.abs(v).max()


def test_taken_at_its_word_it_has_none_of_these_numbers(ready):
    held = ready.problem.with_narrow(LAW).with_stated_fixed
    v = response_of(held, ()).velocity(LAW, held.as_stated)
    assert v == pytest.approx(response_of(ready.problem, ()).velocity(LAW, np.zeros(0)), rel=1e-9)


def _off(ready, every):
    """Of G' in standard errors, the plate's resonances all higher by some of what is counted."""
    sweep, moving = ready.problem.sweep, ready.problem.with_narrow(LAW).around(LAW)
    own = [n.kind == "resonance" for n in moving.nuisances.each]
    v = response_of(moving, ()).velocity(LAW, every * np.array(own, dtype=float))
    rng = np.random.default_rng(1)
    v = v + NOISE * np.abs(v) * (rng.standard_normal(len(v)) + 1j * rng.standard_normal(len(v)))
    return ready.remade(sweep_of(sweep.frequency_hz, sweep.segment, v))


def _deviation(task, reduced):
    noise = Noise(task.sweep.std_m_s, "stated")
    start = LAWS["fractional-zener"](60e6, 0.9e9, 4e-4, 0.5)
    none = begin(task, reduced, noise, None, start).none
    omega, n = 2 * np.pi * np.array([300.0]), len(LAW.names)
    by_log = (none.law.jacobian(omega) * np.array(none.law.values)[:, None]).real[:, 0]
    error = np.sqrt(by_log @ none.covariance[:n, :n] @ by_log)
    return float(none.law.modulus(omega).real[0] - LAW.modulus(omega).real[0]) / error


def test_a_law_of_narrow_resonances_is_off_by_what_it_says(ready, monkeypatch, mesh_is_right):
    task = _off(ready, 1.0)
    assert abs(_deviation(task, ready.reduced)) < 2.5
    monkeypatch.setattr(narrow_resonances, "NARROW", np.inf)
    # To first order beside the fit instead: the law takes it up.
    assert abs(_deviation(task, ready.reduced)) > 4


def test_the_theory_has_one_number_in_common(ready):
    problem = ready.problem.with_narrow(LAW)
    assert [n.name for n in problem.nuisances.each].count(THEORY) == 1
    adjusted = problem.adjusted(0.5 + problem.as_stated, 1 + problem.as_stated)
    by_name = {one.name: one for one in adjusted}
    first = problem.nuisances.narrow.each[0]
    own = by_name[f"resonance_{first.number}"]
    assert own.unit == "Hz"
    assert own.stated == pytest.approx(first.frequency_hz)
    assert own.found == pytest.approx(first.frequency_hz * np.exp(0.5 * first.by_itself))
    loss = by_name[f"loss_{first.number}"]
    assert loss.found - loss.stated == pytest.approx(0.5 * first.loss_by_itself)
    assert (by_name[THEORY].stated, by_name[THEORY].found) == (0.0, 0.5)
