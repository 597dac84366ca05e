"""What every object of this package can do: show itself in a notebook, and leave as numpy, pandas or JSON."""

import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from instrument.errors import BadInput
from instrument.facts.result import Result
from instrument.files.at_once import write_at_once
from instrument.files.replaceable import refuse_for_json
from instrument.stream.jsonable import to_jsonable

Columns = dict[str, NDArray[Any]]
"""Arrays of one length by name; each name ends with its unit."""

_ROWS = 12
"""Of a table in a notebook; longer ones are shown by their beginning and their end."""


class Shown:
    """A table of columns and some lines about it."""

    def to_numpy(self) -> Columns:
        """The table as arrays by name, units in the names. Shape (rows,) each."""
        raise NotImplementedError

    def as_dict(self) -> dict[str, Any]:
        """All facts as JSON knows them: numbers, strings, lists, objects; None for NaN."""
        raise NotImplementedError

    def lines(self) -> list[str]:
        """What there is to say, a line each; the first one is the heading."""
        raise NotImplementedError

    def to_dataframe(self) -> Any:
        """The table as a `pandas.DataFrame`. Raises `BadInput` where pandas is not installed."""
        try:
            import pandas
        except ImportError:
            raise BadInput(
                "to_dataframe() needs pandas, which is not installed: pip install 'viscorig[notebook]'"
            ) from None
        return pandas.DataFrame(self.to_numpy())

    def to_json(self, path: str | Path) -> Path:
        """Write `as_dict()` as the commands write theirs; the path. Raises `BadInput`."""
        path = Path(path)
        refuse_for_json(path)
        write_at_once(path, json.dumps(to_jsonable(self.as_dict()), indent=1, allow_nan=False) + "\n")
        return path

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.lines()[0]}>"

    def __str__(self) -> str:
        """Heading, table where there is one to print, and the rest of what there is to say."""
        heading, *rest = self.lines()
        return "\n".join([heading, *self.printed(), *rest])

    def printed(self) -> list[str]:
        """Lines of a table as a terminal shows it; none where `lines` say it all."""
        return []

    def _repr_html_(self) -> str:
        heading, *rest = (escape(line) for line in self.lines())
        said = "".join(f"<br>{line}" for line in rest)
        return f"<p><b>{heading}</b>{said}</p>{_table(self.to_numpy())}"


def columns(rows: Sequence[Result]) -> Columns:
    """Rows of a result as columns; None is NaN among numbers."""
    keys = [key for key in type(rows[0]).model_fields if key in rows[0].model_fields_set] if rows else []
    return {key: _column([getattr(row, key) for row in rows]) for key in keys}


def _column(values: list[Any]) -> NDArray[Any]:
    if any(value is None for value in values) and not any(isinstance(value, str) for value in values):
        return np.array(values, dtype=float)
    return np.array(values)


def _table(table: Columns) -> str:
    count = max((len(values) for values in table.values()), default=0)
    head = "".join(f"<th>{escape(name)}</th>" for name in table)
    half = _ROWS // 2
    shown = list(range(count)) if count <= _ROWS else [*range(half), None, *range(count - half, count)]
    body = "".join(f"<tr>{_row(table, k)}</tr>" for k in shown)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _row(table: Columns, k: int | None) -> str:
    return "".join(f"<td>{'…' if k is None else escape(_cell(values[k]))}</td>" for values in table.values())


def _cell(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, float | complex) else str(value)
