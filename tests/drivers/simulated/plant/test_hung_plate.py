"""The treated plate struck, hung free or in its clamp, against the plate that is fitted and its mass."""

from dataclasses import replace

import numpy as np
import pytest

from drivers.simulated.plant import effects as e
from drivers.simulated.plant import specimen
from drivers.simulated.plant.bare import StruckPlate
from drivers.simulated.plant.hung_plate import hung_plate, reduced_free_plate, struck_where_it_stands
from drivers.simulated.plant.law import ZN1
from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.solid_plate import PlateStated
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.planning.free_plate import free_specimen
from fitting.plate.plate import Plate
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file

SHEETS = tuple(
    Sheet(layer.thickness_m, layer.young_pa, layer.poisson, layer.density_kg_m3) for layer in specimen.LAYERS
)
PLATE = PlateStated(specimen.LENGTH_M, specimen.WIDTH_M, SHEETS)
MASS_KG = PLATE.length_m * PLATE.width_m * sum(s.thickness_m * s.density_kg_m3 for s in SHEETS)
HIT, READ = (0.285, 0.18), (0.015, 0.02)
F_HZ = np.array([60.0, 90.0, 130.0])


@pytest.fixture(scope="module")
def reduced():
    return reduced_free_plate(PLATE, ZN1, pieces=(2, 2))


NOTHING = e.Effects()


def hung(reduced, effects=NOTHING, hit=HIT, read=READ, law=ZN1):
    return StruckPlate(hit, read, structure=hung_plate(PLATE, reduced, law, effects, hit, read))


def stated(**changes):
    plate = Plate(replace(read_specimen(case_file("specimen.toml")), **changes))
    omega = 2 * np.pi * F_HZ
    x = displacement_direct(plate, viscous_damping(plate), omega, ZN1.modulus(omega))
    return 1j * omega * x


def test_hung_free_it_answers_as_the_plate_that_is_fitted(reduced):
    plate = hung(reduced)
    coarse = free_specimen(read_specimen(case_file("specimen.toml"))).elements
    free = {"boundary": "free", "modal_ratios": (), "elements": coarse}
    theirs = stated(**free, force_m=HIT, pickup_m=READ)
    for f, v in zip(F_HZ, theirs, strict=True):
        assert plate.mobility(f) == pytest.approx(v, rel=0.03)


def test_slowly_it_moves_as_one_and_below_that_it_swings_on_its_threads(reduced):
    middle = PLATE.length_m / 2, PLATE.width_m / 2
    plate = hung(reduced, hit=middle, read=middle)
    f = 6.0
    # A pendulum of 0.8 Hz, and what little the plate bends.
    assert plate.mobility(f) * 2j * np.pi * f * MASS_KG == pytest.approx(1 / (1 - (0.8 / f) ** 2), rel=0.02)
    assert plate.modes(1)[0] == pytest.approx([0.8], rel=1e-3)


@pytest.mark.parametrize(
    ("effects", "more"),
    [
        (e.Effects(added_mass=e.AddedMass(0.02, PLATE.length_m / 2, PLATE.width_m / 2)), 0.02),
        # Two half discs of air as wide as the plate: the order of rho a b min(a, b).
        (e.Effects(air_added_mass=e.AirAddedMass(1.2)), 1.2 * 0.3 * 0.2**2),
    ],
)
def test_what_is_on_it_weighs(reduced, effects, more):
    middle = PLATE.length_m / 2, PLATE.width_m / 2
    plain, heavier = (hung(reduced, one, middle, middle).mobility(6.0) for one in (e.Effects(), effects))
    assert abs(plain / heavier) - 1 == pytest.approx(more / MASS_KG, rel=0.5)


def test_a_stiffer_substrate_rings_higher(reduced):
    f = np.linspace(60.0, 140.0, 401)
    plain, stiffer = hung(reduced), hung(reduced, e.Effects(substrate_stiffness=e.SubstrateStiffness(1.2)))
    # A pole that no blow stirs may lie anywhere: what is seen of it is nothing.
    peaks = [f[np.argmax([abs(p.mobility(x)) for x in f])] for p in (plain, stiffer)]
    assert 1.01 < peaks[1] / peaks[0] < np.sqrt(1.2)


def test_loose_all_over_it_has_the_core_of_a_law_as_much_softer():
    everywhere, softer = e.PartialDebond("y", 0.0, PLATE.width_m), ZN1.scaled(e.LOOSE)
    loose = reduced_free_plate(PLATE, ZN1, pieces=(1, 1), loose=everywhere)
    theirs = hung(reduced_free_plate(PLATE, softer, pieces=(1, 1)), law=softer)
    for f in F_HZ:
        assert hung(loose).mobility(f) == pytest.approx(theirs.mobility(f), rel=1e-4)


def test_a_strip_that_came_loose_lets_it_ring_lower(reduced):
    strip = e.PartialDebond("x", 0.2, PLATE.length_m)
    plates = hung(reduced), hung(reduced_free_plate(PLATE, ZN1, pieces=(1, 1), loose=strip))
    f = np.arange(50.0, 120.0, 1.0)
    whole, loose = (f[np.argmax([abs(plate.mobility(one)) for one in f])] for plate in plates)
    assert 0.7 * whole < loose < 0.97 * whole


def test_in_its_clamp_it_answers_as_the_plate_that_is_fitted():
    hit = (0.285, 0.1)
    row = sandwich(by_hand=e.ByHand(spot_m=hit)).structure.readings[0]
    plate = StruckPlate(hit, hit, structure=struck_where_it_stands(sandwich().structure, ZN1, row))
    theirs = stated(force_m=hit, elements=(10, 8))
    for f, v in zip(F_HZ, theirs, strict=True):
        assert plate.mobility(f) == pytest.approx(v, rel=0.03)
