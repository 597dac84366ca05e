"""A chamber brought to its temperature, with a rig of a few lines: what happens, and when it is over."""

from types import SimpleNamespace

import pytest

from drivers.errors import DriverError, Refused
from instrument.errors import RigStopped
from instrument.files.experiment_file import TemperatureTable
from instrument.run.control import RunControl
from instrument.run.soaking import Soaking, ask_set_point, read_temperature
from instrument.stream.raw import Held, SoakBegan, SoakEnded, TemperatureRead

RATE = 1000.0
WANTED = TemperatureTable(set_point_c=30.0, within_c=0.5, soak_s=20.0, most_s=60.0)


class Chamber:
    """Reads what it is told to, in turn, the last one again and again."""

    def __init__(self, *temperatures):
        self.temperatures, self.set_point = list(temperatures), 20.0

    def go_to(self, set_point_c):
        # As its register holds it.
        self.set_point = round(set_point_c, 1)
        return self.set_point

    def temperature_c(self):
        return self.temperatures.pop(0) if len(self.temperatures) > 1 else self.temperatures[0]

    def set_point_c(self):
        return self.set_point


class FrontEnd:
    sample_rate_hz = RATE

    def __init__(self, *, fails=False):
        self.reads, self.started, self.stopped, self.fails = [], [], 0, fails

    def start(self, channels, rate_hz):
        self.started.append(([c.name for c in channels], rate_hz))

    def read(self, samples):
        self.reads.append(samples)
        return SimpleNamespace(samples=samples)

    def stop(self):
        self.stopped += 1
        if self.fails:
            raise DriverError("no answer")


class World:
    """A rig, a control, and what was told."""

    def __init__(self, *temperatures, fails=False):
        self.chamber = Chamber(*temperatures) if temperatures else None
        self.front_end = FrontEnd(fails=fails)
        sensor = SimpleNamespace(input=1, iepe=False, range_v=10.0)
        self.rig = SimpleNamespace(
            chamber=self.chamber, front_end=self.front_end, sensors={"base": sensor}, sample_rate_hz=RATE
        )
        self.control, self.events, self.watched = RunControl(), [], 0

    def watch(self):
        self.watched += 1

    def soak(self, wanted=WANTED, watch=None):
        Soaking(self.rig, self.events.append, self.control, watch or self.watch).run(wanted)
        return self.events


def test_a_soak_ends_when_the_temperature_has_stayed_near_for_long_enough():
    world = World(20.0, 29.8, 30.2)
    began, *reads, ended = world.soak()
    assert began == SoakBegan(30.0, 0.5, 20.0, 60.0)
    assert [type(e) for e in reads] == [TemperatureRead] * 6
    assert [e.value_c for e in reads] == [20.0, 29.8, 30.2, 30.2, 30.2, 30.2]
    assert [e.soak_s for e in reads] == pytest.approx([0, 5, 10, 15, 20, 25])
    assert ended == SoakEnded(pytest.approx(25.0))
    assert world.front_end.started == [(["base"], RATE)]
    assert world.front_end.stopped == 1


def test_a_temperature_that_leaves_begins_anew():
    reads = World(30.0, 30.0, 31.0, 30.0).soak()[1:-1]
    # Near again from 15 s on: 20 s later it is done.
    assert [e.soak_s for e in reads] == pytest.approx(range(0, 40, 5))


def test_what_goes_by_is_read_in_short_blocks_and_watched():
    world = World(30.0)
    world.soak()
    assert set(world.front_end.reads) == {500}
    assert sum(world.front_end.reads) / RATE == pytest.approx(20.0)
    assert world.watched == len(world.front_end.reads)


def test_a_chamber_that_does_not_come_there_is_given_up_with_what_it_did():
    world = World(20.0, 25.0)
    with pytest.raises(
        RigStopped, match=r"chamber at 25\.0 °C after 60 s, 0 s within 0\.5 °C of 30 °C, 20 s"
    ):
        world.soak()
    assert world.front_end.stopped == 1


def test_after_a_hold_the_soak_begins_again():
    world = World(30.0)
    asked = []

    def watch():
        asked.append(0)
        if len(asked) == 12:
            world.control.hold()
        elif len(asked) == 20:
            world.control.resume()

    events = world.soak(watch=watch)
    kinds = [type(e).__name__ for e in events]
    assert kinds.count("SoakBegan") == 2
    assert kinds[kinds.index("Held") + 1] == "SoakBegan"
    assert isinstance(events[-1], SoakEnded)
    # Counted from the second beginning.
    assert events[-1] == SoakEnded(pytest.approx(20.0))
    assert Held() in events


def test_what_the_watch_stops_leaves_the_front_end_stopped_though_it_fails_itself():
    world = World(20.0, fails=True)

    def watch():
        raise RigStopped("the door is open")

    with pytest.raises(RigStopped, match="the door is open"):
        world.soak(watch=watch)
    assert world.front_end.stopped == 1


def test_a_rig_without_a_chamber_cannot_be_brought_anywhere_and_reads_nothing():
    world = World()
    with pytest.raises(RigStopped, match="no chamber to bring to 30 °C"):
        world.soak()
    assert read_temperature(world.rig) is None
    world = World(21.5)
    assert read_temperature(world.rig) == TemperatureRead(21.5, 20.0, None)


def test_a_set_point_is_asked_for_and_taken_back():
    asked = []

    class Asked(Chamber):
        def go_to(self, set_point_c):
            asked.append(set_point_c)
            return super().go_to(set_point_c)

    ask_set_point(SimpleNamespace(chamber=Asked(22.0)), WANTED)
    assert asked == [30.0, 20.0]
    ask_set_point(SimpleNamespace(chamber=Asked(22.0)), None)
    ask_set_point(SimpleNamespace(chamber=None), WANTED)
    assert asked == [30.0, 20.0]


def test_one_that_is_refused_names_the_key_and_leaves_the_old_one():
    class Small(Chamber):
        def go_to(self, set_point_c):
            if set_point_c > 25.0:
                raise Refused("chamber at X: refused")
            return super().go_to(set_point_c)

    chamber = Small(22.0)
    with pytest.raises(RigStopped, match=r"^chamber at X: refused: is temperature\.set_point_c = 30 within"):
        ask_set_point(SimpleNamespace(chamber=chamber), WANTED)
    assert chamber.set_point == 20.0
