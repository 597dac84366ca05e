"""Named arrays side by side, of a CSV or a MATLAB struct, to what they are.

A name says what it is, and its unit: `velocity_mm_s`, `Velocity real [mm/s]`, `base_accel_m_s2`, `FRF (g/N)`.
"""

import re
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.files.point_columns import understood
from instrument.files.table import rate_of_times
from instrument.files.units import DERIVATIVE, KNOWN, Quantity, Unit, unit_of
from instrument.interchange.found import Columns, Found, Ratio

Named = dict[str, NDArray[Any]]
"""Arrays of one length; matrices (samples, hits) for hits side by side; single numbers as arrays of one."""
Part = Literal["whole", "re", "im", "magnitude", "phase"]

_PARTS: dict[str, Part] = {
    **dict.fromkeys(("re", "real"), "re"),
    **dict.fromkeys(("im", "imag", "imaginary"), "im"),
    **dict.fromkeys(("mag", "magnitude", "amp", "amplitude", "abs", "modulus"), "magnitude"),
    **dict.fromkeys(("phase", "phi", "arg", "angle"), "phase"),
}
_BASE = {"base", "reference", "ref", "clamp", "excitation", "shaker", "input"}
_STEMS = {"accelerance": "(m/s^2)/N", "inertance": "(m/s^2)/N", "mobility": "(m/s)/N", "receptance": "m/N"}
_SUFFIXES = (
    ("_mm_s2", "mm/s^2"),
    ("_m_s2", "m/s^2"),
    ("_mm_s", "mm/s"),
    ("_m_s", "m/s"),
    ("_mm", "mm"),
    ("_kn", "kN"),
    ("_m", "m"),
    ("_n", "N"),
    ("_g", "g"),
)
"""Units at the end of a name, longest first."""
_RATES = ("sample_rate_hz", "sampling_rate_hz", "fs", "fs_hz", "sample_rate", "sampling_frequency")
_AXIS_HZ = {"hz": 1.0, "khz": 1e3, "rad/s": 1 / (2 * np.pi), "": 1.0}
_AXIS_S = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "": 1.0}


@dataclass(frozen=True)
class _Signal:
    """A quantity, its parts put together."""

    name: str
    unit: Unit
    is_base: bool
    values: NDArray[Any]


def read_table(source: str, table: Named, found: Found) -> bool:
    """Add what a table holds; False where it is none of ours. Raises `BadInput` where it contradicts itself.

    `source` names it in messages.
    """
    signals = _signals(source, table)
    frequency = _axis(table, ("frequency", "freq", "f"), _AXIS_HZ)
    if frequency is not None:
        _on_lines(source, table, frequency, signals, found)
        return bool(signals)
    if any(s.unit.quantity == "force" for s in signals):
        _records(source, _rate_hz(source, table), signals, table.get("accepted"), found)
        return True
    return False


# Axes


def _axis(table: Named, words: tuple[str, ...], units: dict[str, float]) -> Array | None:
    """The column of an axis in its SI unit."""
    for name, values in table.items():
        unit, tokens = _bracketed(name)
        last = tokens[-1] if len(tokens) > 1 and not unit else ""
        unit = unit or (last if last in units else "")
        if tokens and tokens[0] in words and unit.lower() in units and values.ndim == 1 and values.size > 1:
            return np.asarray(values, float) * units[unit.lower()]
    return None


def _rate_hz(source: str, table: Named) -> float:
    """Samples a second."""
    for name in table:
        if name.lower() in _RATES and table[name].size == 1:
            return float(table[name].ravel()[0])
    t = _axis(table, ("time", "t"), _AXIS_S)
    if t is None:
        raise BadInput(f"{source}: no sample rate, expected sample_rate_hz or a column of times")
    rate = rate_of_times(t)
    if rate is None:
        raise BadInput(f"{source}: its times are not evenly spaced, expected a constant step")
    return rate


# Signals


def _others() -> list[str]:
    """Columns of the sweep CSV that pass as they are; phasors may come in other units and other parts."""
    names = [column for column in understood() if column.given == "if known"]
    return [column.name for column in names if not any(f"_{part}_" in column.name for part in ("re", "im"))]


def _signals(source: str, table: Named) -> list[_Signal]:
    """Real and imaginary parts, or magnitude and phase, put together."""
    others = _others()
    parts: dict[tuple[str, ...], dict[Part, str]] = {}
    for name in table:
        if name in others or (_unit(name) is None and _part(name) != "phase"):
            continue
        parts.setdefault(_stem(name), {})[_part(name)] = name
    return [s for stem, by_part in parts.items() if (s := _signal(source, table, stem, by_part)) is not None]


def _signal(source: str, table: Named, stem: tuple[str, ...], names: dict[Part, str]) -> _Signal | None:
    unit = next((u for part, n in names.items() if part != "phase" and (u := _unit(n))), None)
    if unit is None:
        return None
    if ("re" in names) != ("im" in names):
        raise BadInput(
            f"{source}: {next(iter(names.values()))}: its other part is missing, expected re and im"
        )
    if "re" in names:
        values: NDArray[Any] = table[names["re"]] + 1j * table[names["im"]]
    elif "phase" in names:
        size = names.get("magnitude") or names.get("whole")
        if size is None:
            return None
        values = table[size] * np.exp(1j * _radians(names["phase"], table[names["phase"]]))
    else:
        values = table[names.get("whole") or names["magnitude"]]
    label = next(iter(names.values()))
    return _Signal(label, unit, bool(_BASE & set(stem)), values * unit.factor)


def _radians(name: str, values: NDArray[Any]) -> NDArray[Any]:
    words = name.lower()
    return np.asarray(values if "rad" in words else np.deg2rad(values))


def _bracketed(name: str) -> tuple[str, list[str]]:
    """The unit in brackets at a name's end, and the words before it."""
    plain = name.strip()
    match = re.search(r"\[([^\]]*)\]\s*$", plain) or re.search(r"[\s_]\((.*)\)\s*$", plain)
    before = plain[: match.start()] if match else plain
    return (match[1] if match else ""), [w for w in re.split(r"[^a-z0-9]+", before.lower()) if w]


def _unit(name: str) -> Unit | None:
    unit, words = _bracketed(name)
    if unit:
        return unit_of(unit)
    stem = next((_STEMS[w] for w in words if w in _STEMS), None)
    if stem is not None:
        return unit_of(stem)
    lower = name.strip().lower()
    return next((unit_of(u) for suffix, u in _SUFFIXES if lower.endswith(suffix)), None)


def _part(name: str) -> Part:
    _, words = _bracketed(name)
    return next((_PARTS[w] for w in words if w in _PARTS), "whole")


def _stem(name: str) -> tuple[str, ...]:
    """What the parts of one quantity have in common."""
    bracket, words = _bracketed(name)
    lower = name.strip().lower()
    if not bracket:
        tail = next((suffix for suffix, _ in _SUFFIXES if lower.endswith(suffix)), "")
        words = [w for w in re.split(r"[^a-z0-9]+", lower.removesuffix(tail)) if w]
    return tuple(w for w in words if w not in _PARTS and w not in ("deg", "rad"))


# What they make together


def _on_lines(source: str, table: Named, f: Array, signals: list[_Signal], found: Found) -> None:
    """Ratios, or a velocity beside its base acceleration."""
    signals = [s for s in signals if s.values.shape == f.shape]
    alone = sum(s.unit.per is not None for s in signals) == 1
    for s in signals:
        if s.unit.per is not None:
            ratio = Ratio(f"{source}: {s.name}", f, s.values.astype(complex), s.unit.quantity, s.unit.per)
            found.add_ratio(ratio, _coherence(table, s.name, alone=alone))
    motions = [s for s in signals if s.unit.per is None and s.unit.quantity in DERIVATIVE]
    readings, bases = [s for s in motions if not s.is_base], [s for s in motions if s.is_base]
    if not readings:
        return
    if len(readings) > 1 or len(bases) > 1:
        raise BadInput(
            f"{source}: {', '.join(s.name for s in motions)}: which is the response? expected one velocity, "
            f"and one motion of the base (a name with one of {', '.join(sorted(_BASE))})"
        )
    found.sweeps.append(_sweep(source, table, f, readings[0], bases[0] if bases else None, found))


def _sweep(
    source: str, table: Named, f: Array, reading: _Signal, base: _Signal | None, found: Found
) -> Columns:
    columns: Columns = {"frequency_hz": f}
    v = _as(source, reading, "velocity", f)
    columns |= _phasor("velocity", "m_s", v) if np.iscomplexobj(v) else {"velocity_m_s": v}
    if base is not None:
        a = _as(source, base, "acceleration", f)
        columns |= _phasor("base_accel", "m_s2", a)
    columns |= {n: np.asarray(table[n], float) for n in _others() if n in table and table[n].shape == f.shape}
    how = "phasors" if np.iscomplexobj(v) else "amplitudes"
    over = f", with {base.name}" if base is not None else ", no base channel"
    band = f"{len(f)} points, {f.min():.5g} to {f.max():.5g} Hz"
    found.said.append(f"{source}: {reading.name} as velocity {how}{over}, {band}")
    return columns


def _as(source: str, signal: _Signal, wanted: Quantity, f: Array) -> NDArray[Any]:
    """Another motion: each derivative is i omega, of an amplitude omega."""
    turns = DERIVATIVE[wanted] - DERIVATIVE[signal.unit.quantity]
    if turns < 0 and np.any(f <= 0):
        raise BadInput(f"{source}: {signal.name} at 0 Hz cannot be integrated, expected lines above 0 Hz")
    omega = 2 * np.pi * f
    return np.asarray(signal.values * (1j * omega if np.iscomplexobj(signal.values) else omega) ** turns)


def _phasor(stem: str, unit: str, values: NDArray[Any]) -> Columns:
    x = values.astype(complex)
    return {f"{stem}_re_{unit}": x.real, f"{stem}_im_{unit}": x.imag}


def _coherence(table: Named, ratio: str, *, alone: bool) -> Array | None:
    """The only one beside the only ratio; else the one whose further words are all in the ratio's name."""
    names, words = [n for n in table if n.lower().startswith("coherence")], set(_bracketed(ratio)[1])
    further = {n: set(_bracketed(n)[1]) - {"coherence"} for n in names}
    own = names if alone and len(names) == 1 else [n for n in names if further[n] and further[n] <= words]
    return np.asarray(table[own[0]], float) if len(own) == 1 else None


def _records(
    source: str, rate_hz: float, signals: list[_Signal], accepted: NDArray[Any] | None, found: Found
) -> None:
    """A force and its responses; matrices are hits side by side, those not accepted are left out."""
    forces = [s for s in signals if s.unit.quantity == "force" and s.unit.per is None]
    motions = [s for s in signals if s.unit.quantity in DERIVATIVE and s.unit.per is None]
    if len(forces) != 1:
        raise BadInput(f"{source}: {', '.join(s.name for s in forces)}: which is the force? expected one")
    for signal in (*forces, *motions):
        if np.iscomplexobj(signal.values):
            raise BadInput(f"{source}: {signal.name}: complex samples in time, expected real ones")
    length = forces[0].values.shape[0]
    responses = [s for s in motions if s.values.shape == forces[0].values.shape]
    if not responses:
        raise BadInput(
            f"{source}: no response of {length} samples beside the force, expected a unit of {KNOWN}"
        )
    for k, force in enumerate(_hits(forces[0].values)):
        if accepted is not None and accepted.size > k and not accepted.ravel()[k]:
            found.said.append(f"passed over: {source} hit {k + 1}: not accepted")
            continue
        mine: list[tuple[Motion, Array]] = [
            (s.unit.quantity, _hits(s.values)[k]) for s in responses if s.unit.quantity != "force"
        ]
        found.add_hit(f"{source} hit {k + 1}", rate_hz, force, mine)


def _hits(values: NDArray[Any]) -> list[Array]:
    """Columns of a matrix; a vector is one."""
    x = np.asarray(values, float)
    return [x] if x.ndim == 1 else [x[:, k] for k in range(x.shape[1])]
