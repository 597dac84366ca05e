"""A plate built from its numbers, against the shipped plate: a solid of other elements, on another basis."""

import pytest

from drivers.simulated.plant import effects as e
from drivers.simulated.plant import specimen
from drivers.simulated.plant.bare import StruckPlate
from drivers.simulated.plant.built_plate import mounted_plate, really, reduced_plate, struck_plate
from drivers.simulated.plant.law import ZN1
from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plant.solid_plate import PlateStated

SHEETS = tuple(
    Sheet(layer.thickness_m, layer.young_pa, layer.poisson, layer.density_kg_m3) for layer in specimen.LAYERS
)
PLATE = PlateStated(specimen.LENGTH_M, specimen.WIDTH_M, SHEETS)
BARE = PlateStated(specimen.LENGTH_M, specimen.WIDTH_M, SHEETS[:1])
COARSE = (4, 3)
LOW_HZ = (9.0, 16.0, 17.5, 25.0, 60.0, 92.0, 100.0)


@pytest.fixture(scope="module")
def reduced():
    return reduced_plate(PLATE, ZN1, pieces=COARSE)


def mounted(reduced, effects=e.Effects(), by_hand=e.ByHand()):  # noqa: B008
    found = mounted_plate(PLATE, reduced, ZN1, specimen.BARE_MODAL_RATIOS, specimen.SPOT_M, effects, by_hand)
    return ShakenPlate(effects, mounted=found)


def ratio(plant, frequency_hz):
    seen = plant.steady_state(frequency_hz)
    return seen["spot_velocity"] / seen["base_acceleration"]


@pytest.fixture(scope="module")
def built(reduced):
    return mounted(reduced)


@pytest.fixture(scope="module")
def shipped():
    return ShakenPlate()


def test_it_answers_as_the_shipped_plate(built, shipped):
    for f in LOW_HZ:
        assert ratio(built, f) == pytest.approx(ratio(shipped, f), rel=5e-3)


@pytest.mark.parametrize(
    "effects",
    [
        e.Effects(added_mass=e.AddedMass(0.01, 0.25, 0.05)),
        e.Effects(spot_offset=e.SpotOffset(0.004, -0.003)),
        e.Effects(substrate_stiffness=e.SubstrateStiffness(1.05)),
        e.Effects(viscous_damping=e.ViscousDamping(2.0)),
        e.Effects(base_rocking=e.BaseRocking(0.2)),
    ],
)
def test_an_effect_does_to_it_what_it_does_to_the_shipped_plate(reduced, built, shipped, effects):
    ours_with, theirs_with = mounted(reduced, effects), ShakenPlate(effects)
    for f in (16.0, 60.0, 95.0):
        ours, theirs = ratio(ours_with, f) / ratio(built, f), ratio(theirs_with, f) / ratio(shipped, f)
        assert ours - 1 == pytest.approx(theirs - 1, rel=0.03, abs=3e-4)


def test_a_known_mass_and_another_spot_are_as_if_they_were_hidden(reduced):
    mass = e.AddedMass(0.005, 0.2, 0.1)
    by_hand = mounted(reduced, by_hand=e.ByHand(mass=mass, spot_m=(0.2, 0.15)))
    hidden = mounted(reduced, e.Effects(added_mass=mass, spot_offset=e.SpotOffset(0.2 - 0.06, 0.15 - 0.06)))
    assert ratio(by_hand, 40.0) == pytest.approx(ratio(hidden, 40.0), rel=1e-9)


def test_a_thicker_core_is_another_plate():
    thick = really(PLATE, e.Effects(core_thickness=e.CoreThickness(1.1)))
    assert thick.sheets[1].thickness_m == pytest.approx(1.1 * PLATE.sheets[1].thickness_m)
    assert really(PLATE, e.Effects()) is PLATE


@pytest.mark.parametrize("place", [(-0.001, 0.1), (0.1, 0.21)])
def test_a_place_off_the_plate_is_refused(reduced, place):
    with pytest.raises(ValueError, match="off the plate"):
        mounted(reduced, by_hand=e.ByHand(spot_m=place))


def test_the_bare_plate_has_the_shipped_plates_modes():
    reduced = reduced_plate(BARE, pieces=COARSE)
    hit, response = (0.285, 0.025), (0.27, 0.17)
    struck = struck_plate(
        BARE, reduced, specimen.BARE_MODAL_RATIOS, e.Effects(), hit, response, sensor_kg=6e-4
    )
    built, shipped = StruckPlate(hit, response, structure=struck), StruckPlate(hit, response, 6e-4)
    f, zeta = built.modes(6)
    their_f, their_zeta = shipped.modes(6)
    assert f == pytest.approx(their_f, rel=5e-3)
    assert zeta == pytest.approx(their_zeta, rel=0.02)
    assert built.accelerance(40.0) == pytest.approx(shipped.accelerance(40.0), rel=0.02)
