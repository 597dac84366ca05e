"""Whether the sensors' calibrations still hold."""

from collections.abc import Iterator
from datetime import date, timedelta

from instrument.files.rig_file import RigDocument

_SOON = timedelta(days=30)


def sensor_remarks(rig: RigDocument, today: date) -> Iterator[str]:
    """A line for each sensor whose calibration has expired, or soon will; nothing of a simulated rig."""
    if rig.is_simulated:
        return
    for name, sensor in rig.channels.named().items():
        until = sensor.valid_until
        if until is None:
            continue
        which = f"channels.{name}" + (f" (serial {sensor.serial})" if sensor.serial else "")
        if until < today:
            yield f"{which}: calibration expired on {until.isoformat()}, or say calibrated_until"
        elif until - today <= _SOON:
            yield f"{which}: calibration expires on {until.isoformat()}"
