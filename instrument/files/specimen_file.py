"""SPECIMEN.toml: its keys, units and limits, and the `PlateSpecimen` it describes."""

from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, Field, ValidationError, create_model, model_validator

from fitting.discrepancy.stiff_core import for_its_core
from fitting.errors import OutsideModel
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import LAWS, CoreLaw
from fitting.laws.table import Tabulated
from fitting.specimen import Drive, Kind, PlacedMass, PlateSpecimen, Reading
from fitting.stated.edges import named
from fitting.stated.layers import Core
from fitting.stated.tolerances import IN_FILES, OF_FEW, OF_TEMPERATURE, STATED
from fitting.structures.shear_pair import TYPICAL as OF_PAIR
from instrument.errors import BadInput
from instrument.files.law_table import with_rows
from instrument.files.layer_tables import (
    GluePart,
    PatchPart,
    Poisson,
    StatedLayer,
    refuse_patches,
    refuse_place,
)
from instrument.files.toml import NotNegative, Percent, Positive, TomlTable, one_line, read_document

Elements = Annotated[int, Field(ge=2, le=400)]


def _known(boundary: str) -> str:
    try:
        return named(boundary)
    except OutsideModel as error:
        raise ValueError(f"expected {str(error).partition('expected ')[2]}") from None


class _Plate(TomlTable):
    length_mm: Positive
    width_mm: Positive
    boundary: Annotated[str, AfterValidator(_known)]
    both_sides: bool | None = None
    """The same core and constraining layer on the other side too."""


class _Core(TomlTable):
    thickness_mm: Positive
    poisson: Poisson
    density_kg_m3: Positive
    law: dict[str, Any]


class _Damping(TomlTable):
    modal_percent: list[Percent] = Field(max_length=50)


class _Pickup(TomlTable):
    x_mm: NotNegative
    y_mm: NotNegative
    reads: Reading = "relative"


class _Mass(TomlTable):
    """A known mass that was put on the plate."""

    mass_kg: Positive
    x_mm: NotNegative
    y_mm: NotNegative


class _BaseSection(TomlTable):
    acceleration_m_s2: Positive


class _Excitation(TomlTable):
    kind: Drive = "base"
    x_mm: NotNegative | None = None
    y_mm: NotNegative | None = None

    @model_validator(mode="after")
    def _placed(self) -> "_Excitation":
        given = [n for n, v in (("x_mm", self.x_mm), ("y_mm", self.y_mm)) if v is not None]
        if self.kind == "force" and len(given) < 2:
            raise ValueError('kind = "force", expected x_mm and y_mm of the point where it acts')
        if self.kind == "base" and given:
            raise ValueError(f'{given[0]} with kind = "base", expected kind = "force"')
        return self

    @property
    def force_m(self) -> tuple[float, float] | None:
        """Where the force acts."""
        if self.x_mm is None or self.y_mm is None:
            return None
        return self.x_mm * 1e-3, self.y_mm * 1e-3


class _Mesh(TomlTable):
    elements_x: Elements
    elements_y: Elements


class TolerancesSection(TomlTable):
    """Standard deviations of what was measured or looked up; typical ones where a key is left out."""

    substrate_young_percent: NotNegative | None = None
    substrate_thickness_percent: NotNegative | None = None
    substrate_density_percent: NotNegative | None = None
    substrate_poisson_percent: NotNegative | None = None
    constraining_young_percent: NotNegative | None = None
    constraining_thickness_percent: NotNegative | None = None
    constraining_density_percent: NotNegative | None = None
    constraining_poisson_percent: NotNegative | None = None
    core_thickness_percent: NotNegative | None = None
    core_density_percent: NotNegative | None = None
    core_poisson_percent: NotNegative | None = None
    length_mm: NotNegative | None = None
    width_mm: NotNegative | None = None
    pickup_mm: NotNegative | None = None
    force_mm: NotNegative | None = None
    damping_percent: NotNegative | None = None
    gain_percent: NotNegative | None = None
    delay_us: NotNegative | None = None
    phase_deg: NotNegative | None = None
    substrate_young_per_k_percent: NotNegative | None = None
    constraining_young_per_k_percent: NotNegative | None = None
    substrate_young_y_percent: NotNegative | None = None
    substrate_shear_percent: NotNegative | None = None
    substrate_angle_deg: NotNegative | None = None
    constraining_young_y_percent: NotNegative | None = None
    constraining_shear_percent: NotNegative | None = None
    constraining_angle_deg: NotNegative | None = None
    glue_thickness_percent: NotNegative | None = None
    glue_shear_percent: NotNegative | None = None
    patch_mm: NotNegative | None = None
    cut_mm: NotNegative | None = None
    mass_percent: NotNegative | None = None
    place_mm: NotNegative | None = None
    area_percent: NotNegative | None = None
    axial_mpa: NotNegative | None = None
    exact: bool = False


_OF_LAYERS = tuple(name for name in STATED if name.startswith(("substrate", "constraining")))
_NOT_OF: dict[Kind, tuple[str, ...]] = {
    "plate": ("area", *OF_TEMPERATURE),
    "beam": ("area", *OF_FEW),
    "shear-pair": (*_OF_LAYERS, *OF_FEW, "length", "width", "pickup", "force", "place", "axial"),
}
"""Stated numbers that a kind of specimen has not."""
_MOST_PERCENT = 50.0
"""A number that uncertain is not known: it should be left to the fit, not stated."""
_MOST_PICKUPS = 20
"""A bound on what one file asks for."""
_TO_SI = {said.ending: said.to_si for said in IN_FILES.values()}
"""By the ending of a key: pads have tolerances that no plate has."""
MOST_MASSES = 10
"""Largest number of `[[mass]]` tables."""


class SpecimenDocument(TomlTable):
    """SPECIMEN.toml."""

    plate: _Plate
    substrate: StatedLayer
    constraining: StatedLayer | None = None
    core: _Core | None = None
    glue: Annotated[list[GluePart], Field(max_length=2)] | None = None
    """`[[glue]]`: thin layers beside the core."""
    patch: Annotated[list[PatchPart], Field(min_length=1, max_length=20)] | None = None
    """`[[patch]]`: where the treatment is; left out: everywhere."""
    damping: _Damping | None = None
    pickup: _Pickup | None = None
    further_pickups: list[_Pickup] | None = None
    """Of `[[pickup]]`, those after the first."""
    mass: list[_Mass] | None = Field(default=None, max_length=MOST_MASSES)
    base: _BaseSection = _BaseSection(acceleration_m_s2=PUBLISHED_G_M_S2)
    excitation: _Excitation | None = None
    mesh: _Mesh | None = None
    tolerances: TolerancesSection | None = None

    @model_validator(mode="before")
    @classmethod
    def _several(cls, given: Any) -> Any:
        return with_further_pickups(given)

    @property
    def pickups(self) -> list[_Pickup]:
        """All of them."""
        return [] if self.pickup is None else [self.pickup, *(self.further_pickups or [])]

    @property
    def force_m(self) -> tuple[float, float] | None:
        """Where a force drives it; None: the base does."""
        return self.excitation.force_m if self.excitation is not None else None

    @model_validator(mode="after")
    def _whole(self) -> "SpecimenDocument":
        if (self.core is None) != (self.constraining is None):
            missing = "constraining" if self.constraining is None else "core"
            raise ValueError(f"[{missing}] is missing, expected [core] and [constraining] both or neither")
        if self.core is None:
            for name, given in (
                ("glue", self.glue),
                ("patch", self.patch),
                ("both_sides", self.plate.both_sides),
            ):
                if given:
                    raise ValueError(f"{name} without [core] and [constraining], expected a treated plate")
        for name, face in (("substrate", self.substrate), ("constraining", self.constraining)):
            for key in ("young_percent_per_k", "young_at_c"):
                # A document that was kept has all its keys.
                if face is not None and getattr(face, key) is not None:
                    raise ValueError(
                        f"{name}.{key} of a plate, expected it of a beam: others do not count it"
                    )
        refuse_patches(self.patch or [], self.plate.length_mm, self.plate.width_mm)
        if "base" in self.model_fields_set and self.force_m is not None:
            raise ValueError('[base] with [excitation] kind = "force", expected one of them')
        if len({p.reads for p in self.pickups}) > 1:
            raise ValueError("pickups that read relative and absolute, expected one of them")
        placed = [("pickup", p) for p in self.pickups] + [("mass", m) for m in self.mass or ()]
        for table, spot in (*placed, ("excitation", self.excitation)):
            for name, own in (("x_mm", "length_mm"), ("y_mm", "width_mm")):
                at, side = getattr(spot, name, None), getattr(self.plate, own)
                if at is not None:
                    refuse_place(f"{table}.{name}", at, f"plate.{own} = {side:g}", side)
        return self


def with_further_pickups(given: Any) -> Any:
    """A document's tables, of several `[[pickup]]` the first under its name. Raises `ValueError`."""
    pickups = given.get("pickup") if isinstance(given, dict) else None
    if not isinstance(pickups, list):
        return given
    if not 0 < len(pickups) <= _MOST_PICKUPS:
        raise ValueError(f"{len(pickups)} pickups, expected 1 to {_MOST_PICKUPS}")
    return {**given, "pickup": pickups[0], "further_pickups": pickups[1:] or None}


def read_specimen(path: Path) -> PlateSpecimen:
    """Read and check a specimen. Raises `BadInput` with one line."""
    try:
        return specimen_of(read_specimen_document(path))
    except OutsideModel as error:
        raise BadInput(f"{path}: {error}") from None


def read_specimen_document(path: Path) -> SpecimenDocument:
    """A plate's document, the rows of a law's table in it. Raises `BadInput`."""
    return with_rows(read_document(path, SpecimenDocument), path)


def specimen_of(d: SpecimenDocument) -> PlateSpecimen:
    """The specimen a document describes. Raises `OutsideModel`."""
    core = None
    if d.core is not None:
        core = Core(
            d.core.thickness_mm * 1e-3,
            d.core.poisson,
            d.core.density_kg_m3,
            law_of(d.core.law),
            tuple(g.glue() for g in d.glue or ()),
        )
    plate = PlateSpecimen(
        length_m=d.plate.length_mm * 1e-3,
        width_m=d.plate.width_mm * 1e-3,
        boundary=d.plate.boundary,
        substrate=d.substrate.face(),
        constraining=d.constraining.face() if d.constraining is not None else None,
        core=core,
        modal_ratios=tuple(p / 100 for p in d.damping.modal_percent) if d.damping else (),
        pickup_m=(d.pickup.x_mm * 1e-3, d.pickup.y_mm * 1e-3) if d.pickup else None,
        further_pickups_m=tuple((p.x_mm * 1e-3, p.y_mm * 1e-3) for p in d.pickups[1:]),
        reads=d.pickup.reads if d.pickup else "relative",
        masses=tuple(PlacedMass(m.mass_kg, m.x_mm * 1e-3, m.y_mm * 1e-3) for m in d.mass or ()),
        force_m=d.force_m,
        base_acceleration_m_s2=d.base.acceleration_m_s2,
        tolerances=tolerances_of(d.tolerances),
        exact=d.tolerances is not None and d.tolerances.exact,
        elements=(d.mesh.elements_x, d.mesh.elements_y) if d.mesh else None,
        patches=tuple(p.patch() for p in d.patch or ()),
        both_sides=bool(d.plate.both_sides),
    )
    return for_its_core(plate)


def typical_tolerances(kind: Kind) -> dict[str, float | None]:
    """Keys of `[tolerances]` that a kind of specimen has, and what counts where one is left out, in its unit.

    None where that depends on what else is stated.
    """
    found: dict[str, float | None] = {}
    for key in TolerancesSection.model_fields:
        name, _, ending = key.rpartition("_")
        if key == "exact" or name in _NOT_OF[kind]:
            continue
        own = OF_PAIR.get(name) if kind == "shear-pair" else None
        typical = own if own is not None else STATED[name].typical
        found[key] = None if name in OF_TEMPERATURE else typical / _TO_SI[ending]
    return found


def tolerances_of(table: TolerancesSection | None, kind: Kind = "plate") -> dict[str, float]:
    """As named, in what `fitting.stated.tolerances` counts in; `kind` of specimen. Raises `OutsideModel`."""
    given = table.model_dump(exclude_none=True, exclude={"exact"}) if table is not None else {}
    found = {}
    for key, value in given.items():
        name, _, ending = key.rpartition("_")
        if name in _NOT_OF[kind]:
            raise OutsideModel(
                f"tolerances.{key}: a {kind} has no such number, expected the keys that its own tables have"
            )
        if ending == "percent" and value > _MOST_PERCENT:
            raise OutsideModel(
                f"tolerances.{key} = {value:g}, expected a standard deviation of at most {_MOST_PERCENT:g} %"
            )
        found[name] = value * _TO_SI[ending]
    return found


def law_of(table: dict[str, Any]) -> CoreLaw:
    """The law of `[core.law]`: `kind` decides the other keys. Raises `OutsideModel` where a key is wrong."""
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in LAWS:
        raise OutsideModel(
            f"core.law.kind: {kind!r}, {LAWS.expected(kind)}, or a package installed that adds it"
        )
    law = LAWS[kind]
    # Where rows came from says nothing any more once they are read.
    aside = ("path",) if law is Tabulated else ()
    fields: dict[str, Any] = {}
    for name, field in law.file_fields().items():
        one = Annotated[float, Field(allow_inf_nan=False)]
        is_list = law.__annotations__[name] is not float
        fields[field.file_key] = (list[one] if is_list else one, ...)
    model = create_model("core.law", __base__=TomlTable, **fields)
    try:
        given = model.model_validate({k: v for k, v in table.items() if k not in ("kind", *aside)})
    except ValidationError as error:
        raise OutsideModel(one_line(error, prefix="core.law.")) from None
    values = {}
    for name, field in law.file_fields().items():
        value = getattr(given, field.file_key)
        values[name] = (
            tuple(v * field.to_si for v in value) if isinstance(value, list) else value * field.to_si
        )
    built = law(**values)
    for objection in built.objections():
        raise OutsideModel(f"core.law: {objection}")
    return built
