"""A velocity on its way into the file, and its derivatives: what effects and stated channels make of them."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis.response.channels import Channels
from fitting.diagnosis.response.unknowns import STATED_NUMBER, Unknowns, stepped
from fitting.effects.gain_error import GainErrorEffect
from fitting.effects.phase_scale import PhaseScaleEffect
from fitting.effects.sensor_lowpass import SensorLowpassEffect
from fitting.effects.substrate_stiffness import SubstrateStiffnessEffect
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances

OMEGA = 2 * np.pi * np.array([20.0, 90.0, 250.0])
V = np.array([0.3 + 0.1j, -0.2 + 0.5j, 0.05 - 0.4j])
GAIN, DELAY = Nuisance("gain", "gain", 0.01), Nuisance("delay", "delay", 1e-5)


def channels(*effects, stated=(GAIN, DELAY)):
    unknowns = Unknowns(len(stated), effects)
    problem = SimpleNamespace(nuisances=Nuisances(None, stated), points=SimpleNamespace(omega=OMEGA))
    return unknowns, Channels(problem, unknowns)


def test_stated_numbers_come_first_and_then_each_effects_own():
    lowpass, gain = SensorLowpassEffect(), GainErrorEffect()
    unknowns = Unknowns(2, [lowpass, gain])
    u = np.arange(2.0 + len(lowpass.parameters) + 1)
    assert unknowns.parameters == (STATED_NUMBER, STATED_NUMBER, *lowpass.parameters, *gain.parameters)
    assert u[unknowns.stated].tolist() == [0.0, 1.0]
    assert unknowns.of(1, u).tolist() == [u[-1]]
    assert [unknowns.owner(n) for n in (2, len(u) - 1)] == [0, 1]


def test_a_step_goes_with_what_is_typical_of_an_unknown():
    unknowns = Unknowns(1, [GainErrorEffect()])
    assert unknowns.step(1, np.array([0.0, 1.0])) == pytest.approx(1.02 * unknowns.step(0, np.zeros(2)))


def test_a_gain_error_and_the_stated_gain_multiply():
    _, read = channels(GainErrorEffect())
    assert read.read(V, np.array([2.0, 0.0, 1.1])) == pytest.approx(1.1 * 1.02 * V)


def test_a_stated_delay_turns_the_phase_by_its_seconds():
    _, read = channels(GainErrorEffect())
    assert read.read(V, np.array([0.0, 3.0, 1.0])) == pytest.approx(V * np.exp(-1j * OMEGA * 3e-5))


@pytest.mark.parametrize("effects", [(), (GainErrorEffect(),)], ids=["stated", "with an effect"])
def test_derivatives_are_read_through_the_same_channels(effects):
    _, read = channels(*effects)
    u = np.array([1.0, -2.0, *(0.9 for _ in effects)])
    by = np.array([V[::-1] * 1e-12, np.zeros(3), 4.0 * V])
    along = read.along(V, read.read(V, u), by, u)
    # Both channels are linear: a derivative is read as a velocity is.
    assert along == pytest.approx(np.array([read.read(d, u) for d in by]), rel=1e-8)


@pytest.mark.parametrize("counted", [0.0, 1.0, 2.0])
def test_a_channel_that_bends_reads_each_derivative_as_if_it_were_alone(counted):
    _, read = channels(PhaseScaleEffect(), SensorLowpassEffect(), stated=())
    u = np.array([1.1, counted, 3e3])
    by = np.array([V[::-1] * 1e12, np.zeros(3), 1e-9j * V])
    alone = [read.along(V, read.read(V, u), one[None], u)[0] for one in by]
    assert np.array_equal(read.along(V, read.read(V, u), by, u), alone)
    for k in (0, 2):
        h = 1e-6 * np.abs(V).max() / np.abs(by[k]).max()
        central = (read.read(V + h * by[k], u) - read.read(V - h * by[k], u)) / (2 * h)
        # A step to one side is off by half of itself.
        assert np.abs(alone[k] - central).max() < 2e-6 * np.abs(central).max()


def test_a_reading_goes_with_the_unknown_of_its_channel():
    _, read = channels(GainErrorEffect())
    u = np.array([0.0, 0.0, 1.05])
    assert read.by(2, V, u) == pytest.approx(V)
    assert np.array_equal(stepped(u, 2, 0.01), [0.0, 0.0, 1.06])
    assert u[2] == 1.05  # as it was


def test_an_effect_without_a_channel_changes_no_reading():
    _, read = channels(SubstrateStiffnessEffect(), stated=())
    assert read.read(V, np.array([1.5])) is V
    assert not read.by(0, V, np.array([1.5])).any()
