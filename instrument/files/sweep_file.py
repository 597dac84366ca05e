"""A sweep as CSV: columns with their units in the name, `#` comments, any order."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from fitting.arrays import Array, Complex
from fitting.specimen import Drive, Reading
from fitting.sweep import Sweep, segments_by_gap
from instrument.errors import BadInput
from instrument.files.column import Column
from instrument.files.near_columns import words_of_near
from instrument.files.nearest import nearest
from instrument.files.point_columns import understood
from instrument.files.table import SMALLEST, check_above_zero, check_frequency, check_whole, number, read_rows
from instrument.files.text import IMPORT_READS, read_text

_SAME_SIZE = 0.02
"""Between an amplitude and its phasor, written with few digits."""
_DRIVES: dict[Drive, tuple[str, str]] = {
    "base": ("base_accel_re_m_s2", "base_accel_im_m_s2"),
    "force": ("force_re_n", "force_im_n"),
}
"""Columns of the phasor that drives."""
_MEANT = 0.8
"""How alike an unknown column is to one of ours that was meant."""
_IN_OTHER_UNIT = re.compile("_(?:mm|um|nm|cm|in)_")
_DECISIVE = (
    "level_g",
    "weight",
    "velocity_re_m_s",
    "velocity_im_m_s",
    "velocity_m_s",
    "velocity_std_m_s",
    "base_accel_re_m_s2",
    "base_accel_im_m_s2",
)
"""Without them the same file gives another law."""
_READS = re.compile(r"velocity is (absolute|relative)\b|^\W*(absolute|relative) velocity over\b", re.I)
"""What exports of sessions, and people, say that a laser sees."""
_READINGS = (("velocity", "m_s", 0), ("acceleration", "m_s2", -1), ("displacement", "m", 1))
"""Stem and unit of phasor columns, and the power of i omega that makes a velocity of them."""


@dataclass(frozen=True)
class SweepFile:
    """The rows of a file: known columns as numbers, unknown ones as they stand."""

    path: Path
    columns: dict[str, Array]
    unknown: dict[str, list[str]]
    reads: Reading | None = None
    """As its comments say; None where they do not."""

    @property
    def remark(self) -> str:
        """For people, of columns whose names are nearly those of ours; empty where there are none."""
        return words_of_near(self.path, [*self.columns, *self.unknown])

    @property
    def temperature_c(self) -> float | None:
        """Mean of the column of that name, where there is one. Raises `BadInput`."""
        values = self._temperatures_c()
        return float(values.mean()) if len(values) else None

    @property
    def temperature_range_c(self) -> tuple[float, float] | None:
        """Its ends. Raises `BadInput`."""
        values = self._temperatures_c()
        return (float(values.min()), float(values.max())) if len(values) else None

    def _temperatures_c(self) -> Array:
        cells = [c for c in self.unknown.get("temperature_c", []) if c.strip()]
        try:
            values = np.array([float(c) for c in cells])
        except ValueError:
            values = np.array([np.nan])
        if not np.all(np.isfinite(values) & (values > -273.15)):
            raise BadInput(f"{self.path}: column temperature_c: expected numbers in degrees Celsius")
        return values

    def sweep(self, amplitude: float, drive: Drive = "base") -> Sweep:
        """The sweep, levels multiples of `amplitude`: m/s^2 of the base, or newtons. Raises `BadInput`."""
        c = self.columns
        f = c["frequency_hz"]
        self._check_drive(drive)
        base, (real, imaginary) = None, _DRIVES[drive]
        if real in c:
            base = c[real] + 1j * c[imaginary]
        return Sweep(
            frequency_hz=f,
            velocity_m_s=self._velocity(),
            commanded_m_s2=c.get("level_g", np.ones(len(f))) * amplitude,
            segment=c["segment"].astype(np.intp) if "segment" in c else segments_by_gap(f),
            sweep=c["sweep"].astype(np.intp) if "sweep" in c else np.ones(len(f), dtype=np.intp),
            base_m_s2=base,
            std_m_s=c.get("velocity_std_m_s"),
            weight=c.get("weight"),
            time_s=c.get("time_s"),
            pickup=c["pickup"].astype(np.intp) if "pickup" in c else None,
        )

    def _check_drive(self, drive: Drive) -> None:
        """Raise `BadInput` where the columns are those of another drive."""
        other, (wrong, _) = next((d, names) for d, names in _DRIVES.items() if d != drive)
        if wrong in self.columns:
            raise BadInput(
                f"{self.path}: column {wrong}, but the specimen's [excitation] kind is {drive!r}, "
                f"expected {other!r}"
            )
        if drive == "force":
            if "force_re_n" not in self.columns:
                raise BadInput(f"{self.path}: no force, expected force_re_n and force_im_n, or an FRF")
            if "level_g" in self.columns:
                raise BadInput(f"{self.path}: column level_g with a force, expected one level")

    def _velocity(self) -> Array | Complex:
        """As read, or made from acceleration or displacement: v = a/(i omega) = i omega x."""
        c, jw = self.columns, 2j * np.pi * self.columns["frequency_hz"]
        for stem, unit, power in _READINGS:
            if f"{stem}_re_{unit}" in c:
                read = c[f"{stem}_re_{unit}"] + 1j * c[f"{stem}_im_{unit}"]
                return np.asarray(read * jw**power) if power else read
        return c["velocity_m_s"]


def read_sweep(path: Path) -> SweepFile:
    """Read and check a sweep. Raises `BadInput` naming file, line and column."""
    header, rows = read_rows(path, lambda header: _check_header(path, header))
    known = {column.name: column for column in understood()}
    columns: dict[str, Array] = {}
    for k, name in enumerate(header):
        if name in known:
            columns[name] = np.array([_number(path, line, known[name], row[k]) for line, row in rows])
    lines = [f"line {line}" for line, _ in rows]
    _check_phasors(path, lines, columns)
    _check_amplitudes(path, lines, columns)
    _check_twice(path, lines, columns)
    unknown = {
        name: [row[k] for _, row in rows] for k, name in enumerate(header) if name and name not in known
    }
    comments = [line for line in read_text(path).splitlines() if line.lstrip().startswith("#")]
    return SweepFile(path, columns, unknown, reading_said(comments))


def reading_said(lines: Iterable[str]) -> Reading | None:
    """What a laser sees as some lines of text have it; None where none says it, or not all the same."""
    found = {(said[1] or said[2]).lower() for line in lines if (said := _READS.search(line)) is not None}
    return cast(Reading, found.pop()) if len(found) == 1 else None


def words_of_other_reading(said: str, stated: Reading) -> str:
    """For people, where a file says itself what its laser sees, and the specimen another; else empty."""
    if said == stated:
        return ""
    frame = "absolute" if said == "absolute" else "relative to the clamp"
    return f'it says that velocities are {frame}: expected reads = "{said}" in [pickup]'


def sweep_of_columns(
    path: Path, columns: dict[str, Array], reads: Reading | None = None, lines: Sequence[int] = ()
) -> SweepFile:
    """A sweep of columns from another program's file, NaN for what is not known of a row.

    Shape (rows,) each; `reads`: as that file says; `lines`: of its rows, where they are known. Raises
    `BadInput` naming file, row or line, and column.
    """
    known = {column.name: column for column in understood()}
    own = {name: values for name, values in columns.items() if name in known}
    rows = [f"line {n}" for n in lines] or [f"row {n + 1}" for n in range(len(columns["frequency_hz"]))]
    for name, values in own.items():
        for row, value in zip(rows, values.tolist(), strict=True):
            _check_number(f"{path}: {row}", known[name], value, f"{value:g}")
    _check_phasors(path, rows, own)
    _check_twice(path, rows, own)
    others = {name: values.tolist() for name, values in columns.items() if name not in known}
    unknown = {n: ["" if v != v else repr(v) for v in some] for n, some in others.items()}
    return SweepFile(path, own, unknown, reads)


def _check_header(path: Path, header: list[str]) -> None:
    for column in understood():
        if column.given == "always" and column.name not in header:
            if "force_n" in header:
                raise BadInput(
                    f"{path}: an impact record, expected a sweep: 'viscorig damping' reads a record"
                )
            near = nearest(column.name, header)
            turning = next((name for name in header if "rad_s" in name or "omega" in name.lower()), None)
            if turning:
                raise BadInput(
                    f"{path}: header: column {column.name} missing, found {turning}: expected Hz, rad/s "
                    "over 2 pi"
                )
            found = f"is it {near}?" if near else f"found {', '.join(header)[:120]}"
            raise BadInput(f"{path}: header: column {column.name} missing, {found}; {IMPORT_READS}")
    known = [column.name for column in understood()]
    for name in header:
        meant = nearest(name, [k for k in known if k not in header], _MEANT) if name not in known else None
        if meant in known and _IN_OTHER_UNIT.sub("_m_", name) == meant:
            raise BadInput(
                f"{path}: header: column {name} is not in m, expected {meant}, in m; {IMPORT_READS}"
            )
        if meant in _DECISIVE:
            raise BadInput(
                f"{path}: header: column {name} is unknown, the nearest is {meant}: expected that, or a name "
                "that is not like it"
            )
    pairs = [(f"{stem}_re_{unit}", f"{stem}_im_{unit}") for stem, unit, _ in _READINGS]
    readings = [pair for pair in pairs if pair[0] in header and pair[1] in header]
    if not readings and "velocity_m_s" not in header:
        raise BadInput(
            f"{path}: header: no velocity, expected velocity_re_m_s and velocity_im_m_s, or velocity_m_s, "
            f"or acceleration or displacement in their place; {IMPORT_READS}"
        )
    phases = [name for name in header if "phase" in name.lower()]
    if not readings and phases:
        raise BadInput(
            f"{path}: header: column {phases[0]} beside amplitudes, phases are not read so: expected "
            "velocity_re_m_s and velocity_im_m_s, amplitude times cosine and sine; without the column "
            "amplitudes alone are fitted"
        )
    if len(readings) > 1:
        raise BadInput(f"{path}: header: {readings[0][0]} and {readings[1][0]}, expected one kind of reading")
    for pair in _phasors():
        given = [name for name in pair if name in header]
        if len(given) == 1:
            missing = pair[0] if given[0] == pair[1] else pair[1]
            raise BadInput(f"{path}: header: column {missing} missing beside {given[0]}")


def _phasors() -> list[tuple[str, str]]:
    """Names of real and imaginary parts."""
    return [(c.name, c.imaginary) for c in understood() if c.imaginary]


def _number(path: Path, line: int, column: Column, text: str) -> float:
    value = number(path, line, column.name, text)
    _check_number(f"{path}: line {line}", column, value, text)
    return value


def _check_number(where: str, column: Column, value: float, text: str) -> None:
    if column.name == "frequency_hz":
        check_frequency(where, column.name, value, text)
    if column.above_zero:
        check_above_zero(where, column.name, value, text)
    if column.whole:
        check_whole(where, column.name, value, text)


def _check_phasors(path: Path, places: list[str], columns: dict[str, Array]) -> None:
    for real, imaginary in _phasors():
        if real in columns:
            zero = np.flatnonzero(np.maximum(np.abs(columns[real]), np.abs(columns[imaginary])) < SMALLEST)
            if zero.size:
                stem = real.partition("_re_")[0]
                raise BadInput(f"{path}: {places[zero[0]]}: {stem} is zero, expected a reading")


def _check_amplitudes(path: Path, places: list[str], columns: dict[str, Array]) -> None:
    """Raise `BadInput` where amplitudes beside phasors are not theirs."""
    amplitude = columns.get("velocity_m_s")
    if amplitude is None or "velocity_re_m_s" not in columns:
        return
    size = np.hypot(columns["velocity_re_m_s"], columns["velocity_im_m_s"])
    wrong = np.flatnonzero(np.abs(amplitude - size) > _SAME_SIZE * np.maximum(amplitude, size))
    if wrong.size:
        k = int(wrong[0])
        raise BadInput(
            f"{path}: {places[k]}: velocity_m_s = {amplitude[k]:g} beside a phasor of {size[k]:.4g}, "
            "expected one of both, or both alike"
        )


def _check_twice(path: Path, places: list[str], columns: dict[str, Array]) -> None:
    names = [column.name for column in understood() if column.identity and column.name in columns]
    keys = [columns[name] for name in names]
    seen: dict[tuple[float, ...], str] = {}
    for place, key in zip(places, zip(*keys, strict=True), strict=True):
        if key in seen:
            raise BadInput(
                f"{path}: {place}: the same point as {seen[key]} "
                f"({', '.join(names)} all equal), expected each once, or a column sweep that numbers passes"
            )
        seen[key] = place
