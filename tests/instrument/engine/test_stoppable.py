"""A shaker stopped for good stays so, whatever the run goes on to ask of it."""

import pytest
from engine_cases import drive_v, engine_rig, is_silent

from drivers.errors import DriverError, Refused
from drivers.shaker.modbus import ModbusShaker
from instrument.engine.stoppable import StoppableShaker
from instrument.run.at_rest import bring_to_rest, came_to_rest


@pytest.fixture
def rig(tmp_path):
    with engine_rig(tmp_path, virtual=False) as (rig, _):
        yield rig


@pytest.fixture
def shaker(rig):
    shaker = ModbusShaker.tcp(*rig.modbus.address)
    yield shaker
    shaker.close()


def drive(shaker) -> None:
    shaker.start()
    shaker.command(50.0, 0.5, 100.0)


def test_stopped_for_good_it_is_at_rest_and_refuses_to_be_driven(rig, shaker):
    run = StoppableShaker(shaker)
    drive(run)
    run.stop_for_good()
    assert is_silent(rig)
    with pytest.raises(Refused, match="for good"):
        run.start()
    with pytest.raises(Refused, match="for good"):
        run.command(50.0, 0.5, 100.0)
    run.stop()
    run.beat()
    assert not run.status().running


def test_a_start_that_was_on_its_way_leads_nowhere(rig, shaker):
    run = StoppableShaker(shaker)
    drive(run)
    run.stop_for_good()
    # What the run had sent just before arrives after the stop: the device has no latch against it.
    shaker.start()
    with pytest.raises(Refused):
        run.command(50.0, 0.5, 100.0)
    assert drive_v(rig) == 0.0
    run.stop()
    assert is_silent(rig)


def test_a_device_started_again_meanwhile_is_stopped_again(rig, shaker):
    class Restarted:
        """Started by somebody else right after the first stop."""

        stops = 0

        def stop(self) -> None:
            shaker.stop()
            self.stops += 1
            if self.stops == 1:
                drive(shaker)

        def status(self):
            return shaker.status()

    restarted = Restarted()
    bring_to_rest(restarted)
    assert restarted.stops == 2
    assert is_silent(rig)


def test_where_nobody_answers_it_says_why_and_the_run_still_cannot_drive(rig, shaker):
    run = StoppableShaker(ModbusShaker.tcp("127.0.0.1", 1, timeout_s=0.1, retries=0))
    with pytest.raises(DriverError, match="no connection"):
        run.stop_for_good()
    with pytest.raises(Refused):
        run.start()
    assert "no connection" in came_to_rest(run)
    run.close()
