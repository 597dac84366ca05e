"""The stated numbers that a plate has, how well each is known, and the plate with some moved."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import exp
from typing import Any

from fitting.plate.mesh import is_turned
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face, Orthotropy
from fitting.stated.number_names import NumberName, number_name
from fitting.stated.patches import OF_PATCHES, shift_of, shifts_of
from fitting.stated.tolerances import OF_OWN_AXES, PLATE, STATED, StatedNumber

_LARGEST_POISSON = 0.4999
"""A moved number stays below one half, where a solid no longer gives in volume."""


def plate_numbers(specimen: PlateSpecimen) -> list[tuple[str, str]]:
    """Those of `PLATE` that a specimen has: name, and kind. Every patch has its own."""
    return [(name, kind) for kind in PLATE for name in _names(specimen, STATED[kind])]


def _names(specimen: PlateSpecimen, number: StatedNumber) -> list[str]:
    if number.name == "axial":
        return [f"axial_{along}" for along in specimen.pulled_along]
    if number.name in OF_PATCHES:
        return [shift.name for shift in shifts_of(specimen) if shift.kind == number.name]
    return [number.name] if _has(specimen, number) else []


def _has(specimen: PlateSpecimen, number: StatedNumber) -> bool:
    if number.layer == "glue":
        return specimen.has_glue
    if number.layer in ("constraining", "core") and specimen.core is None:
        return False
    if number.name in OF_OWN_AXES:
        own = getattr(specimen, number.layer).rolled
        # About axes that are the plate's a turn is felt to second order.
        return own is not None and (number.quantity != "angle" or is_turned(specimen))
    return True


def tolerance(specimen: PlateSpecimen, name: str) -> float:
    """Standard deviation of a stated number: named, else typical; zero for `exact`."""
    if specimen.exact:
        return 0.0
    return float(specimen.tolerances.get(name, STATED[name].typical))


def moved(specimen: PlateSpecimen, names: Sequence[str], by: Sequence[float]) -> PlateSpecimen:
    """The specimen with some of `PLATE` moved: by a share in the logarithm, metres or radians.

    What it does not have is left out. The pickup stays where it is stated, so many metres from the clamp.
    """
    moves = _Moves(specimen)
    for name, step in zip(names, by, strict=True):
        if step:
            which = number_name(name)
            _MOVED_BY.get(which.kind, _Moves.layer)(moves, which, step)
    return moves.made()


@dataclass(frozen=True)
class _Moves:
    """What becomes of a specimen, one number after the other."""

    specimen: PlateSpecimen
    plate: dict[str, Any] = field(default_factory=dict)
    """Its own fields."""
    layers: dict[str, dict[str, Any]] = field(default_factory=dict)
    """Those of its layers."""

    def made(self) -> PlateSpecimen:
        """The specimen with all of them."""
        layers = {name: replace(getattr(self.specimen, name), **own) for name, own in self.layers.items()}
        return replace(self.specimen, **layers, **self.plate) if layers or self.plate else self.specimen

    def side(self, which: NumberName, step: float) -> None:
        """The mesh is kept: its elements stretch."""
        number = which.number
        self.plate[number.field] = getattr(self.specimen, number.field) + step
        self.plate["elements"] = self.specimen.mesh

    def axial(self, which: NumberName, step: float) -> None:
        x, y = self.plate.get("axial_pa", self.specimen.axial_pa)
        self.plate["axial_pa"] = (x + step, y) if which.along == "x" else (x, y + step)

    def patch(self, which: NumberName, step: float) -> None:
        if self.specimen.patches:
            self.plate["patches"] = shift_of(which).of(self.specimen, step, self.plate.get("patches"))

    def glue(self, which: NumberName, step: float) -> None:
        """All of it by the same factor."""
        number = which.number
        if self.specimen.core is None or not self.specimen.has_glue:
            return
        core = self.layers.setdefault("core", {})
        glue = core.get("glue", self.specimen.core.glue)
        core["glue"] = tuple(replace(g, **{number.field: getattr(g, number.field) * exp(step)}) for g in glue)

    def axes(self, which: NumberName, step: float) -> None:
        """Of a face that is not the same along both."""
        number = which.number
        face: Face | None = getattr(self.specimen, number.layer)
        if face is None or face.rolled is None:
            return
        own = self.layers.setdefault(number.layer, {})
        axes: Orthotropy = own.get("rolled", face.rolled)
        value = getattr(axes, number.field)
        value = value + step if number.quantity == "angle" else value * exp(step)
        own["rolled"] = replace(axes, **{number.field: value})

    def layer(self, which: NumberName, step: float) -> None:
        number = which.number
        layer = getattr(self.specimen, number.layer)
        if layer is None:
            return
        value = getattr(layer, number.field) * exp(step)
        if number.quantity == "poisson":
            value = min(value, _LARGEST_POISSON)
        self.layers.setdefault(number.layer, {})[number.field] = value


_MOVED_BY: dict[str, Callable[[_Moves, NumberName, float], None]] = {
    "length": _Moves.side,
    "width": _Moves.side,
    "axial": _Moves.axial,
    **dict.fromkeys(OF_PATCHES, _Moves.patch),
    "glue_thickness": _Moves.glue,
    "glue_shear": _Moves.glue,
    **dict.fromkeys(OF_OWN_AXES, _Moves.axes),
}
"""How each kind is moved; those that are not here, as a number of a layer."""
