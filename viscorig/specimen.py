"""The specimen: from its file, or from the same keys given in Python."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

import numpy as np
from pydantic import ValidationError

from fitting.errors import OutsideModel
from fitting.specimen import PlateSpecimen as Model
from instrument.errors import BadInput
from instrument.files.law_table import with_rows
from instrument.files.specimen_file import (
    SpecimenDocument,
    read_specimen_document,
    specimen_of,
)
from instrument.files.structure_file import read_structure
from instrument.files.toml import one_line, read_tables
from instrument.stream.jsonable import to_jsonable
from viscorig.shown import Columns, Shown


class Specimen(Shown):
    """A plate as the model is told: the tables of a SPECIMEN.toml, units in their keys.

        Specimen(
            plate={"length_mm": 300.2, "width_mm": 199.9, "boundary": "cantilever"},
            substrate={"thickness_mm": 1.9, "young_gpa": 68.9, "poisson": 0.3, "density_kg_m3": 2700.0},
            pickup={"x_mm": 60.0, "y_mm": 60.0},
        )

    Keys and units: docs/specimen.md. Raises `BadInput` naming the key that is wrong.
    """

    model: Model
    """The specimen as it is computed with: frozen, in SI units."""

    def __init__(self, **tables: Mapping[str, Any]) -> None:
        self._tables: dict[str, Any] = to_jsonable(tables)
        try:
            document = with_rows(SpecimenDocument.model_validate(self._tables), Path())
            self._keep_rows(document)
            self.model = specimen_of(document)
        except ValidationError as error:
            raise BadInput(f"specimen: {one_line(error)}") from None
        except OutsideModel as error:
            raise BadInput(f"specimen: {error}") from None

    @classmethod
    def from_file(cls, path: str | Path) -> Self:
        """Read a SPECIMEN.toml. Raises `BadInput`."""
        made = cls.__new__(cls)
        read = read_structure(Path(path))
        if not isinstance(read, Model):
            raise BadInput(f"{path}: a {read.kind}, expected a plate: here others are not taken")
        made.model = read
        made._tables = read_tables(Path(path))
        made._keep_rows(read_specimen_document(Path(path)))
        return made

    def _keep_rows(self, document: SpecimenDocument) -> None:
        """Of a law's table: where it lies holds for this folder alone."""
        if document.core is not None and "core" in self._tables:
            self._tables["core"]["law"] = dict(to_jsonable(document.core.law))

    def of(self, model: Model) -> "Specimen":
        """The specimen's tables, computed with another model: read at one of its spots."""
        made = Specimen.__new__(Specimen)
        made.model, made._tables = model, self._tables
        return made

    def but(self, **tables: Mapping[str, Any]) -> "Specimen":
        """A specimen with other values: `specimen.but(core={"thickness_mm": 0.4})`. Raises `BadInput`."""
        return Specimen(
            **{**self._tables, **{k: {**self._tables.get(k, {}), **t} for k, t in tables.items()}}
        )

    def as_dict(self) -> dict[str, Any]:
        """The tables: `Specimen(**specimen.as_dict())` is the same one."""
        return dict(to_jsonable(self._tables))

    def to_numpy(self) -> Columns:
        """Every number and word of the tables, a row each."""
        rows = list(_flat(self._tables))
        return {"key": np.array([k for k, _ in rows]), "value": np.array([v for _, v in rows], dtype=object)}

    def lines(self) -> list[str]:
        """The plate's size and its layers."""
        m = self.model
        law = (
            f", core {1e3 * m.core.thickness_m:g} mm ({m.core.law.kind})" if m.core is not None else ", bare"
        )
        return [f"{m.boundary} plate {1e3 * m.length_m:g} x {1e3 * m.width_m:g} mm{law}"]


def load_specimen(path: str | Path) -> Specimen:
    """Read a SPECIMEN.toml. Raises `BadInput` naming file, key and what is expected."""
    return Specimen.from_file(path)


def _flat(table: Mapping[str, Any], prefix: str = "") -> list[tuple[str, Any]]:
    found: list[tuple[str, Any]] = []
    for key, value in table.items():
        found += _flat(value, f"{prefix}{key}.") if isinstance(value, Mapping) else [(prefix + key, value)]
    return found
