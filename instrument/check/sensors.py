"""Whether the sensors' calibrations still hold."""

from collections.abc import Iterator, Sequence
from datetime import date, timedelta

from drivers.front_end.interface import Transducer
from instrument.files.rig_file import RigDocument

_SOON = timedelta(days=30)
_SAME = 0.005
"""Of a sensitivity: two calibrations of one sensor differ by so much and mean nothing."""


def sensor_remarks(rig: RigDocument, today: date) -> Iterator[str]:
    """A line for each sensor whose calibration has expired, or soon will; nothing of a simulated rig."""
    if rig.is_simulated:
        return
    for name, sensor in rig.channels.named().items():
        if sensor.calibrated is not None and sensor.calibrated > today:
            yield f"channels.{name}: calibrated on {sensor.calibrated.isoformat()}, which is still to come"
        until = sensor.valid_until
        remark = calibration_remark(until, today) if until is not None else ""
        if remark:
            which = f"channels.{name}" + (f" (serial {sensor.serial})" if sensor.serial else "")
            yield f"{which}: {remark}"


def calibration_remark(until: date, today: date) -> str:
    """Of a calibration that holds until a day; empty where there is nothing to say yet."""
    if until < today:
        return f"calibration expired on {until.isoformat()}, or say calibrated_until"
    return f"calibration expires on {until.isoformat()}" if until - today <= _SOON else ""


def memory_remarks(rig: RigDocument, found: Sequence[Transducer | None]) -> Iterator[str]:
    """A line for each sensor that says of itself, by its own memory, something else than the rig does.

    `found` is by input, from 1 on.
    """
    for name, sensor in rig.channels.named().items():
        own = found[sensor.input - 1] if sensor.input <= len(found) else None
        if own is None or name == "velocity":
            continue
        which = f"channels.{name}, input {sensor.input}"
        if sensor.serial and sensor.serial != own.serial:
            yield f"{which}: serial {sensor.serial} stated, but the sensor there is {own.type} {own.serial}"
            continue
        mv = own.mv_per_unit
        if mv is not None and abs(mv / sensor.sensitivity_mv_per_unit - 1) > _SAME:
            off = 100 * (mv / sensor.sensitivity_mv_per_unit - 1)
            yield (
                f"{which}: {sensor.sensitivity_mv_per_unit:g} mV per unit stated, but the memory of "
                f"{own.type} {own.serial} says {mv:.5g} ({off:+.1f} %): which calibration is the newer one?"
            )
