"""LabVIEW measurement text (.lvm): segments of channels side by side, with or without a time column."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.files.text import read_text

_END = "***End_of_Header***"
_SEPARATORS = {"Tab": "\t", "Comma": ",", "Semicolon": ";"}


@dataclass(frozen=True)
class SampleBlock:
    """One block of samples: named channels with their units, evenly sampled."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    sample_rate_hz: float
    samples: Array
    """Shape (samples, channels)."""


def read_lvm(path: Path) -> list[SampleBlock]:
    """Every segment of the file. Raises `BadInput`."""
    lines = read_text(path, encoding="latin-1").splitlines()
    if not lines or not lines[0].startswith("LabVIEW Measurement"):
        raise BadInput(f"{path}: line 1: expected 'LabVIEW Measurement'")
    ends = [k for k, line in enumerate(lines) if line.startswith(_END)]
    if len(ends) < 2:
        raise BadInput(f"{path}: no segment header, expected a second {_END}")
    facts = {}
    for line in lines[1 : ends[0]]:
        key, _, value = line.partition("\t")
        facts[key.strip()] = value.strip()
    separator = _SEPARATORS.get(facts.get("Separator", "Tab"), "\t")
    comma = facts.get("Decimal_Separator", ".") == ","
    segments = []
    for k, end in enumerate(ends[1:], start=1):
        header = _header(lines, ends[k - 1] + 1, end, separator)
        stop = _next_header(lines, end + 1)
        segments += _segments(path, header, lines, end + 1, stop, separator, facts, comma=comma)
    return segments


def _header(lines: list[str], start: int, end: int, separator: str) -> dict[str, list[str]]:
    found = {}
    for line in lines[start:end]:
        key, *values = line.split(separator)
        if key.strip() and values:
            found[key.strip()] = [v.strip() for v in values]
    return found


def _next_header(lines: list[str], start: int) -> int:
    """Where the samples end: at the next segment's `Channels`, or with the file."""
    for k in range(start, len(lines)):
        if lines[k].startswith("Channels") or lines[k].startswith(_END):
            return k
    return len(lines)


def _segments(
    path: Path,
    header: dict[str, list[str]],
    lines: list[str],
    start: int,
    stop: int,
    separator: str,
    facts: dict[str, str],
    *,
    comma: bool,
) -> list[SampleBlock]:
    try:
        count = int(header["Channels"][0])
        steps = [_float(text, comma=comma) for text in header["Delta_X"][:count] if text]
        step = steps[0]
    except (KeyError, ValueError, IndexError):
        raise BadInput(f"{path}: line {start}: segment without Channels or Delta_X") from None
    axis = header.get("X_Dimension", [""])[0]
    if axis.lower() not in ("", "time"):
        raise BadInput(
            f"{path}: line {start}: X_Dimension {axis!r}, expected Time: spectra are not read of it"
        )
    if not 1 <= count <= len(lines[start].split(separator)):
        raise BadInput(f"{path}: line {start}: {count} channels, expected as many as the names below")
    if step <= 0:
        raise BadInput(f"{path}: line {start}: Delta_X = {step:g}, expected more than 0")
    if any(other != step for other in steps):
        said = ", ".join(f"{s:g}" for s in steps)
        raise BadInput(f"{path}: line {start}: Delta_X = {said}, expected the same of every channel")
    columns = facts.get("X_Columns", "One")
    # The first field of a row is the time, empty where X_Columns is No; with Multi each channel has its own.
    first, stride = (1, 2) if columns == "Multi" else (1, 1)
    names = [n.strip() for n in lines[start].split(separator)]
    titles = tuple(names[first + stride * k] if first + stride * k < len(names) else "" for k in range(count))
    units = tuple((header.get("Y_Unit_Label", []) + [""] * count)[:count])
    rows = []
    for number in range(start + 1, stop):
        if not lines[number].strip():
            continue
        fields = lines[number].split(separator)
        try:
            rows.append([_float(fields[first + stride * k], comma=comma) for k in range(count)])
        except (ValueError, IndexError):
            raise BadInput(
                f"{path}: line {number + 1}: {lines[number][:60]!r}, expected {count} numbers"
            ) from None
    if len(rows) < 8:
        raise BadInput(f"{path}: line {start}: {len(rows)} samples in the segment, expected more")
    samples = np.array(rows)
    # One header may stand for several segments: `Samples` says how long each is.
    length = int(header.get("Samples", ["0"])[0] or 0)
    pieces = len(samples) // length if length > 0 and len(samples) % length == 0 else 1
    return [SampleBlock(titles, units, 1 / step, piece) for piece in np.split(samples, pieces)]


def _float(text: str, *, comma: bool) -> float:
    value = float(text.replace(",", ".") if comma or "." not in text else text)
    if not np.isfinite(value):
        raise ValueError(text)
    return value
