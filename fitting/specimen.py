"""The specimen: what the plate model is told, in SI units.

Frozen data only. Files and their units are translated at the border (`instrument.files.specimen_file`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Generic, Literal, Protocol, Self, TypeVar, get_args

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw
from fitting.stated.edges import Edges, edges_of, named
from fitting.stated.layers import Core, Face, Glue, Orthotropy
from fitting.stated.number_names import NumberName, number_name
from fitting.stated.patches import OF_PATCHES, Patch, shift_of
from fitting.stated.tolerances import OF_OWN_AXES, StatedNumber, StatedValue, of_scope

Kind = Literal["plate", "beam", "shear-pair"]
"""Which structure a specimen is. What another one needs: CONTRIBUTING.md."""
KINDS: tuple[Kind, ...] = get_args(Kind)
Reading = Literal["relative", "absolute"]
Drive = Literal["base", "force"]
Point = TypeVar("Point")
"""A point in m: of a plate x and y, of a beam x."""

OF_DRIVE_AND_READING = of_scope("file", "spot", "channel", "chain")
"""Tolerances that are not of the plate itself."""
DEFAULT_ELEMENTS = 1040
"""Elements of the default mesh: 40 x 26 on a plate of aspect 1.5."""
_ALIKE = 1e-7
"""Of an area, what rounding makes of halves that are alike."""


@dataclass(frozen=True)
class PlacedMass:
    """A small mass of known size that somebody has put on a plate."""

    mass_kg: float
    x_m: float
    y_m: float


class StatedSpecimen(Protocol):
    """What every specimen says, plate or not."""

    @property
    def kind(self) -> Kind:
        """Which structure it is."""

    @property
    def core(self) -> Core | None:
        """Its law is where identification starts."""

    @property
    def offers(self) -> frozenset[str]:
        """What an effect may need: `base`, one that moves, or a `force`; `clamp`, a clamped root."""

    @property
    def reads(self) -> Reading:
        """Relative to the base, or absolute."""

    @property
    def drive(self) -> Drive:
        """What moves it: its base, or a force at a point."""

    @property
    def drive_amplitude(self) -> float:
        """Zero to peak, that readings are told for: m/s^2 of the base, or newtons."""

    @property
    def tolerances(self) -> Mapping[str, float]:
        """Stated tolerances by the names of `fitting.stated.tolerances`."""

    @property
    def exact(self) -> bool:
        """Everything stated is exact."""

    @property
    def modal_ratios(self) -> tuple[float, ...]:
        """Remaining viscous damping."""

    @property
    def carried_kg(self) -> float | None:
        """Of a shear pair: what its pads carry, as stated. None of what has a length."""

    def stated_number(self, name: str) -> StatedValue:
        """What is stated of one number, named as results list it: `pickup_x`."""


class BaseDriven:
    """What a structure says that only its base can drive."""

    drive: Drive = "base"
    offers = frozenset({"base"})
    base_acceleration_m_s2: float

    @property
    def drive_amplitude(self) -> float:
        """Of the base, in m/s^2."""
        return self.base_acceleration_m_s2


class Driven(Generic[Point]):
    """What a structure says that its base drives, or a force at a point, and that is read at spots."""

    force_m: Point | None
    """Where; None: the base does."""
    base_acceleration_m_s2: float
    carried_kg: ClassVar[None] = None
    pickup_m: Point | None
    further_pickups_m: tuple[Point, ...]
    __dataclass_fields__: ClassVar[dict[str, Any]]
    """Those who derive from it are dataclasses."""

    @property
    def drive(self) -> Drive:
        """What moves the specimen: its base, or a force at a point."""
        return "base" if self.force_m is None else "force"

    @property
    def drive_amplitude(self) -> float:
        """Of the base in m/s^2, or one newton."""
        return self.base_acceleration_m_s2 if self.force_m is None else 1.0

    @property
    def pickups_m(self) -> tuple[Point, ...]:
        """All spots, in the order of their numbers from 0."""
        return () if self.pickup_m is None else (self.pickup_m, *self.further_pickups_m)

    def at_pickup(self, number: int) -> Self:
        """Itself as one of its spots reads it: `pickup_m` alone is left."""
        if not self.further_pickups_m:
            return self
        return replace(self, pickup_m=self.pickups_m[number], further_pickups_m=())


@dataclass(frozen=True)
class PlateSpecimen(Driven[tuple[float, float]]):
    """A rectangular plate, bare (`core` and `constraining` None) or with a constrained core.

    x runs from the clamped edge, y from a long edge.
    """

    length_m: float
    width_m: float
    boundary: str
    """By name or edge by edge (`fitting.stated.edges`); kept by its name where it has one."""
    substrate: Face
    constraining: Face | None = None
    core: Core | None = None
    modal_ratios: tuple[float, ...] = ()
    """Remaining viscous damping, fractions of critical, in frequency order (Table 3)."""
    pickup_m: tuple[float, float] | None = None
    further_pickups_m: tuple[tuple[float, float], ...] = ()
    """Spots beside the first: rows of data say which one they are of (`at_pickup`); a model read at the first
    serves them too, and a force there."""
    masses: tuple[PlacedMass, ...] = ()
    """On the constraining layer; models are of the plate without them, a joint fit puts them on."""
    force_m: tuple[float, float] | None = None
    """Where a force along w drives it, its edges at rest; None: the base does."""
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    """Standard deviations of stated numbers (`fitting.stated.tolerances`): relative, m or s. Not named:
    typical ones."""
    exact: bool = False
    """Everything stated is exact: a simulation of this very plate, or a published case."""
    elements: tuple[int, int] | None = None
    """Elements along x and y; None for the default mesh."""
    patches: tuple[Patch, ...] = ()
    """Where core and constraining layer are; none: everywhere."""
    both_sides: bool = False
    """The same treatment on the other side too: in bending the substrate's middle then does not stretch."""
    axial_pa: tuple[float | None, float | None] = (None, None)
    """Stress in its faces along x and along y; zero is filled in where clamps on opposite edges may pull."""
    faces_shear: bool = False
    """Whether it is counted that the core shears its faces (`fitting.plate.face_shear`)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "boundary", named(self.boundary))
        held = [edge == "clamped" for edge in self.edges]
        between = zip(self.axial_pa, held[:2], held[2:], strict=True)
        pulled = tuple(0.0 if stress is None and a and b else stress for stress, a, b in between)
        object.__setattr__(self, "axial_pa", pulled)
        if self.force_m is not None:
            # A force leaves the edges at rest: relative and absolute readings agree.
            object.__setattr__(self, "reads", "relative")

    @property
    def kind(self) -> Kind:
        """Which structure it is."""
        return "plate"

    @property
    def offers(self) -> frozenset[str]:
        """As `StatedSpecimen` has it; `one side`: treated on one alone, `whole`: and all over it.

        `root`: one clamped edge alone, both sides of the axis alike; `isotropic substrate`.
        """
        found = {"base"} if self.force_m is None else {"force"}
        if "clamped" in self.edges:
            found.add("clamp")
        if self.boundary == "cantilever" and self.mirrored:
            found.add("root")
        if self.pulled_along:
            found.add("two clamps")
        if not self.both_sides:
            found |= {"one side"} if self.patches else {"one side", "whole"}
        if self.substrate.rolled is None:
            found.add("isotropic substrate")
        return frozenset(found)

    @property
    def pulled_along(self) -> tuple[Literal["x", "y"], ...]:
        """Where clamps on opposite edges may pull it."""
        along: tuple[Literal["x", "y"], ...] = ("x", "y")
        return tuple(a for a, stress in zip(along, self.axial_pa, strict=True) if stress is not None)

    @property
    def pulled_thickness_m(self) -> float:
        """Of what the stress is in: its faces, of a plate with patches the substrate."""
        c, own = self.constraining, self.substrate.thickness_m
        return own if c is None or self.patches else own + (2 if self.both_sides else 1) * c.thickness_m

    @property
    def mirrored(self) -> bool:
        """Whether layers and patches are alike on both sides of the plate's axis."""
        faces = (f for f in (self.substrate, self.constraining) if f is not None)
        if any(f.rolled is not None and not f.rolled.aligned for f in faces):
            return False
        if not self.patches:
            return True
        B = self.width_m
        seen = [Patch(p.from_x_m, p.to_x_m, B - p.to_y_m, B - p.from_y_m) for p in self.patches]
        # Patches do not overlap: what is treated on both sides of the axis is all of it, or not.
        common = sum(p.common_m2(q) for p in self.patches for q in seen)
        return common > self.treated_m2 * (1 - _ALIKE)

    @property
    def alike_in_y(self) -> bool:
        """Whether motions even and odd in y do not couple: long edges and what is between them are alike."""
        return self.edges[1] == self.edges[3] and self.mirrored

    @property
    def only_even(self) -> bool:
        """Whether nothing stirs motions odd in y: the base drives it, and both its halves are alike."""
        return self.force_m is None and self.alike_in_y

    @property
    def lacks_edge_twist(self) -> bool:
        """Whether its stiffness has what free edges lack in twist (`Plate.edge_twist`).

        A bare plate in its clamp has not: a hammer test's fit takes it off each mode, and doubts it.
        """
        return self.core is not None or not self.only_even

    @property
    def treated_m2(self) -> float:
        """Area that is treated, of one side."""
        if not self.patches:
            return self.length_m * self.width_m
        return sum((p.to_x_m - p.from_x_m) * (p.to_y_m - p.from_y_m) for p in self.patches)

    @property
    def apart_m(self) -> float:
        """Between the middles of the faces; zero for a bare plate."""
        if self.core is None or self.constraining is None:
            return 0.0
        return self.core.between_faces_m + (self.substrate.thickness_m + self.constraining.thickness_m) / 2

    @property
    def has_glue(self) -> bool:
        """Whether glue takes part in the slip."""
        return self.core is not None and bool(self.core.glue)

    @property
    def slips(self) -> bool:
        """Whether anything slips beside the core: glue, or faces that shear."""
        return self.has_glue or (self.core is not None and self.faces_shear)

    @property
    def edges(self) -> Edges:
        """How each edge is held."""
        return edges_of(self.boundary)

    @property
    def mesh(self) -> tuple[int, int]:
        """Elements along x and y, nearly square and about `DEFAULT_ELEMENTS` in all by default."""
        if self.elements is not None:
            return self.elements
        along_x = (DEFAULT_ELEMENTS * self.length_m / self.width_m) ** 0.5
        n_x = max(8, round(along_x))
        n_y = max(8, round(DEFAULT_ELEMENTS / along_x))
        return n_x, n_y

    @property
    def as_it_stands(self) -> "PlateSpecimen":
        """The plate on its edges, masses and all, whatever drives it and wherever it is read."""
        stated = {name: size for name, size in self.tolerances.items() if name not in OF_DRIVE_AND_READING}
        at_rest = replace(self, force_m=None, pickup_m=None, further_pickups_m=(), tolerances=stated)
        return replace(at_rest, reads="relative", base_acceleration_m_s2=PUBLISHED_G_M_S2)

    @property
    def bare(self) -> "PlateSpecimen":
        """The plate before its damping treatment."""
        return replace(
            self, constraining=None, core=None, patches=(), both_sides=False, masses=(), faces_shear=False
        )

    def with_law(self, law: CoreLaw) -> "PlateSpecimen":
        """The plate with another core law. Raises `ValueError` for a bare one."""
        if self.core is None:
            raise ValueError("a bare plate has no core to give a law to")
        return replace(self, core=replace(self.core, law=law))

    def stated_number(self, name: str) -> StatedValue:
        """As `StatedSpecimen` has it; of glue the first layer's, as all are moved by the same factor."""
        which = number_name(name)
        return which.number.valued(self._stated_si(which))

    def _stated_si(self, which: NumberName) -> float:
        number = which.number
        if number.unstated is not None:
            return number.unstated
        if number.name in OF_PATCHES:
            return shift_of(which).stated_m(self)
        match number.name:
            case "length" | "width":
                return float(getattr(self, number.field))
            case "pickup" | "force":
                return float(getattr(self, number.field)[which.axis])
            case "axial":
                return self.axial_pa[which.axis] or 0.0
            case "damping":
                return self.modal_ratios[which.item]
            case "mass":
                return self.masses[which.item].mass_kg
            case "place":
                mass = self.masses[which.item]
                return float((mass.x_m, mass.y_m)[which.axis])
            case _:
                return float(getattr(self._layer(number), number.field))

    def _layer(self, number: StatedNumber) -> Face | Core | Glue | Orthotropy | None:
        """The layer that holds a stated number; None where the specimen has none."""
        if number.layer == "glue":
            return self.core.glue[0] if self.core is not None else None
        layer: Face | Core | None = getattr(self, number.layer)
        return layer.rolled if number.name in OF_OWN_AXES and isinstance(layer, Face) else layer
