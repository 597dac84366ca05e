"""The points of a sweep as columns, as they are exported."""

from dataclasses import dataclass

from instrument.files.column import ColumnPoint, Values
from instrument.files.point_columns import exported
from instrument.session.contents import Contents


@dataclass(frozen=True)
class PointColumn:
    """One quantity, its values."""

    name: str
    unit: str
    """"1" for a number without one, empty for text."""
    values: Values


def columns(contents: Contents) -> list[PointColumn]:
    """What is known of each point.

    `level_g` times the specimen's base acceleration is the commanded level, whatever that acceleration is.
    """
    reference = contents.specimen.base_acceleration_m_s2
    first = min((p.time_s for p in contents.points), default=0.0)
    rows = [ColumnPoint(p.point, p.time_s, first, reference) for p in contents.points]
    return [PointColumn(c.name, c.unit, c.read(rows)) for c in exported() if c.read is not None]
