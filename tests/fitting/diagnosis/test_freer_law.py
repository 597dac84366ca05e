"""A law that bends as far as the data ask for: further where they do, and no further where they do not."""

from dataclasses import replace

import numpy as np

from fitting.bent_law import BentLaw
from fitting.diagnosis.begin import begin
from fitting.diagnosis.freer_law import loosened
from fitting.diagnosis.small_problem import SmallProblem
from fitting.laws import LAWS
from fitting.noise import Noise
from fitting.specimen import Core, Face
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
FREQUENCY_HZ, NOISE = np.geomspace(15, 1500, 160), 2e-3


def bumpy(omega, height):
    """The formula's modulus, its loss factor higher by `height` about 150 Hz."""
    G = FORMULA.modulus(omega)
    bump = height * np.exp(-0.5 * (np.log(omega / (2 * np.pi * 150)) / 1.2) ** 2)
    return G.real + 1j * G.imag * np.exp(bump)


def begun(height):
    w, count = 2 * np.pi * FREQUENCY_HZ, len(FREQUENCY_HZ)
    relative = rational_of(system_of(OBERST, OBERST.parts()), w, 3e8)
    v = 1j * w * relative.with_derivative(bumpy(w, height))[0] * 9.81
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


def test_a_law_that_may_not_bend_and_a_noise_that_nobody_knows_are_left_as_they_are():
    usual = begun(0.0)
    rigid = replace(usual, none=replace(usual.none, law=FORMULA))
    assert loosened(rigid).none is rigid.none
    unknown = replace(usual, none=replace(usual.none, noise_known=False))
    assert loosened(unknown).none is unknown.none
