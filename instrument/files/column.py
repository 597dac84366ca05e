"""A column: one quantity of a measured point, its unit, how it is read and how people see it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.files.acceleration import acceleration_unit
from instrument.stream.derived import PointMeasured

Values = NDArray[Any]
Given = Literal["always", "velocity", "if known", "kept"]
"""Of a sweep CSV that is read: must be there, one of two ways to say the velocity, may be there, is kept as
it stands."""


@dataclass(frozen=True)
class ColumnPoint:
    """A point, and what it is told against."""

    point: PointMeasured
    time_s: float = np.nan
    """Since the session's first sample."""
    first_s: float = 0.0
    """Time of the first point."""
    reference_m_s2: float = PUBLISHED_G_M_S2
    """Base acceleration that `level_g` multiplies."""
    tolerance_percent: float = np.nan
    """How far a reading may be off its level, in percent of it."""


Read = Callable[[Sequence[ColumnPoint]], Values]


@dataclass(frozen=True)
class ShownQuantity:
    """A quantity as people read it."""

    label: str
    text: Callable[[ColumnPoint], str]
    tip: str = ""
    acceleration: bool = False
    """Whether the label is to say the unit in which accelerations are shown."""

    @property
    def heading(self) -> str:
        """Over a column."""
        return f"{self.label} / {acceleration_unit().under}" if self.acceleration else self.label


@dataclass(frozen=True)
class Column:
    """One quantity of a point."""

    name: str
    """In files for other programs."""
    unit: str
    """"1" for a number without one, empty for text."""
    read: Read | None = None
    """From points; None where no exported file has it."""
    field: str = ""
    """Of `PointMeasured`, and of the session file's `/points`; empty where they have no such quantity."""
    given: Given = "kept"
    above_zero: bool = False
    whole: bool = False
    identity: bool = False
    """Two rows equal in all of these are one measurement written twice."""
    unsaid: float | None = None
    """What counts where only others of a file's tables say it."""
    report: ShownQuantity | None = None
    record: ShownQuantity | None = None

    @property
    def imaginary(self) -> str:
        """Name of the other part, where this is a phasor's real one; else empty."""
        return self.name.replace("_re_", "_im_") if "_re_" in self.name else ""


def reading_std_m_s(points: Sequence[PointMeasured]) -> Array:
    """Of each part of the velocity, the base channel's noise carried over: both blur the response.

    Shape (points,).
    """
    base = np.array([p.base_m_s2 for p in points])
    velocity = np.array([p.velocity_m_s for p in points])
    base_std = np.array([p.base_accel_std_m_s2 for p in points])
    velocity_std = np.array([p.velocity_std_m_s for p in points])
    return np.asarray(np.hypot(velocity_std, np.abs(velocity / base) * base_std))


def number(value: float | None, spec: str, unit: str = "", nothing: str = "\u2013") -> str:
    """A number with its unit; a dash for none."""
    return nothing if value is None or not np.isfinite(value) else f"{value:{spec}}{unit}"


def each(value: Callable[[ColumnPoint], float]) -> Read:
    """Read point by point."""
    return lambda rows: np.array([value(r) for r in rows], dtype=float)


def numbers(field: str) -> Read:
    """Read as it stands; whole where all are."""

    def read(rows: Sequence[ColumnPoint]) -> Values:
        values = [getattr(r.point, field) for r in rows]
        whole = bool(values) and all(isinstance(v, int) for v in values)
        return np.array([np.nan if v is None else v for v in values], dtype=int if whole else float)

    return read


def texts(value: Callable[[PointMeasured], str]) -> Read:
    """Read as words."""
    return lambda rows: np.array([value(r.point) for r in rows], dtype=object)


def plain(field: str, unit: str, **more: Any) -> Column:
    """A number of the point as it stands, under one name everywhere."""
    return Column(field, unit, numbers(field), field, **more)


def said(
    label: str, field: str, spec: str, unit: str = "", tip: str = "", scale: float = 1.0
) -> ShownQuantity:
    """In the window's record."""

    def text(row: ColumnPoint) -> str:
        value = getattr(row.point, field)
        return number(None if value is None else scale * value, spec, unit)

    return ShownQuantity(label, text, tip)


def told(label: str, field: str, spec: str) -> ShownQuantity:
    """In the report's table, its unit in the heading."""
    return ShownQuantity(label, lambda row: number(getattr(row.point, field), spec, nothing="-"))
