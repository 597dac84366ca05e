"""Stated numbers that no such plate has: most are a unit away from the right one. Questioned before any work.

The limits are wide on purpose, of handbooks and of what is built, not of what is likely: what lies outside is
nearly always a wrong unit. `--force` insists.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from fitting.errors import OutsideModel
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.errors import BadInput
from instrument.files.specimen_file import law_of
from instrument.files.toml import read_tables

INSIST = "--force to go on all the same"
_LAYERS = ("substrate", "constraining", "layer", "upper", "lower")
_FREQUENCY_HZ = 100.0
_MODULUS_PA = (2e3, 2e10)
"""|G*| of a soft foam, and of a stiff glassy polymer with room to spare."""
_RATIO_PERCENT = (0.003, 12.0)
"""The largest of a bare plate's modal damping ratios."""
_KNOWN_PERCENT, _UNKNOWN_MM = 0.05, 20.0
"""A stiffness, thickness or gain is known no better; a place on a plate is not known worse."""
_MOST_GB = 5.0
"""What a response may take unasked: 80 x 80 elements do, six times as many as are converged. A choice."""
_HUNDRED_SQUARE = (80.0, 8.0)
"""What a response of 100 x 100 elements took: seconds, GB. Both go with the longer side, and with the third
and second power of the shorter one: its lines are factorised."""
_FASTEST_M_S, _SLOWEST_M_S = 13_500.0, 2_200.0
"""Of sound along a bar: beryllium has 12,900, and what is stiffer for its weight are fibres; aluminium and
steel have 5000, brass 3500, tin 2600."""
_METALS_KG_M3 = (2500.0, 9000.0)
"""From aluminium to copper: lead and gold are slower."""
_DENSE_KG_M3, _DENSE_POISSON = 600.0, 0.05
"""What is heavier than foam and cork widens nearly as rubber does; glassy polymers have 0.3 and more."""
SPOT_MM = 0.3
"""No laser's spot is so near an edge: it would be half beside it."""


class Usual(NamedTuple):
    """Limits of a key in its unit, what a known thing has, and the units it is mistaken for, by factor."""

    low: float
    high: float
    known: str
    mistaken: dict[str, float]


_LENGTH = {"m": 1e3, "um": 1e-3, "cm": 10.0}
_FACE = {
    "young_gpa": Usual(0.5, 700.0, "aluminium 69, steel 205", {"MPa": 1e-3, "Pa": 1e-9, "TPa": 1e3}),
    "density_kg_m3": Usual(300.0, 23_000.0, "aluminium 2700, steel 7850", {"g/cm3": 1e3, "g/m3": 1e-3}),
    "thickness_mm": Usual(0.01, 100.0, "sheet 0.1 to 10", _LENGTH),
    "poisson": Usual(0.1, 0.5, "metals 0.25 to 0.35", {}),
    "loss_factor": Usual(0.0, 0.5, "metals below 0.01", {"%": 1e-2}),
}
_GLUE = {
    "shear_mpa": Usual(2.0, 20_000.0, "epoxies 300 to 2000", {"GPa": 1e3, "Pa": 1e-6}),
    "thickness_mm": Usual(1e-3, 5.0, "films 0.01 to 0.5", _LENGTH),
    "density_kg_m3": Usual(100.0, 8_000.0, "epoxies 1200", {"g/cm3": 1e3, "g/m3": 1e-3}),
}
_CORE = {
    "density_kg_m3": Usual(5.0, 8_000.0, "rubber 1000", {"g/cm3": 1e3, "g/m3": 1e-3}),
    "thickness_mm": Usual(0.005, 100.0, "films 0.02 to 2", _LENGTH),
}
_SIZE = {
    "length_mm": Usual(5.0, 5_000.0, "plates 50 to 1000", _LENGTH),
    "width_mm": Usual(2.0, 5_000.0, "plates 10 to 1000", _LENGTH),
}
_PAIR = {
    "mass_kg": Usual(1e-3, 100.0, "0.1 to 5", {"g": 1e-3}),
    "thickness_mm": Usual(0.1, 100.0, "discs 1 to 20", _LENGTH),
    "outer_diameter_mm": Usual(2.0, 1_000.0, "discs 10 to 100", _LENGTH),
    "area_mm2": Usual(3.0, 1e6, "discs 100 to 10 000", {"cm2": 100.0, "m2": 1e6}),
}
_PLACED = {"mass_kg": Usual(1e-5, 2.0, "sensors and known masses 0.0005 to 0.1", {"g": 1e-3, "mg": 1e-6})}
_BASE = {
    "acceleration_m_s2": Usual(
        1e-3, 500.0, f"1 g is {PUBLISHED_G_M_S2:g}, shakers up to 100 g", {"cm/s^2 or mm/s^2": 1e-2}
    )
}
_USUAL = {
    **dict.fromkeys(_LAYERS, _FACE),
    "core": _CORE,
    "plate": _SIZE,
    "beam": _SIZE,
    "base": _BASE,
    "shear-pair": _PAIR,
}
"""Limits of the numbers in every table of a specimen's file."""


def question_specimen(path: Path, *, insist: bool = False) -> None:
    """Ask about a specimen that reads well. Raises `BadInput` in one line."""
    if insist:
        return
    for doubt in specimen_doubts(read_tables(path)):
        raise BadInput(f"{path}: {doubt}; {INSIST}")


def specimen_doubts(tables: dict[str, Any]) -> list[str]:
    """Everything in a specimen's tables that asks for a question; empty for a usual one."""
    found: list[str] = []
    for name, usual in _USUAL.items():
        found += outside(name, tables.get(name), usual)
    for name in _LAYERS:
        found += _metal(name, tables.get(name))
    glues = tables.get("glue")
    for glue in glues if isinstance(glues, list) else []:
        found += outside("glue", glue, _GLUE)
    placed = tables.get("mass")
    for mass in placed if isinstance(placed, list) else []:
        found += outside("mass", mass, _PLACED)
    return [
        *found,
        *_dense_core(tables),
        *_damping(tables),
        *_pickup(tables),
        *_tolerances(tables),
        *_law(tables),
        *_mesh(tables),
    ]


def outside(place: str, table: Any, usual: dict[str, Usual]) -> Iterator[str]:
    """A question for each number of a table that lies beyond its limits."""
    if not isinstance(table, dict):
        return
    for key, limits in usual.items():
        value = table.get(key)
        if isinstance(value, int | float) and not limits.low <= value <= limits.high:
            yield (
                f"{place}.{key} = {value:g} is outside {limits.low:g} to {limits.high:g} ({limits.known})"
                f"{_mistaken(value, limits)}"
            )


def _metal(name: str, table: Any) -> Iterator[str]:
    """Whether some solid has both its modulus and its density, by the speed of sound along a bar."""
    if not isinstance(table, dict):
        return
    E, density = table.get("young_gpa"), table.get("density_kg_m3")
    if not (isinstance(E, int | float) and isinstance(density, int | float) and E > 0 and density > 0):
        return
    speed = math.sqrt(1e9 * E / density)
    said = f"{name}.young_gpa = {E:g} with density_kg_m3 = {density:g}"
    if speed > _FASTEST_M_S:
        yield f"{said}: no solid is so stiff and so light: is one of them another layer's?"
    elif speed < _SLOWEST_M_S and _METALS_KG_M3[0] < density < _METALS_KG_M3[1]:
        yield f"{said}: no metal is so soft: is it in millions of psi (6.9 GPa)?"


def _mistaken(value: float, usual: Usual) -> str:
    """The unit it would be usual in; the nearest to what is known where several would do."""
    middle = math.sqrt(max(usual.low, 1e-3) * usual.high)
    fits = {u: value * f for u, f in usual.mistaken.items() if usual.low <= value * f <= usual.high}
    if not fits:
        return ""
    unit = min(fits, key=lambda u: abs(math.log(max(fits[u], 1e-12) / middle)))
    return f": is it in {unit}?"


def _dense_core(tables: dict[str, Any]) -> Iterator[str]:
    """Whether a core that is no foam or cork has Poisson's ratio of one."""
    core = tables.get("core")
    if not isinstance(core, dict):
        return
    ratio, density = core.get("poisson"), core.get("density_kg_m3")
    if not (isinstance(ratio, int | float) and isinstance(density, int | float)):
        return
    if ratio < _DENSE_POISSON and density > _DENSE_KG_M3:
        yield (
            f"core.poisson = {ratio:g} with density_kg_m3 = {density:g}: rubber has 0.45 to 0.5, only "
            "foam and cork so little"
        )


def _damping(tables: dict[str, Any]) -> Iterator[str]:
    table = tables.get("damping")
    ratios = table.get("modal_percent") if isinstance(table, dict) else None
    if not ratios:
        return
    most, (low, high) = max(ratios), _RATIO_PERCENT
    if most > high:
        yield f"damping.modal_percent up to {most:g}, bare plates have less than {high:g}: 100 times less?"
    elif 0 < most < low:
        yield f"damping.modal_percent at most {most:g} %, no bare plate has so little: are they fractions?"


def _pickup(tables: dict[str, Any]) -> Iterator[str]:
    found = tables.get("pickup")
    for one in found if isinstance(found, list) else [found]:
        for key in ("x_mm", "y_mm"):
            at = one.get(key) if isinstance(one, dict) else None
            if isinstance(at, int | float) and 0 < at < SPOT_MM:
                yield f"pickup.{key} = {at:g} is nearer to the edge than a laser's spot is wide: is it in m?"


def _tolerances(tables: dict[str, Any]) -> Iterator[str]:
    stated = tables.get("tolerances")
    for key, value in stated.items() if isinstance(stated, dict) else ():
        if isinstance(value, bool) or not isinstance(value, int | float):
            continue
        if key.endswith("_percent") and 0 < value < _KNOWN_PERCENT:
            yield f"tolerances.{key} = {value:g}: nobody knows it to {value:g} %: is it a fraction?"
        if key.endswith("_mm") and value > _UNKNOWN_MM:
            yield f"tolerances.{key} = {value:g} is no reading of a ruler: is it in um?"


def _law(tables: dict[str, Any]) -> Iterator[str]:
    core = tables.get("core")
    stated = core.get("law") if isinstance(core, dict) else None
    if not isinstance(stated, dict) or stated.get("kind") == "table":
        return
    try:
        size = abs(complex(law_of(stated).modulus(np.array([2 * np.pi * _FREQUENCY_HZ]))[0]))
    except OutsideModel:
        return
    low, high = _MODULUS_PA
    if not low <= size <= high:
        yield (
            f"core.law gives |G*| = {size * 1e-6:.3g} MPa at {_FREQUENCY_HZ:g} Hz, outside {low * 1e-6:g} to "
            f"{high * 1e-6:g} MPa: are its moduli in MPa?"
        )


def _mesh(tables: dict[str, Any]) -> Iterator[str]:
    table = tables.get("mesh")
    stated = [table.get(f"elements_{axis}") for axis in "xy"] if isinstance(table, dict) else []
    sides = [n for n in stated if isinstance(n, int)]
    if not sides or len(sides) < len(stated):
        return
    short, long = sorted(n / 100 for n in sides)
    seconds, gb = (at * long * short**power for at, power in zip(_HUNDRED_SQUARE, (3, 2), strict=True))
    if gb > _MOST_GB:
        yield (
            f"mesh of {sides[0]} x {sides[1]} elements, a response of which takes some {_time(seconds)} and "
            f"{gb:.2g} GB: leave [mesh] out (about 1040 elements are converged) or take fewer"
        )


def _time(seconds: float) -> str:
    return f"{seconds / 60:.0f} min" if seconds > 90 else f"{seconds:.0f} s"
