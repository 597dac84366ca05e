"""Calibrations that have expired, or soon will."""

from datetime import date

import pytest

from drivers.front_end.interface import Transducer
from instrument.check.sensors import memory_remarks, sensor_remarks
from instrument.files.new_file import TEMPLATES
from instrument.files.rig_file import RigDocument, SensorSection
from instrument.files.toml import read_document

TODAY = date(2026, 6, 15)


def rig_with(**changes):
    rig = read_document(TEMPLATES["real-rig"], RigDocument)
    base = rig.channels.base.model_copy(update={"serial": "A7", **changes})
    return rig.model_copy(update={"channels": rig.channels.model_copy(update={"base": base})})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, ""),
        ({"calibrated": date(2026, 6, 1)}, ""),
        ({"calibrated": date(2062, 6, 1)}, "channels.base: calibrated on 2062-06-01, which is still to come"),
        ({"calibrated": date(2025, 6, 1)}, "channels.base (serial A7): calibration expired on 2026-06-01"),
        ({"calibrated": date(2025, 7, 1)}, "channels.base (serial A7): calibration expires on 2026-07-01"),
        ({"calibrated": date(2024, 2, 29)}, "expired on 2025-02-28"),
        ({"calibrated": date(2025, 1, 1), "calibrated_until": date(2027, 1, 1)}, ""),
        ({"calibrated_until": date(2026, 6, 14)}, "expired on 2026-06-14"),
    ],
)
def test_a_calibration_holds_for_a_year_or_as_long_as_is_said(changes, said):
    remarks = list(sensor_remarks(rig_with(**changes), TODAY))
    assert len(remarks) == bool(said)
    assert said in " ".join(remarks)


def test_a_simulated_sensor_needs_no_calibration():
    assert list(sensor_remarks(read_document(TEMPLATES["rig"], RigDocument), date(2040, 1, 1))) == []


def test_nothing_is_known_of_a_sensor_without_a_date():
    assert SensorSection(input=1).valid_until is None


@pytest.mark.parametrize(
    ("own", "remark"),
    [
        (Transducer("4507", "A7", 10.0), None),
        (Transducer("4507", "A7", None), None),
        (
            Transducer("4507", "A7", 10.4),
            "10 mV per unit stated, but the memory of 4507 A7 says 10.4 (+4.0",
        ),
        (Transducer("4507", "B8", 10.0), "serial A7 stated, but the sensor there is 4507 B8"),
    ],
)
def test_a_sensor_that_says_something_else_of_itself_is_told_of(own, remark):
    rig = rig_with(sensitivity_mv_per_unit=10.0)
    found = [None] * 8
    found[rig.channels.base.input - 1] = own
    remarks = list(memory_remarks(rig, found))
    assert len(remarks) == (remark is not None)
    assert all(remark in one for one in remarks)
