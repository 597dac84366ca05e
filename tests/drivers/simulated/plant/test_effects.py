from dataclasses import fields

import numpy as np
import pytest
from scipy.linalg import eigh

from drivers.simulated.plant import effects as e
from drivers.simulated.plant.law import ZN1, MaxwellLaw
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.shaken import ShakenPlate

FREQUENCIES_HZ = (19.3, 60.0, 100.5, 281.1)

NEUTRAL = {
    "clamp_friction": e.Effects(e.ClampCompliance(1e14, 1e14), e.ClampFriction(0.0)),
    "spot_offset": e.Effects(spot_offset=e.SpotOffset(0.0, 0.0)),
    "added_mass": e.Effects(added_mass=e.AddedMass(0.0, 0.2, 0.05)),
    "air_added_mass": e.Effects(air_added_mass=e.AirAddedMass(0.0)),
    "temperature_drift": e.Effects(temperature_drift=e.TemperatureDrift(0.0)),
    "partial_debond": e.Effects(partial_debond=e.PartialDebond("x", 0.1, 0.1)),
    "amplitude_softening": e.Effects(amplitude_softening=e.AmplitudeSoftening(0.0)),
    "viscous_damping": e.Effects(viscous_damping=e.ViscousDamping(1.0)),
    "base_rocking": e.Effects(base_rocking=e.BaseRocking(0.0)),
    "fixture_resonance": e.Effects(fixture_resonance=e.FixtureResonance(130.0, 0.02, 0.0)),
    "core_thickness": e.Effects(core_thickness=e.CoreThickness(1.0)),
    "substrate_stiffness": e.Effects(substrate_stiffness=e.SubstrateStiffness(1.0)),
    "core_law": e.Effects(core_law=e.OtherLaw(ZN1)),
}
PRESENT = {
    "clamp_compliance": e.Effects(e.ClampCompliance(2.8e13, 2.8e13)),
    "clamp_friction": e.Effects(e.ClampCompliance(2.8e13, 2.8e13), e.ClampFriction(0.2)),
    "spot_offset": e.Effects(spot_offset=e.SpotOffset(0.004, 0.001)),
    "added_mass": e.Effects(added_mass=e.AddedMass(0.003, 0.27, 0.06)),
    "air_added_mass": e.Effects(air_added_mass=e.AirAddedMass(1.2)),
    "partial_debond": e.Effects(partial_debond=e.PartialDebond("y", 0.0, 0.02)),
    "viscous_damping": e.Effects(viscous_damping=e.ViscousDamping(2.0)),
    "base_rocking": e.Effects(base_rocking=e.BaseRocking(0.2)),
    "fixture_resonance": e.Effects(fixture_resonance=e.FixtureResonance(100.0, 0.02, 0.05)),
    "core_thickness": e.Effects(core_thickness=e.CoreThickness(0.92)),
    "substrate_stiffness": e.Effects(substrate_stiffness=e.SubstrateStiffness(1.05)),
    "core_law": e.Effects(core_law=e.OtherLaw(MaxwellLaw(2e5, (4e5, 2e6), (1e-3, 1e-4)))),
}


def readings(effects):
    """Absolute velocity at the spot over base acceleration."""
    plate = ShakenPlate(effects)
    states = [plate.steady_state(f) for f in FREQUENCIES_HZ]
    return np.array([s["spot_velocity"] / s["base_acceleration"] for s in states])


@pytest.fixture(scope="module")
def clean():
    return readings(e.Effects())


def first_frequency_hz(effects):
    s = sandwich(effects).structure
    springs = sum((b.law.modulus(0.0).real * b.K for b in s.branches[1:]), np.zeros_like(s.K))
    lam = eigh(s.K + 0.5e6 * s.branches[0].K + springs, s.M, eigvals_only=True)
    return float(np.sqrt(lam[0]) / (2 * np.pi))


@pytest.mark.parametrize("name", NEUTRAL)
def test_an_effect_of_no_severity_is_none(name, clean):
    bare = readings(e.Effects(e.ClampCompliance(1e14, 1e14))) if name == "clamp_friction" else clean
    np.testing.assert_allclose(readings(NEUTRAL[name]), bare, rtol=3e-5)


@pytest.mark.parametrize("name", PRESENT)
def test_an_effect_is_felt_and_the_plate_stays_passive(name, clean):
    assert np.abs(readings(PRESENT[name]) / clean - 1).max() > 2e-3
    assert ShakenPlate(PRESENT[name]).poles().real.max() < 0


def test_every_effect_is_tested():
    names = {field.name for field in fields(e.Effects)}
    assert names == set(NEUTRAL) | set(PRESENT)


def test_stiff_springs_are_the_rigid_clamp():
    stiff, rigid = sandwich(e.Effects(e.ClampCompliance(1e19, 1e19))).structure, sandwich().structure
    for omega in 2 * np.pi * np.array(FREQUENCIES_HZ):
        found, wanted = (s.readings @ s.response(omega)[:, 0] for s in (stiff, rigid))
        np.testing.assert_allclose(found, wanted, rtol=1e-5)


@pytest.mark.parametrize(
    ("effects", "direction"),
    [
        (e.Effects(e.ClampCompliance(2.8e13, 2.8e13)), -1),
        (PRESENT["added_mass"], -1),
        (PRESENT["air_added_mass"], -1),
        (e.Effects(partial_debond=e.PartialDebond("x", 0.0, 0.03)), -1),
        (PRESENT["partial_debond"], -1),
        (PRESENT["substrate_stiffness"], 1),
        (PRESENT["core_thickness"], 1),
    ],
)
def test_first_frequency_moves_the_right_way(effects, direction):
    assert direction * (first_frequency_hz(effects) / first_frequency_hz(e.Effects()) - 1) > 5e-4


def test_damping_lowers_the_peak():
    without = abs(readings(e.Effects(e.ClampCompliance(2.8e13, 2.8e13)))[0])
    assert abs(readings(PRESENT["clamp_friction"])[0]) < 0.9999 * without
    assert abs(readings(PRESENT["viscous_damping"])[0]) < 0.99 * abs(readings(e.Effects())[0])


def test_a_point_mass_at_the_tip_weighs_as_its_modal_mass():
    s = sandwich().structure
    lam, phi = eigh(s.K + 0.5e6 * s.branches[0].K, s.M)
    w = s.readings[1] @ phi[:, 0]
    x, y, m = 0.3002, 0.09995, 1e-4
    moved = first_frequency_hz(e.Effects(added_mass=e.AddedMass(m, x, y))) ** 2 * (2 * np.pi) ** 2
    assert moved / lam[0] - 1 == pytest.approx(-m * w**2, rel=0.01)


def test_rocking_adds_the_lever_of_the_spot_where_the_plate_follows():
    plate = ShakenPlate(PRESENT["base_rocking"])
    s = plate.steady_state(0.5)
    assert s["spot_velocity"] / s["base_velocity"] == pytest.approx(1 + 0.2 * 0.06, rel=2e-3)


def test_a_fixture_resonance_is_narrow():
    near, far = (ShakenPlate(PRESENT["fixture_resonance"]).steady_state(f) for f in (100.0, 250.0))
    ratio = [s["spot_velocity"] / s["base_acceleration"] for s in (near, far)]
    plain = ShakenPlate()
    for change, f, limits in ((ratio[0], 100.0, (0.03, 5)), (ratio[1], 250.0, (0, 0.03))):
        s = plain.steady_state(f)
        assert limits[0] < abs(change / (s["spot_velocity"] / s["base_acceleration"]) - 1) < limits[1]


def test_nonsense_is_refused():
    with pytest.raises(ValueError, match="leaves the edge strips"):
        sandwich(e.Effects(partial_debond=e.PartialDebond("y", 0.08, 0.1)))
    with pytest.raises(ValueError, match='along "z"'):
        sandwich(e.Effects(partial_debond=e.PartialDebond("z", 0.0, 0.1)))
    with pytest.raises(ValueError, match="off the plate"):
        sandwich(e.Effects(spot_offset=e.SpotOffset(0.3, 0.0)))
