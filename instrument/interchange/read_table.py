"""Named arrays side by side, of a CSV or a MATLAB struct, to what they are by their names."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.files.point_columns import understood
from instrument.files.rates import CONTRADICTION
from instrument.files.table import check_above_zero, check_size, rate_of_times
from instrument.files.units import DERIVATIVE, KNOWN, Quantity
from instrument.interchange.celsius import with_celsius
from instrument.interchange.columns_of_ours import with_columns_of_ours
from instrument.interchange.found import CARRIED, Columns, Found, Ratio
from instrument.interchange.read_modes import read_modes
from instrument.interchange.said_by_name import ANGULAR, ANGULAR_HZ, BASE, NotSaid, axis_of
from instrument.interchange.signals import Named, Signal, signals_of
from instrument.interchange.unit_in_name import bracketed, is_unit_said, stated_factor, unit_in

_RATES = ("sample_rate_hz", "sampling_rate_hz", "fs", "fs_hz", "sample_rate", "sampling_frequency")
_FREQUENCIES = ("frequency", "freq", "f")
_TIMES = ("time", "t")
_COHERENCE = "coh"
_SPREAD = "velocity_std_m_s"
"""Of a velocity: beside a ratio, whose level nobody knows, it is of none."""
_LONGEST = 200
_SAME_AXIS = 1e-6
"""Relative: between two columns of one axis, written with as many digits."""
_AXIS_HZ = {"Hz": 1.0, "kHz": 1e3, "rad/s": 1 / (2 * np.pi), "": 1.0}
_AXIS_S = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "": 1.0}


def read_table(source: str, table: Named, found: Found) -> bool:
    """Add what a table holds; False where it is none of ours. Raises `BadInput` where it contradicts itself.

    `source` names it in messages.
    """
    if read_modes(source, table, found):
        return True
    table = with_celsius(source, table, found)
    signals = signals_of(source, table, _others())
    frequency = _axis(source, table, _FREQUENCIES, _AXIS_HZ)
    if frequency is None:
        frequency = _axis(source, table, ANGULAR, ANGULAR_HZ)
    if frequency is not None:
        if any(s.unit.per != "force" for s in signals):
            table = with_columns_of_ours(source, table, found)
        sweeps = len(found.sweeps)
        used = _on_lines(source, table, frequency[1], signals, found)
        own = _own_taken(found.sweeps[sweeps:])
    elif any(s.unit.quantity == "force" for s in signals):
        used = _records(source, _rate_hz(source, table), signals, table.get("accepted"), found)
        own = set()
    else:
        return False
    _say_left(source, table, frequency, used, own, found)
    return bool(signals)


def _own_taken(sweeps: list[Columns]) -> set[str]:
    """Columns of ours that need no word more: sweeps have them, or it was said why not."""
    spreads = {_SPREAD} - {name for columns in sweeps for name in columns}
    return {*_others(), *CARRIED} - spreads if sweeps else set()


def _say_left(
    source: str,
    table: Named,
    frequency: tuple[str, Array] | None,
    used: list[Signal],
    own: set[str],
    found: Found,
) -> None:
    """Of what was not taken, its names: nobody else would miss them. `own`: columns of ours that were."""
    taken = {name for signal in used for name in signal.names} | own
    left = [n for n in table if n not in taken and n.lower() not in (*_RATES, "accepted", "hit")]
    left = [n for n in left if not _is_coherence(n)]
    if frequency is not None:
        left = [n for n in left if not _says_the_same(table, n, *frequency)]
    else:
        left = [n for n in left if bracketed(n)[1][:1] not in ([t] for t in _TIMES)]
    if used and left:
        found.said.append(f"passed over: {source}: {', '.join(left)[:_LONGEST]}")


def _says_the_same(table: Named, name: str, axis: str, f: Array) -> bool:
    """Whether a column is the axis, or another one of the same frequencies."""
    kinds = ((_FREQUENCIES, _AXIS_HZ), (ANGULAR, ANGULAR_HZ))
    known = [one for kind, units in kinds for one in axis_of("", [name], kind, units, needed=False)]
    own = (table[n] * factor for n, factor in known if table[n].shape == f.shape)
    return name == axis or any(np.allclose(x, f, rtol=_SAME_AXIS) for x in own)


# Axes


def _axis(
    source: str, table: Named, words: tuple[str, ...], units: dict[str, float], *, needed: bool = True
) -> tuple[str, Array] | None:
    """Name and values of an axis, in its SI unit; where it is `needed` one in another unit is refused."""
    rows = [
        n
        for n, values in table.items()
        if values.ndim == 1 and values.size > 1 and not np.iscomplexobj(values) and unit_in(n) is None
    ]
    found = axis_of(source, rows, words, units, needed=needed)
    each = [np.asarray(table[name], float) * factor for name, factor in found]
    for (name, _), values in zip(found[1:], each[1:], strict=True):
        if values.shape != each[0].shape or not np.allclose(values, each[0], rtol=_SAME_AXIS, equal_nan=True):
            raise NotSaid(f"{source}: {found[0][0]} and {name}: which of them? expected one")
    return (found[0][0], each[0]) if found else None


def _rate_hz(source: str, table: Named) -> float:
    """Samples a second, as is said or as the times have it. Raises `BadInput` where these contradict."""
    said = [float(table[n].ravel()[0]) for n in table if n.lower() in _RATES and table[n].size == 1]
    t = _axis(source, table, _TIMES, _AXIS_S, needed=not said)
    if t is None and not said:
        raise BadInput(f"{source}: no sample rate, expected sample_rate_hz or a column of times")
    if t is not None:
        rate = rate_of_times(t[1])
        if rate is None:
            raise BadInput(f"{source}: its times are not evenly spaced, expected a constant step")
        said.append(rate)
    if min(said) > 0 and max(said) > min(said) * (1 + CONTRADICTION):
        raise BadInput(f"{source}: sample rates contradict: {', '.join(f'{r:.6g}' for r in said)} Hz")
    return said[0]


def _others() -> list[str]:
    """Columns of the sweep CSV that pass as they are; phasors may come in other units and other parts."""
    names = [column for column in understood() if column.given == "if known"]
    return [column.name for column in names if not any(f"_{part}_" in column.name for part in ("re", "im"))]


# What they make together


def _on_lines(source: str, table: Named, f: Array, signals: list[Signal], found: Found) -> list[Signal]:
    """Those taken: ratios, or a velocity beside its base acceleration or its force."""
    signals = [one for s in signals for one in _columns_apart(s, len(f))]
    for s in (s for s in signals if s.values.shape != f.shape):
        found.said.append(f"passed over: {source}: {s.name}: {s.values.shape} beside {len(f)} frequencies")
    signals = [s for s in signals if s.values.shape == f.shape]
    alone = sum(s.unit.per is not None for s in signals) == 1
    beside = _beside(source, table, f, found)
    for s in signals:
        if s.unit.per is not None:
            if not any(is_unit_said(name) for name in s.names):
                found.said.append(f"{source}: {s.name}: no unit, taken in SI's")
            kept = {name: values for name, values in beside.items() if name != _SPREAD}
            found.add_ratio(_ratio(source, s, f, kept), _coherence(table, s.name, alone=alone))
    plain = [s for s in signals if s.unit.per is None]
    forces = [s for s in plain if s.unit.quantity == "force"]
    motions = [s for s in plain if s.unit.quantity in DERIVATIVE]
    readings, drives = [s for s in motions if not s.is_base], [s for s in motions if s.is_base] + forces
    ratios = [s for s in signals if s.unit.per is not None]
    if not readings:
        moved = [s.name for s in drives if s.unit.quantity != "force"]
        if moved and not ratios:
            raise NotSaid(f"{source}: {', '.join(moved)}: of the base by name, expected a response beside it")
        return ratios
    if len(readings) > 1 or len(drives) > 1:
        raise NotSaid(
            f"{source}: {', '.join(s.name for s in motions + forces)}: which is the response? expected one "
            f"velocity, and one force or motion of the base (a name with one of {', '.join(sorted(BASE))})"
        )
    found.sweeps.append(_sweep(source, f, readings[0], drives[0] if drives else None, beside, found))
    return [*ratios, *readings, *drives]


def _columns_apart(s: Signal, lines: int) -> list[Signal]:
    """Of a ratio's matrix each column, or row: as many points as it has. Anything else as it is."""
    if s.unit.per is None or s.values.ndim != 2 or lines not in s.values.shape:
        return [s]
    columns = s.values if s.values.shape[0] == lines else s.values.T
    return [replace(s, name=f"{s.name} {k + 1}", values=columns[:, k]) for k in range(columns.shape[1])]


def _ratio(source: str, s: Signal, f: Array, beside: Columns) -> Ratio:
    if not np.iscomplexobj(s.values):
        raise BadInput(
            f"{source}: {s.name}: no phase, expected real and imaginary part, or magnitude and phase"
        )
    name = f"{source}: {s.name}"
    over = s.unit.per or "force"
    return Ratio(name, f, s.values.astype(complex), s.unit.quantity, over, response=s.name, beside=beside)


def _sweep(
    source: str, f: Array, reading: Signal, drive: Signal | None, beside: Columns, found: Found
) -> Columns:
    columns: Columns = {"frequency_hz": f}
    v = _as(source, reading, "velocity", f)
    _check_rows(source, reading, f, found)
    _check_sizes(source, reading, drive)
    columns |= _phasor("velocity", "m_s", v) if np.iscomplexobj(v) else {"velocity_m_s": v}
    over = ", no base channel"
    if drive is not None:
        is_force = drive.unit.quantity == "force"
        a = drive.values if is_force else _as(source, drive, "acceleration", f)
        columns |= _phasor("force", "n", a) if is_force else _phasor("base_accel", "m_s2", a)
        unsaid = np.iscomplexobj(v) and not np.iscomplexobj(a)
        over = f", with {drive.words}{' (no phase: taken as 0)' if unsaid else ''}"
    columns |= beside
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


def _check_sizes(source: str, reading: Signal, drive: Signal | None) -> None:
    """Raise `NotSaid` where one of the two is rms or peak to peak and nothing is said of the other."""
    if drive is None:
        return
    for one, other in ((reading, drive), (drive, reading)):
        if one.peak != 1.0 and all(stated_factor(name) is None for name in other.names):
            raise NotSaid(
                f"{source}: {other.name}: rms, peak or peak to peak beside {one.name}? expected in its name"
            )


def _check_rows(source: str, reading: Signal, f: Array, found: Found) -> None:
    """Raise `BadInput` for a row of a sweep that is none."""
    for name, values in ((reading.name, reading.values), ("frequency in Hz", f)):
        for k in np.flatnonzero(~np.isfinite(values)):
            # Of a complex one the part that is none.
            x = values[k] if np.isrealobj(values) else np.abs(values[k])
            check_size(f"{source}: {found.place(int(k), len(f))}", name, x, f"{x:g}")
    for k in np.flatnonzero(f <= 0):
        check_above_zero(f"{source}: {found.place(int(k), len(f))}", "frequency in Hz", f[k], f"{f[k]:g}")


def _as(source: str, signal: Signal, wanted: Quantity, f: Array) -> NDArray[Any]:
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
    names = [n for n in table if _is_coherence(n)]
    words = set(bracketed(ratio)[1])
    further = {n: set(bracketed(n)[1][1:]) for n in names}
    own = names if alone and len(names) == 1 else [n for n in names if further[n] and further[n] <= words]
    return np.asarray(table[own[0]], float) if len(own) == 1 else None


def _is_coherence(name: str) -> bool:
    return "".join(bracketed(name)[1][:1]).startswith(_COHERENCE)


def _records(
    source: str, rate_hz: float, signals: list[Signal], accepted: NDArray[Any] | None, found: Found
) -> list[Signal]:
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
