"""Sweeps without the rig against the plant that the rig shakes."""

import numpy as np
import pytest

from campaign.law import TrueLaw
from campaign.plant.cases import nominal_specimen
from campaign.plant.channels import TrueChannels
from campaign.plant.hammer import hammer_test
from campaign.plant.response import steady
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant import effects as e
from drivers.simulated.plant.bare import StruckPlate
from drivers.simulated.plant.law import ZN1
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plant.slow_change import SlowChange
from fitting.identification.bare_plate import fit_bare_plate

FREQUENCIES_HZ = np.array([14.5, 19.3, 100.5, 109.0, 281.1, 305.0])
REACHED = 5e-6
"""By the shaken plate, which is condensed; the sweeps here are the plant's in full."""
ROCKING = e.Effects(base_rocking=e.BaseRocking(0.1), fixture_resonance=e.FixtureResonance(130.0, 0.02, 0.05))
ALL_IN_ONE = e.Effects(
    clamp_compliance=e.ClampCompliance(3e13, 2e13),
    spot_offset=e.SpotOffset(0.004, -0.002),
    added_mass=e.AddedMass(0.003, 0.27, 0.06),
    air_added_mass=e.AirAddedMass(1.2),
    viscous_damping=e.ViscousDamping(2.0),
    base_rocking=e.BaseRocking(0.1),
    fixture_resonance=e.FixtureResonance(130.0, 0.02, 0.05),
    core_thickness=e.CoreThickness(1.05),
    substrate_stiffness=e.SubstrateStiffness(0.97),
    partial_debond=e.PartialDebond("x", 0.25, 0.28),
)


def at(effects, frequency_hz=FREQUENCIES_HZ, level_m_s2=9.81, time_s=0.0, modulus=ZN1.modulus):
    ones = np.ones(len(frequency_hz))
    return steady(effects, modulus, frequency_hz, level_m_s2 * ones, time_s * ones)


@pytest.mark.parametrize("effects", [e.Effects(), ROCKING, ALL_IN_ONE])
def test_agrees_with_the_shaken_plate(effects):
    shaken = ShakenPlate(effects)
    found = at(effects)
    for f, v, strain in zip(
        FREQUENCIES_HZ, found.velocity_per_acceleration_s, found.core_strain, strict=True
    ):
        s = shaken.steady_state(f)
        relative = (s["spot_velocity"] - s["base_velocity"]) / s["base_acceleration"]
        assert abs(v / relative - 1) < REACHED
        assert strain == pytest.approx(9.81 * abs(s["core_strain"] / s["base_acceleration"]), rel=REACHED)


def test_friction_independent_of_rate_is_the_shaken_plate_s_at_60_hz():
    rubbing = e.Effects(clamp_compliance=ALL_IN_ONE.clamp_compliance, clamp_friction=e.ClampFriction(0.2))
    shaken = ShakenPlate(rubbing)
    frequencies_hz = np.array([60.0, 19.3])
    found = at(rubbing, frequencies_hz).velocity_per_acceleration_s
    off = []
    for f, v in zip(frequencies_hz, found, strict=True):
        s = shaken.steady_state(f)
        off.append(abs(v / ((s["spot_velocity"] - s["base_velocity"]) / s["base_acceleration"]) - 1))
    # Elements that relax are softer below.
    assert off[0] < 2e-3
    assert off[1] > 10 * off[0]


def test_an_absolute_reading_is_the_shaken_plate_s_spot():
    omega = 2 * np.pi * FREQUENCIES_HZ
    seen = TrueChannels(absolute=True).velocity_per_acceleration(
        at(ROCKING).velocity_per_acceleration_s, omega
    )
    shaken = ShakenPlate(ROCKING)
    states = [shaken.steady_state(f) for f in FREQUENCIES_HZ]
    np.testing.assert_allclose(
        seen, [s["spot_velocity"] / s["base_acceleration"] for s in states], rtol=REACHED
    )


def test_a_delay_turns_and_a_gain_stretches():
    omega = 2 * np.pi * FREQUENCIES_HZ
    seen = TrueChannels(delay_s=1e-4, gain=1.02).velocity_per_acceleration(np.ones(len(omega)) + 0j, omega)
    np.testing.assert_allclose(seen, 1.02 * np.exp(-1e-4j * omega))


def test_a_drift_reads_the_law_as_the_rig_does():
    drift = e.TemperatureDrift(5.0, 300.0, 8.0, 110.0)
    slow = SlowChange(ZN1, e.Effects(temperature_drift=drift))
    warm = at(e.Effects(temperature_drift=drift), time_s=250.0)
    omega = 2 * np.pi * FREQUENCIES_HZ
    np.testing.assert_allclose(warm.modulus_pa, slow.law(250.0).modulus(omega), rtol=1e-12)
    shifted = at(e.Effects(), modulus=slow.law(250.0).modulus)
    np.testing.assert_allclose(warm.velocity_per_acceleration_s, shifted.velocity_per_acceleration_s)


def test_softening_comes_to_the_fixed_point_of_its_strain():
    soft = e.AmplitudeSoftening(0.15, reference_strain=0.07)
    f = np.linspace(15, 24, 40)
    found = at(e.Effects(amplitude_softening=soft), f)
    factor = 1 - soft.k * found.core_strain / soft.reference_strain
    np.testing.assert_allclose(found.modulus_pa, factor * ZN1.modulus(2 * np.pi * f), rtol=1e-7)
    again = at(e.Effects(), f, modulus=lambda omega: factor * ZN1.modulus(omega))
    np.testing.assert_allclose(
        found.velocity_per_acceleration_s, again.velocity_per_acceleration_s, rtol=REACHED
    )
    gentle = at(e.Effects(amplitude_softening=soft), f, level_m_s2=9.81 / 1000)
    np.testing.assert_allclose(gentle.modulus_pa, ZN1.modulus(2 * np.pi * f), rtol=3e-4)


def test_softening_is_where_the_rig_s_plate_settles():
    soft = e.AmplitudeSoftening(0.15, reference_strain=0.07, time_constant_s=0.1)
    shaken = ShakenPlate(e.Effects(amplitude_softening=soft))
    volts = 9.81 / abs(shaken.steady_state(19.3)["base_acceleration"])
    shaken.drive(DrivePiece(0.0, 19.3, volts, 0.0, 0.0))
    shaken.at(0.8, 1e-3, 10)
    found = at(e.Effects(amplitude_softening=soft), np.array([19.3]))
    assert found.modulus_pa[0] == pytest.approx(shaken.law.modulus(2 * np.pi * 19.3), rel=2e-3)


def test_runaway_softening_is_refused():
    with pytest.raises(ArithmeticError, match="smaller k"):
        at(e.Effects(amplitude_softening=e.AmplitudeSoftening(2.0, 0.07)), np.linspace(10.5, 11.1, 20))


def test_another_material_is_another_response():
    other = TrueLaw("fractional-zener", (0.2e6, 5e6, 9e-5, 0.7))
    assert abs(at(e.Effects(), modulus=other.modulus).velocity_per_acceleration_s[1]) != pytest.approx(
        abs(at(e.Effects()).velocity_per_acceleration_s[1]), rel=0.02
    )


def test_the_hammer_shares_metal_and_air_and_nothing_else():
    shared = e.Effects(substrate_stiffness=e.SubstrateStiffness(1.04), air_added_mass=e.AirAddedMass(1.2))
    more = e.Effects(
        substrate_stiffness=e.SubstrateStiffness(1.04),
        air_added_mass=e.AirAddedMass(1.2),
        clamp_compliance=e.ClampCompliance(1e13, 1e13),
        viscous_damping=e.ViscousDamping(3.0),
    )
    f, ratio = hammer_test(more, np.random.default_rng(1))
    same = hammer_test(shared, np.random.default_rng(1))
    np.testing.assert_array_equal([f, ratio], same)
    known_hz, known = StruckPlate((0.28, 0.02), (0.06, 0.06), effects=shared).modes(8)
    assert 0 < np.abs(f / known_hz - 1).max() < 2e-3
    assert 0 < np.abs(ratio / known - 1).max() < 0.03


def test_the_fit_of_the_bare_plate_takes_the_hammer_s_result():
    stiffer = e.Effects(substrate_stiffness=e.SubstrateStiffness(1.04))
    fit = fit_bare_plate(nominal_specimen(), *hammer_test(stiffer, np.random.default_rng(2)))
    assert fit.young_scale == pytest.approx(1.04, abs=0.006)
    assert not fit.left_out_hz
