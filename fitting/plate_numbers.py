"""The stated numbers that a plate has, how well each is known, and the plate with some moved."""

from collections.abc import Sequence
from dataclasses import replace
from math import exp
from typing import Any

from fitting.mesh import is_turned
from fitting.patches import OF_PATCHES, shift_of, shifts_of
from fitting.specimen import Face, Orthotropy, Specimen
from fitting.tolerances import PLATE, STATED

_FIELDS = {
    "young": "young_pa",
    "thickness": "thickness_m",
    "density": "density_kg_m3",
    "poisson": "poisson",
    "young_y": "young_y_pa",
    "shear": "shear_pa",
    "angle": "angle_rad",
}
_OWN_AXES = ("young_y", "shear", "angle")
"""Of an orthotropic face alone."""
_LARGEST_POISSON = 0.4999
"""A moved number stays below one half, where a solid no longer gives in volume."""


def plate_numbers(specimen: Specimen) -> list[tuple[str, str]]:
    """Those of `PLATE` that a specimen has: name, and kind. Every patch has its own."""
    found: list[tuple[str, str]] = []
    for kind in PLATE:
        layer, _, quantity = kind.partition("_")
        if kind == "axial":
            found += [(f"axial_{a}", kind) for a in specimen.pulled_along]
        elif kind in OF_PATCHES:
            found += [(shift.name, kind) for shift in shifts_of(specimen) if shift.kind == kind]
        elif layer == "glue":
            found += [(kind, kind)] if specimen.has_glue else []
        elif layer in ("constraining", "core") and specimen.core is None:
            continue
        elif quantity in _OWN_AXES:
            own = getattr(specimen, layer).rolled
            # About axes that are the plate's a turn is felt to second order.
            has = own is not None and (quantity != "angle" or is_turned(specimen))
            found += [(kind, kind)] if has else []
        else:
            found.append((kind, kind))
    return found


def tolerance(specimen: Specimen, name: str) -> float:
    """Standard deviation of a stated number: named, else typical; zero for `exact`."""
    if specimen.exact:
        return 0.0
    return float(specimen.tolerances.get(name, STATED[name].typical))


def moved(specimen: Specimen, names: Sequence[str], by: Sequence[float]) -> Specimen:
    """The specimen with some of `PLATE` moved: by a share in the logarithm, metres or radians.

    The pickup stays where it is stated, so many metres from the clamp.
    """
    changes: dict[str, dict[str, Any]] = {}
    sides: dict[str, Any] = {}
    for name, step in zip(names, by, strict=True):
        if not step:
            continue
        if name in ("length", "width"):
            # The mesh is kept: its elements stretch.
            sides |= {f"{name}_m": getattr(specimen, f"{name}_m") + step, "elements": specimen.mesh}
            continue
        layer_name, quantity = name.split("_", 1)
        if layer_name == "axial":
            x, y = sides.get("axial_pa", specimen.axial_pa)
            sides["axial_pa"] = (x + step, y) if quantity == "x" else (x, y + step)
            continue
        if layer_name in OF_PATCHES and not specimen.patches:
            continue
        if layer_name in OF_PATCHES:
            sides["patches"] = shift_of(name).of(specimen, step, sides.get("patches"))
            continue
        if layer_name == "glue" and not specimen.has_glue:
            continue
        if layer_name == "glue":
            glue = changes.get("core", {}).get(
                "glue", specimen.core.glue if specimen.core is not None else ()
            )
            field = _FIELDS[quantity]
            thicker = tuple(replace(g, **{field: getattr(g, field) * exp(step)}) for g in glue)
            changes.setdefault("core", {})["glue"] = thicker
            continue
        layer: Face | None = getattr(specimen, layer_name)
        if layer is not None and quantity in _OWN_AXES:
            axes: Orthotropy | None = changes.get(layer_name, {}).get("rolled", layer.rolled)
            if axes is None:
                continue
            field = _FIELDS[quantity]
            value = getattr(axes, field)
            other = replace(axes, **{field: value + step if quantity == "angle" else value * exp(step)})
            changes.setdefault(layer_name, {})["rolled"] = other
            continue
        if layer is not None:
            value = getattr(layer, _FIELDS[quantity]) * exp(step)
            if quantity == "poisson":
                value = min(value, _LARGEST_POISSON)
            changes.setdefault(layer_name, {})[_FIELDS[quantity]] = value
    layers = {name: replace(getattr(specimen, name), **of_layer) for name, of_layer in changes.items()}
    return replace(specimen, **layers, **sides) if layers or sides else specimen
