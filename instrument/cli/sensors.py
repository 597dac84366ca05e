"""`viscorig sensors`: the laboratory's sensors and their calibrations."""

from datetime import UTC, datetime
from pathlib import Path

import click

from instrument.check.sensors import calibration_remark
from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.facts.sensors import SensorFound, SensorsResult
from instrument.files.sensor_file import read_sensors


@click.command()
@file_argument("sensors")
@json_option
def sensors(sensors: Path, json_path: str | None) -> None:
    """The sensors of SENSORS.toml, and whose calibration has expired or soon will.

    `viscorig new sensors` writes a commented file; one is added by a table of its own.
    """
    out = Output(json_path)
    today = datetime.now(UTC).date()
    found = []
    for one in read_sensors(sensors):
        until = one.valid_until
        found.append(
            SensorFound(
                serial=one.serial,
                kind=one.kind,
                model=one.model,
                sensitivity_mv_per_unit=one.mv_per_unit(),
                calibrated=one.calibrated.isoformat() if one.calibrated else None,
                calibrated_until=until.isoformat() if until else None,
                remark=calibration_remark(until, today) if until else "no calibration stated",
            )
        )
    remarks = sum(bool(s.remark) for s in found)
    columns = ["serial", "kind", "model", "mV per m/s^2, N, degC", "calibrated", "until", "remark"]
    rows = [
        [
            s.serial, s.kind, s.model or "-", f"{s.sensitivity_mv_per_unit:.6g}",
            s.calibrated or "-", s.calibrated_until or "-", s.remark or "-",
        ]
        for s in found
    ]  # fmt: skip
    out.table(f"{len(found)} sensors", columns, rows)
    out.say(f"{remarks} with remarks" if remarks else "every calibration holds")
    out.result(SensorsResult(sensors=tuple(found), remarks=remarks))
