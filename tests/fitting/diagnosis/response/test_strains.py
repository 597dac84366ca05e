"""Strains of the core, as softening goes by them, beside those of a plate solved at every point."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shear_pair_cases

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_answer import StrainedCore
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.response.plate_changes import PlateChanges
from fitting.diagnosis.response.point_modulus import PointModulus
from fitting.diagnosis.response.strains import Reference, Strains
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.diagnosis.several.responses import response_of
from fitting.dynamics.damping import viscous_damping
from fitting.effects import CATALOGUE
from fitting.effects.added_mass import PointMass
from fitting.effects.amplitude_softening import CoreStrain
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.reduced.rational import rational_sweep
from fitting.reduced.reduced_plate import reduce_plate
from fitting.sweep import Sweep
from fitting.widened.change import Change
from fitting.widened.enriching import enriched
from fitting.widened.full_plate import FullPlate

F_HZ = np.linspace(14.0, 26.0, 90)
OMEGA = 2 * np.pi * F_HZ
LAW = ConstantModulus(0.3e6, 0.2)
"""Of a core that damps little: the first resonance is some 1.5 Hz wide."""
MASS, STEP = np.array([5e-3, 0.25, 0.16]), np.array([5e-6, 0.0, 0.0])


@pytest.fixture(scope="module")
def clamped(zn1):
    """A plate of few elements, exact as stated, and its sweep over the first resonance."""
    return swept(replace(zn1, elements=(8, 6), exact=True))


@pytest.fixture(scope="module")
def told(zn1):
    """The same, its stated numbers known within usual tolerances."""
    return swept(replace(zn1, elements=(8, 6), exact=False)).problem


def swept(specimen):
    plate = Plate(specimen)
    damping = viscous_damping(plate)
    reduced = reduce_plate(plate, damping, domain_of(specimen, F_HZ))
    widened = enriched(FullPlate(plate, damping), plate.carried @ reduced.V, [PointMass(), CoreStrain()])
    ones = np.ones(len(F_HZ))
    sweep = Sweep(F_HZ, ones + 0j, ones, np.ones(len(F_HZ), int), np.ones(len(F_HZ), int))
    problem = DiagnosisProblem.of(sweep, specimen, widened, lambda omega: rational_sweep(reduced, omega))
    return SimpleNamespace(problem=problem.around(LAW), plate=widened)


def with_mass(plate, mass):
    return CATALOGUE["added_mass"].change(plate, mass)


def exact(plate, softened, change, gained=0.0):
    G = LAW.modulus(OMEGA)
    return StrainedCore(
        plate, OMEGA, G * (1 - softened) + 1j * gained * np.sqrt(G.real * G.imag), change
    ).strain


@pytest.mark.parametrize("softened", [-0.2, 0.0, 0.1, 0.2, 0.4])
@pytest.mark.parametrize("mass", [None, MASS], ids=["as it is", "with a mass"])
def test_strain_over_a_sharp_resonance_is_that_of_a_plate_solved_at_every_point(clamped, softened, mass):
    change = Change() if mass is None else with_mass(clamped.plate, mass)
    reference = Reference()
    strains = Strains(clamped.problem, clamped.plate, reference)
    found = strains.under(LAW, b"", lambda: change)(np.full(len(F_HZ), softened))
    expected = exact(clamped.plate, softened, change)
    assert expected.max() > 5 * expected.min()
    np.testing.assert_allclose(found * reference.strain, expected, rtol=2e-3)


@pytest.mark.parametrize(
    ("softened", "gained"), [(0.0, 0.0), (0.1, 0.1), (0.4, 0.2), (0.3, 0.4), (0.1, -0.1)]
)
@pytest.mark.parametrize("mass", [None, MASS], ids=["as it is", "with a mass"])
def test_strain_of_a_core_that_gains_loss_is_less_near_resonance(clamped, softened, gained, mass):
    change = Change() if mass is None else with_mass(clamped.plate, mass)
    reference = Reference()
    strain = Strains(clamped.problem, clamped.plate, reference).under(LAW, b"", lambda: change)
    found = strain(np.full(len(F_HZ), softened), np.full(len(F_HZ), gained)) * reference.strain
    expected = exact(clamped.plate, softened, change, gained)
    np.testing.assert_allclose(found, expected, rtol=2e-2)
    without = strain(np.full(len(F_HZ), softened)).max() * reference.strain
    if gained:
        assert abs(found.max() - expected.max()) < 0.05 * abs(without - expected.max())


@pytest.mark.parametrize("softened", [-300.0, 300.0])
def test_a_step_far_beyond_what_a_core_does_has_a_strain_above_zero_and_spoils_no_other(clamped, softened):
    strain = Strains(clamped.problem, clamped.plate, Reference()).under(LAW, b"", Change)
    usual = strain(np.full(len(F_HZ), 0.1))
    far = strain(np.full(len(F_HZ), softened))
    assert ((far > 0) & np.isfinite(far)).all()
    np.testing.assert_array_equal(strain(np.full(len(F_HZ), 0.1)), usual)


def test_strain_a_step_further_over_a_sharp_resonance_is_what_the_changed_plate_has(clamped):
    up, down = (with_mass(clamped.plate, MASS + s * STEP) for s in (1, -1))
    strains = Strains(clamped.problem, clamped.plate, Reference())
    softened = np.full(len(F_HZ), 0.1)
    here = (LAW, b"", lambda: with_mass(clamped.plate, MASS))
    moved = strains.along(*here, lambda core: core.by((up, down, 2 * STEP[0]))[None])
    found = STEP[0] * moved(softened, None)[0]
    expected = np.log(exact(clamped.plate, 0.1, up) / exact(clamped.plate, 0.1, down)) / 2
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()


def parts(clamped, *names):
    effects = [CATALOGUE[name] for name in names]
    unknowns = Unknowns(0, effects)
    changes = PlateChanges(clamped.problem, unknowns, clamped.plate)
    spans = [span for effect in effects for span in effect.spans]
    return changes, PointModulus(clamped.problem, unknowns, changes, spans, Reference())


def test_only_effects_that_change_a_plate_do_and_only_those_that_shift_a_modulus(clamped):
    changes, modulus = parts(clamped, "added_mass", "amplitude_softening", "gain_error")
    assert (changes.effects, modulus.effects, modulus.strained) == ([0], [1], True)
    u = np.array([*MASS, 0.0, 1.0])
    expected = with_mass(clamped.plate, MASS)
    np.testing.assert_array_equal(changes.every(u).M, expected.M)
    assert changes.key(u) == changes.key(u + np.array([0, 0, 0, 0.1, 0.1]))
    assert changes.key(u) != changes.key(u + np.array([1e-3, 0, 0, 0, 0]))
    assert changes.stated(u) == []
    at_rest = parts(SimpleNamespace(problem=struck(clamped.problem), plate=clamped.plate), "added_mass")[0]
    assert np.all(at_rest.every(MASS).load == 0)
    assert np.any(expected.load != 0)


def struck(problem):
    return replace(problem, points=replace(problem.points, drive="force"))


def test_a_softened_modulus_is_below_the_law_s_where_strain_is_largest_and_moves_with_the_law(clamped):
    _, modulus = parts(clamped, "amplitude_softening")
    k = np.array([0.1])
    assert modulus.of_law(LAW) is modulus.of_law(LAW)
    np.testing.assert_array_equal(modulus.at(LAW, 0 * k), LAW.modulus(OMEGA))
    share = (modulus.at(LAW, k) / LAW.modulus(OMEGA)).real
    strain = exact(clamped.plate, 0.0, Change())
    # Told for 1 g, and driven at 1 m/s^2.
    assert share.min() == pytest.approx(1 - 0.1 / 9.81, abs=5e-4)
    assert abs(F_HZ[share.argmin()] - F_HZ[strain.argmax()]) < 0.5


def moved(law, n, h=1e-3):
    return law.with_values(law.values * np.exp(h * (np.arange(len(law.values)) == n)))


@pytest.mark.parametrize("n", [0, 1])
def test_strain_under_a_law_a_step_away_is_what_the_plate_has_with_it(clamped, n):
    strains = Strains(clamped.problem, clamped.plate, Reference())
    softened, gained = np.full(len(F_HZ), 0.1), np.full(len(F_HZ), 0.1)
    other, at_nodes = moved(LAW, n), clamped.problem.dense.omega
    along = strains.along(LAW, b"", Change, strains.of_laws([other.modulus(at_nodes)]))
    found = along(softened, gained)[0]
    each = []
    for law in (other, LAW):
        G = law.modulus(OMEGA)
        softer = G * 0.9 + 0.1j * np.sqrt(G.real * G.imag)
        each.append(StrainedCore(clamped.plate, OMEGA, softer, Change()).strain)
    expected = np.log(each[0] / each[1])
    assert np.abs(expected).max() > 1e-4
    assert np.abs(found - expected).max() < 0.06 * np.abs(expected).max()


@pytest.mark.parametrize(
    ("largest", "lost", "most_off"),
    [(0.02, 0.1, 0.01), pytest.param(0.006, 0.3, 0.045, id="a third of it lost and more")],
)
@pytest.mark.parametrize("names", [("k",), ("k", "loss"), ("k", "saturation", "kept")])
def test_derivatives_of_a_softened_core_are_those_of_differences(told, names, largest, lost, most_off):
    effect = next(
        e for e in CATALOGUE["amplitude_softening"].variants() if tuple(q.key for q in e.parameters) == names
    )
    own = {"k": 0.2, "saturation": 0.5, "loss": 0.1, "kept": 0.4}
    z = np.full(len(told.nuisances), 0.3)
    plain, response = SweepResponse(told, []), SweepResponse(told, [effect], reference=Reference(largest))
    u = np.array([*z, *(own[name] for name in names)])
    softened = np.abs(plain.velocity(LAW, z) / response.velocity(LAW, u) - 1)
    assert softened.max() > lost
    of_law, of_numbers = off_differences(response, u, [1e-3] * len(z) + [1e-4] * len(names))
    assert of_law.max() < most_off
    assert of_numbers[len(z) :].max() < 1e-4
    # Of so coarse a plate some stated numbers are followed roughly, softened or not.
    _, without = off_differences(plain, z, [1e-3] * len(z))
    assert (of_numbers[: len(z)] < without + most_off).all()


def off_differences(response, u, steps):
    """Of derivatives to the law's numbers and to others, relative to the derivative's size."""
    v, by = response.with_derivatives(LAW, u)
    h, expected = 1e-4, []
    for n in range(len(LAW.values)):
        up, down = (response.velocity(moved(LAW, n, s * h), u) for s in (1, -1))
        expected.append((up - down) / (2 * h))
    for one in np.diag(steps):
        up, down = (response.velocity(LAW, u + s * one) for s in (1, -1))
        expected.append((up - down) / (2 * one.sum()))
    size = np.linalg.norm(np.array(expected) / v, axis=1)
    off = np.linalg.norm((by - expected) / v, axis=1) / np.maximum(size, 1e-6)
    return off[: len(LAW.values)], off[len(LAW.values) :]


def test_a_pair_of_low_loss_softens_at_its_resonance_as_the_wave_in_its_pads_has_it():
    law = shear_pair_cases.LAW.with_values(np.array([1.1e6, 8.8e6, 1e-6, 0.6]))
    pair = shear_pair_cases.pair(0.2533, exact=True)
    pair = replace(pair, core=replace(pair.core, law=law))
    still = shear_pair_cases.sweep(pair, noise=0.0)
    moved = np.abs(still.velocity_m_s - still.commanded_m_s2 / (1j * still.omega)) / still.omega
    per_strain = 2.0
    soft = shear_pair_cases.sweep(pair, noise=0.0, softening=per_strain)
    effect = next(
        e for e in CATALOGUE["amplitude_softening"].on("shear-pair").variants() if len(e.parameters) == 1
    )
    k = per_strain * moved.max() / pair.core.thickness_m * PUBLISHED_G_M_S2 / shear_pair_cases.G_0
    found = response_of(SmallProblem.of_small(soft, pair), [effect]).velocity(law, np.array([k]))
    # It moves the readings by as much as they are.
    assert np.abs(still.velocity_m_s / soft.velocity_m_s - 1).max() > 0.3
    np.testing.assert_allclose(found, soft.velocity_m_s, rtol=3e-3)
