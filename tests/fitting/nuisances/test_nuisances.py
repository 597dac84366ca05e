"""A reduced plate with its stated numbers moved, beside plates built anew; derivatives beside differences."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_answer import answer
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.nuisances.moved_plate import moved_plate
from fitting.nuisances.nuisances import nuisances_of
from fitting.plate.mesh import Mesh
from fitting.plate.parts import coefficients
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import tolerance
from fitting.reduced.domain import domain_of
from fitting.reduced.rational import rational_sweep
from fitting.reduced.reduced_plate import reduce_plate
from fitting.stated.tolerances import OF_FEW, PLATE, STATED
from fitting.sweep import Sweep
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep

OMEGA = 2 * np.pi * np.array([19.5, 62.0, 100.0, 281.0])
G = np.array([0.3e6 * (1 + 0.3j), 0.45e6 * (1 + 0.6j), 0.55e6 * (1 + 0.9j), 1.2e6 * (1 + 1.1j)])
CHANNELS = ("gain", "delay", "phase")


class Moved:
    """A plate reduced as stated, its stated numbers free to move."""

    def __init__(self, specimen):
        self.specimen = specimen
        self.plate = Plate(specimen)
        self.damping = viscous_damping(self.plate)
        reduced = reduce_plate(self.plate, self.damping, domain_of(specimen, np.array([14.0, 300.0])))
        self.reduced = reduced
        mesh = Mesh(specimen.length_m, specimen.width_m, *specimen.mesh)
        plain = EnrichedReducedPlate.plain(reduced, mesh, specimen.pickup_m)
        U, d = np.zeros((len(reduced.load), len(specimen.modal_ratios))), np.zeros(len(specimen.modal_ratios))
        U[:, reduced.mode], d[reduced.mode] = reduced.U, reduced.d
        self.spanned = replace(plain, U=U, d=d)
        self.nuisances = nuisances_of(specimen, self.spanned, has_phase=True)

    def places(self, *, without=CHANNELS):
        """A few draws within two or three tolerances of all together."""
        held = [k for k, n in enumerate(self.nuisances.each) if n.kind in without]
        for seed in range(4):
            z = 1.5 * np.random.default_rng(seed).normal(size=len(self.nuisances))
            z[held] = 0.0
            yield z

    def answer(self, z, **how):
        change = self.nuisances.change(self.spanned, z)
        return answer(self.spanned, OMEGA, G, change, [], with_pitch=False, **how)

    def anew(self, z):
        by = dict(zip([n.name for n in self.nuisances.each], z, strict=True))
        spot = tolerance(self.specimen, "pickup")
        x, y = self.specimen.pickup_m
        pickup = x + spot * by["pickup_x"], y + spot * by["pickup_y"]
        plate = Plate(replace(self.nuisances.moved_specimen(z), pickup_m=pickup))
        d = [
            d * np.exp(tolerance(self.specimen, "damping") * by.get(f"damping_{r + 1}", 0.0))
            for r, d in zip(self.damping.mode, self.damping.d, strict=True)
        ]
        return displacement_direct(plate, replace(self.damping, d=np.array(d)), OMEGA, G)


@pytest.fixture(scope="module", params=["as published", "lossy and on its side", "between clamps"])
def moved(request, zn1):
    plain = replace(zn1, exact=False, elements=(10, 8))
    if request.param == "as published":
        return Moved(plain)
    if request.param == "between clamps":
        return Moved(replace(plain, boundary="-".join(["clamped"] * 4)))
    faces = {name: replace(getattr(plain, name), loss_factor=0.01) for name in ("substrate", "constraining")}
    return Moved(replace(plain, **faces, length_m=0.18, width_m=0.24, elements=(8, 10), pickup_m=(0.15, 0.1)))


def test_the_moved_plate_answers_as_one_built_anew(moved):
    stated, off = moved.anew(np.zeros(len(moved.nuisances))), []
    for z in moved.places():
        found, expected = moved.answer(z).heave.value, moved.anew(z)
        np.testing.assert_allclose(found, expected, rtol=1e-4)
        off.append(np.abs(expected / stated - 1).max())
    assert max(off) > 0.02


@pytest.mark.parametrize("name", [n for n in PLATE if n not in OF_FEW])
def test_each_stated_number_moves_the_plate_as_one_built_anew(moved, name):
    its = [k for k, n in enumerate(moved.nuisances.each) if n.kind == name]
    # Only clamps on opposite edges pull.
    assert len(its) == (len(moved.specimen.pulled_along) if name == "axial" else 1)
    for k, by in product(its, (-3.0, 3.0)):
        z = by * np.eye(len(moved.nuisances))[k]
        # What free edges lack in twist is none of the parts that move: of 1.5 % in thickness it misses 5 %.
        np.testing.assert_allclose(moved.answer(z).heave.value, moved.anew(z), rtol=2e-4)


@pytest.mark.parametrize(("share", "tolerance"), [(0.0, 1e-5), (1.0, 0.02)])
def test_derivatives_agree_with_differences(moved, share, tolerance):
    """Exact as stated, and elsewhere as good as a sweep's fit needs."""
    z = share * next(moved.places())
    z[[k for k, n in enumerate(moved.nuisances.each) if n.kind in CHANNELS]] = 0.0
    by, h = moved.answer(z, nuisances=(moved.nuisances, z)).heave.by_z, 1e-3
    size = np.abs(moved.answer(z).heave.value)
    for k, n in enumerate(moved.nuisances.each):
        step = h * np.eye(len(z))[k]
        difference = (moved.answer(z + step).heave.value - moved.answer(z - step).heave.value) / (2 * h)
        if n.kind in CHANNELS:
            assert not by[k].any()
            continue
        allowed = 1e-6 + tolerance * np.abs(difference / size).max()
        np.testing.assert_allclose(by[k] / size, difference / size, atol=allowed, err_msg=n.name)


def test_the_bare_plate_is_that_of_the_moved_specimen_its_free_length_as_stated(moved):
    nuisances, mounting = moved.nuisances, ("length", "axial")
    for z in [*moved.places(), *moved.places()]:  # the second time as they were kept
        K_0, M = nuisances.bare_coefficients(z)
        bare = nuisances.moved_specimen(
            [0 if n.kind in mounting else z[k] for k, n in enumerate(nuisances.each)]
        )
        expected = coefficients(bare.bare, moved.specimen.bare)
        assert_array_equal(K_0, expected.K_0)
        assert_array_equal(M, expected.M)


@pytest.mark.parametrize("share", [1.0, 3.0])
def test_derivatives_at_the_very_place_are_exact(moved, share):
    z, h, of = share * next(moved.places()), 1e-3, moved.nuisances.of_parts
    for by, step in zip(of.by_there(z), h * np.eye(len(z)), strict=True):
        difference = (of.change(z + step) - of.change(z - step)) / (2 * h)
        np.testing.assert_allclose(by, difference, atol=1e-4 * np.abs(difference).max())


def test_a_reduced_plate_is_moved_as_the_widened_one(moved):
    z = next(moved.places())
    again = moved_plate(moved.reduced, moved.nuisances, moved.spanned, z)
    np.testing.assert_allclose(again.displacement(OMEGA, G), moved.answer(z).heave.value, rtol=1e-9)
    same = moved_plate(moved.reduced, moved.nuisances, moved.spanned, 0 * z)
    np.testing.assert_allclose(same.displacement(OMEGA, G), moved.reduced.displacement(OMEGA, G), rtol=1e-9)


def test_as_stated_nothing_is_changed(moved):
    z = np.zeros(len(moved.nuisances))
    plain = answer(moved.spanned, OMEGA, G, Change(), [], with_pitch=False)
    np.testing.assert_allclose(moved.answer(z).heave.value, plain.heave.value, rtol=1e-12)
    np.testing.assert_allclose(plain.heave.value, moved.reduced.displacement(OMEGA, G), rtol=1e-9)


def test_the_reading_has_gain_delay_and_phase(moved):
    nuisances, omega = moved.nuisances, OMEGA
    z = next(moved.places(without=()))
    by = dict(zip([n.name for n in nuisances.each], z, strict=True))
    gain, delay, phase = (by[name] * tolerance(moved.specimen, name) for name in CHANNELS)
    v = np.array([1.0, 2j, -1 + 1j, 0.5])
    read = nuisances.reading(v, omega, z)
    np.testing.assert_allclose(read, v * (1 + gain) * np.exp(1j * (phase - omega * delay)), rtol=1e-12)
    for k, d in nuisances.by_reading(read, omega, z).items():
        step = 1e-3 * np.eye(len(z))[k]
        up, down = (nuisances.reading(v, omega, z + s * step) for s in (1, -1))
        np.testing.assert_allclose(d, (up - down) / 2e-3, rtol=1e-5)


def test_an_exact_specimen_has_none(moved):
    exact = nuisances_of(replace(moved.specimen, exact=True), moved.spanned, has_phase=True)
    assert len(exact) == 0
    assert not exact


def test_what_is_exact_by_itself_is_left_out(moved):
    stated = replace(moved.specimen, tolerances={"gain": 0.0, "substrate_young": 0.03})
    names = {n.name: n for n in nuisances_of(stated, moved.spanned, has_phase=True).each}
    assert "gain" not in names
    assert names["substrate_young"].sigma == 0.03
    assert names["core_thickness"].sigma == STATED["core_thickness"].typical


def test_without_phase_there_is_no_delay_and_no_angle_and_only_modes_that_move_are_damped(moved):
    with_phase = [n.name for n in moved.nuisances.each]
    without = [n.name for n in nuisances_of(moved.specimen, moved.spanned, has_phase=False).each]
    assert set(with_phase) - set(without) == {"delay", "phase"}
    damped = {n for n in with_phase if n.startswith("damping")}
    assert damped == {f"damping_{r + 1}" for r in moved.reduced.mode}
    assert len(damped) < len(moved.specimen.modal_ratios)


@pytest.fixture(scope="module")
def response(zn1, zn1_models):
    """Of a whole sweep, the plate as published but not exact."""
    return _response_to(synthetic_sweep(zn1).take(np.arange(0, len(GRID_HZ), 6)), zn1, zn1_models)


def _response_to(sweep, zn1, zn1_models):
    specimen = replace(zn1, exact=False)
    mesh = Mesh(specimen.length_m, specimen.width_m, *specimen.mesh)
    reduced = zn1_models.reduced
    plain = EnrichedReducedPlate.plain(reduced, mesh, specimen.pickup_m)
    problem = DiagnosisProblem.of(
        sweep,
        specimen,
        replace(plain, U=_every(reduced), d=_damped(reduced)),
        lambda omega: rational_sweep(reduced, omega),
    )
    law = problem.stated_law
    return SweepResponse(problem.around(law), ()), law, reduced


def _every(reduced):
    U = np.zeros((len(reduced.load), 8))
    U[:, reduced.mode] = reduced.U
    return U


def _damped(reduced):
    d = np.zeros(8)
    d[reduced.mode] = reduced.d
    return d


def test_a_sweeps_derivatives_agree_with_differences(response):
    response, law, _ = response
    _agrees_with_differences(response, law)


def test_derivatives_agree_where_a_sweep_has_more_resonances_than_are_taken_out_together(zn1, zn1_models):
    f = np.arange(14.0, 410.0)
    sweep = Sweep(f, np.ones(len(f), complex), np.ones(len(f)), np.ones(len(f), int), np.ones(len(f), int))
    response, law, _ = _response_to(sweep, zn1, zn1_models)
    _agrees_with_differences(response, law)


def _agrees_with_differences(response, law):
    z = np.round(np.random.default_rng(3).normal(size=len(response.nuisances)))
    v, by = response.with_derivatives(law, z)
    np.testing.assert_allclose(response.velocity(law, z), v, rtol=1e-12)
    own = len(law.names)
    assert len(by) == own + len(z)
    for k in range(len(z)):
        step = 1e-2 * np.eye(len(z))[k]
        difference = (response.velocity(law, z + step) - response.velocity(law, z - step)) / 2e-2
        np.testing.assert_allclose(by[own + k] / np.abs(v), difference / np.abs(v), atol=2e-4)
    logs = np.log(law.values)
    for k in range(own):
        step = 1e-4 * np.eye(own)[k]
        up, down = (response.velocity(law.with_logs(logs + s * step), z) for s in (1, -1))
        np.testing.assert_allclose(by[k] / np.abs(v), (up - down) / 2e-4 / np.abs(v), atol=2e-3)


def test_a_sweep_of_the_moved_plate_is_that_of_the_reduced_one_at_every_point(response):
    """Nodes and poles between them carry the answer to all points."""
    response, law, _ = response
    problem, nuisances = response.problem, response.nuisances
    for seed in range(3):
        z = np.random.default_rng(seed).normal(size=len(nuisances))
        omega = problem.points.omega
        change = nuisances.change(problem.plate, z)
        x = answer(problem.plate, omega, law.modulus(omega), change, [], with_pitch=False)
        expected = 1j * omega * problem.points.drive_amplitude * x.heave.value
        expected = nuisances.reading(expected, omega, z)
        assert np.abs(response.velocity(law, z) / expected - 1).max() < 3e-4
