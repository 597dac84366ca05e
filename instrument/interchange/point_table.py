"""The points of a sweep as columns: one place that says what is exported under which name and unit."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from instrument.session.contents import Contents, TimedPoint
from instrument.session.points import sweep_of

Array = NDArray[Any]


@dataclass(frozen=True)
class Column:
    """One quantity of every point."""

    name: str
    unit: str
    """"1" for a number without one, empty for text."""
    values: Array


_FROM_POINT: tuple[tuple[str, str, str], ...] = (
    ("step", "1", "step"),
    ("purpose", "", "purpose"),
    ("settle_s", "s", "settle_s"),
    ("dwell_s", "s", "dwell_s"),
    ("drive_v", "V", "drive_v"),
    ("control_error_percent", "%", "control_error_percent"),
    ("base_distortion_percent", "%", "base_distortion_percent"),
    ("velocity_distortion_percent", "%", "velocity_distortion_percent"),
    ("range", "", "range_name"),
    ("signal_level", "1", "signal_level"),
    ("temperature_c", "degC", "temperature_c"),
)
"""Columns that `viscorig identify` does not read and keeps as they stand: name, unit, field."""


def columns(contents: Contents) -> list[Column]:
    """Those of the sweep CSV first, then what else is known of each point.

    `level_g` times the specimen's base acceleration is the commanded level, whatever that acceleration is.
    """
    points = contents.points
    reference = contents.specimen.base_acceleration_m_s2
    sweep = sweep_of(contents.measured)
    assert sweep.base_m_s2 is not None
    assert sweep.std_m_s is not None
    first = min((p.time_s for p in points), default=0.0)
    known = [
        Column("sweep", "1", sweep.sweep),
        Column("segment", "1", sweep.segment),
        Column("level_g", "1", _all(points, lambda p: p.point.level_m_s2 / reference)),
        Column("time_s", "s", _all(points, lambda p: p.time_s - first)),
        Column("frequency_hz", "Hz", sweep.frequency_hz),
        Column("velocity_re_m_s", "m/s", sweep.velocity_m_s.real),
        Column("velocity_im_m_s", "m/s", sweep.velocity_m_s.imag),
        Column("base_accel_re_m_s2", "m/s^2", sweep.base_m_s2.real),
        Column("base_accel_im_m_s2", "m/s^2", sweep.base_m_s2.imag),
        Column("velocity_std_m_s", "m/s", sweep.std_m_s),
    ]
    further = [
        Column(name, unit, _texts(points, key) if not unit else _numbers(points, key))
        for name, unit, key in _FROM_POINT
    ]
    remarks = Column("remarks", "", np.array(["; ".join(p.point.remarks) for p in points], dtype=object))
    return [*known, *further, remarks]


def _all(points: list[TimedPoint], value: Callable[[TimedPoint], float]) -> Array:
    return np.array([value(p) for p in points], dtype=float)


def _numbers(points: list[TimedPoint], key: str) -> Array:
    values = [getattr(p.point, key) for p in points]
    whole = bool(values) and all(isinstance(v, int) for v in values)
    return np.array([np.nan if v is None else v for v in values], dtype=int if whole else float)


def _texts(points: list[TimedPoint], key: str) -> Array:
    return np.array([str(getattr(p.point, key)) for p in points], dtype=object)
