"""The result of `viscorig sensors`."""

from instrument.facts.result import Result


class SensorFound(Result):
    """One sensor of the file."""

    serial: str
    kind: str
    model: str
    sensitivity_mv_per_unit: float
    """Per m/s^2, N or degree Celsius."""
    calibrated: str | None
    calibrated_until: str | None
    remark: str
    """What is to be done about it; empty where its calibration holds."""


class SensorsResult(Result):
    """All of them, in the order of the file."""

    sensors: tuple[SensorFound, ...]
    remarks: int
    """How many carry one."""
