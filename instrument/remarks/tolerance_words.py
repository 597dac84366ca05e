"""The tolerances that a specimen's numbers are taken with: named in its file, typical, or none at all."""

from fitting.plate.plate_numbers import plate_numbers, tolerance
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import IN_FILES, OF_CHANNELS, OF_TEMPERATURE, PLATE, STATED
from fitting.structures import AnySpecimen
from instrument.facts.check import ToleranceUsed

_NOT_OF_A_SWEEP = ("mass", "place", "area")
"""Of masses put on a plate, or of a shear pair's disc: no scope, but not of a plate by itself."""


def asked(specimen: AnySpecimen) -> list[str]:
    """Kinds of stated numbers that a sweep of this specimen can feel."""
    if not isinstance(specimen, PlateSpecimen):
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
            name=f"{name}_{IN_FILES[STATED[name].unit].ending}",
            value=_tolerance(specimen, name) * IN_FILES[STATED[name].unit].from_si,
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
        said = IN_FILES[STATED[name].unit]
        value = f"{_tolerance(specimen, name) * said.from_si:.3g} {said.unit}"
        rows.append((name.replace("_", " "), value + ("" if name in specimen.tolerances else " (typical)")))
    return rows


def _tolerance(specimen: AnySpecimen, name: str) -> float:
    return tolerance(specimen, name) if isinstance(specimen, PlateSpecimen) else specimen.tolerance(name)
