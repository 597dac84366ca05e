"""A law that bends as far as the data ask for: further where they do, and no further where they do not."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.data.noise import Noise
from fitting.diagnosis.diagnose import diagnose_problem
from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.freer_law import freedom_of, loosened
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.search.catalogue_search import Search
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.effects import CATALOGUE
from fitting.laws import LAWS
from fitting.laws.bent_law import BentLaw
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import system_of
from fitting.structures.small_sum import rational_of
from fitting.sweep import Sweep

FORMULA = LAWS["fractional-zener"](1.2e8, 9e8, 6e-5, 0.5)
STATED = LAWS["fractional-zener"](1e8, 1.5e9, 1e-4, 0.5)
OBERST = Beam(
    0.2,
    0.01,
    "clamped-free",
    Face(2e-3, 70e9, 0.3, 2700.0),
    core=Core(2.5e-3, 0.49, 1000.0, STATED),
    pickup_m=0.15,
)
DELAY_S, LATER_S = 2e-5, 1e-4
FREQUENCY_HZ, NOISE = np.geomspace(15, 1500, 160), 2e-3


def bumpy(omega, height):
    """The formula's modulus, its loss factor higher by `height` about 150 Hz."""
    G = FORMULA.modulus(omega)
    bump = height * np.exp(-0.5 * (np.log(omega / (2 * np.pi * 150)) / 1.2) ** 2)
    return G.real + 1j * G.imag * np.exp(bump)


def begun(height, delay_s=0.0):
    w, count = 2 * np.pi * FREQUENCY_HZ, len(FREQUENCY_HZ)
    relative = rational_of(system_of(OBERST, OBERST.parts()), w, 3e8)
    v = 1j * w * relative.with_derivative(bumpy(w, height))[0] * 9.81 * np.exp(-1j * w * delay_s)
    rng = np.random.default_rng(5)
    scatter = NOISE * np.abs(v) / np.sqrt(2)
    v = v + scatter * (rng.normal(size=count) + 1j * rng.normal(size=count))
    ones = np.ones(count, dtype=int)
    sweep = Sweep(FREQUENCY_HZ, v, 9.81 * ones, ones, ones, base_m_s2=9.81 * ones + 0j)
    noise = Noise(NOISE * np.abs(v) / np.sqrt(2), "stated")
    problem = SmallProblem.of_small(sweep, OBERST)
    return begin(problem, None, noise, None, STATED)


def off(found, height):
    """Error of the loss factor over its standard error at 150 Hz."""
    none, w = found.none, np.array([2 * np.pi * 150])
    n = len(none.law.names)
    G, dG = none.law.modulus(w)[0], none.law.jacobian(w)[:, 0] * none.law.values
    by = dG.imag / G.imag - dG.real / G.real
    error = float(np.sqrt(by @ none.covariance[:n, :n] @ by))
    true = bumpy(w, height)[0]
    return float(np.log(G.imag / G.real / (true.imag / true.real))) / error


def test_a_material_far_from_the_formula_gets_the_freedom_it_asks_for():
    usual = begun(0.5)
    freer = loosened(usual)
    assert isinstance(freer.none.law, BentLaw)
    assert freer.none.law.freedom >= 2 * usual.problem.freedom
    assert freer.none.chi2 < usual.none.chi2 - 10
    assert abs(off(freer, 0.5)) < 2
    assert abs(off(freer, 0.5)) < abs(off(usual, 0.5))


def test_a_material_of_the_formula_keeps_the_usual_freedom():
    usual = begun(0.0)
    assert loosened(usual).none is usual.none


def late(height):
    """A search of a beam read late, and the delay that explains it."""
    start, delay = begun(height, DELAY_S), CATALOGUE["channel_delay"]
    search = Search(start.problem, start.evidence, start.none, [delay], ALONE)
    u = np.concatenate([start.none.u, [DELAY_S]])
    return search, search.judged(search.work.fit([delay], start.none.law, u))


def test_beside_an_effect_a_material_far_from_the_formula_gets_its_freedom_and_pays_for_it():
    search, explained = late(0.5)
    assert search.none.cost > search.reach(explained)
    (freer,) = search.freer([explained], explained)
    times = freedom_of(freer.fitted.law) / freedom_of(search.stated)
    assert times >= 2
    rare = freer.cost - cost(freer.fitted, search.problem.plate)
    assert rare == pytest.approx(2 * np.log(10) * np.log2(times))
    assert freer.cost < explained.cost
    _, (again,) = search.tempered([freer])
    tempered = cost(freer.fitted, search.problem.plate, search.temper(freer))
    assert again.cost == pytest.approx(tempered + rare)


def test_an_effect_is_named_though_its_core_is_off_any_formula_and_that_is_said():
    start = begun(0.8, LATER_S)
    v = start.problem.sweep.velocity_m_s
    noise = Noise(NOISE * np.abs(v) / np.sqrt(2), "stated")
    found = diagnose_problem(DiagnosisCase(start.problem, [CATALOGUE["channel_delay"]], noise, STATED))
    assert found.verdict == "effect"
    (one,) = found.effects
    assert one.name == "channel_delay"
    delay = one.parameters["delay"]
    assert abs(delay.value - LATER_S) < 3 * delay.standard_error
    assert found.warnings[0].startswith("beside channel_delay the law may bend 4 times as far")


def test_beside_an_effect_a_material_of_the_formula_keeps_the_usual_freedom():
    search, explained = late(0.0)
    assert search.freer([explained], explained) == []


def test_two_effects_and_a_rare_material_would_be_too_much_at_once():
    search, explained = late(0.5)
    fitted, other = explained.fitted, CATALOGUE["phase_offset"]
    u = np.concatenate([fitted.u, np.zeros(len(other.parameters))])
    pair = search.judged(search.work.fit([*fitted.effects, other], fitted.law, u))
    assert search.freer([pair], pair) == []


def test_a_law_that_may_not_bend_and_a_noise_that_nobody_knows_are_left_as_they_are():
    usual = begun(0.0)
    rigid = replace(usual, none=replace(usual.none, law=FORMULA))
    assert loosened(rigid).none is rigid.none
    unknown = replace(usual, none=replace(usual.none, noise_known=False))
    assert loosened(unknown).none is unknown.none
