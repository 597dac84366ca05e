"""A sweep as CSV: columns with their units in the name, `#` comments, any order."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.sweep import Sweep, segments_by_gap
from instrument.errors import BadInput
from instrument.files.table import number, read_rows

_NUMBERS = (
    "frequency_hz",
    "velocity_re_m_s",
    "velocity_im_m_s",
    "velocity_m_s",
    "base_accel_re_m_s2",
    "base_accel_im_m_s2",
    "level_g",
    "time_s",
    "velocity_std_m_s",
    "weight",
    "segment",
    "sweep",
)
_ABOVE_ZERO = ("frequency_hz", "velocity_m_s", "level_g", "velocity_std_m_s", "weight")
_WHOLE = ("segment", "sweep")
_LARGEST_WHOLE = 1e9
_IDENTITY = ("sweep", "segment", "level_g", "frequency_hz", "time_s")
"""Two rows equal in all of these are one measurement written twice."""


@dataclass(frozen=True)
class SweepFile:
    """The rows of a file: known columns as numbers, unknown ones as they stand."""

    path: Path
    columns: dict[str, Array]
    unknown: dict[str, list[str]]

    def sweep(self, acceleration_m_s2: float) -> Sweep:
        """The sweep, its levels multiples of `acceleration_m_s2`."""
        c = self.columns
        f = c["frequency_hz"]
        phasor = "velocity_re_m_s" in c
        base = None
        if "base_accel_re_m_s2" in c:
            base = c["base_accel_re_m_s2"] + 1j * c["base_accel_im_m_s2"]
        return Sweep(
            frequency_hz=f,
            velocity_m_s=c["velocity_re_m_s"] + 1j * c["velocity_im_m_s"] if phasor else c["velocity_m_s"],
            commanded_m_s2=c.get("level_g", np.ones(len(f))) * acceleration_m_s2,
            segment=c["segment"].astype(np.intp) if "segment" in c else segments_by_gap(f),
            sweep=c["sweep"].astype(np.intp) if "sweep" in c else np.ones(len(f), dtype=np.intp),
            base_m_s2=base,
            std_m_s=c.get("velocity_std_m_s"),
            weight=c.get("weight"),
            time_s=c.get("time_s"),
        )


def read_sweep(path: Path) -> SweepFile:
    """Read and check a sweep. Raises `BadInput` naming file, line and column."""
    header, rows = read_rows(path, lambda header: _check_header(path, header))
    columns: dict[str, Array] = {}
    for k, name in enumerate(header):
        if name in _NUMBERS:
            columns[name] = np.array([_number(path, line, name, row[k]) for line, row in rows])
    lines = [line for line, _ in rows]
    _check_phasors(path, lines, columns)
    _check_twice(path, lines, columns)
    unknown = {
        name: [row[k] for _, row in rows] for k, name in enumerate(header) if name and name not in _NUMBERS
    }
    return SweepFile(path, columns, unknown)


def _check_header(path: Path, header: list[str]) -> None:
    if "frequency_hz" not in header:
        raise BadInput(f"{path}: header: column frequency_hz missing, found {', '.join(header)[:120]}")
    has_phasor = "velocity_re_m_s" in header and "velocity_im_m_s" in header
    if not has_phasor and "velocity_m_s" not in header:
        raise BadInput(
            f"{path}: header: no velocity, expected velocity_re_m_s and velocity_im_m_s, or velocity_m_s"
        )
    for pair in (("velocity_re_m_s", "velocity_im_m_s"), ("base_accel_re_m_s2", "base_accel_im_m_s2")):
        given = [name for name in pair if name in header]
        if len(given) == 1:
            missing = pair[0] if given[0] == pair[1] else pair[1]
            raise BadInput(f"{path}: header: column {missing} missing beside {given[0]}")


def _number(path: Path, line: int, name: str, text: str) -> float:
    value = number(path, line, name, text)
    if name in _ABOVE_ZERO and value <= 0:
        raise BadInput(f"{path}: line {line}: {name} = {text}, expected more than 0")
    if name in _WHOLE and (value != int(value) or abs(value) > _LARGEST_WHOLE):
        raise BadInput(f"{path}: line {line}: {name} = {text}, expected a whole number below 1e9")
    return value


def _check_phasors(path: Path, lines: list[int], columns: dict[str, Array]) -> None:
    for stem, unit in (("velocity", "m_s"), ("base_accel", "m_s2")):
        names = f"{stem}_re_{unit}", f"{stem}_im_{unit}"
        if names[0] in columns:
            zero = np.flatnonzero((columns[names[0]] == 0) & (columns[names[1]] == 0))
            if zero.size:
                raise BadInput(f"{path}: line {lines[zero[0]]}: {stem} is zero, expected a reading")


def _check_twice(path: Path, lines: list[int], columns: dict[str, Array]) -> None:
    keys = [columns[name] for name in _IDENTITY if name in columns]
    seen: dict[tuple[float, ...], int] = {}
    for line, key in zip(lines, zip(*keys, strict=True), strict=True):
        if key in seen:
            raise BadInput(
                f"{path}: line {line}: the same point as line {seen[key]} "
                f"({', '.join(n for n in _IDENTITY if n in columns)} all equal), expected each once"
            )
        seen[key] = line
