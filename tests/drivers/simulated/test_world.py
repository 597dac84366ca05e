"""One plate, one clock: what the inputs are given, and when the shaker comes to rest."""

import numpy as np
import pytest

from drivers.errors import Refused
from drivers.simulated.drive import DrivePiece
from drivers.simulated.sensors import COUNTS, Input, SimulatedSensor, hum
from drivers.simulated.shaker_device import ShakerDevice
from drivers.simulated.world import Laser, Wiring, World

RATE = 8192.0
FULL = 10.0


class Line:
    """A plate whose every output is a sine of 50 Hz in sample time."""

    def __init__(self):
        self.pieces: list[DrivePiece] = []

    def drive(self, piece):
        self.pieces.append(piece)

    def at(self, output, first_s, step_s, count):
        return np.sin(2 * np.pi * 50.0 * (first_s + step_s * np.arange(count)))


class Struck(Line):
    def __init__(self):
        super().__init__()
        self.hits = []

    def hit(self, now_s):
        self.hits.append(now_s)


def world(virtual=True, **wiring):
    inputs = {
        1: SimulatedSensor("base_acceleration", 1.0, 0.0, 10.0),
        2: SimulatedSensor("laser", 1.0, 1e-3, 10.0),
    }
    return World(
        {"damped": Line(), "bare": Struck()},
        Wiring(**{"inputs": inputs, **wiring}),
        Laser(1.0, 10.0, 1e-3),
        virtual,
    )


def started(one, channels=(1, 2)):
    one.start(channels, np.full(len(channels), FULL), RATE)
    return one


def test_samples_do_not_depend_on_how_they_are_asked_for():
    whole = started(world()).acquire(1000)
    pieces = started(world())
    parts = [pieces.acquire(n) for n in (1, 99, 400, 500)]
    np.testing.assert_array_equal(np.concatenate([p.counts for p in parts], axis=1), whole.counts)
    assert [p.first_sample for p in parts] == [0, 1, 100, 500]


def test_another_acquisition_has_other_noise():
    one = world()
    first, second = (started(one).acquire(100).counts[1] for _ in range(2))
    assert not np.array_equal(first, second)


def test_the_laser_lags_by_its_delay_and_inputs_by_their_skew():
    inputs = {n: SimulatedSensor(q, 1.0, 0.0, 10.0) for n, q in ((1, "base_acceleration"), (2, "laser"))}
    one = started(world(inputs=inputs, skew_samples=0.5))
    volts = one.acquire(4096).counts * FULL / COUNTS
    t = np.arange(4096) / RATE
    phase = [np.angle(np.sum(v * np.exp(-2j * np.pi * 50.0 * t)[: len(v)])) for v in volts[:, :4096]]
    assert phase[1] - phase[0] == pytest.approx(-2 * np.pi * 50.0 * (1e-3 + 0.5 / RATE), abs=1e-5)


def test_time_stands_still_in_virtual_time_and_advances_with_samples():
    one = started(world())
    assert one.clock() == (0, 0.0)
    one.acquire(8192)
    assert one.clock() == (8192, 1.0)
    one.stop()
    assert one.clock()[1] == 1.0


def test_an_unattended_shaker_comes_to_rest_and_no_sample_is_lost():
    one = started(world())
    device = ShakerDevice(one.drive)
    one.advance = device.advance
    device.start(0.0)
    device.command(50.0, 2.0, 100.0, 0.0)
    before = one.acquire(1000)
    device.stop(one.clock()[1])
    one._asked -= 10.0  # as if nobody had asked for ten seconds
    for _ in range(20):
        one.tick(device.status(one.clock()[1]).ramping)
    assert device.log[-1].what == "silent"
    after = one.acquire(3000)
    assert after.first_sample == before.first_sample + 1000
    again = started(world()).acquire(4000)
    np.testing.assert_array_equal(np.concatenate([before.counts, after.counts], axis=1), again.counts)


def test_the_operator_channel_mounts_aims_and_hits():
    one = started(world())
    one.at_operator_channel("mount", {"plate": "bare"})
    one.at_operator_channel("hit", {})
    assert one.plates["bare"].hits == [0.0]
    one.at_operator_channel("aim", {"point": "base"})
    assert one.laser.aimed_at == "base"


@pytest.mark.parametrize(
    ("name", "body", "said"),
    [
        ("mount", {"plate": "wooden"}, "no plate 'wooden'"),
        ("aim", {"point": "moon"}, "no point 'moon'"),
        ("hit", {}, "not for hitting"),
        ("strike", {}, "not for striking"),
        ("shout", {}, "expected mount, clamp, aim, load, strike or hit"),
    ],
)
def test_the_operator_channel_refuses_what_there_is_not(name, body, said):
    with pytest.raises(Refused, match=said):
        world().at_operator_channel(name, body)


def test_a_converter_rounds_clips_and_says_so():
    one = Input(SimulatedSensor("x", 1.0, 0.0, 20.0), FULL, 8.0, (0,))
    fine = one.convert(np.array([1.0, -1.0]), np.zeros(2))
    np.testing.assert_array_equal(fine.counts, np.rint(np.array([1.0, -1.0]) * COUNTS / FULL))
    assert not fine.overload
    over = one.convert(np.array([15.0, -15.0]), np.zeros(2))
    np.testing.assert_array_equal(over.counts, [COUNTS - 1, -COUNTS])
    assert over.overload


def test_a_sensors_own_output_ends_before_the_converters():
    one = Input(SimulatedSensor("x", 1.0, 0.0, 4.0), FULL, 10.0, (0,))
    assert one.convert(np.array([100.0]), np.zeros(1)).counts[0] == pytest.approx(4.08 * COUNTS / FULL, abs=1)


def test_hum_is_the_mains_and_its_third():
    x = hum(0.1, 50.0, 0.0, 1 / RATE, 8192)
    lines = np.abs(np.fft.rfft(x)) * 2 / 8192
    assert lines[50] == pytest.approx(0.1, rel=1e-9)
    assert lines[150] == pytest.approx(0.03, rel=1e-9)
