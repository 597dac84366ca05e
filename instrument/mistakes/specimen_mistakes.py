"""Stated numbers that are right for something else: from the other end, exchanged, in another unit."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from fitting.specimen import PlateSpecimen
from fitting.stated.edges import named
from fitting.structures import AnySpecimen, Beam

_CM, _INCH = 10.0, 25.4
"""Times a length that was taken for mm."""
_UNITS = (("cm", _CM), ("inches", _INCH))
_MSI = 6.894757
"""GPa of a million psi."""

Stated = tuple[str, AnySpecimen]
Laminate = TypeVar("Laminate", PlateSpecimen, Beam)


def specimen_mistakes(specimen: AnySpecimen) -> Iterator[Stated]:
    """What seems to be stated, in a phrase, and the specimen that would be meant; the likeliest first."""
    if isinstance(specimen, PlateSpecimen):
        yield from _spots(specimen)
        yield from _sides(specimen)
        yield from _faces(specimen)
        yield from _thicknesses(specimen)
    elif isinstance(specimen, Beam):
        yield from _spot_of_beam(specimen)
        yield from _length_of_beam(specimen)
        yield from _faces(specimen)
        yield from _thicknesses(specimen)


def _spots(plate: PlateSpecimen) -> Iterator[Stated]:
    assert plate.pickup_m is not None
    (x, y), length, width = plate.pickup_m, plate.length_m, plate.width_m
    yield "pickup.x_mm is from the free end, expected from the clamp", _at(plate, length - x, y)
    if y <= width / 2:
        yield "pickup.y_mm is from the middle, expected from a long edge", _at(plate, x, width / 2 + y)
    if x <= length / 2 and y <= width / 2:
        middle = _at(plate, length / 2 + x, width / 2 + y)
        yield "the pickup is stated from the plate's middle, expected from its corner at the clamp", middle
    if y <= length and x <= width and x != y:
        yield "pickup.x_mm and pickup.y_mm are exchanged", _at(plate, y, x)


def _at(plate: PlateSpecimen, x: float, y: float) -> PlateSpecimen:
    return replace(plate, pickup_m=(x, y))


def _sides(plate: PlateSpecimen) -> Iterator[Stated]:
    assert plate.pickup_m is not None
    length, width, (x, y) = plate.length_m, plate.width_m, plate.pickup_m
    sides = replace(plate, length_m=width, width_m=length)
    held = _or_held_otherwise(plate)
    if x <= width and y <= length:
        yield f"plate.length_mm and plate.width_mm are exchanged{held if x == y else ''}", sides
    yield f"length and width are exchanged, and the pickup's with them{held}", _at(sides, y, x)
    for unit, times in _UNITS:
        other = _at(replace(plate, length_m=times * length, width_m=times * width), times * x, times * y)
        yield f"length, width and pickup are in {unit}, expected mm", other
        yield f"all lengths and thicknesses are in {unit}, expected mm", _thicker(other, times)


def _or_held_otherwise(plate: PlateSpecimen) -> str:
    """The boundary that makes the same plate as sides and pickup exchanged; empty where it is the stated one.

    Of a cantilever it is not told: of the usual plate exchanged sides are likelier.
    """
    x_0, y_0, x_1, y_1 = plate.edges
    turned = named("-".join((y_0, x_0, y_1, x_1)))
    if plate.boundary in (turned, "cantilever"):
        return ""
    return f", or plate.boundary is meant to be '{turned}'"


def _spot_of_beam(beam: Beam) -> Iterator[Stated]:
    x, force, length = beam.pickup_m, beam.force_m, beam.span_m
    if x is not None and x <= length:
        yield (
            "pickup.x_mm is from the free end, expected from the clamped one",
            replace(beam, pickup_m=length - x),
        )
    if force is not None and force <= length:
        yield "excitation.x_mm is from the other end", replace(beam, force_m=length - force)
        if x is not None and x <= length:
            both = replace(beam, force_m=length - force, pickup_m=length - x)
            yield "pickup and excitation are from the free end, expected from the clamped one", both
            yield "pickup.x_mm and excitation.x_mm are exchanged", replace(beam, force_m=x, pickup_m=force)


def _length_of_beam(beam: Beam) -> Iterator[Stated]:
    for unit, times in _UNITS:
        other = replace(
            beam,
            length_m=times * beam.length_m,
            width_m=times * beam.width_m,
            pickup_m=None if beam.pickup_m is None else times * beam.pickup_m,
            force_m=None if beam.force_m is None else times * beam.force_m,
        )
        yield f"length, width and places are in {unit}, expected mm", other
        yield f"all lengths and thicknesses are in {unit}, expected mm", _thicker(other, times)


def _thicker(one: Laminate, times: float) -> Laminate:
    """All its layers."""
    upper, core = one.constraining, one.core
    return replace(
        one,
        substrate=replace(one.substrate, thickness_m=times * one.substrate.thickness_m),
        constraining=upper and replace(upper, thickness_m=times * upper.thickness_m),
        core=core and replace(core, thickness_m=times * core.thickness_m),
    )


def _thicknesses(one: PlateSpecimen | Beam) -> Iterator[Stated]:
    """One of its faces' with the decimal point in another place; a core's modulus makes up for its own."""
    for name in ("substrate", "constraining"):
        face = getattr(one, name)
        for times, said in ((0.1, "large"), (10.0, "small")) if face is not None else ():
            other: AnySpecimen = replace(one, **{name: replace(face, thickness_m=times * face.thickness_m)})
            yield f"{name}.thickness_mm is ten times too {said}", other


def _faces(one: PlateSpecimen | Beam) -> Iterator[Stated]:
    upper, core = one.constraining, one.core
    if upper is None or core is None:
        return
    thinner = replace(one, constraining=replace(upper, thickness_m=core.thickness_m))
    exchanged = replace(thinner, core=replace(core, thickness_m=upper.thickness_m))
    yield "the thicknesses of core and constraining layer are exchanged", exchanged
    lower = replace(one.substrate, thickness_m=upper.thickness_m)
    turned = replace(one, substrate=lower, constraining=replace(upper, thickness_m=one.substrate.thickness_m))
    yield "the thicknesses of substrate and constraining layer are exchanged", turned
    stiff = replace(
        one,
        substrate=replace(one.substrate, young_pa=_MSI * one.substrate.young_pa),
        constraining=replace(upper, young_pa=_MSI * upper.young_pa),
    )
    yield "young_gpa is in millions of psi, expected GPa", stiff
