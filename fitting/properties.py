"""What a specimen's data sheet and caliper leave uncertain, and the specimen with one of it changed."""

from dataclasses import replace
from typing import Literal, get_args

from fitting.specimen import Core, Face, Specimen

Property = Literal[
    "substrate_young",
    "substrate_thickness",
    "substrate_density",
    "constraining_young",
    "constraining_thickness",
    "constraining_density",
    "core_thickness",
    "core_density",
]
PROPERTIES: tuple[Property, ...] = get_args(Property)

_FIELDS = {"young": "young_pa", "thickness": "thickness_m", "density": "density_kg_m3"}


def with_property_scaled(specimen: Specimen, name: Property, factor: float) -> Specimen:
    """The same specimen with one property multiplied; unchanged where it has no such layer."""
    layer_name, quantity = name.split("_")
    layer: Face | Core | None = getattr(specimen, layer_name)
    if layer is None:
        return specimen
    field = _FIELDS[quantity]
    return replace(specimen, **{layer_name: replace(layer, **{field: getattr(layer, field) * factor})})  # type: ignore[arg-type]
