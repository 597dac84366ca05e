"""`[core.law] kind = "table"`: the CSV or material card it names, read into the specimen's own document.

From then on the document holds the rows: a session needs no file beside it.
"""

import json
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, TypeVar

import numpy as np
from pydantic import BaseModel, Field, ValidationError

from fitting.arrays import Array
from fitting.laws.table import Tabulated
from instrument.errors import BadInput
from instrument.files.dma_file import read_dma
from instrument.files.file_kind import no_json
from instrument.files.text import read_text
from instrument.files.toml import one_line

COLUMNS = tuple(Tabulated.file_fields())
_INCOMPRESSIBLE = 0.4999
"""Poisson's ratio of a core that states none: rubber's."""

D = TypeVar("D", bound=BaseModel)
_Rows = tuple[Array, Array, Array]
Finite = Annotated[float, Field(allow_inf_nan=False)]


class _Row(BaseModel):
    frequency_hz: Finite
    storage_modulus_pa: Finite
    loss_factor: Finite


class _Card(BaseModel):
    law: list[_Row]


def with_rows(document: D, specimen: Path) -> D:
    """The document of a specimen's file, the rows of its law's table in it. Raises `BadInput`."""
    core = getattr(document, "core", None)
    if core is None or core.law.get("kind") != Tabulated.kind or any(k in core.law for k in COLUMNS):
        return document
    found = _read(core.law, specimen, getattr(core, "poisson", _INCOMPRESSIBLE))
    return document.model_copy(update={"core": core.model_copy(update={"law": found})})


def _read(law: Mapping[str, Any], specimen: Path, poisson: float) -> dict[str, Any]:
    said = law.get("path")
    path = specimen.parent / said if isinstance(said, str) and said else None
    if path is None or not path.exists():
        found = "missing" if said is None else f"{said!r}" + ("" if path is None else ": no such file")
        expected = f"expected a CSV with {', '.join(COLUMNS)}, or a material card"
        raise BadInput(f"{specimen}: core.law.path: {found}, {expected}")
    rows = _card_rows(path) if path.suffix.lower() == ".json" else _csv_rows(path, poisson)
    order = np.argsort(rows[0], kind="stable")
    for a, b in pairwise(order):
        if rows[0][a] == rows[0][b]:
            raise BadInput(f"{path}: frequency_hz = {rows[0][a]:g} twice, expected each once")
    columns = (column[order].tolist() for column in rows)
    return {**law, **dict(zip(COLUMNS, columns, strict=True))}


def _csv_rows(path: Path, poisson: float) -> _Rows:
    table = read_dma(path, poisson)
    warm = table.temperatures()
    if len(warm) > 1:
        raise BadInput(
            f"{path}: temperature_c: {len(warm)} temperatures ({warm[0]:g} to {warm[-1]:g}), expected one: "
            "a table of the core as it is measured"
        )
    return table.frequency_hz, table.storage_modulus_pa, table.loss_factor


def _card_rows(path: Path) -> _Rows:
    try:
        card = _Card.model_validate(json.loads(read_text(path)))
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: {no_json(path, error)}, expected a material card's JSON") from None
    except ValidationError as error:
        raise BadInput(f"{path}: expected a material card's JSON: {one_line(error)}") from None
    except RecursionError:
        raise BadInput(
            f"{path}: not JSON that can be read (too deep), expected a material card's JSON"
        ) from None
    f, G, eta = (np.array([getattr(row, name) for row in card.law]) for name in COLUMNS)
    return f, G, eta
