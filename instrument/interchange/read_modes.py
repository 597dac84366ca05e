"""Tables of modes as other laboratories write them: loss factors, damping ratios, Q, or half-power widths."""

import re
from collections.abc import Callable
from itertools import pairwise
from typing import Literal

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.interchange.celsius import OURS, is_temperature, with_celsius
from instrument.interchange.found import Columns, Found, Modes
from instrument.interchange.said_by_name import ANGULAR, ANGULAR_HZ, NotSaid
from instrument.interchange.signals import Named
from instrument.interchange.unit_in_name import bracketed, part_in, unit_in

Loss = Literal["loss factor", "damping ratio", "quality", "bandwidth", "decrement"]
Kind = Literal["mode", "frequency", "spread", "damping"] | Loss

_LOSS_OF: dict[Loss, Callable[[Array, Array], Array]] = {
    "loss factor": lambda x, f: x,
    "damping ratio": lambda x, f: 2 * x,
    "quality": lambda x, f: 1 / x,
    "bandwidth": lambda x, f: x / f,
    "decrement": lambda x, f: x / np.pi,
}
"""The loss factor of a mode, of a small one, from what is stated and its frequency: ASTM E756, ISO 6721-1.
Of several that are stated the first counts."""
_HZ = {"hz": 1.0, "khz": 1e3, "rad/s": 1 / (2 * np.pi), "": 1.0}
_PLAIN = {"": 1.0, "-": 1.0, "1": 1.0, "%": 0.01, "percent": 0.01, "pct": 0.01}
_LINEAR: tuple[Loss, ...] = ("loss factor", "damping ratio")
"""Whose standard deviation becomes the loss factor's as they do themselves."""
_FREQUENCY = frozenset(("frequency", "freq", "f", "fn", "f0", "eigenfrequency"))
_NUMBER = frozenset(("mode", "n", "order"))
_SPREAD = frozenset(("std", "sd", "sigma", "stdev", "deviation", "uncertainty", "se"))
_GREEK = (("η", "eta"), ("ζ", "zeta"), ("Δf", "df"), ("δ", " delta"), ("σ", "sigma"))
_S_OF = re.compile(r"^\s*(?:s|sd|std|sigma)\s*\(([^()]*)\)")
_HALF_POWER_DB = "3"
_TIMES = re.compile(r"[x×*]\s*10|10\s*\^|\b1?[eE][-+]\d")
"""A factor in a name."""
_EXPANDED = re.compile(r"k\s*=\s*[2-9]|\d\s*%|expanded|erweitert", re.I)
"""More than one standard deviation."""
_AGREE = 0.05
"""Between two statements of one loss factor, written with few digits."""


def read_modes(source: str, table: Named, found: Found) -> bool:
    """Add a table of modes; False where this is none. Raises `NotSaid` where it says too little."""
    kinds = {name: kind for name in table if (kind := _kind(name)) is not None}
    stated = [name for name, kind in kinds.items() if kind in _LOSS_OF or kind == "damping"]
    frequencies = [name for name, kind in kinds.items() if kind == "frequency"]
    frequencies = [name for name in frequencies if not _is_angular(name)] or frequencies
    numbers = [name for name, kind in kinds.items() if kind == "mode"]
    if not stated or not frequencies or any(_is_phasor(name) for name in table):
        return False
    if not numbers:
        if not any(unit_in(name) is not None for name in table):
            found.said.append(f"{source}: {stated[0]}: of which mode? expected a column of their numbers")
        return False
    _refuse_doubt(source, kinds, frequencies)
    units = ANGULAR_HZ if _is_angular(frequencies[0]) else _HZ
    f = table[frequencies[0]] * _factor(source, frequencies[0], units)
    if not np.all(f > 0):
        raise BadInput(f"{source}: {frequencies[0]}: up from {np.min(f):g}, expected more than 0")
    if len(numbers) > 1:
        raise NotSaid(f"{source}: {', '.join(numbers)}: which is the mode's number? expected one")
    columns: Columns = {"mode": table[numbers[0]], "frequency_hz": f}
    name, columns["loss_factor"] = _loss_factor(source, table, {n: kinds[n] for n in stated}, f)
    columns |= _spreads(source, table, kinds, f)
    warm = with_celsius(source, table, found)
    if OURS in warm:
        columns[OURS] = warm[OURS]
    half_power = any(kinds[n] == "bandwidth" or "half" in bracketed(n)[1] for n in stated)
    found.modes.append(Modes(columns, "half-power" if half_power else None))
    found.said.append(f"{source}: {len(f)} modes, {np.min(f):.5g} to {np.max(f):.5g} Hz, from {name}")
    left = [n for n in table if n not in kinds and not is_temperature(n)]
    if left:
        found.said.append(f"passed over: {source}: {', '.join(left)[:200]}")
    return True


def _kind(name: str) -> Kind | None:
    """What a column is of, by its words."""
    ordered = _words(name)
    return "spread" if not _SPREAD.isdisjoint(ordered) else _kind_of(ordered, name)


def _spelt(name: str) -> str:
    """With Greek letters spelt out; `s(f)` is the standard deviation of f."""
    for letter, plain in _GREEK:
        name = name.replace(letter, plain)
    return _S_OF.sub(r"std \1", name)


def _words(name: str) -> list[str]:
    return bracketed(_spelt(name))[1]


def _kind_of(ordered: list[str], name: str) -> Kind | None:
    words = set(ordered)
    if words & {"bandwidth", "width", "df"} or {"delta", "f"} <= words:
        return "bandwidth"
    if words & {"decrement", "logdec"}:
        return "decrement"
    if words & {"eta", "lossfactor", "tandelta"} or words >= {"loss", "factor"}:
        return "loss factor"
    if words >= {"tan", "delta"} or words >= {"tan", "d"}:
        return "loss factor"
    if words & {"zeta", "critical"} or words >= {"damping", "ratio"}:
        return "damping ratio"
    if words & {"q", "quality", "qfactor"} and "%" not in name:
        return "quality"
    if "damping" in words:
        return "damping"
    if words & _FREQUENCY or _is_angular(name):
        return "frequency"
    return "mode" if ordered and ordered[0] in _NUMBER else None


def _is_phasor(name: str) -> bool:
    """Whether a column is a part of a phasor of something with a unit: modes have none beside them."""
    return part_in(name) in ("re", "im") and unit_in(name) is not None


def _is_angular(name: str) -> bool:
    return not set(ANGULAR).isdisjoint(bracketed(name)[1])


def _refuse_doubt(source: str, kinds: dict[str, Kind], frequencies: list[str]) -> None:
    if len(frequencies) > 1:
        raise NotSaid(f"{source}: {', '.join(frequencies)}: which is the mode's frequency? expected one")
    for name, kind in kinds.items():
        _, words = bracketed(name)
        if kind == "damping":
            raise NotSaid(
                f"{source}: {name}: the loss factor, or the ratio to critical (half of it)? expected "
                "'Loss factor' or 'Damping ratio'"
            )
        if kind == "bandwidth" and "db" in words and _HALF_POWER_DB not in words:
            raise NotSaid(f"{source}: {name}: expected the width at half power, 3 dB below the peak")
        if kind == "bandwidth" and ("half", "width") in pairwise(words):
            raise NotSaid(f"{source}: {name}: half of a width? expected 'Half-power width' for all of it")
        if kind in _LOSS_OF and _TIMES.search(name):
            raise NotSaid(f"{source}: {name}: times a number? expected the number itself, or %")
        if kind == "spread" and _EXPANDED.search(name):
            raise NotSaid(f"{source}: {name}: expected one standard deviation")


def _loss_factor(source: str, table: Named, stated: dict[str, Kind], f: Array) -> tuple[str, Array]:
    """From the first of what is stated. Raises `BadInput` where another one says something else."""
    known = []
    for kind, of in _LOSS_OF.items():
        for name in (n for n, k in stated.items() if k == kind):
            factor = _factor(source, name, _HZ if kind == "bandwidth" else _PLAIN)
            x = np.asarray(table[name], float) * factor
            if not np.all(x > 0):
                raise BadInput(f"{source}: {name}: down to {np.min(x):g}, expected more than 0")
            known.append((name, np.asarray(of(x, f))))
    (name, eta), *others = known
    for other, its in others:
        if not np.allclose(its, eta, rtol=_AGREE):
            row = int(np.argmax(np.abs(its / eta - 1)))
            raise BadInput(
                f"{source}: row {row + 1}: loss factor {eta[row]:.4g} by {name}, {its[row]:.4g} by {other}: "
                "expected one of both"
            )
    return name, eta


def _spreads(source: str, table: Named, kinds: dict[str, Kind], f: Array) -> Columns:
    """Standard deviations, made of what is stated as what they are of is.

    Raises `NotSaid` where that, or of what their percents are, is not said.
    """
    columns: Columns = {}
    for name in (n for n, kind in kinds.items() if kind == "spread"):
        of = _kind_of([word for word in _words(name) if word not in _SPREAD], name)
        if of == "frequency":
            units = ANGULAR_HZ if _is_angular(name) else _HZ
            columns["frequency_std_hz"] = table[name] * _factor(source, name, units)
            continue
        if of not in _LINEAR:
            raise NotSaid(
                f"{source}: {name}: of what? expected that of frequency, loss factor or damping ratio"
            )
        factor = _factor(source, name, _PLAIN)
        if factor not in ({_factor(source, n, _PLAIN) for n, k in kinds.items() if k == of} or {1.0}):
            said = "no unit" if factor == 1 else "in '%'"
            raise NotSaid(
                f"{source}: {name}: {said}, expected that of its value: percents may be of it, or of 1"
            )
        columns.setdefault("loss_factor_std", _LOSS_OF[of](table[name] * factor, f))
    return columns


def _factor(source: str, name: str, units: dict[str, float]) -> float:
    """To Hz or to one, by the unit in brackets or the last word. Raises `NotSaid` for any other one."""
    bracket, words = bracketed(_spelt(name))
    unit = bracket.strip().lower()
    if not unit:
        unit = "%" if "%" in name else next((w for w in words[-1:] if w in units), "")
    known = "%" if unit.startswith("%") and "%" in units else unit
    if known not in units:
        expected = ", ".join(u for u in units if u)
        raise NotSaid(f"{source}: {name}: in {bracket!r}, expected {expected or 'no unit'}")
    return units[known]
