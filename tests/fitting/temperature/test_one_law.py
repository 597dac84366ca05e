"""The laws of all temperatures as one set of parameters: what each sweep reads, and how it goes with them."""

from dataclasses import replace

import numpy as np
import pytest
from temperature_cases import LAW, REFERENCE, T

from fitting.laws.bent_law import BentLaw
from fitting.temperature.one_law import OneLaw, OwnLaws
from fitting.temperature.shifts import Shift

F = np.geomspace(14.0, 300.0, 7)
POINTS = (7,) * len(T)
PARAMETERS = {"wlf": (4.0, 60.0), "arrhenius": (1.2e5,), "free": (1.5, 0.6, -0.5, -1.1)}


def bent():
    law = BentLaw.over(LAW, np.array([5.0, 900.0]))
    return law.with_values(
        law.values * np.linspace(0.9, 1.1, len(law.names)) ** (np.arange(len(law.names)) > 3)
    )


def one_law(kind, b=()):
    shift = Shift(kind, T, REFERENCE)
    theta = shift.positive(np.array(PARAMETERS[kind]))
    return OneLaw(bent(), shift, tuple(theta.tolist()), POINTS, b)


def with_temperatures(kind, off=(0.5, -1.0, 2.0, 0.3, -0.4), error_k=0.3):
    law = one_law(kind, (1.02, 0.98, 1.05, 0.95))
    warmer = tuple(np.exp(off).tolist())
    return replace(law, shift=Shift(kind, T, REFERENCE, error_k), warmer=warmer)


def own_laws():
    laws = [BentLaw.over(LAW, F * 1.1**k) for k in range(len(T))]
    return OwnLaws(tuple(laws), POINTS)


CASES = {
    "wlf": one_law("wlf"),
    "arrhenius, vertical": one_law("arrhenius", (1.02, 0.98, 1.05, 0.95)),
    "free": one_law("free"),
    "own": own_laws(),
    "wlf, temperatures": with_temperatures("wlf"),
    "arrhenius, temperatures": with_temperatures("arrhenius"),
}


@pytest.mark.parametrize("name", CASES)
def test_a_sweeps_modulus_goes_with_all_parameters_as_the_chain_says(name):
    law, h = CASES[name], 1e-5
    for k in range(len(T)):
        here = law.at(k)
        by_own = here.jacobian(2 * np.pi * F) * here.values[:, None]
        said = law.chain(k).T @ by_own
        logs = np.log(law.values)
        for j in range(len(logs)):
            up, down = (law.with_logs(logs + s * h * (np.arange(len(logs)) == j)).at(k) for s in (1, -1))
            expected = (up.modulus(2 * np.pi * F) - down.modulus(2 * np.pi * F)) / (2 * h)
            np.testing.assert_allclose(said[j], expected, rtol=2e-4, atol=1e-5 * np.abs(LAW.ginf_pa))


@pytest.mark.parametrize("name", CASES)
def test_names_values_limits_and_priors_go_together(name):
    law = CASES[name]
    assert len(law.names) == len(law.values) == len(law.limits) == len(set(law.names))
    assert len(law.search_widths) + law.bend_count == len(law.names)
    np.testing.assert_array_equal(law.with_values(law.values).values, law.values)
    known = law.names[len(law.names) - law.bend_count :]
    assert all("bend" in n or n.startswith("temperature_") for n in known)


def test_a_moved_temperature_is_where_its_sweep_is_read():
    law = with_temperatures("wlf")
    warm = Shift("wlf", T + 0.3 * np.array([0.5, -1.0, 2.0, 0.3, -0.4]), REFERENCE)
    np.testing.assert_allclose(law.log_shift, warm.log_shift(law.parameters))
    np.testing.assert_allclose(law.off, [0.5, -1.0, 2.0, 0.3, -0.4])


def test_the_reference_has_the_law_itself_and_a_shift_is_along_the_frequency():
    law = one_law("free")
    np.testing.assert_allclose(law.at(2).modulus(2 * np.pi * F), law.law.modulus(2 * np.pi * F))
    np.testing.assert_allclose(law.at(0).modulus(2 * np.pi * F), law.law.modulus(2 * np.pi * F * np.exp(1.5)))
    both = np.concatenate([2 * np.pi * F] * len(T))
    np.testing.assert_allclose(law.modulus(both)[: len(F)], law.at(0).modulus(2 * np.pi * F))
