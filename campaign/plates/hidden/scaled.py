"""One number of one layer times a factor, beyond its tolerance: of plates and of beams."""

from dataclasses import Field, dataclass, replace
from typing import Any, ClassVar, Protocol, TypeVar


class _Layered(Protocol):
    """A dataclass whose layers are fields."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


_Specimen = TypeVar("_Specimen", bound=_Layered)


@dataclass(frozen=True)
class ScaledLayer:
    """The factor, and what it is of."""

    layer: ClassVar[str]
    number: ClassVar[str]
    sizes: ClassVar[tuple[float, float]]
    """How far the factor is from one, either way."""

    scale: float

    def scaled(self, true: _Specimen) -> _Specimen:
        """The specimen as it is with the effect."""
        layer = getattr(true, self.layer)
        scaled = replace(layer, **{self.number: self.scale * getattr(layer, self.number)})
        return replace(true, **{self.layer: scaled})


@dataclass(frozen=True)
class SubstrateStiffness(ScaledLayer):
    """Young's modulus of the substrate."""

    name: ClassVar[str] = "substrate_stiffness"
    layer: ClassVar[str] = "substrate"
    number: ClassVar[str] = "young_pa"
    sizes: ClassVar[tuple[float, float]] = (0.04, 0.08)


@dataclass(frozen=True)
class ConstrainingStiffness(ScaledLayer):
    """Young's modulus of the constraining layer."""

    name: ClassVar[str] = "constraining_stiffness"
    layer: ClassVar[str] = "constraining"
    number: ClassVar[str] = "young_pa"
    sizes: ClassVar[tuple[float, float]] = (0.05, 0.1)


@dataclass(frozen=True)
class ConstrainingThickness(ScaledLayer):
    """Thickness of the constraining layer."""

    name: ClassVar[str] = "constraining_thickness"
    layer: ClassVar[str] = "constraining"
    number: ClassVar[str] = "thickness_m"
    sizes: ClassVar[tuple[float, float]] = (0.05, 0.1)


@dataclass(frozen=True)
class CoreThickness(ScaledLayer):
    """Thickness of the core."""

    name: ClassVar[str] = "core_thickness"
    layer: ClassVar[str] = "core"
    number: ClassVar[str] = "thickness_m"
    sizes: ClassVar[tuple[float, float]] = (0.1, 0.15)
