"""The specimen: what the plate model is told, in SI units.

Frozen data only. Files and their units are translated at the border (`instrument.specimen_file`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, Protocol

from fitting.edges import Edges, edges_of, named
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw

Reading = Literal["relative", "absolute"]

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


class StatedSpecimen(Protocol):
    """What every specimen says, plate or not."""

    @property
    def kind(self) -> str:
        """Which structure it is: `plate`, `shear-pair`, `beam`."""

    @property
    def core(self) -> Core | None:
        """Its law is where identification starts."""

    @property
    def reads(self) -> Reading:
        """Relative to the base, or absolute."""

    @property
    def base_acceleration_m_s2(self) -> float:
        """Zero to peak."""

    @property
    def tolerances(self) -> Mapping[str, float]:
        """As named (`fitting.tolerances`)."""

    @property
    def exact(self) -> bool:
        """Everything stated is exact."""

    @property
    def modal_ratios(self) -> tuple[float, ...]:
        """Remaining viscous damping."""


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
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict)
    """Standard deviations of stated numbers (`fitting.tolerances`): relative, m or s. Not named: typical
    ones."""
    exact: bool = False
    """Everything stated is exact: a simulation of this very plate, or a published case."""
    elements: tuple[int, int] | None = None
    """Elements along x and y; None for the default mesh."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "boundary", named(self.boundary))

    @property
    def kind(self) -> str:
        """Which structure it is."""
        return "plate"

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
        return replace(self, constraining=None, core=None)

    def with_law(self, law: CoreLaw) -> "Specimen":
        """The same plate with another core law. Raises `ValueError` for a bare one."""
        if self.core is None:
            raise ValueError("a bare plate has no core to give a law to")
        return replace(self, core=replace(self.core, law=law))
