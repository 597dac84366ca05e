"""Universal files of any origin: data set 58 with its units, data set 164 where it scales them."""

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pyuff

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.interchange.found import Found, Ratio, motion_of
from instrument.interchange.units import DERIVATIVE, KNOWN, Quantity, Unit, unit_of

_TIME, _FRF, _TRANSMISSIBILITY, _COHERENCE = 1, 4, 5, 6
_QUANTITIES: dict[int, Quantity] = {8: "displacement", 11: "velocity", 12: "acceleration", 13: "force"}
_PLACE = re.compile(r"\bsweep (\d+) segment (\d+)\b")
_ACCELERATION = 12


def read_uff(path: Path) -> Found:
    """FRFs, transmissibilities and time records. Raises `BadInput` naming the data set."""
    sets = _sets(path)
    scale = next(
        (_Scale(1 / s["length"], 1 / s["force"]) for s in sets if s["type"] == 164), _Scale(1.0, 1.0)
    )
    functions = [(k, s) for k, s in enumerate(sets, start=1) if s["type"] == 58]
    if not functions:
        raise BadInput(f"{path}: no data set 58, found {_kinds(sets)}")
    coherences = [np.asarray(s["data"], float) for _, s in functions if s["func_type"] == _COHERENCE]
    found, records = Found(), []
    for k, s in functions:
        where = f"{path}: set {k}"
        if s["func_type"] in (_FRF, _TRANSMISSIBILITY):
            ratio = _ratio(where, _name(s, k), s, scale)
            alike = (c for c in coherences if len(c) == len(ratio.H))
            found.add_ratio(ratio, next(alike, None))
        elif s["func_type"] == _TIME:
            records.append(_record(where, s, scale))
        elif s["func_type"] != _COHERENCE:
            found.said.append(f"passed over: {_name(s, k)}: function type {s['func_type']}")
    _add_hits(path, found, records)
    return found


class _Scale:
    """Factors of data set 164 to SI."""

    def __init__(self, length: float, force: float) -> None:
        self.length, self.force = length, force

    def of(self, quantity: Quantity) -> float:
        return self.force if quantity == "force" else self.length


_Record = tuple[Quantity, float, Array]
"""What, samples a second, samples in SI."""


def _ratio(where: str, name: str, s: dict[str, Any], scale: _Scale) -> Ratio:
    unit = _ratio_unit(where, s, scale)
    level = None
    if s.get("z_axis_spec_data_type") == _ACCELERATION and float(s.get("z_axis_value", 0)) > 0:
        level = float(s["z_axis_value"]) * _unit(where, "z_axis", s, scale).factor
    place = _PLACE.search(f"{s.get('id1', '')} {s.get('id2', '')}")
    return Ratio(
        name,
        _frequency_hz(s),
        np.asarray(s["data"], np.complex128) * unit.factor,
        unit.quantity,
        unit.per or "force",
        level,
        (int(place[1]), int(place[2])) if place else None,
    )


def _ratio_unit(where: str, s: dict[str, Any], scale: _Scale) -> Unit:
    """Numerator over denominator; some programs label the numerator with the unit of the whole."""
    whole = unit_of(_label(s, "ordinate"))
    if whole is not None and whole.per is not None:
        return whole
    over, under = _unit(where, "ordinate", s, scale), _unit(where, "orddenom", s, scale)
    return Unit(over.quantity, over.factor / under.factor, under.quantity)


def _record(where: str, s: dict[str, Any], scale: _Scale) -> _Record:
    unit = _unit(where, "ordinate", s, scale)
    x = np.asarray(s["x"], float)
    step = float(s["abscissa_inc"]) if s.get("abscissa_spacing") else float(x[-1] - x[0]) / (len(x) - 1)
    if not step > 0:
        raise BadInput(f"{where}: a step of {step:g} s between samples, expected more than 0")
    return unit.quantity, 1 / step, np.asarray(s["data"], float) * unit.factor


def _unit(where: str, axis: str, s: dict[str, Any], scale: _Scale) -> Unit:
    """Of an axis: what its label says, else its data type in the file's units."""
    code = int(s.get(f"{axis}_spec_data_type", 0))
    label = _label(s, axis)
    named = unit_of(label)
    if label and (named is None or named.per is not None):
        raise BadInput(f"{where}: {axis} in {label!r}, expected one of {KNOWN}")
    if named is not None:
        if code in _QUANTITIES and _QUANTITIES[code] != named.quantity:
            raise BadInput(f"{where}: {axis} is {_QUANTITIES[code]} (type {code}) in {label!r}: which is it?")
        return named
    if code not in _QUANTITIES:
        raise BadInput(
            f"{where}: {axis} of data type {code} without a unit, expected 8, 11, 12 or 13 "
            "(displacement, velocity, acceleration, force)"
        )
    return Unit(_QUANTITIES[code], scale.of(_QUANTITIES[code]))


def _label(s: dict[str, Any], axis: str) -> str:
    """The unit an axis is labelled with; empty for none."""
    label = str(s.get(f"{axis}_axis_units_lab", "")).strip()
    return "" if label == "NONE" else label


def _frequency_hz(s: dict[str, Any]) -> Array:
    x = np.asarray(s["x"], float)
    return x / (2 * np.pi) if _label(s, "abscissa").lower() == "rad/s" else x


def _add_hits(path: Path, found: Found, records: list[_Record]) -> None:
    """Each force with the responses behind it; where there is one force, with all of them."""
    forces = [k for k, r in enumerate(records) if r[0] == "force"]
    if records and not forces:
        found.said.append(f"passed over: {len(records)} time records without a force among them")
    for n, k in enumerate(forces, start=1):
        end = forces[n] if n < len(forces) else len(records)
        mine = records[k + 1 : end] if len(forces) > 1 else records[:k] + records[k + 1 :]
        _, rate, force = records[k]
        source = f"{path.name} hit {n}"
        responses: list[tuple[Motion, Array]] = []
        for quantity, its_rate, samples in mine:
            if len(samples) != len(force) or abs(its_rate / rate - 1) > 1e-6:
                raise BadInput(
                    f"{path}: {source}: a response of {len(samples)} samples at {its_rate:g} Hz beside "
                    f"a force of {len(force)} at {rate:g} Hz, expected both alike"
                )
            if quantity in DERIVATIVE:
                responses.append((motion_of(source, quantity), samples))
        if not responses:
            raise BadInput(f"{path}: {source}: no response beside the force")
        found.add_hit(source, rate, force, responses)


def _sets(path: Path) -> list[dict[str, Any]]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # the library raises whatever it meets
        raise BadInput(f"{path}: not a universal file: {' '.join(str(error).split())[:80]}") from None
    return [s for s in (read if isinstance(read, list) else [read]) if "type" in s]


def _kinds(sets: list[dict[str, Any]]) -> str:
    return ", ".join(sorted({str(s["type"]) for s in sets})) or "no set at all"


def _name(s: dict[str, Any], k: int) -> str:
    said = " ".join(str(s.get(key, "")).strip() for key in ("id1", "id2"))
    return " ".join(said.replace("NONE", "").split()) or f"set {k}"
