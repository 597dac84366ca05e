"""SPECIMEN.toml of any structure: `[plate]`, `[beam]`, `[shear-pair]`; which table it holds decides."""

import tomllib
from collections.abc import Collection
from pathlib import Path
from typing import Any

from pydantic import ConfigDict, Field, model_validator

from fitting.errors import OutsideModel
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import Kind, Reading
from fitting.stated.layers import Core
from fitting.structures import AnySpecimen
from fitting.structures.shear_pair import MOST_BY_EDGES, ShearPair, disc
from instrument.errors import BadInput
from instrument.files.beam_file import BeamDocument
from instrument.files.file_kind import refuse_another
from instrument.files.law_table import with_rows
from instrument.files.specimen_file import (
    SpecimenDocument,
    TolerancesSection,
    law_of,
    specimen_of,
    tolerances_of,
)
from instrument.files.toml import NotNegative, Positive, TomlTable, read_document, read_tables

_RUBBER = 0.4999
"""Poisson's ratio of a pad; nothing depends on it."""


class _Disc(TomlTable):
    mass_kg: Positive
    discs: int = Field(ge=1, le=100)
    thickness_mm: Positive
    outer_diameter_mm: Positive | None = None
    inner_diameter_mm: NotNegative | None = None
    area_mm2: Positive | None = None
    bending: bool = False
    edges: bool = False

    @model_validator(mode="after")
    def _shaped(self) -> "_Disc":
        if (self.outer_diameter_mm is None) == (self.area_mm2 is None):
            raise ValueError("expected outer_diameter_mm (and inner_diameter_mm) or area_mm2, one of them")
        if self.inner_diameter_mm is not None and self.outer_diameter_mm is None:
            raise ValueError("inner_diameter_mm without outer_diameter_mm, expected both")
        inner = self.inner_diameter_mm or 0.0
        if self.outer_diameter_mm is not None and inner >= self.outer_diameter_mm:
            raise ValueError(
                f"inner_diameter_mm = {inner:g}, expected less than outer_diameter_mm = "
                f"{self.outer_diameter_mm:g}"
            )
        for name in ("bending", "edges"):
            if getattr(self, name) and self.outer_diameter_mm is None:
                raise ValueError(f"{name} = true with area_mm2, expected the discs' diameters")
        if self.bending and self.edges:
            raise ValueError(
                "bending = true and edges = true, expected one: bending is in what edges give way"
            )
        return self


class _Rubber(TomlTable):
    density_kg_m3: Positive
    law: dict[str, Any]


class _Reads(TomlTable):
    reads: Reading = "absolute"


class _PairBase(TomlTable):
    acceleration_m_s2: Positive = PUBLISHED_G_M_S2


class _PairTolerances(TolerancesSection):
    thickness_percent: NotNegative | None = None


class ShearPairDocument(TomlTable):
    """SPECIMEN.toml with `[shear-pair]`."""

    # Kept in a session under the key of the file.
    model_config = ConfigDict(serialize_by_alias=True)

    pair: _Disc = Field(alias="shear-pair")
    core: _Rubber
    pickup: _Reads = _Reads()
    base: _PairBase = _PairBase()
    tolerances: _PairTolerances | None = None

    @property
    def geometry(self) -> dict[str, object]:
        """Its own keys, those that are there."""
        return self.pair.model_dump(exclude_none=True)

    def specimen(self) -> ShearPair:
        """The shear pair that the file describes. Raises `OutsideModel`."""
        p = self.pair
        if p.outer_diameter_mm is not None:
            area, gyration = disc(p.outer_diameter_mm * 1e-3, (p.inner_diameter_mm or 0.0) * 1e-3)
        else:
            assert p.area_mm2 is not None
            area, gyration = p.area_mm2 * 1e-6, None
        named = tolerances_of(self.tolerances, "shear-pair")
        if "thickness" in named:
            # Of the only layer there is.
            named.setdefault("core_thickness", named["thickness"])
            del named["thickness"]
        found = ShearPair(
            mass_kg=p.mass_kg,
            discs=p.discs,
            area_m2=area,
            core=Core(p.thickness_mm * 1e-3, _RUBBER, self.core.density_kg_m3, law_of(self.core.law)),
            gyration_m=gyration,
            bending=p.bending,
            edges=p.edges,
            reads=self.pickup.reads,
            base_acceleration_m_s2=self.base.acceleration_m_s2,
            tolerances=named,
            exact=self.tolerances is not None and self.tolerances.exact,
        )
        if found.edges and found.softer_by_edges > MOST_BY_EDGES:
            raise OutsideModel(
                f"[shear-pair] edges = true with discs {p.thickness_mm:g} mm thick: their edges would take "
                f"{100 * found.softer_by_edges:.0f} % of the stiffness, expected at most "
                f"{100 * MOST_BY_EDGES:.0f} % (thinner discs)"
            )
        return found


AnyDocument = SpecimenDocument | BeamDocument | ShearPairDocument
"""What a specimen file may hold."""

_CURE = "a specimen file (viscorig new plate)"

_DOCUMENTS: dict[Kind, type[ShearPairDocument] | type[BeamDocument]] = {
    "shear-pair": ShearPairDocument,
    "beam": BeamDocument,
}


def document_type(tables: Collection[str]) -> type[AnyDocument]:
    """By the tables that a file has; a plate's where none says what it is."""
    return next((model for name, model in _DOCUMENTS.items() if name in tables), SpecimenDocument)


def read_structure(path: Path) -> AnySpecimen:
    """Read and check a specimen of any kind. Raises `BadInput` with one line."""
    try:
        return described(read_structure_document(path))
    except OutsideModel as error:
        raise BadInput(f"{path}: {error}") from None


def read_structure_document(path: Path) -> AnyDocument:
    """The document of a specimen of any kind, the rows of a law's table in it. Raises `BadInput`."""
    tables = _tables(path) if not path.is_dir() else {}
    named = tables.get("specimen")
    cure = f"a specimen: it names {named}" if isinstance(named, str) else _CURE
    refuse_another(path, "a specimen", cure)
    kinds = [name for name in ("plate", *_DOCUMENTS) if name in tables]
    if len(kinds) > 1:
        raise BadInput(f"{path}: [{kinds[0]}] and [{kinds[1]}], expected one of them")
    return with_rows(read_document(path, document_type(tables)), path)


def described(document: AnyDocument) -> AnySpecimen:
    """The specimen a document describes. Raises `OutsideModel`."""
    if isinstance(document, SpecimenDocument):
        return specimen_of(document)
    return document.specimen()


def _tables(path: Path) -> dict[str, Any]:
    try:
        return read_tables(path)
    except (tomllib.TOMLDecodeError, RecursionError, ValueError):
        # What is wrong with it is said where it is read.
        return {}
