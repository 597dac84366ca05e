"""Universal files: functions of data set 58 in SI units, as labelled or as data set 164 scales them."""

import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyuff
from numpy.typing import NDArray

from fitting.arrays import Array
from instrument.errors import BadInput, system_words
from instrument.files.rates import rate_of_step
from instrument.files.table import rate_of_times
from instrument.files.units import KNOWN, Quantity, Unit, unit_of

TIME, FRF, TRANSMISSIBILITY, COHERENCE = 1, 4, 5, 6
"""Function types."""
CODES: dict[Quantity, int] = {"displacement": 8, "velocity": 11, "acceleration": 12, "force": 13}
"""Data types of an axis."""
_QUANTITIES = {code: quantity for quantity, code in CODES.items()}
HERTZ = {"Hz": 1.0, "1/s": 1.0, "kHz": 1e3, "rad/s": 1 / (2 * np.pi)}
SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6}
"""Units of an abscissa."""
_OTHER_AXES = {19: "rpm", 20: "orders"}
"""Data types of an abscissa that is neither time nor frequency."""
_AXES = {1: " X", 2: " Y", 3: " Z", 4: " about X", 5: " about Y", 6: " about Z"}
_UNSAID = (0, 1)
"""Data types "unknown" and "general"."""
_PLACE = re.compile(r"\bsweep (\d+) segment (\d+)\b")
_MARK = re.compile(rb"    -1(?=[\r\n]|\Z| {74})")
"""Begins a set and ends it; behind a binary one it stands in no line of its own."""
_STEP_DIGITS = 5e-6
"""A step is written with six digits."""


class DegreeOfFreedom(NamedTuple):
    """Where, and along which axis."""

    name: str
    node: int
    axis: int
    """1 to 3: X, Y, Z; 4 to 6: about them; 0 where it is not said."""


@dataclass(frozen=True)
class Function:
    """One data set 58."""

    label: str
    """First line of its names; empty for none."""
    name: str
    kind: int
    x: Array
    """Hz or s."""
    values: NDArray[Any]
    """In SI units."""
    unit: Unit
    rate_hz: float = np.nan
    """Of samples in time."""
    level_m_s2: float | None = None
    """Base acceleration it was measured at."""
    place: tuple[int, int] | None = None
    """Sweep and segment, where the file says."""
    between: tuple[DegreeOfFreedom, ...] = ()
    """Of the response, then of the reference."""
    turned: bool = False
    """Whether a negative direction turned its sign."""

    @property
    def points(self) -> str:
        """Between which points, for people."""
        return " over ".join(
            f"{at.name} node {at.node}{_AXES.get(at.axis, '')}".strip() for at in self.between
        )


@dataclass(frozen=True)
class _Scale:
    """Factors of data set 164 to SI."""

    length: float
    force: float

    def of(self, quantity: Quantity) -> float:
        return self.force if quantity == "force" else self.length


@dataclass
class Universal:
    """A file's functions; those of another kind by their names alone."""

    functions: list[Function]
    others: list[tuple[str, int]]
    """Name and function type."""


def read_uff58(path: Path, *, over: Quantity | None = None) -> Universal:
    """Time records, FRFs, transmissibilities, coherences. Raises `BadInput` naming the data set.

    `over` is what an FRF is over where the file does not say; time records of no known kind are then left
    out. Without it such a file is refused.
    """
    sets = _sets(path)
    if not any(s["type"] == 58 for s in sets):
        kinds = ", ".join(sorted({str(s["type"]) for s in sets})) or "no set at all"
        raise BadInput(f"{path}: no data set 58, found {kinds}")
    found = Universal([], [])
    scales = [(k, _Scale(1 / s["length"], 1 / s["force"])) for k, s in enumerate(sets, 1) if s["type"] == 164]
    for k, s in enumerate(sets, start=1):
        if s["type"] != 58:
            continue
        where, kind, scale = f"{path}: set {k}", s["func_type"], _scale_of(k, scales)
        if kind in (FRF, TRANSMISSIBILITY, TIME, COHERENCE):
            _check_whole(where, s)
        if kind in (FRF, TRANSMISSIBILITY):
            found.functions.append(_ratio(where, k, s, scale, over))
        elif kind == TIME and not (over and _is_unknown(s)):
            found.functions.append(_record(where, k, s, scale))
        elif kind == COHERENCE:
            found.functions.append(_coherence(where, k, s))
        else:
            found.others.append((_name(s, k), kind))
    return found


def _scale_of(k: int, scales: list[tuple[int, _Scale]]) -> _Scale:
    """Of the last units before a set; of the first in the file where there are none before it."""
    before = [scale for place, scale in scales if place < k]
    return (before[-1:] or [scale for _, scale in scales[:1]] or [_Scale(1.0, 1.0)])[0]


def _check_whole(where: str, s: dict[str, Any]) -> None:
    """Raise `BadInput` where a set has not the values that it says it has."""
    said, there = int(s.get("num_pts", 0)), len(s["data"])
    if said and said != there:
        raise BadInput(f"{where}: {there} values, expected {said} as its head says")


def _is_unknown(s: dict[str, Any]) -> bool:
    """Whether neither data type nor label says what was recorded."""
    return (
        int(s.get("ordinate_spec_data_type", 0)) not in _QUANTITIES and unit_of(_label(s, "ordinate")) is None
    )


def _coherence(where: str, k: int, s: dict[str, Any]) -> Function:
    values = np.asarray(s["data"], float)
    unit = Unit("force", 1.0, "force")
    return Function(
        _line(s), _name(s, k), COHERENCE, _axis(where, s, HERTZ), values, unit, between=_between(s)
    )


def _ratio(where: str, k: int, s: dict[str, Any], scale: _Scale, over: Quantity | None) -> Function:
    unit = _ratio_unit(where, s, scale, over)
    level = None
    if s.get("z_axis_spec_data_type") == CODES["acceleration"] and float(s.get("z_axis_value", 0)) > 0:
        level = float(s["z_axis_value"]) * _unit(where, "z_axis", s, scale).factor
    place = _PLACE.search(f"{s.get('id1', '')} {s.get('id2', '')}")
    if not np.iscomplexobj(s["data"]):
        raise BadInput(f"{where}: an FRF of real numbers, expected complex ones: is it an amplitude?")
    return Function(
        _line(s),
        _name(s, k),
        s["func_type"],
        _axis(where, s, HERTZ),
        np.asarray(s["data"], np.complex128) * (unit.factor * _sign(s, "rsp") * _sign(s, "ref")),
        unit,
        level_m_s2=level,
        place=(int(place[1]), int(place[2])) if place else None,
        between=_between(s),
        turned=_sign(s, "rsp") * _sign(s, "ref") < 0,
    )


def _ratio_unit(where: str, s: dict[str, Any], scale: _Scale, over: Quantity | None) -> Unit:
    """Numerator over denominator; some programs label the numerator with the unit of the whole."""
    whole = unit_of(_label(s, "ordinate"))
    if whole is not None and whole.per is not None:
        return whole
    above = _unit(where, "ordinate", s, scale)
    unsaid = int(s.get("orddenom_spec_data_type", 0)) in _UNSAID and not _label(s, "orddenom")
    below = Unit(over, scale.of(over)) if over and unsaid else _unit(where, "orddenom", s, scale)
    return Unit(above.quantity, above.factor / below.factor, below.quantity)


def _record(where: str, k: int, s: dict[str, Any], scale: _Scale) -> Function:
    unit = _unit(where, "ordinate", s, scale)
    x = _axis(where, s, SECONDS)
    even = s.get("abscissa_spacing")
    step = float(s["abscissa_inc"]) * _axis_factor(where, s, SECONDS) if even else _step(where, x)
    if not step > 0:
        raise BadInput(f"{where}: a step of {step:g} s between samples, expected more than 0")
    values = np.asarray(s["data"], float) * unit.factor
    rate = rate_of_step(step, _STEP_DIGITS)
    return Function(_line(s), _name(s, k), TIME, x, values, unit, rate_hz=rate)


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


def _axis(where: str, s: dict[str, Any], units: dict[str, float]) -> Array:
    return np.asarray(s["x"], float) * _axis_factor(where, s, units)


def _axis_factor(where: str, s: dict[str, Any], units: dict[str, float]) -> float:
    """Of an abscissa to Hz or s. Raises `BadInput` for another one."""
    label, code = _label(s, "abscissa"), int(s.get("abscissa_spec_data_type", 0))
    known = {unit.lower(): factor for unit, factor in units.items()}
    if label.lower() in known:
        return known[label.lower()]
    if label or code in _OTHER_AXES:
        found = repr(label) if label else _OTHER_AXES[code]
        raise BadInput(f"{where}: abscissa in {found}, expected {', '.join(units)}")
    return 1.0


def _step(where: str, x: Array) -> float:
    """Between times that are written out. Raises `BadInput` where it is not constant."""
    rate = rate_of_times(x)
    if rate is None:
        raise BadInput(f"{where}: its times are not evenly spaced, expected a constant step")
    return 1 / rate


def _sign(s: dict[str, Any], end: str) -> float:
    """-1 for a direction that is stated as negative: what was measured is along it, not along its axis."""
    return -1.0 if int(s.get(f"{end}_dir", 0)) < 0 else 1.0


def _between(s: dict[str, Any]) -> tuple[DegreeOfFreedom, ...]:
    def at(end: str) -> DegreeOfFreedom:
        name = str(s.get(f"{end}_ent_name", "")).strip().replace("NONE", "")
        return DegreeOfFreedom(name, int(s.get(f"{end}_node", 0)), abs(int(s.get(f"{end}_dir", 0))))

    return at("rsp"), at("ref")


def _line(s: dict[str, Any]) -> str:
    return str(s.get("id1", "")).strip()


def _name(s: dict[str, Any], k: int) -> str:
    said = " ".join(str(s.get(key, "")).strip() for key in ("id1", "id2"))
    return " ".join(said.replace("NONE", "").split()) or f"set {k}"


def _check_closed(path: Path) -> None:
    """Raise `BadInput` where the last set does not end: the library passes over what is left of it."""
    try:
        marks = len(_MARK.findall(path.read_bytes()))
    except OSError as error:
        raise BadInput(f"{path}: {system_words(error)}") from None
    if marks % 2:
        raise BadInput(f"{path}: cut off in data set {marks // 2 + 1}, expected -1 at its end")


def _sets(path: Path) -> list[dict[str, Any]]:
    if not path.is_file():
        raise BadInput(f"{path}: no such file")
    _check_closed(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # the library raises whatever it meets
        raise BadInput(f"{path}: not a universal file: {' '.join(str(error).split())[:80]}") from None
    return [s for s in (read if isinstance(read, list) else [read]) if "type" in s]
