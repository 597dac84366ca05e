"""The stated numbers as a joint fit found them, beside what was stated."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, pi
from typing import Any

from fitting.arrays import Array
from fitting.nuisance import Nuisance
from fitting.patches import OF_PATCHES, shift_of
from fitting.specimen import Glue, Specimen, StatedSpecimen
from fitting.tolerances import ADDED


@dataclass(frozen=True)
class Adjusted:
    """One stated number; values in `unit`."""

    name: str
    stated: float
    tolerance: float
    """Standard deviation, as stated or typical."""
    found: float
    standard_error: float
    pull: float
    """(found - stated) in tolerances."""
    unit: str


_LAYERS = {
    "young": ("young_pa", 1e-9, "GPa"),
    "thickness": ("thickness_m", 1e3, "mm"),
    "density": ("density_kg_m3", 1.0, "kg/m^3"),
    "poisson": ("poisson", 1.0, "1"),
    "young_y": ("young_y_pa", 1e-9, "GPa"),
    "shear": ("shear_pa", 1e-9, "GPa"),
    "angle": ("angle_rad", 180 / pi, "deg"),
}


def adjusted(
    specimen: StatedSpecimen, each: Sequence[Nuisance], z: Array, errors: Array
) -> tuple[Adjusted, ...]:
    """`z` and its standard `errors` in standard deviations of the tolerances. Shape (count,) both."""
    return tuple(
        _one(specimen, n, float(at), float(error)) for n, at, error in zip(each, z, errors, strict=True)
    )


def _one(specimen: StatedSpecimen, n: Nuisance, z: float, error: float) -> Adjusted:
    stated, factor, unit = stated_number(specimen, n)
    if is_relative(n):
        found, sigma = stated * exp(n.sigma * z), stated * n.sigma
        spread = found * n.sigma * error
    else:
        found, sigma, spread = stated + n.sigma * z, n.sigma, n.sigma * error
    return Adjusted(n.name, factor * stated, factor * sigma, factor * found, factor * spread, z, unit)


def is_relative(n: Nuisance) -> bool:
    """Whether a number is moved in its logarithm; else by so much."""
    return n.unit == "1" and n.kind not in ADDED


def stated_number(specimen: StatedSpecimen, n: Nuisance) -> tuple[float, float, str]:
    """The number in SI, and its unit in results with the factor to it."""
    if n.stated is not None:
        return n.stated, 1.0, "Hz" if n.kind == "resonance" else "1"
    if not isinstance(specimen, Specimen):
        return specimen.stated_number(n.kind)  # type: ignore[attr-defined]
    if n.kind in ("length", "width"):
        return getattr(specimen, f"{n.kind}_m"), 1e3, "mm"
    if n.kind in ("pickup", "force"):
        place = getattr(specimen, f"{n.kind}_m")
        return place["xy".index(n.name[-1])], 1e3, "mm"
    if n.kind == "damping":
        return specimen.modal_ratios[int(n.name.split("_")[1]) - 1], 1e2, "%"
    if n.kind == "mass":
        return specimen.masses[int(n.name.split("_")[1]) - 1].mass_kg, 1e3, "g"
    if n.kind == "place":
        mass = specimen.masses[int(n.name.split("_")[1]) - 1]
        return getattr(mass, f"{n.name[-1]}_m"), 1e3, "mm"
    if n.kind == "axial":
        return specimen.axial_pa["xy".index(n.name[-1])] or 0.0, 1e-6, "MPa"
    if n.kind == "gain":
        return 1.0, 1.0, "1"
    if n.kind == "delay":
        return 0.0, 1e6, "us"
    if n.kind == "phase":
        return 0.0, 180 / pi, "deg"
    if n.kind in OF_PATCHES:
        return shift_of(n.name).stated_m(specimen), 1e3, "mm"
    layer, _, quantity = n.kind.partition("_")
    field, factor, unit = _LAYERS[quantity]
    if n.kind == "glue_shear":
        # As its file has it: glue is a hundredth of what a face is.
        factor, unit = 1e-6, "MPa"
    stated: Any = _glue(specimen) if layer == "glue" else getattr(specimen, layer)
    owner = stated if hasattr(stated, field) else stated.rolled
    return getattr(owner, field), factor, unit


def _glue(specimen: Specimen) -> Glue:
    """The first one: all are moved by the same factor."""
    assert specimen.core is not None
    return specimen.core.glue[0]
