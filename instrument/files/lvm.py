"""LabVIEW measurement text (.lvm): segments of channels side by side, with or without a time column."""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.files.text import lines_of, read_text

_END = "***End_of_Header***"
_SEPARATORS = {"Tab": "\t", "Comma": ",", "Semicolon": ";"}
_LEAST_SAMPLES = 8
"""Fewer hold no hit."""


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
    lines = lines_of(path, read_text(path, encoding="latin-1"))
    if not lines or not lines[0].startswith("LabVIEW Measurement"):
        raise BadInput(f"{path}: line 1: expected 'LabVIEW Measurement'")
    ends = [k for k, line in enumerate(lines) if line.startswith(_END)]
    if len(ends) < 2:
        raise BadInput(f"{path}: no segment header, expected a second {_END}")
    layout = Layout.of(lines[1 : ends[0]])
    blocks = []
    for before, end in pairwise(ends):
        start, stop = end + 1, _next_header(lines, end + 1)
        try:
            header = SegmentHeader.of(lines[before + 1 : end], "".join(lines[start : start + 1]), layout)
        except BadInput as refused:
            raise BadInput(f"{path}: line {start}: {refused}") from None
        rows = _rows(path, lines, range(start + 1, stop), len(header.names), layout)
        if len(rows) < _LEAST_SAMPLES:
            raise BadInput(f"{path}: line {start}: {len(rows)} samples in the segment, expected more")
        blocks += header.split(np.array(rows))
    return blocks


@dataclass(frozen=True)
class Layout:
    """How the whole file writes its rows."""

    separator: str
    decimal_comma: bool
    first: int
    """Column of the first channel. Before it is the time, empty where `X_Columns` is No."""
    stride: int
    """Columns from one channel to the next: with `X_Columns` Multi each has its own time."""

    @classmethod
    def of(cls, lines: list[str]) -> "Layout":
        """By the file's own header."""
        facts = {}
        for line in lines:
            key, _, value = line.partition("\t")
            facts[key.strip()] = value.strip()
        multi = facts.get("X_Columns", "One") == "Multi"
        return cls(
            separator=_SEPARATORS.get(facts.get("Separator", "Tab"), "\t"),
            decimal_comma=facts.get("Decimal_Separator", ".") == ",",
            first=1,
            stride=2 if multi else 1,
        )

    def fields(self, line: str) -> list[str]:
        """The fields of a row."""
        return line.split(self.separator)

    def column(self, channel: int) -> int:
        """Which field of a row is a channel's, counted from 0."""
        return self.first + self.stride * channel

    def number(self, text: str) -> float:
        """The number in a field. Raises `ValueError` where it is none."""
        value = float(text.replace(",", ".") if self.decimal_comma or "." not in text else text)
        if not np.isfinite(value):
            raise ValueError(text)
        return value


@dataclass(frozen=True)
class SegmentHeader:
    """What the header of a segment says of its samples, and the row of names below it."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    step_s: float
    samples: int
    """In each of the segments it stands for; 0 where it does not say."""

    @classmethod
    def of(cls, lines: list[str], names: str, layout: Layout) -> "SegmentHeader":
        """By the lines between two ends of headers. Raises `BadInput`, without file and line."""
        said = {}
        for line in lines:
            key, *values = layout.fields(line)
            if key.strip() and values:
                said[key.strip()] = [v.strip() for v in values]
        try:
            count = int(said["Channels"][0])
            steps = [layout.number(text) for text in said["Delta_X"][:count] if text]
            step = steps[0]
        except (KeyError, ValueError, IndexError):
            raise BadInput("segment without Channels or Delta_X") from None
        axis = said.get("X_Dimension", [""])[0]
        if axis.lower() not in ("", "time"):
            raise BadInput(f"X_Dimension {axis!r}, expected Time: spectra are not read of it")
        titles = [name.strip() for name in layout.fields(names)]
        if not 1 <= count <= len(titles):
            raise BadInput(f"{count} channels, expected as many as the names below")
        if step <= 0:
            raise BadInput(f"Delta_X = {step:g}, expected more than 0")
        if any(other != step for other in steps):
            every = ", ".join(f"{s:g}" for s in steps)
            raise BadInput(f"Delta_X = {every}, expected the same of every channel")
        columns = [layout.column(k) for k in range(count)]
        return cls(
            names=tuple(titles[c] if c < len(titles) else "" for c in columns),
            units=tuple((said.get("Y_Unit_Label", []) + [""] * count)[:count]),
            step_s=step,
            samples=int(said.get("Samples", ["0"])[0] or 0),
        )

    def split(self, samples: Array) -> list[SampleBlock]:
        """One header may stand for several segments. `samples` has shape (samples, channels)."""
        whole = self.samples > 0 and len(samples) % self.samples == 0
        pieces = np.split(samples, len(samples) // self.samples if whole else 1)
        return [SampleBlock(self.names, self.units, 1 / self.step_s, piece) for piece in pieces]


def _next_header(lines: list[str], start: int) -> int:
    """Where the samples end: at the next segment's `Channels`, or with the file."""
    for k in range(start, len(lines)):
        if lines[k].startswith("Channels") or lines[k].startswith(_END):
            return k
    return len(lines)


def _rows(path: Path, lines: list[str], numbers: range, count: int, layout: Layout) -> list[list[float]]:
    """Of a segment, `count` channels each."""
    rows, columns = [], [layout.column(k) for k in range(count)]
    for number in numbers:
        if not lines[number].strip():
            continue
        fields = layout.fields(lines[number])
        try:
            rows.append([layout.number(fields[c]) for c in columns])
        except (ValueError, IndexError):
            raise BadInput(
                f"{path}: line {number + 1}: {lines[number][:60]!r}, expected {count} numbers"
            ) from None
    return rows
