"""Whose a device's table in RIG.toml is, and what is said of one that is nobody's."""

from datetime import date
from typing import Annotated

import pytest
from pydantic import BaseModel, SerializeAsAny, ValidationError

from drivers.chamber.driver import ChamberOptions
from drivers.shaker.driver import ShakerDriver, ShakerOptions
from drivers.vibrometer.driver import VibrometerOptions
from fitting.plugins import Registry
from instrument.files.devices import DEVICES, SHAKERS, by_kind, options_of, ranges_of

SHAKER = {"address": "127.0.0.1:502"}


class Rig(BaseModel):
    shaker: Annotated[SerializeAsAny[ShakerOptions], by_kind("shaker")]


class Room(BaseModel):
    chamber: Annotated[SerializeAsAny[ChamberOptions], by_kind("chamber")]


def refused(table):
    with pytest.raises(ValidationError) as error:
        Rig.model_validate({"shaker": table})
    return [(fault["loc"], fault["msg"]) for fault in error.value.errors()]


def test_a_table_is_read_by_the_driver_of_its_kind_the_usual_one_where_none_is_named():
    assert type(Rig(shaker=SHAKER).shaker) is options_of("shaker", "modbus-tcp") is options_of("shaker", None)
    serial = Rig(shaker={"kind": "modbus-rtu", "address": "/dev/ttyUSB1"}).shaker
    assert type(serial) is options_of("shaker", "modbus-rtu") is not options_of("shaker", None)
    assert Rig(shaker=serial).shaker is serial


def test_a_kind_that_nobody_has_is_refused_with_those_there_are():
    ((place, said),) = refused({**SHAKER, "kind": "steam"})
    assert place == ("shaker", "kind")
    assert said == "expected one of modbus-rtu, modbus-tcp"
    assert options_of("shaker", "steam") is None
    assert options_of("shaker", 3) is None


def test_every_key_of_a_table_that_is_wrong_has_a_line_of_its_own():
    places = [place for place, _ in refused({"address": 5, "colour": "red"})]
    assert ("shaker", "address") in places
    assert ("shaker", "colour") in places


def test_what_is_no_table_is_refused():
    ((place, said),) = refused("127.0.0.1:502")
    assert place == ("shaker",)
    assert "expected a table" in said


def test_a_session_s_json_gives_back_the_table_of_its_kind():
    for rig in (Rig(shaker=SHAKER), Rig(shaker={"kind": "modbus-rtu", "address": "/dev/ttyUSB1"})):
        again = Rig.model_validate_json(rig.model_dump_json())
        assert again == rig
        assert type(again.shaker) is type(rig.shaker)
    keys = {"address": "a:1", "temperature_register": 100, "type": "int16", "scale_c": 0.1}
    room = Room(chamber=keys)
    assert Room.model_validate_json(room.model_dump_json()) == room


OF_STEAM = """
from datetime import date
from typing import Literal
from drivers.shaker.driver import ShakerDriver, ShakerOptions

class Steam(ShakerOptions):
    kind: Literal["steam"] = "steam"
    descaled: date
    valves: tuple[int, ...]

class driver(ShakerDriver):
    options = Steam
    def open(self, *_): ...
"""


def test_a_session_s_json_gives_back_dates_and_tuples_of_another_package_s_table(package, monkeypatch):
    package("own-shaker", OF_STEAM, shakers={"steam": "driver"})
    monkeypatch.setitem(DEVICES, "shaker", Registry(SHAKERS.group, SHAKERS._own, SHAKERS._judge))
    rig = Rig(shaker={"kind": "steam", **SHAKER, "descaled": date(2026, 1, 15), "valves": (1, 3)})
    assert Rig.model_validate_json(rig.model_dump_json()) == rig


def test_every_device_has_a_usual_kind_whose_driver_is_there():
    for device, registry in DEVICES.items():
        usual = options_of(device, None)
        assert usual is not None
        assert usual in {registry[kind].options for kind in registry}


def test_the_ranges_of_a_laser_are_its_own_from_the_most_sensitive_on():
    options = options_of("vibrometer", "polytec")
    table = options.model_validate({"kind": "polytec", "address": "simulated", "model": "OFV-5000"})
    assert isinstance(table, VibrometerOptions)
    full = [r.full_scale_m_s for r in ranges_of(table)]
    assert full == sorted(full)
    assert len(full) > 3


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("driver = 3", "3 is no class derived from drivers.shaker.driver.ShakerDriver"),
        (
            "from drivers.shaker.driver import ShakerDriver\n"
            "class driver(ShakerDriver):\n    options = int\n    def open(self, *_): ...",
            "its options are no model derived from drivers.shaker.driver.ShakerOptions",
        ),
    ],
)
def test_another_package_s_driver_that_is_none_is_refused_with_why(package, monkeypatch, text, said):
    package("own-shaker", text, shakers={"steam": "driver"})
    monkeypatch.setitem(DEVICES, "shaker", Registry(SHAKERS.group, SHAKERS._own, SHAKERS._judge))
    assert isinstance(DEVICES["shaker"]["modbus-tcp"], ShakerDriver)
    ((_, message),) = refused({**SHAKER, "kind": "steam"})
    assert said in message
