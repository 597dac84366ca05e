"""`[chamber]` of RIG.toml: what it refuses, and the device it opens."""

import pytest
from pydantic import ValidationError

from drivers.chamber.driver import ChamberOptions
from drivers.chamber.modbus_driver import ModbusTcpChamberDriver, ModbusTcpChamberOptions
from drivers.chamber.serial_driver import SerialThermometerDriver, SerialThermometerOptions
from drivers.errors import Unreachable

TABLE = {"address": "127.0.0.1:502", "temperature_register": 100, "type": "int16", "scale_c": 0.1}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"scale_c": None}, "0.1 where 235 means 23.5 °C"),
        ({"set_point_register": 100}, "100 is the temperature's own register"),
        ({"address": "nowhere"}, "nowhere"),
        ({"unit": 256}, "unit"),
    ],
)
def test_a_table_that_cannot_be_meant_is_refused(change, said):
    with pytest.raises(ValidationError, match=said):
        ModbusTcpChamberOptions.model_validate(TABLE | change)


def test_only_a_register_for_it_makes_a_chamber_of_a_thermometer():
    chamber: ChamberOptions = ModbusTcpChamberOptions.model_validate(TABLE | {"set_point_register": 300})
    assert chamber.has_set_point
    assert not ModbusTcpChamberOptions.model_validate(TABLE).has_set_point
    assert not SerialThermometerOptions(address="/dev/ttyS9").has_set_point
    assert not ChamberOptions(address="anywhere").has_set_point


def test_a_float_is_degrees_where_nothing_else_is_said():
    table = ModbusTcpChamberOptions.model_validate(TABLE | {"type": "float32", "scale_c": None})
    assert table.registers.scale_c == 1.0


def test_a_chamber_is_looked_for_at_its_address_when_it_is_first_read():
    options = ModbusTcpChamberOptions.model_validate(TABLE | {"address": "127.0.0.1:9", "unit": 7})
    chamber = ModbusTcpChamberDriver().open(options)
    with pytest.raises(Unreachable, match=r"^chamber at 127\.0\.0\.1:9 unit 7, reading temperature"):
        chamber.temperature_c()
    chamber.close()


def test_a_thermometer_is_looked_for_when_it_is_first_read(tmp_path):
    thermometer = SerialThermometerDriver().open(SerialThermometerOptions(address=str(tmp_path / "none")))
    with pytest.raises(Unreachable, match="none"):
        thermometer.temperature_c()
    thermometer.close()
