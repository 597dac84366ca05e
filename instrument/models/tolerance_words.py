"""The tolerances that a specimen's numbers are taken with: named in its file, typical, or none at all."""

from math import pi

from fitting.plate.plate_numbers import plate_numbers, tolerance
from fitting.specimen import Specimen
from fitting.stated.tolerances import OF_CHANNELS, OF_TEMPERATURE, PLATE, STATED
from fitting.structures import AnySpecimen
from instrument.facts.check import ToleranceUsed

_UNITS = {
    "1": ("percent", "%", 1e2),
    "m": ("mm", "mm", 1e3),
    "s": ("us", "µs", 1e6),
    "rad": ("deg", "°", 180 / pi),
    "1/K": ("percent", "%/K", 1e2),
    "Pa": ("mpa", "MPa", 1e-6),
}
"""Ending of the file's key, unit for people, factor."""
_NOT_OF_A_SWEEP = ("mass", "place", "area")
"""Of masses put on a plate, or of a shear pair's disc: no scope, but not of a plate by itself."""


def asked(specimen: AnySpecimen) -> list[str]:
    """Kinds of stated numbers that a sweep of this specimen can feel."""
    if not isinstance(specimen, Specimen):
        # What a theory leaves open nobody states.
        return [*(n for n in specimen.numbers if n in STATED), *specimen.places, *OF_CHANNELS]
    of_plate = {kind for _, kind in plate_numbers(specimen)}
    unfelt: tuple[str, ...] = (*_NOT_OF_A_SWEEP, *OF_TEMPERATURE)
    if specimen.force_m is None:
        unfelt = (*unfelt, "force")
    return [name for name in STATED if name not in unfelt and (name not in PLATE or name in of_plate)]


def not_named(specimen: AnySpecimen) -> list[str]:
    """Those of them whose tolerance is a typical one; none of an exact specimen."""
    return [] if specimen.exact else [name for name in asked(specimen) if name not in specimen.tolerances]


def tolerances_used(specimen: AnySpecimen) -> tuple[ToleranceUsed, ...]:
    """Every tolerance under the file's key; empty for an exact specimen."""
    if specimen.exact:
        return ()
    return tuple(
        ToleranceUsed(
            name=f"{name}_{_UNITS[STATED[name].unit][0]}",
            value=_tolerance(specimen, name) * _UNITS[STATED[name].unit][2],
            source="named" if name in specimen.tolerances else "typical",
        )
        for name in asked(specimen)
    )


def tolerance_rows(specimen: AnySpecimen) -> list[tuple[str, str]]:
    """Name and value, marked where it is typical; one row for an exact specimen."""
    if specimen.exact:
        return [("all stated numbers", "exact")]
    rows = []
    for name in asked(specimen):
        _, unit, factor = _UNITS[STATED[name].unit]
        value = f"{_tolerance(specimen, name) * factor:.3g} {unit}"
        rows.append((name.replace("_", " "), value + ("" if name in specimen.tolerances else " (typical)")))
    return rows


def _tolerance(specimen: AnySpecimen, name: str) -> float:
    return tolerance(specimen, name) if isinstance(specimen, Specimen) else specimen.tolerance(name)
