import os
import select
import time
from threading import Event, RLock, Thread

import pytest

from drivers.errors import Garbled, Refused, TimedOut, Unreachable
from drivers.vibrometer.polytec_simulated import Head, VibrometerServer
from drivers.vibrometer.polytec_vibrometer import PolytecVibrometer


@pytest.fixture
def server():
    with VibrometerServer(Head(), lock=RLock()) as running:
        yield running


@pytest.fixture
def vibrometer(server):
    driver = PolytecVibrometer(server.path, timeout_s=0.3)
    yield driver
    driver.close()


def test_it_says_who_it_is(vibrometer):
    assert vibrometer.identity() == "OFV-5000 Vibrometer Controller, VD-09, OFV-505"


def test_every_range_is_set_and_read_back(server, vibrometer):
    seen = []
    server.head.on_range = seen.append
    for wanted in reversed(vibrometer.ranges):
        found = vibrometer.set_range(wanted.name)
        assert (found.name, found.scale_m_s_v) == (wanted.name, wanted.scale_m_s_v)
        assert found == vibrometer.range()
    assert [r.name for r in seen] == [r.name for r in reversed(vibrometer.ranges)]


def test_of_the_range_it_was_set_to_the_name_alone_is_asked_again(server, vibrometer, monkeypatch):
    asked, ask = [], PolytecVibrometer._exchange
    monkeypatch.setattr(
        PolytecVibrometer, "_exchange", lambda self, command: asked.append(str(command)) or ask(self, command)
    )
    wanted = vibrometer.set_range("20mm/s/V")
    asked.clear()
    assert vibrometer.range() == wanted
    assert asked == ["Get,VeloDec,1,Range"]
    server.head.range_name = "50mm/s/V"
    assert vibrometer.range().name == "50mm/s/V"
    assert len(asked) == 4


def test_an_answer_that_is_none_to_the_question_may_be_late(server, vibrometer, monkeypatch):
    monkeypatch.setattr(VibrometerServer, "_reply", lambda self, text: "20mm/s/V")
    with pytest.raises(Garbled, match=r"expected a whole number \(a late answer to another question\?\)"):
        vibrometer.signal_level()


def test_a_range_that_there_is_not_is_refused_and_nothing_is_sent(server, vibrometer):
    with pytest.raises(Refused, match="has no range '7mm/s/V': it has 5mm/s/V"):
        vibrometer.set_range("7mm/s/V")
    assert server.head.range_name == "5mm/s/V"


def test_a_range_that_the_device_does_not_take_is_refused(server, vibrometer):
    server.faults.stuck_range = True
    with pytest.raises(Refused, match="range 50mm/s/V was asked, the device keeps 5mm/s/V"):
        vibrometer.set_range("50mm/s/V")


def test_the_delay_is_the_devices_own_by_range(server, vibrometer):
    assert vibrometer.signal_delay_s() is None
    server.head.delay_s["50mm/s/V"] = 8.16e-6
    server.head.delay_s["100mm/s/V"] = 1.1e-3
    assert vibrometer.set_range("50mm/s/V").delay_s == pytest.approx(8.16e-6, rel=1e-9)
    assert vibrometer.set_range("100mm/s/V").delay_s == pytest.approx(1.1e-3, rel=1e-9)
    assert vibrometer.signal_delay_s() == pytest.approx(1.1e-3, rel=1e-9)


def test_the_signal_level_goes_from_none_to_full(server, vibrometer):
    for level in (0.0, 0.25, 1.0):
        server.head.signal_level = level
        assert vibrometer.signal_level() == pytest.approx(level, abs=1 / 512)


def test_another_decoder_than_the_models_is_refused(server):
    server.head.model = "OFV-5000 VD-08"
    with pytest.raises(Refused, match="decoder VD-09 expected, found none and VD-08"):
        PolytecVibrometer(server.path, timeout_s=0.3)


def test_the_portable_one_speaks_the_assumed_language():
    with VibrometerServer(Head(model="PDV-100"), lock=RLock()) as server:
        driver = PolytecVibrometer(server.path, model="PDV-100", timeout_s=0.3)
        assert driver.set_range("125mm/s/V").full_scale_m_s == pytest.approx(0.5)
        assert driver.range().delay_s == pytest.approx(1.1e-3)
        driver.close()


@pytest.mark.parametrize("fault", ["garbled_replies", "silent_replies", "noise_before_reply"])
def test_two_bad_answers_are_asked_for_again(server, vibrometer, fault):
    setattr(server.faults, fault, 2)
    assert vibrometer.range().name == "5mm/s/V"
    assert getattr(server.faults, fault) == 0


def test_a_setting_survives_a_bad_acknowledge(server, vibrometer):
    for fault in ("garbled_replies", "silent_replies"):
        setattr(server.faults, fault, 1)
        assert vibrometer.set_range("50mm/s/V" if fault == "silent_replies" else "10mm/s/V")


def test_a_device_that_goes_on_echoing_is_understood(server, vibrometer):
    server.faults.stuck_echo = True
    assert vibrometer.set_range("50mm/s/V").name == "50mm/s/V"
    assert vibrometer.identity() == "OFV-5000 Vibrometer Controller, VD-09, OFV-505"


def test_what_the_device_said_before_is_no_answer(server, vibrometer):
    server.head.signal_level = 0.5
    port = os.open(server.path, os.O_RDWR | os.O_NOCTTY)
    server.chatter(b"17")
    assert select.select([port], [], [], 5)[0]
    os.close(port)
    assert vibrometer.signal_level() == 0.5


def test_garbage_without_end_is_given_up(server, vibrometer):
    server.faults.garbled_replies = 1000
    with pytest.raises(Garbled, match=r"Get,SignalLevel,0,Value: .*whole number, 3 attempts"):
        vibrometer.signal_level()
    assert server.faults.garbled_replies == 997


def test_silence_is_given_up_in_bounded_time(server, vibrometer):
    server.faults.silent_replies = 1000
    begun = time.monotonic()
    with pytest.raises(TimedOut, match=r"no line in 0\.3 s, 3 attempts"):
        vibrometer.range()
    assert time.monotonic() - begun < 3


def test_an_unplugged_one_is_unreachable_in_bounded_time(server, vibrometer):
    server.unplug()
    begun = time.monotonic()
    with pytest.raises(Unreachable, match="is it plugged in"):
        vibrometer.range()
    assert time.monotonic() - begun < 5
    vibrometer.close()


def test_one_plugged_in_again_is_found_again(server, vibrometer):
    server.unplug()
    server.plug()
    assert vibrometer.set_range("20mm/s/V").name == "20mm/s/V"


def test_unplugged_while_it_waits_for_an_answer(server, vibrometer):
    server.faults.silent_replies = 1000
    waiting, raised = Event(), []

    def ask():
        waiting.set()
        with pytest.raises((Unreachable, TimedOut)) as caught:
            vibrometer.range()
        raised.append(caught.type)

    thread = Thread(target=ask)
    thread.start()
    assert waiting.wait(5)
    while server.faults.silent_replies == 1000:
        assert thread.is_alive()
    server.unplug()
    thread.join(10)
    assert raised == [Unreachable]


def test_where_nothing_is_connected_opening_is_unreachable(tmp_path):
    with pytest.raises(Unreachable, match="3 attempts to open"):
        PolytecVibrometer(str(tmp_path / "none"), timeout_s=0.1)


def test_a_closed_driver_stays_closed(vibrometer):
    vibrometer.close()
    vibrometer.close()
    with pytest.raises(Unreachable, match="was closed"):
        vibrometer.range()


def test_threads_do_not_mix_their_answers(server, vibrometer):
    server.head.signal_level = 0.5
    wrong = []

    def ask(question, answer):
        wrong.extend(found for _ in range(30) if (found := question()) != answer)

    threads = [
        Thread(target=ask, args=(vibrometer.signal_level, 0.5)),
        Thread(target=ask, args=(vibrometer.signal_delay_s, None)),
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20)
    assert not wrong
