"""Plates driven by a force at a point, and plates whose long edges are not alike, beside full solves."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from fitting.damping import viscous_damping
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.diagnosis.response import SweepResponse
from fitting.direct import displacement_direct, solve_direct
from fitting.domain import domain_of
from fitting.effects import CATALOGUE
from fitting.effects.added_mass import PointMass
from fitting.effects.enriching import enriched
from fitting.effects.full_plate import FullPlate
from fitting.errors import OutsideModel
from fitting.plate import Plate
from fitting.rational import rational_sweep
from fitting.reduced import reduce_plate
from fitting.sweep import Sweep
from fitting.tolerances import tolerance

F_HZ = np.array([31.0, 58.0, 104.0, 161.0, 247.0])
OMEGA = 2 * np.pi * F_HZ
FORCE_M, OTHER_FORCE_M = (0.27, 0.03), (0.271, 0.0305)
MASS = np.array([5e-3, 0.12, 0.16])


class Driven:
    """A plate reduced and widened for a mass."""

    def __init__(self, specimen):
        self.specimen, self.plate = specimen, Plate(specimen)
        self.damping = viscous_damping(self.plate)
        self.reduced = reduce_plate(self.plate, self.damping, domain_of(specimen, F_HZ))
        full = FullPlate(self.plate, self.damping)
        self.widened = enriched(full, self.plate.carried @ self.reduced.V, [PointMass()])
        self.law = specimen.core.law
        self.G = self.law.modulus(OMEGA)

    def full(self, mass_kg=0.0, at=(0.1, 0.1)):
        row = self.plate.observe(*at)
        load = self.plate.load - (mass_kg * row if self.specimen.drive == "base" else 0.0)
        added = sp.csc_array(mass_kg * np.outer(row, row))
        return np.array(
            [
                self.plate.pickup
                @ solve_direct(
                    sp.csc_array(self.plate.dynamic_stiffness(w, g) - w**2 * added),
                    w,
                    self.damping,
                    load[:, None],
                )[:, 0]
                for w, g in zip(OMEGA, self.G, strict=True)
            ]
        )

    def response(self, effects):
        ones = np.ones(len(OMEGA))
        sweep = Sweep(F_HZ, ones + 0j, ones, np.arange(len(OMEGA)), np.ones(len(OMEGA), int))
        problem = DiagnosisProblem.of(
            sweep, self.specimen, self.widened, lambda omega: rational_sweep(self.reduced, omega)
        )
        return SweepResponse(problem.around(self.law), effects)


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
    assert names["coarse"] == set(CATALOGUE)
    assert names["coarse"] - names["struck"] == base | {"level_error", "amplitude_softening"}
    assert names["struck"] - names["free"] == clamp
    assert {"added_mass", "spot_offset", "gain_error", "channel_delay", "air_added_mass"} < names["free"]


def test_a_force_on_a_held_edge_moves_nothing(coarse):
    with pytest.raises(OutsideModel, match="held edge"):
        _ = Plate(replace(coarse, force_m=(0.0, 0.1))).load
