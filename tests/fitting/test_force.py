"""Plates driven by a force at a point, and plates whose long edges are not alike, beside full solves."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from driven_plate import F_HZ, OMEGA, Driven

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_answer import StrainedCore
from fitting.diagnosis.response.strains import Reference, Strains
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.search.candidates import CandidateFit
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.one_plate import plates_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.several.several_response import SeveralResponse
from fitting.dynamics.direct import displacement_direct
from fitting.effects import CATALOGUE
from fitting.errors import OutsideModel
from fitting.identification.model import SweepModel
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import tolerance
from fitting.reduced.rational import rational_sweep, rational_sweeps
from fitting.sweep import Sweep
from fitting.widened.change import Change

FORCE_M, OTHER_FORCE_M = (0.27, 0.03), (0.271, 0.0305)
FURTHER_FORCE_M, FURTHER_SPOT_M = (0.04, 0.16), (0.22, 0.17)
MASS = np.array([5e-3, 0.12, 0.16])


@pytest.fixture(scope="module")
def coarse(zn1):
    """Of a mesh that gives both sides of every comparison alike: coarser still than the paper's."""
    return replace(zn1, elements=(8, 6))


@pytest.fixture(scope="module")
def free(coarse):
    return Driven(replace(coarse, boundary="free", force_m=FORCE_M, exact=False))


def test_a_struck_free_plate_is_reduced_to_what_it_is(free):
    assert free.plate.rigid.shape[1] == 6
    np.testing.assert_allclose(free.reduced.displacement(OMEGA, free.G), free.full(), rtol=1e-6)
    assert free.reduced.estimated_error(OMEGA, free.G).max() < 1e-4


def test_force_and_pickup_may_change_places(free):
    s = replace(free.specimen, force_m=free.specimen.pickup_m, pickup_m=FORCE_M)
    there = displacement_direct(Plate(s), free.damping, OMEGA, free.G)
    np.testing.assert_allclose(there, free.full(), rtol=1e-8)


def test_slow_pushes_move_a_free_plate_as_a_rigid_body(free):
    s, f = free.specimen, np.array([0.5])
    slow = displacement_direct(free.plate, free.damping, 2 * np.pi * f, free.law.modulus(2 * np.pi * f))[0]
    layers = (s.substrate, s.core, s.constraining)
    mass = s.length_m * s.width_m * sum(x.density_kg_m3 * x.thickness_m for x in layers)
    lever = 1.0
    for side, a, b in ((s.length_m, s.force_m[0], s.pickup_m[0]), (s.width_m, s.force_m[1], s.pickup_m[1])):
        # Turns about the middle, the radius of gyration side / sqrt(12).
        lever += 12 * (a - side / 2) * (b - side / 2) / side**2
    assert slow.real == pytest.approx(-lever / (mass * (2 * np.pi * f[0]) ** 2), rel=2e-3)


def test_a_mass_on_a_struck_plate_is_no_load(free):
    mass = CATALOGUE["added_mass"]
    u = np.concatenate([np.zeros(len(free.response([]).nuisances)), MASS])
    v = free.response([mass]).velocity(free.law, u)
    np.testing.assert_allclose(v, 1j * OMEGA * free.full(MASS[0], MASS[1:]), rtol=5e-4)
    assert np.abs(free.full(MASS[0], MASS[1:]) / free.full() - 1).max() > 0.03


def test_the_point_of_the_force_is_a_stated_number(free):
    response = free.response([CATALOGUE["added_mass"]])
    names = [n.name for n in response.nuisances.each]
    assert {"force_x", "force_y"} < set(names)
    u = np.concatenate([np.zeros(len(names)), MASS])
    moved = u.copy()
    for axis, (a, b) in enumerate(zip(FORCE_M, OTHER_FORCE_M, strict=True)):
        moved[names.index(f"force_{'xy'[axis]}")] = (b - a) / tolerance(free.specimen, "force")
    other = replace(free.specimen, force_m=OTHER_FORCE_M)
    expected = displacement_direct(Plate(other), free.damping, OMEGA, free.G)
    plain = free.response([])
    found = plain.velocity(free.law, moved[: len(names)]) / (1j * OMEGA)
    np.testing.assert_allclose(found, expected, rtol=1e-4)
    _, by = response.with_derivatives(free.law, moved)
    for k in range(len(u)):
        h = 1e-3 if k < len(names) else 1e-3 * MASS[k - len(names)]
        up, down = (response.velocity(free.law, moved + s * h * (np.arange(len(u)) == k)) for s in (1, -1))
        difference = (up - down) / (2 * h)
        size = max(np.abs(difference).max(), 1e-6 * np.abs(up).max())
        np.testing.assert_allclose(by[len(free.law.names) + k], difference, atol=5e-3 * size)


PAIRS = [(FORCE_M, 0), (FORCE_M, 1), (FURTHER_FORCE_M, 0), (FURTHER_FORCE_M, 1)]
"""Force, and number of the spot."""


class Spots:
    """A free plate struck at two points and read at two: one model."""

    def __init__(self, specimen):
        further = (FURTHER_SPOT_M, FURTHER_FORCE_M)
        self.driven = Driven(replace(specimen, boundary="free", force_m=FORCE_M, further_pickups_m=further))
        self.specimens = [
            replace(self.driven.specimen.at_pickup(k), force_m=force, exact=False) for force, k in PAIRS
        ]
        self.law, self.G = self.driven.law, self.driven.G
        sweeps = rational_sweeps(self.driven.reduced, OMEGA)
        sides = [(0 if force == FORCE_M else 3, 1 + k) for force, k in PAIRS]
        self.reduced = [self.driven.reduced.between(*side) for side in sides]
        self.rational = [sweeps.of(*side) for side in sides]

    def members(self):
        def member(specimen, reduced):
            ones = np.ones(len(OMEGA))
            sweep = Sweep(F_HZ, ones + 0j, ones, np.ones(len(OMEGA), int), np.ones(len(OMEGA), int))
            plate = self.driven.widened.at(specimen.force_m, specimen.pickup_m)
            return DiagnosisProblem.of(sweep, specimen, plate, lambda omega: rational_sweep(reduced, omega))

        return [member(s, reduced) for s, reduced in zip(self.specimens, self.reduced, strict=True)]

    def several(self):
        files = [Place(1, 0), Place(1, 1), Place(2, 0), Place(2, 1)]
        return SeveralProblem.of_members(self.members(), self.reduced, files)


@pytest.fixture(scope="module")
def spots(coarse):
    return Spots(coarse)


def test_one_basis_serves_every_force_and_spot(spots):
    for specimen, reduced, rational in zip(spots.specimens, spots.reduced, spots.rational, strict=True):
        full = displacement_direct(Plate(specimen), spots.driven.damping, OMEGA, spots.G)
        np.testing.assert_allclose(reduced.displacement(OMEGA, spots.G), full, rtol=1e-6)
        np.testing.assert_allclose(rational.displacement(spots.G), full, rtol=1e-6)
        assert reduced.estimated_error(OMEGA, spots.G).max() < 1e-4


def test_members_of_one_plate_share_its_matrices_condensed_or_not(spots):
    problem = spots.several()
    assert problem.plates == plates_of(problem.members) == (0, 0, 0, 0)
    condensed = problem.condensed(spots.law)
    for some in (problem, condensed):
        assert len({id(m.plate.matrices) for m in some.members}) == 1
        assert len({m.plate.observe.tobytes() for m in some.members}) == 2
        assert len({m.plate.load.tobytes() for m in some.members}) == 2
    assert len(condensed.members[0].plate.group) < len(problem.members[0].plate.group)


def test_another_process_is_sent_one_plate_and_makes_the_rest_itself(spots):
    problem = spots.several().condensed(spots.law)
    fit = CandidateFit(problem, None, SimpleNamespace(effects=()), CATALOGUE["added_mass"])
    plain = len(pickle.dumps(fit))
    assert fit._response.problem is problem
    assert len(pickle.dumps(fit)) == plain
    assert plain < 1.2 * len(pickle.dumps(problem.members[0]))
    there = pickle.loads(pickle.dumps(problem))
    assert len({id(m.plate.matrices) for m in there.members}) == 1


def test_what_is_of_a_struck_plate_itself_is_one_number_and_what_is_of_a_spot_several(spots):
    names = [n.name for n in spots.several().nuisances.each]
    assert {
        "length",
        "width",
        "force_x [1]",
        "force_x [2]",
        "gain [1, pickup 0]",
        "gain [2, pickup 1]",
    } < set(names)
    assert not {n for n in names if n.startswith(("length [", "width [", "damping_1 ["))}


def test_members_solved_together_read_what_each_reads_alone(spots):
    mass = CATALOGUE["added_mass"]
    problem = spots.several().condensed(spots.law).around(spots.law)
    together = SeveralResponse(problem, [mass])
    z = 0.5 * np.random.default_rng(2).standard_normal(len(problem.nuisances))
    u = np.concatenate([z, MASS])
    v, by = together.with_derivatives(spots.law, u)
    n = len(spots.law.names)
    for k, (m, part) in enumerate(zip(problem.members, problem.starts_at, strict=True)):
        alone = SweepResponse(m, [mass])
        expected, derivatives = alone.with_derivatives(
            spots.law, np.concatenate([z[problem.places[k]], MASS])
        )
        np.testing.assert_allclose(v[part], expected, rtol=1e-8)
        at = np.concatenate([np.arange(n), n + problem.places[k], n + len(z) + np.arange(3)])
        size = np.abs(derivatives).max(axis=1, keepdims=True)
        np.testing.assert_allclose((by[at][:, part] / size).real, (derivatives / size).real, atol=1e-6)
    direct = spots.driven.full(MASS[0], MASS[1:])
    u[: len(z)] = 0.0
    found = together.velocity(spots.law, u)[problem.starts_at[0]]
    np.testing.assert_allclose(found, 1j * OMEGA * direct, rtol=2e-3)


def test_one_matrix_is_solved_once_for_all_that_drives_and_reads_it(spots, monkeypatch):
    problem = spots.several().condensed(spots.law).around(spots.law)
    together = SeveralResponse(problem, [CATALOGUE["added_mass"]])
    solved = []
    solve = np.linalg.solve

    def counted(A, b):
        solved.append(b.shape)
        return solve(A, b)

    monkeypatch.setattr(np.linalg, "solve", counted)
    together.velocity(spots.law, np.concatenate([np.zeros(len(problem.nuisances)), MASS]))
    # Two forces and two spots, at every node.
    assert [shape for shape in solved if shape[-1] == 4] == [(len(OMEGA), solved[0][1], 4)]


def test_a_core_softens_with_what_a_force_strains_it(free):
    """At the softened modulus the plate is strained by so much that this is its softened modulus."""
    softening, k = CATALOGUE["amplitude_softening"], 0.04
    forces = np.array([1.0, 2.0, 3.0, 1.0, 2.0])
    response = free.response([softening], forces + 0j)
    assert softening.objection(response.problem.points, response.plate) is None
    u = np.append(np.zeros(len(response.nuisances)), k)
    v = response.velocity(free.law, u)

    def strain(G):
        return StrainedCore(free.widened, OMEGA, G, Change()).strain

    reference = strain(free.G).max()
    softened = np.zeros(len(forces))
    for _ in range(80):
        softened = 0.5 * (softened + k * strain(free.G * (1 - softened)) * forces / reference)
    assert softened.max() > 0.05
    expected = 1j * OMEGA * free.reduced.displacement(OMEGA, free.G * (1 - softened))
    np.testing.assert_allclose(v, expected, rtol=2e-3)


def test_strain_is_told_over_the_largest_at_a_newton_and_goes_with_the_force(free):
    forces, reference = np.array([1.0, 2.0, 3.0, 1.0, 2.0]), Reference()
    response = free.response([CATALOGUE["amplitude_softening"]], forces + 0j)
    strains = Strains(response.problem, response.plate, reference)
    at = strains.under(free.law, b"", Change)(np.zeros(len(forces)))
    assert (at / forces).max() == pytest.approx(1.0, rel=1e-6)
    largest = StrainedCore(free.widened, OMEGA, free.G, Change()).strain.max()
    assert reference.strain == pytest.approx(largest, rel=1e-6)


@pytest.mark.parametrize("of", range(3), ids=["mass", "x", "y"])
def test_a_derivative_of_the_strain_is_what_a_small_change_makes_of_it(free, of):
    step = np.zeros(3)
    step[of] = 1e-4 * MASS[of]

    def change(times):
        return CATALOGUE["added_mass"].change(free.widened, MASS + times * step)

    def strain(times):
        return StrainedCore(free.widened, OMEGA, free.G, change(times)).strain

    by = StrainedCore(free.widened, OMEGA, free.G, change(0)).by((change(1), change(-1), 2 * step[of]))
    expected = np.log(strain(1) / strain(-1)) / (2 * step[of])
    np.testing.assert_allclose(by, expected, rtol=1e-4)


def test_strain_a_step_further_is_what_the_changed_plate_has(free):
    response = free.response([CATALOGUE["amplitude_softening"]], np.array([1.0, 2.0, 3.0, 1.0, 2.0]) + 0j)
    strains = Strains(response.problem, response.plate, Reference())
    softened, h = np.array([0.0, 0.1, 0.2, 0.3, 0.4]), 1e-3 * MASS[0]

    def change(mass_kg):
        return lambda: CATALOGUE["added_mass"].change(response.plate, np.array([mass_kg, *MASS[1:]]))

    nearby = change(MASS[0] + h)(), change(MASS[0] - h)(), 2 * h
    here = strains.under(free.law, b"here", change(MASS[0]))(softened)
    there = strains.under(free.law, b"there", change(MASS[0] + h))(softened)
    moved = strains.along(free.law, b"here", change(MASS[0]), lambda core: core.by(nearby)[None])
    np.testing.assert_allclose(h * moved(softened, None)[0], there / here - 1, rtol=2e-2)


@pytest.mark.parametrize(("force_n", "why"), [(None, "how large"), (np.full(5, 2.0 + 0j), "one size")])
def test_softening_is_not_judged_from_one_size_of_the_force(free, force_n, why):
    points = free.response([], force_n).problem.points
    assert why in CATALOGUE["amplitude_softening"].objection(points, free.widened)


@pytest.mark.parametrize("force_m", [None, FORCE_M])
def test_long_edges_that_are_not_alike(coarse, force_m):
    driven = Driven(replace(coarse, boundary="clamped-clamped-free-free", force_m=force_m))
    np.testing.assert_allclose(driven.reduced.displacement(OMEGA, driven.G), driven.full(), rtol=1e-6)
    mass = CATALOGUE["added_mass"]
    v = driven.response([mass]).velocity(driven.law, MASS)
    np.testing.assert_allclose(v, 1j * OMEGA * driven.full(MASS[0], MASS[1:]), rtol=5e-4)


def test_effects_stand_where_there_is_what_they_need(coarse):
    struck = replace(coarse, force_m=FORCE_M)
    free = replace(struck, boundary="free")
    plates = {"coarse": coarse, "struck": struck, "free": free}
    names = {k: {n for n, e in CATALOGUE.items() if e.standing_on(s)} for k, s in plates.items()}
    base = {"absolute_velocity", "base_rocking", "base_roll", "fixture_resonance"}
    clamp = {"clamp_compliance", "clamp_friction", "clamp_line", "uneven_clamp", "treatment_not_gripped"}
    elsewhere = {
        "fixture_transfer",
        "exponential_window",
        "outside_damping",
        "sensor_mounting",
        "axial_stress",
    }
    assert names["coarse"] == set(CATALOGUE) - elsewhere
    assert names["struck"] - names["coarse"] == {"exponential_window"}
    assert names["coarse"] - names["struck"] == base | {"level_error"}
    assert names["struck"] - names["free"] == clamp
    assert {"added_mass", "spot_offset", "gain_error", "channel_delay", "air_added_mass"} < names["free"]


def test_a_force_on_a_held_edge_moves_nothing(coarse):
    with pytest.raises(OutsideModel, match="held edge"):
        _ = Plate(replace(coarse, force_m=(0.0, 0.1))).load


@pytest.fixture(scope="module")
def shaken(coarse):
    return Driven(replace(coarse, exact=False, reads="absolute"))


def test_a_base_and_a_force_drive_one_plate_in_one_task(shaken, free):
    responses = [shaken.response([]), free.response([])]
    problem = SeveralProblem.of_members([r.problem for r in responses], [shaken.reduced, free.reduced])
    z = 0.5 * np.random.default_rng(4).standard_normal(len(problem.nuisances))
    found = SeveralResponse(problem, []).velocity(shaken.law, z)
    for r, at, part in zip(responses, problem.places, problem.starts_at, strict=True):
        np.testing.assert_allclose(found[part], r.velocity(shaken.law, z[at]), rtol=1e-8)
    # As stated the first fit, of the law alone, reads the same.
    points = problem.points
    model = SweepModel(problem.rational, np.arange(10), np.ones(10), points.reads, points.at_rest)
    expected = SeveralResponse(problem, []).velocity(shaken.law, 0 * z)
    np.testing.assert_allclose(model.velocity(shaken.law), expected, rtol=1e-8)
    few = np.array([1, 7])
    np.testing.assert_allclose(model.take(few).velocity(shaken.law), expected[few], rtol=1e-8)
    names = {n.name for n in problem.nuisances.each}
    assert {"core_thickness", "length [1]", "length [2]", "gain [1]", "gain [2]", "force_x [2]"} < names
