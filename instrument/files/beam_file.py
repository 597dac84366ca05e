"""SPECIMEN.toml with `[beam]`."""

from typing import Any

from pydantic import Field, model_validator

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import Drive, PlacedMass, Reading
from fitting.stated.layers import Core
from fitting.structures.beam import Beam
from fitting.structures.stated_beam import Ends
from instrument.files.layer_tables import Poisson, StatedLayer, refuse_place
from instrument.files.specimen_file import (
    MOST_MASSES,
    TolerancesSection,
    law_of,
    tolerances_of,
    with_further_pickups,
)
from instrument.files.toml import NotNegative, Positive, TomlTable


class _Length(TomlTable):
    length_mm: Positive
    width_mm: Positive
    boundary: Ends
    both_sides: bool = False
    held_width: bool = False


class _Viscoelastic(TomlTable):
    thickness_mm: Positive
    poisson: Poisson
    density_kg_m3: Positive
    law: dict[str, Any]


class _Spot(TomlTable):
    x_mm: NotNegative
    y_mm: NotNegative | None = None
    """As of a plate, from a long edge; it changes nothing: a beam is read in the middle of its width."""
    reads: Reading = "relative"


class _Mass(TomlTable):
    """A known mass on the beam, in the middle of its width: an accelerometer."""

    mass_kg: Positive
    x_mm: NotNegative
    y_mm: NotNegative | None = None
    """As of a spot."""


class _Base(TomlTable):
    acceleration_m_s2: Positive = PUBLISHED_G_M_S2


class _Excitation(TomlTable):
    kind: Drive = "base"
    x_mm: NotNegative | None = None
    y_mm: NotNegative | None = None
    """As of a spot."""

    @model_validator(mode="after")
    def _placed(self) -> "_Excitation":
        if self.kind == "force" and self.x_mm is None:
            raise ValueError('kind = "force", expected x_mm of the point where it acts')
        for key, place in (("x_mm", self.x_mm), ("y_mm", self.y_mm)):
            if self.kind == "base" and place is not None:
                raise ValueError(f'{key} with kind = "base", expected kind = "force"')
        return self


class BeamDocument(TomlTable):
    """All of the file."""

    beam: _Length
    substrate: StatedLayer
    constraining: StatedLayer | None = None
    core: _Viscoelastic | None = None
    pickup: _Spot | None = None
    further_pickups: list[_Spot] | None = None
    """Of `[[pickup]]`, those after the first."""
    mass: list[_Mass] | None = Field(default=None, max_length=MOST_MASSES)
    base: _Base = _Base()
    excitation: _Excitation | None = None
    tolerances: TolerancesSection | None = None

    @model_validator(mode="before")
    @classmethod
    def _several(cls, given: Any) -> Any:
        return with_further_pickups(given)

    @model_validator(mode="before")
    @classmethod
    def _undamped(cls, given: Any) -> Any:
        if isinstance(given, dict) and "damping" in given:
            raise ValueError(
                "[damping], expected none: a beam has its metal's in [substrate], as loss_factor"
            )
        return given

    @model_validator(mode="after")
    def _whole(self) -> "BeamDocument":
        for name, layer in (("substrate", self.substrate), ("constraining", self.constraining)):
            if layer is not None and layer.young_gpa is None:
                raise ValueError(f"{name}.young_x_gpa, expected young_gpa: along the beam")
        if self.constraining is not None and self.core is None:
            raise ValueError("[core] is missing, expected one between [substrate] and [constraining]")
        if self.beam.both_sides and self.core is None:
            raise ValueError("both_sides = true, expected [core]: a layer on either side")
        if self.beam.held_width and self.beam.boundary == "free-free":
            raise ValueError('held_width = true with boundary = "free-free", expected a held end')
        self._driven()
        reach = self.beam.length_mm / (2 if self.beam.boundary == "centre-driven" else 1)
        if self.mass and self.beam.boundary == "centre-driven":
            raise ValueError(
                '[[mass]] with boundary = "centre-driven", expected none: its halves would not move alike'
            )
        placed = [("pickup", p.x_mm, p.y_mm) for p in self.pickups]
        placed += [("mass", m.x_mm, m.y_mm) for m in self.mass or ()]
        if self.force_mm is not None and self.excitation is not None:
            placed.append(("excitation", self.force_mm, self.excitation.y_mm))
        for table, *place in placed:
            sides = (("x_mm", "length_mm", reach), ("y_mm", "width_mm", self.beam.width_mm))
            for (key, own, most), at in zip(sides, place, strict=True):
                if at is not None:
                    its = f"beam.{own} = {getattr(self.beam, own):g}"
                    refuse_place(f"{table}.{key}", at, its, most, "beam")
        return self

    def _driven(self) -> None:
        if len({p.reads for p in self.pickups}) > 1:
            raise ValueError("pickups that read relative and absolute, expected one of them")
        if self.force_mm is None:
            return
        if "base" in self.model_fields_set:
            raise ValueError('[base] with [excitation] kind = "force", expected one of them')
        if self.beam.boundary == "centre-driven":
            raise ValueError(
                '[excitation] kind = "force" with boundary = "centre-driven", expected another boundary: '
                "the base drives its centre"
            )

    @property
    def pickups(self) -> list[_Spot]:
        """All of them."""
        return [] if self.pickup is None else [self.pickup, *(self.further_pickups or [])]

    @property
    def force_mm(self) -> float | None:
        """Where a force drives it; None: the base does."""
        return self.excitation.x_mm if self.excitation is not None else None

    @property
    def geometry(self) -> dict[str, object]:
        """Its own keys, where it is read, and where a force drives it."""
        places: dict[str, object] = {}
        if self.pickup is not None:
            places["pickup_x_mm"] = self.pickup.x_mm
        if self.force_mm is not None:
            places["force_x_mm"] = self.force_mm
        return self.beam.model_dump() | places

    def specimen(self) -> Beam:
        """The beam that the file describes. Raises `OutsideModel`."""
        core, c = None, self.core
        if c is not None:
            core = Core(c.thickness_mm * 1e-3, c.poisson, c.density_kg_m3, law_of(c.law))
        return Beam(
            length_m=self.beam.length_mm * 1e-3,
            width_m=self.beam.width_mm * 1e-3,
            boundary=self.beam.boundary,
            substrate=self.substrate.face(),
            constraining=self.constraining.face() if self.constraining is not None else None,
            core=core,
            both_sides=self.beam.both_sides,
            held_width=self.beam.held_width,
            pickup_m=self.pickup.x_mm * 1e-3 if self.pickup is not None else None,
            further_pickups_m=tuple(p.x_mm * 1e-3 for p in self.pickups[1:]),
            force_m=self.force_mm * 1e-3 if self.force_mm is not None else None,
            masses=tuple(PlacedMass(m.mass_kg, m.x_mm * 1e-3, 0.0) for m in self.mass or ()),
            reads=self.pickup.reads if self.pickup is not None else "relative",
            base_acceleration_m_s2=self.base.acceleration_m_s2,
            tolerances=tolerances_of(self.tolerances, "beam"),
            exact=self.tolerances is not None and self.tolerances.exact,
        )
