"""Sensors are looked up by serial number; what the rig says besides must agree."""

from datetime import date

import pytest

from instrument.errors import BadInput
from instrument.files.new_file import write_new
from instrument.files.sensor_file import read_rig

SENSORS = """
[[sensor]]
serial = "4711"
kind = "accelerometer"
sensitivity = 98.0665
unit = "mV/g"
iepe = true
calibrated = 2026-03-02

[[sensor]]
serial = "88"
kind = "force"
sensitivity = 0.00225
unit = "V/N"
"""
RIG = """
sensors = "sensors.toml"
[shaker]
kind = "modbus-tcp"
address = "192.168.0.10:502"
[vibrometer]
kind = "polytec"
address = "/dev/ttyUSB0"
model = "OFV-5000"
[front_end]
kind = "lan-xi"
address = "http://192.168.0.11"
[channels.base]
input = 1
serial = "{base}"
{more}
[channels.velocity]
input = 2
[channels.force]
input = 3
serial = "88"
"""


@pytest.fixture
def rig(tmp_path):
    def written(base="4711", more="", sensors=SENSORS):
        (tmp_path / "sensors.toml").write_text(sensors)
        (tmp_path / "rig.toml").write_text(RIG.format(base=base, more=more))
        return tmp_path / "rig.toml"

    return written


def test_sensitivity_feeding_and_calibration_come_from_the_file(rig):
    channels = read_rig(rig()).channels
    # 98.0665 mV/g at 9.80665 m/s^2 to the g; 2.25 mV/N.
    assert channels.base.sensitivity_mv_per_unit == pytest.approx(10.0)
    assert channels.base.iepe
    assert channels.base.valid_until == date(2027, 3, 2)
    assert channels.force.sensitivity_mv_per_unit == pytest.approx(2.25)


def test_what_is_kept_with_a_session_names_no_file(rig):
    assert read_rig(rig()).sensors is None


def test_the_same_number_may_stand_in_both(rig):
    assert read_rig(rig(more="sensitivity_mv_per_unit = 10.0")).channels.base.iepe


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"base": "4712"}, "'4712' is not in {folder}/sensors.toml, the nearest is 4711"),
        ({"base": "88"}, "is of kind force, expected accelerometer"),
        ({"more": "sensitivity_mv_per_unit = 10.2"}, "channels.base.sensitivity_mv_per_unit: 10.2, but"),
        ({"sensors": SENSORS.replace("mV/g", "mV/N")}, "expected mV/g or mV/(m/s^2)"),
        ({"sensors": SENSORS.replace('"88"', '"4711"')}, "'4711' is there twice"),
    ],
)
def test_what_does_not_agree_is_refused_in_a_line(rig, tmp_path, changes, said):
    with pytest.raises(BadInput) as refused:
        read_rig(rig(**changes))
    assert said.format(folder=tmp_path) in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_missing_file_of_sensors_is_named(rig, tmp_path):
    path = rig()
    (tmp_path / "sensors.toml").unlink()
    with pytest.raises(BadInput, match=r"sensors\.toml: No such file"):
        read_rig(path)


def test_the_template_is_valid(tmp_path, rig):
    path = rig(base="30112").with_name("sensors.toml")
    path.unlink()
    write_new("sensors", path)
    text = path.with_name("rig.toml").read_text().replace('"88"', '"2087"')
    path.with_name("rig.toml").write_text(text)
    base = read_rig(path.with_name("rig.toml")).channels.base
    assert base.sensitivity_mv_per_unit == pytest.approx(10.0, rel=1e-3)
