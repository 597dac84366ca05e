"""The specimen: what the plate model is told, in SI units.

Frozen data only. Files and their units are translated at the border (`instrument.files.specimen_file`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, Protocol

from fitting.edges import Edges, edges_of, named
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw

Reading = Literal["relative", "absolute"]
Drive = Literal["base", "force"]

DEFAULT_ELEMENTS = 1040
"""Elements of the default mesh: 40 x 26 on a plate of aspect 1.5."""


@dataclass(frozen=True)
class Face:
    """An elastic layer: the substrate or the constraining layer."""

    thickness_m: float
    young_pa: float
    poisson: float
    density_kg_m3: float
    loss_factor: float = 0.0


@dataclass(frozen=True)
class Core:
    """The viscoelastic layer. Its law gives G*(omega) and is where identification starts."""

    thickness_m: float
    poisson: float
    density_kg_m3: float
    law: CoreLaw


@dataclass(frozen=True)
class PlacedMass:
    """A small mass of known size that somebody has put on a plate."""

    mass_kg: float
    x_m: float
    y_m: float


class StatedSpecimen(Protocol):
    """What every specimen says, plate or not."""

    @property
    def kind(self) -> str:
        """Which structure it is: `plate`, `shear-pair`, `beam`."""

    @property
    def core(self) -> Core | None:
        """Its law is where identification starts."""

    @property
    def offers(self) -> frozenset[str]:
        """What an effect may need: `base`, one that moves; `clamp`, a clamped root."""

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
        """As named (`fitting.tolerances`)."""

    @property
    def exact(self) -> bool:
        """Everything stated is exact."""

    @property
    def modal_ratios(self) -> tuple[float, ...]:
        """Remaining viscous damping."""


class BaseDriven:
    """What a structure says that only its base can drive."""

    drive: Drive = "base"
    offers = frozenset({"base"})
    base_acceleration_m_s2: float

    @property
    def drive_amplitude(self) -> float:
        """Of the base, in m/s^2."""
        return self.base_acceleration_m_s2


@dataclass(frozen=True)
class Specimen:
    """A rectangular plate, bare (`core` and `constraining` None) or with a constrained core.

    x runs from the clamped edge, y from a long edge.
    """

    length_m: float
    width_m: float
    boundary: str
    """By name or edge by edge (`fitting.edges`); kept by its name where it has one."""
    substrate: Face
    constraining: Face | None = None
    core: Core | None = None
    modal_ratios: tuple[float, ...] = ()
    """Remaining viscous damping, fractions of critical, in frequency order (Table 3)."""
    pickup_m: tuple[float, float] | None = None
    further_pickups_m: tuple[tuple[float, float], ...] = ()
    """Spots beside the first: rows of data say which one they are of; models are of one (`at_pickup`)."""
    masses: tuple[PlacedMass, ...] = ()
    """On the constraining layer; models are of the plate without them, a joint fit puts them on."""
    force_m: tuple[float, float] | None = None
    """Where a force along w drives it, its edges at rest; None: the base does."""
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    """Standard deviations of stated numbers (`fitting.tolerances`): relative, m or s. Not named: typical
    ones."""
    exact: bool = False
    """Everything stated is exact: a simulation of this very plate, or a published case."""
    elements: tuple[int, int] | None = None
    """Elements along x and y; None for the default mesh."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "boundary", named(self.boundary))
        if self.force_m is not None:
            # Its edges are at rest: one reading is the other.
            object.__setattr__(self, "reads", "relative")

    @property
    def kind(self) -> str:
        """Which structure it is."""
        return "plate"

    @property
    def pickups_m(self) -> tuple[tuple[float, float], ...]:
        """All spots, in the order of their numbers from 0."""
        return () if self.pickup_m is None else (self.pickup_m, *self.further_pickups_m)

    def at_pickup(self, number: int) -> "Specimen":
        """The same plate read at one of its spots."""
        if not self.further_pickups_m:
            return self
        return replace(self, pickup_m=self.pickups_m[number], further_pickups_m=())

    @property
    def drive(self) -> Drive:
        """What moves it."""
        return "base" if self.force_m is None else "force"

    @property
    def drive_amplitude(self) -> float:
        """Of the base in m/s^2, or one newton."""
        return self.base_acceleration_m_s2 if self.force_m is None else 1.0

    @property
    def offers(self) -> frozenset[str]:
        """As `Stated` has it."""
        base = {"base"} if self.force_m is None else set()
        return frozenset(base | ({"clamp"} if self.boundary == "cantilever" else set()))

    @property
    def only_even(self) -> bool:
        """Whether nothing stirs motions odd in y: the base drives it, and its long edges are alike."""
        return self.force_m is None and self.edges[1] == self.edges[3]

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
    def bare(self) -> "Specimen":
        """The same plate before its damping treatment."""
        return replace(self, constraining=None, core=None, masses=())

    def with_law(self, law: CoreLaw) -> "Specimen":
        """The same plate with another core law. Raises `ValueError` for a bare one."""
        if self.core is None:
            raise ValueError("a bare plate has no core to give a law to")
        return replace(self, core=replace(self.core, law=law))
