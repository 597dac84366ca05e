import time
from threading import Event, Thread

import httpx
import numpy as np
import pytest

from drivers.errors import DriverError, Garbled, Refused, TimedOut, Unreachable
from drivers.front_end import lan_xi_documents as documents
from drivers.front_end.interface import InputChannel, ReadsMemories, Transducer
from drivers.front_end.lan_xi import LanXiFrontEnd
from drivers.front_end.lan_xi_documents import HEADROOM
from drivers.front_end.lan_xi_frames import Data
from drivers.front_end.lan_xi_stream import StreamReader
from drivers.simulated.lan_xi_measurement import Acquired
from drivers.simulated.lan_xi_server import LanXiServer

RATES = (4096, 65536, 131072)
CHANNELS = tuple(InputChannel(k, f"input {k}", iepe=k == 1) for k in (1, 2, 3, 4))


class Ramps:
    """Counts that tell channel and sample; flags in the samples asked for."""

    def __init__(self, overload=(), cable_fault=()):
        self.overload, self.cable_fault = overload, cable_fault
        self.asked, self.running, self.ended = [], None, Event()

    def start(self, channel_numbers, full_scale_v, sample_rate_hz):
        self.numbers, self.full_scale_v, self.rate_hz = channel_numbers, full_scale_v, sample_rate_hz
        self.at, self.running = 0, True
        self.ended.clear()

    def acquire(self, samples):
        first, self.at = self.at, self.at + samples
        self.asked.append(samples)
        flags = [
            np.array([k == 1 and any(first <= s < self.at for s in listed) for k in range(len(self.numbers))])
            for listed in (self.overload, self.cable_fault)
        ]
        return Acquired(first, self.counts(first, self.at), *flags)

    def counts(self, first, stop):
        mixed = np.arange(first, stop, dtype=np.int64) * 2654435761 % (1 << 24) - (1 << 23)
        return np.array([mixed ^ number for number in self.numbers], np.int32)

    def stop(self):
        self.running = False
        self.ended.set()


@pytest.fixture
def source():
    return Ramps()


@pytest.fixture
def server(source):
    with LanXiServer(source, channels=6, sample_rates=RATES, pace="asked") as running:
        yield running


@pytest.fixture
def front_end(server):
    driver = LanXiFrontEnd(server.url, timeout_s=1.0, paced_by_reader=True)
    yield driver
    driver.close()


def test_it_says_who_it_is(front_end):
    assert front_end.identity() == "LAN-XI SIM-LAN-XI, serial number 000001"
    assert front_end.transducers == (None,) * 6


def test_sensors_with_a_memory_say_who_they_are(source):
    said = Transducer("4507", "31", 10.2)
    own = {2: documents.write_transducer(said, "m/s^2")}
    with LanXiServer(source, channels=3, sample_rates=RATES, pace="asked", transducers=own) as server:
        driver = LanXiFrontEnd(server.url, timeout_s=1.0)
        driver.close()
    assert isinstance(driver, ReadsMemories)
    assert driver.transducers == (None, said, None)


def test_sensors_that_are_read_without_end_are_given_up(server, monkeypatch):
    """A module hangs so: it has to be restarted by hand."""
    monkeypatch.setattr("drivers.simulated.lan_xi_server._DETECTION_POLLS", 1_000_000)
    monkeypatch.setattr("drivers.front_end.lan_xi._DETECTION_S", 0.1)
    with pytest.raises(TimedOut, match=r"detecting sensors took over 0\.1 s: restart the module"):
        LanXiFrontEnd(server.url, timeout_s=1.0)


def test_a_million_samples_are_the_sources_to_the_bit(source, front_end):
    front_end.start(CHANNELS, 131072)
    assert front_end.sample_rate_hz == source.rate_hz == 131072
    at = 0
    for n in (1, 7, 8192, 8193, 100_000, *(8192,) * 110):
        block = front_end.read(n)
        assert (block.first_sample, block.samples) == (at, n)
        np.testing.assert_array_equal(block.counts, source.counts(at, at + n))
        at += n
    assert at > 1_000_000


def test_volts_follow_from_range_and_headroom(source, front_end):
    front_end.start((InputChannel(1, "a", range_v=2.0), InputChannel(2, "b", range_v=20.0)), 4096)
    block = front_end.read(16)
    assert block.full_scale_v.tolist() == [10.0, 31.6]
    np.testing.assert_allclose(block.volts_per_count * 2**23, np.array([10.0, 31.6]) * HEADROOM)
    np.testing.assert_allclose(source.full_scale_v, block.volts_per_count * 2**23)


def test_channels_come_in_the_order_asked_for(source, front_end):
    front_end.start(tuple(InputChannel(n, str(n), range_v=10.0 + n) for n in (5, 1, 3)), 4096)
    assert source.numbers == (1, 3, 5)
    np.testing.assert_array_equal(front_end.read(100).counts, source.counts(0, 100)[[2, 0, 1]])


def test_paced_by_its_reader_the_source_makes_what_is_asked_for(source, front_end):
    front_end.start(CHANNELS, 4096)
    for n in (100, 4096, 20_000):
        front_end.read(n)
    assert source.asked == [100, 4096, 8192, 8192, 3616]


@pytest.mark.parametrize("what", ["overload", "cable_fault"])
def test_flags_land_in_the_block_they_belong_to(source, front_end, what):
    setattr(source, what, (1500, 1600, 3000))
    front_end.start(CHANNELS, 4096)
    blocks = [front_end.read(1000) for _ in range(5)]
    flagged = np.array([getattr(b, what) for b in blocks])
    assert np.argwhere(flagged).tolist() == [[1, 1], [3, 1]]
    assert not any(
        getattr(b, {"overload": "cable_fault", "cable_fault": "overload"}[what]).any() for b in blocks
    )


def test_the_status_of_the_channels_remembers(source, server, front_end):
    source.overload = (5,)
    front_end.start(CHANNELS[:2], 4096)
    seen = []
    for _ in range(2):
        front_end.read(10)
        channels = httpx.get(f"{server.url}/rest/rec/onchange").json()["recordingStatus"]["channelStatus"]
        seen.append([c["anol"] for c in channels])
    assert seen == [["none", "curr"], ["none", "prev"]]


def test_it_starts_again_after_it_stopped_twice(source, server, front_end):
    for _ in range(2):
        front_end.start(CHANNELS, 4096)
        assert front_end.read(10).first_sample == 0
        front_end.stop()
        front_end.stop()
        assert source.running is False
        assert server.state == "RecorderOpened"
    front_end.close()
    assert server.state == "Idle"
    front_end.close()


def test_what_the_module_cannot_do_is_refused(server, front_end):
    with pytest.raises(Refused, match="the nearest is 65536 Hz"):
        front_end.start(CHANNELS, 51200)
    with pytest.raises(Refused, match="channel 7: SIM-LAN-XI has inputs 1 to 6"):
        front_end.start((InputChannel(7, "x"),), 4096)
    with pytest.raises(Refused, match="each once"):
        front_end.start((CHANNELS[0], CHANNELS[0]), 4096)
    with pytest.raises(Refused, match="50 V is beyond"):
        front_end.start((InputChannel(1, "x", range_v=50.0),), 4096)
    with pytest.raises(Refused, match="start it first"):
        front_end.read(1)
    front_end.start(CHANNELS, 4096)
    with pytest.raises(Refused, match="stop it first"):
        front_end.start(CHANNELS, 4096)


@pytest.mark.parametrize(
    "state", ["RecorderOpened", "RecorderConfiguring", "RecorderStreaming", "RecorderRecording"]
)
def test_a_module_left_open_by_a_killed_program_is_taken_over(server, source, state):
    requests = [("PUT", "open"), ("PUT", "create"), ("PUT", "channels/input"), ("POST", "measurements")]
    states = ["RecorderOpened", "RecorderConfiguring", "RecorderStreaming", "RecorderRecording"]
    with httpx.Client(base_url=f"{server.url}/rest/rec/") as http:
        setup = http.get("channels/input/default").json()
        for entry in setup["channels"]:
            entry["destinations"] = ["socket"]
        for method, path in requests[: states.index(state) + 1]:
            http.request(method, path, json=setup).raise_for_status()
    assert server.state == state
    driver = LanXiFrontEnd(server.url, timeout_s=1.0, paced_by_reader=True)
    driver.start(CHANNELS, 4096)
    np.testing.assert_array_equal(driver.read(50).counts, source.counts(0, 50))
    driver.close()


def test_a_client_that_vanished_while_it_measured_is_no_obstacle(server, source):
    first = LanXiFrontEnd(server.url, timeout_s=1.0, paced_by_reader=True)
    first.start(CHANNELS, 4096)
    first.read(10)
    first._disconnect()
    assert source.ended.wait(5)
    second = LanXiFrontEnd(server.url, timeout_s=1.0, paced_by_reader=True)
    second.start(CHANNELS, 4096)
    assert second.read(10).first_sample == 0
    second.close()
    first.close()


def test_a_request_in_a_wrong_state_is_answered_403(server):
    with httpx.Client(base_url=f"{server.url}/rest/rec/") as http:
        assert http.post("measurements").status_code == 403
        assert http.put("close").status_code == 403
        assert http.put("nonsense").status_code == 404
        http.put("open")
        http.put("create")
        assert http.put("channels/input", content=b"{").status_code == 400
        assert http.put("channels/input", json={"channels": []}).status_code == 400


def test_a_stream_that_breaks_off_is_unreachable_and_can_be_started_again(server, front_end):
    front_end.start(CHANNELS, 4096)
    front_end.read(10)
    server.cut_stream()
    with pytest.raises(Unreachable, match="the stream broke off"):
        front_end.read(10)
    front_end.stop()
    front_end.start(CHANNELS, 4096)
    assert front_end.read(10).first_sample == 0


def test_garbage_in_the_stream_is_garbled(server, front_end):
    front_end.start(CHANNELS, 4096)
    front_end.read(10)
    server.garbage()
    with pytest.raises(Garbled, match="a message begins with"):
        front_end.read(10)


@pytest.mark.parametrize(
    ("flagged", "said"), [(False, "goes on at sample 30, expected 10"), (True, "in the device")]
)
def test_lost_samples_are_an_error(server, front_end, flagged, said):
    front_end.start(CHANNELS, 4096)
    front_end.read(10)
    server.lose(20, flagged=flagged)
    with pytest.raises(DriverError, match=said):
        front_end.read(10)


def test_silence_times_out(server):
    driver = LanXiFrontEnd(server.url, timeout_s=0.3)
    driver.start(CHANNELS, 4096)
    begun = time.monotonic()
    with pytest.raises(TimedOut, match=r"silent for 0\.3 s"):
        driver.read(10)
    assert time.monotonic() - begun < 2
    driver.close()


def test_stopping_frees_a_reader_that_waits(server):
    driver = LanXiFrontEnd(server.url, timeout_s=30.0)
    driver.start(CHANNELS, 4096)
    begun, caught = Event(), []

    def read():
        begun.set()
        with pytest.raises(DriverError) as error:
            driver.read(10)
        caught.append(error.type)

    thread = Thread(target=read)
    thread.start()
    assert begun.wait(5)
    driver.stop()
    thread.join(5)
    assert not thread.is_alive()
    assert caught in ([Unreachable], [Refused])
    driver.close()


def test_nobody_there_is_unreachable(source):
    with LanXiServer(source, channels=2, sample_rates=RATES) as gone:
        url = gone.url
    with pytest.raises(Unreachable, match="is the module switched on"):
        LanXiFrontEnd(url, timeout_s=0.5, retries=1)


def test_an_address_that_is_none_is_refused():
    with pytest.raises(Refused, match="expected http://<host>"):
        LanXiFrontEnd("192.168.1.5")


def test_a_module_switched_off_while_open(source):
    with LanXiServer(source, channels=4, sample_rates=RATES, pace="asked") as server:
        driver = LanXiFrontEnd(server.url, timeout_s=0.5, retries=0, paced_by_reader=True)
        driver.start(CHANNELS, 4096)
        driver.read(10)
    with pytest.raises(Unreachable):
        driver.read(10)
    with pytest.raises(Unreachable):
        driver.stop()
    driver.stop()
    driver.close()


def test_in_real_pace_the_samples_come_by_the_clock(source):
    with LanXiServer(source, channels=4, sample_rates=RATES, pace="real") as server:
        driver = LanXiFrontEnd(server.url, timeout_s=2.0)
        begun = time.monotonic()
        driver.start(CHANNELS, 65536)
        for at in range(0, 32768, 4096):
            np.testing.assert_array_equal(driver.read(4096).counts, source.counts(at, at + 4096))
        assert 0.45 < time.monotonic() - begun < 5
        driver.close()


@pytest.mark.timing
def test_four_channels_come_faster_than_three_million_samples_a_second(server, source, front_end):
    fixed = np.zeros((4, 8192), np.int32)
    source.counts = lambda first, stop: fixed[:, : stop - first]
    front_end.start(CHANNELS, 131072)
    begun = time.perf_counter()
    for _ in range(400):
        front_end.read(8192)
    assert 400 * 8192 / (time.perf_counter() - begun) > 3e6


def test_a_port_that_is_taken_is_said_by_what_wanted_it(server):
    port = int(server.url.rpartition(":")[2])
    with pytest.raises(Unreachable, match=f"front-end: cannot serve at 127.0.0.1:{port}: Address already"):
        LanXiServer(Ramps(), channels=6, sample_rates=RATES, port=port)


def test_a_channel_that_gives_no_samples_ends_in_bounded_time(server, source, monkeypatch):
    """The stream is alive, one channel in it is not."""
    device = LanXiFrontEnd(server.url, timeout_s=0.5, paced_by_reader=True)
    try:
        device.start(CHANNELS, 4096)
        device.read(100)
        first_alone = StreamReader.take

        def without_the_second(reader, message):
            if isinstance(message, Data):
                message = Data(message.time, tuple(s for s in message.signals if s.id != 2))
            first_alone(reader, message)

        monkeypatch.setattr(StreamReader, "take", without_the_second)
        receive = device._receive
        monkeypatch.setattr(device, "_receive", lambda: (device._send_credit(10), receive())[1])
        began = time.monotonic()
        with pytest.raises(TimedOut, match="no sample of every channel"):
            device.read(100)
        assert time.monotonic() - began < 5.0
    finally:
        device.close()
