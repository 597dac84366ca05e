"""What all sweeps have in common is not taken for the material; what is of the material is refused."""

from dataclasses import replace

import numpy as np
import pytest
from temperature_cases import LAW, REFERENCE, OneProcess, TwoProcesses, arrhenius, sweeps

from instrument.temperatures.shifted import identify_shifted

SIMPLE = [OneProcess(a) for a in arrhenius()]
NOT_SIMPLE = [TwoProcesses(a, b) for a, b in zip(arrhenius(4e4), arrhenius(1.6e5), strict=True)]
DELAY_S = 1.1e-3
GAIN = 1.04


def late(sweep):
    return replace(sweep, velocity_m_s=sweep.velocity_m_s * np.exp(-1j * sweep.omega * DELAY_S))


def loud(sweep, gain=GAIN):
    return replace(sweep, velocity_m_s=sweep.velocity_m_s * gain, std_m_s=sweep.std_m_s * gain)


def far_too_loud(sweep):
    # Tolerances of all stated numbers together hide a few percent.
    return loud(sweep, 1.1)


def as_it_is(sweep):
    return sweep


def asked(plate, laws, spoiled=as_it_is, kind="arrhenius", measured_on=None, every=2):
    """Some of the temperatures, thirty points each."""
    made = sweeps(measured_on or plate, laws, points=30)
    return identify_shifted(
        [replace(one, data=spoiled(one.data)) for one in made[::every]], plate, kind, REFERENCE
    )


@pytest.fixture(scope="module")
def exact(coarse):
    return replace(coarse, exact=True)


@pytest.fixture(scope="module")
def tolerant(coarse):
    return replace(coarse, exact=False)


def beside(plate):
    """The spot 7 mm from where it is stated."""
    assert plate.pickup_m is not None
    x, y = plate.pickup_m
    return replace(plate, pickup_m=(x - 6e-3, y + 4e-3))


def within(found, key, truth):
    it = found.cause.found.parameters[key]
    return abs(it.value - truth) < 3.5 * it.standard_error


def test_a_delay_of_all_sweeps_is_named_and_the_law_found_beside_it(exact):
    found = asked(exact, SIMPLE, late)
    assert found.cause.effect.name == "channel_delay"
    assert within(found, "delay", DELAY_S)
    assert found.verdict.simple
    assert "the laser on the base beside the accelerometer" in found.verdict.words
    off = found.fit.log_shift - arrhenius()[::2]
    assert np.all(np.abs(off) < 3.5 * found.fit.log_shift_errors + 1e-9)


def test_a_wrong_gain_of_all_sweeps_is_named(exact):
    found = asked(exact, SIMPLE, loud)
    assert found.cause.effect.name == "gain_error"
    assert within(found, "factor", GAIN)
    assert found.verdict.simple


@pytest.mark.long
def test_laws_of_another_form_at_each_temperature_are_refused(exact):
    class Other(OneProcess):
        def modulus(self, omega):
            return replace(LAW, alpha=0.83 - 0.04 * np.log(self.a)).modulus(self.a * omega)

    found = asked(exact, [Other(a) for a in arrhenius()], kind="free", every=4)
    assert found.verdict.simple is False
    assert found.cause is None


@pytest.mark.long
@pytest.mark.parametrize(
    ("spoiled", "cause"), [(late, "channel_delay"), (far_too_loud, "gain_error")], ids=["delay", "gain"]
)
def test_channels_are_told_from_the_material_where_stated_numbers_may_move(tolerant, spoiled, cause):
    found = asked(tolerant, SIMPLE, spoiled)
    assert found.cause.effect.name == cause
    assert found.verdict.simple is not False


@pytest.mark.long
def test_a_spot_beside_its_place_at_every_temperature_is_named(tolerant):
    found = asked(tolerant, SIMPLE, measured_on=beside(tolerant))
    assert found.cause.effect.name == "spot_offset"
    assert within(found, "dx", -6e-3)
    assert within(found, "dy", 4e-3)
    assert found.verdict.simple


@pytest.mark.long
@pytest.mark.parametrize("spoiled", [as_it_is, late], ids=["as it is", "late"])
def test_a_law_that_is_not_simple_is_refused_with_a_delay_too(tolerant, spoiled):
    found = asked(tolerant, NOT_SIMPLE, spoiled, "free")
    assert found.verdict.simple is False
    assert "not thermorheologically simple" in found.verdict.words


@pytest.mark.long
def test_where_no_law_explains_any_sweep_nothing_is_said_of_the_material(exact):
    def spoiled(sweep):
        # A wave along the frequency that no plate, rig or core makes.
        return replace(sweep, velocity_m_s=sweep.velocity_m_s * (1 + 0.05 * np.cos(sweep.frequency_hz / 3)))

    found = asked(exact, SIMPLE, spoiled)
    assert found.verdict.simple is None
    assert "not even a law for each temperature" in found.verdict.words
