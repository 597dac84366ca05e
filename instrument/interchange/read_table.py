"""Named arrays side by side, of a CSV or a MATLAB struct, to what they are by their names."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.files.point_columns import understood
from instrument.files.rates import CONTRADICTION
from instrument.files.table import rate_of_times
from instrument.files.units import DERIVATIVE, KNOWN, Quantity, Unit
from instrument.interchange.found import CARRIED, Columns, Found, Ratio
from instrument.interchange.said_by_name import (
    BASE,
    NotSaid,
    Part,
    amplitude_factor,
    axis_of,
    bracketed,
    of_decibels,
    part_in,
    radians,
    reference_of_db,
    refuse_contradiction,
    refuse_unknown,
    stated_factor,
    stem_of,
    unit_in,
)

Named = dict[str, NDArray[Any]]
"""Arrays of one length; matrices (samples, hits) for hits side by side; single numbers as arrays of one."""
_RATES = ("sample_rate_hz", "sampling_rate_hz", "fs", "fs_hz", "sample_rate", "sampling_frequency")
_FREQUENCIES = ("frequency", "freq", "f", "frequenz", "frequence")
_TIMES = ("time", "t", "zeit", "temps")
_LONGEST = 200
_SAME = 0.02
"""Magnitude and phase beside real and imaginary part are written with few digits."""
_AXIS_HZ = {"Hz": 1.0, "kHz": 1e3, "rad/s": 1 / (2 * np.pi), "": 1.0}
_AXIS_S = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "": 1.0}


@dataclass(frozen=True)
class _Signal:
    """A quantity, its parts put together."""

    name: str
    unit: Unit
    is_base: bool
    values: NDArray[Any]
    peak: float = 1.0
    """What an amplitude was made with, of an rms value or one from peak to peak."""
    names: tuple[str, ...] = ()
    """Of its parts."""

    @property
    def words(self) -> str:
        """What is known of it, for people."""
        return self.name if self.peak == 1.0 else f"{self.name} times {self.peak:.4g}"


def read_table(source: str, table: Named, found: Found) -> bool:
    """Add what a table holds; False where it is none of ours. Raises `BadInput` where it contradicts itself.

    `source` names it in messages.
    """
    signals = _signals(source, table)
    frequency = _axis(source, table, _FREQUENCIES, _AXIS_HZ)
    if frequency is not None:
        used = _on_lines(source, table, frequency, signals, found)
    elif any(s.unit.quantity == "force" for s in signals):
        used = _records(source, _rate_hz(source, table), signals, table.get("accepted"), found)
    else:
        return False
    _say_left(source, table, used, found)
    return bool(signals)


def _say_left(source: str, table: Named, used: list[_Signal], found: Found) -> None:
    """Of what was not taken, its names: nobody else would miss them."""
    taken = {name for signal in used for name in signal.names}
    words = (*_RATES, "coherence", "accepted", "hit", *_others(), *CARRIED)
    left = [
        n
        for n in table
        if n not in taken
        and not any(n.lower().startswith(w) for w in words)
        and bracketed(n)[1][:1] not in ([axis] for axis in (*_FREQUENCIES, *_TIMES))
    ]
    if used and left:
        found.said.append(f"passed over: {source}: {', '.join(left)[:_LONGEST]}")


# Axes


def _axis(
    source: str, table: Named, words: tuple[str, ...], units: dict[str, float], *, needed: bool = True
) -> Array | None:
    """The column of an axis in its SI unit; where it is `needed` one in another unit is refused."""
    rows = [
        n
        for n, values in table.items()
        if values.ndim == 1 and values.size > 1 and not np.iscomplexobj(values) and unit_in(n) is None
    ]
    found = axis_of(source, rows, words, units, needed=needed)
    return None if found is None else np.asarray(table[found[0]], float) * found[1]


def _rate_hz(source: str, table: Named) -> float:
    """Samples a second, as is said or as the times have it. Raises `BadInput` where these contradict."""
    said = [float(table[n].ravel()[0]) for n in table if n.lower() in _RATES and table[n].size == 1]
    t = _axis(source, table, _TIMES, _AXIS_S, needed=not said)
    if t is None and not said:
        raise BadInput(f"{source}: no sample rate, expected sample_rate_hz or a column of times")
    if t is not None:
        rate = rate_of_times(t)
        if rate is None:
            raise BadInput(f"{source}: its times are not evenly spaced, expected a constant step")
        said.append(rate)
    if min(said) > 0 and max(said) > min(said) * (1 + CONTRADICTION):
        raise BadInput(f"{source}: sample rates contradict: {', '.join(f'{r:.6g}' for r in said)} Hz")
    return said[0]


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
        if name in others:
            continue
        unit = unit_in(name)
        if (unit is None or unit.per is None) and part_in(name) != "phase":
            refuse_unknown(source, name, unit)
        if unit is None and part_in(name) != "phase":
            continue
        if unit is not None:
            refuse_contradiction(source, name, unit)
        parts.setdefault(stem_of(name), {})[part_in(name)] = name
    _lend_phase(table, parts)
    return [s for stem, by_part in parts.items() if (s := _signal(source, table, stem, by_part)) is not None]


def _lend_phase(table: Named, parts: dict[tuple[str, ...], dict[Part, str]]) -> None:
    """A phase that does not say of what is that of the only size, beside which there may be a base's."""
    lent = parts.get(())
    if lent is None or set(lent) != {"phase"}:
        return
    sizes = [
        (stem, names)
        for stem, names in parts.items()
        if not BASE & set(stem)
        and set(names) in ({"whole"}, {"magnitude"})
        and not any(np.iscomplexobj(table[name]) for name in names.values())
    ]
    readings = [stem for stem in parts if stem and not BASE & set(stem)]
    if len(sizes) == len(readings) == 1:
        sizes[0][1]["phase"] = lent["phase"]
        del parts[()]


def _signal(source: str, table: Named, stem: tuple[str, ...], names: dict[Part, str]) -> _Signal | None:
    label = next(iter(names.values()))
    units = [u for part, n in names.items() if part != "phase" and (u := unit_in(n))]
    if not units:
        return None
    unit = units[0]
    if any(u != unit for u in units):
        raise BadInput(f"{source}: {' and '.join(names.values())}: expected both in one unit")
    if ("re" in names) != ("im" in names):
        raise BadInput(f"{source}: {label}: its other part is missing, expected re and im")
    size = names.get("magnitude") or names.get("whole")
    if "re" in names:
        values: NDArray[Any] = _from_parts(source, table, names["re"], names["im"])
        if size is not None:
            _check_agree(source, table, names, size, values)
    elif size is None:
        return None
    elif "phase" in names:
        values = _size(table, size)
        if not np.iscomplexobj(values) and np.any(values < 0):
            raise NotSaid(f"{source}: {size}: {np.nanmin(values):g} as a size beside a phase: is it in dB?")
        values = values * np.exp(1j * radians(source, names["phase"], table[names["phase"]]))
    else:
        values = _size(table, size)
    # Of a ratio both are stated alike.
    peak = (
        1.0 if unit.per is not None else max(map(amplitude_factor, names.values()), key=lambda x: abs(x - 1))
    )
    return _Signal(
        label, unit, bool(BASE & set(stem)), values * (unit.factor * peak), peak, tuple(names.values())
    )


def _from_parts(source: str, table: Named, re: str, im: str) -> NDArray[Any]:
    for name in (re, im):
        if reference_of_db(name) is not None:
            raise NotSaid(f"{source}: {name}: dB of a part of a phasor, expected dB of its magnitude")
    return np.asarray(table[re] + 1j * table[im])


def _size(table: Named, name: str) -> NDArray[Any]:
    """As it stands, of dB what it is a level of."""
    reference = reference_of_db(name)
    return table[name] if reference is None else of_decibels(table[name], reference)


def _check_agree(source: str, table: Named, names: dict[Part, str], size: str, values: NDArray[Any]) -> None:
    """Raise `BadInput` where a magnitude, or magnitude and phase, are not those of the parts beside them."""
    other = _size(table, size)
    if np.iscomplexobj(other) or other.shape != values.shape:
        return
    own = np.abs(values)
    if "phase" in names:
        other = other * np.exp(1j * radians(source, names["phase"], table[names["phase"]]))
        own = values
    most = float(np.nanmax(np.abs(values), initial=0.0))
    if not np.allclose(own, other, atol=_SAME * most, rtol=_SAME, equal_nan=True):
        raise BadInput(
            f"{source}: {', '.join(names.values())}: magnitude and phase are not those of real and imaginary "
            "part, expected one of both"
        )


# What they make together


def _on_lines(source: str, table: Named, f: Array, signals: list[_Signal], found: Found) -> list[_Signal]:
    """Those taken: ratios, or a velocity beside its base acceleration or its force."""
    for s in (s for s in signals if s.values.shape != f.shape):
        found.said.append(f"passed over: {source}: {s.name}: {s.values.shape} beside {len(f)} frequencies")
    signals = [s for s in signals if s.values.shape == f.shape]
    alone = sum(s.unit.per is not None for s in signals) == 1
    for s in signals:
        if s.unit.per is not None:
            found.add_ratio(_ratio(source, s, f), _coherence(table, s.name, alone=alone))
    plain = [s for s in signals if s.unit.per is None]
    forces = [s for s in plain if s.unit.quantity == "force"]
    motions = [s for s in plain if s.unit.quantity in DERIVATIVE]
    readings, drives = [s for s in motions if not s.is_base], [s for s in motions if s.is_base] + forces
    ratios = [s for s in signals if s.unit.per is not None]
    if not readings:
        return ratios
    if len(readings) > 1 or len(drives) > 1:
        raise BadInput(
            f"{source}: {', '.join(s.name for s in motions + forces)}: which is the response? expected one "
            f"velocity, and one force or motion of the base (a name with one of {', '.join(sorted(BASE))})"
        )
    found.sweeps.append(_sweep(source, table, f, readings[0], drives[0] if drives else None, found))
    return [*ratios, *readings, *drives]


def _ratio(source: str, s: _Signal, f: Array) -> Ratio:
    if not np.iscomplexobj(s.values):
        raise BadInput(
            f"{source}: {s.name}: no phase, expected real and imaginary part, or magnitude and phase"
        )
    name = f"{source}: {s.name}"
    return Ratio(name, f, s.values.astype(complex), s.unit.quantity, s.unit.per or "force", response=s.name)


def _sweep(
    source: str, table: Named, f: Array, reading: _Signal, drive: _Signal | None, found: Found
) -> Columns:
    columns: Columns = {"frequency_hz": f}
    v = _as(source, reading, "velocity", f)
    _check_rows(source, reading, f)
    _check_sizes(source, reading, drive)
    columns |= _phasor("velocity", "m_s", v) if np.iscomplexobj(v) else {"velocity_m_s": v}
    over = ", no base channel"
    if drive is not None:
        is_force = drive.unit.quantity == "force"
        a = drive.values if is_force else _as(source, drive, "acceleration", f)
        columns |= _phasor("force", "n", a) if is_force else _phasor("base_accel", "m_s2", a)
        unsaid = np.iscomplexobj(v) and not np.iscomplexobj(a)
        over = f", with {drive.words}{' (no phase: taken as 0)' if unsaid else ''}"
    columns |= _beside(source, table, f, found)
    how = "phasors" if np.iscomplexobj(v) else "amplitudes"
    band = f"{len(f)} points, {f.min():.5g} to {f.max():.5g} Hz"
    found.said.append(f"{source}: {reading.words} as velocity {how}{over}, {band}")
    return columns


def _beside(source: str, table: Named, f: Array, found: Found) -> Columns:
    """Columns of ours as they stand; a single number is that of every row."""
    columns: Columns = {}
    for name in (n for n in (*_others(), *CARRIED) if n in table):
        x = np.full(f.shape, table[name].ravel()[0]) if table[name].size == 1 else table[name]
        if x.shape != f.shape or np.iscomplexobj(x):
            found.said.append(f"passed over: {source}: {name}: {x.dtype} of shape {x.shape}")
        elif name not in CARRIED or not np.all(np.isnan(x)):
            columns[name] = np.asarray(x, float)
    return columns


def _check_sizes(source: str, reading: _Signal, drive: _Signal | None) -> None:
    """Raise `NotSaid` where one of the two is rms or peak to peak and nothing is said of the other."""
    if drive is None:
        return
    for one, other in ((reading, drive), (drive, reading)):
        if one.peak != 1.0 and all(stated_factor(name) is None for name in other.names):
            raise NotSaid(
                f"{source}: {other.name}: rms, peak or peak to peak beside {one.name}? expected in its name"
            )


def _check_rows(source: str, reading: _Signal, f: Array) -> None:
    """Raise `BadInput` for a row of a sweep that is none."""
    for what, bad in (("no number", ~np.isfinite(reading.values)), ("a frequency not above 0", ~(f > 0))):
        if bad.any():
            row = int(np.flatnonzero(bad)[0]) + 1
            raise BadInput(f"{source}: {reading.name}: {what} in row {row} of {len(f)}, expected none such")


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
    names, words = [n for n in table if n.lower().startswith("coherence")], set(bracketed(ratio)[1])
    further = {n: set(bracketed(n)[1]) - {"coherence"} for n in names}
    own = names if alone and len(names) == 1 else [n for n in names if further[n] and further[n] <= words]
    return np.asarray(table[own[0]], float) if len(own) == 1 else None


def _records(
    source: str, rate_hz: float, signals: list[_Signal], accepted: NDArray[Any] | None, found: Found
) -> list[_Signal]:
    """Those taken: a force and its responses; matrices are hits side by side, those not accepted left out."""
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
    return [*forces, *responses]


def _hits(values: NDArray[Any]) -> list[Array]:
    """Columns of a matrix; a vector is one."""
    x = np.asarray(values, float)
    return [x] if x.ndim == 1 else [x[:, k] for k in range(x.shape[1])]
