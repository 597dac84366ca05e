"""The same measurement given twice: counted as two it would make everything look better known than it is."""

import hashlib
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.mode_tables.table import ModalTable
from fitting.sweep import Sweep
from instrument.errors import BadInput

_DIGITS = 6
"""To which two points are one: a table that was written again has as many, noise is larger."""


def refuse_repeats(paths: Sequence[Path]) -> None:
    """Raise `BadInput` where two files hold the same, to the last byte, or one is named twice.

    What cannot be read is said where it is read.
    """
    by_size: dict[int, list[Path]] = {}
    for path in paths:
        try:
            if path.is_file():
                by_size.setdefault(path.stat().st_size, []).append(path)
        except OSError:
            continue
    for alike in by_size.values():
        if len(alike) > 1:
            _refuse(alike)


def refuse_same_points(paths: Sequence[Path], sweeps: Sequence[Sweep]) -> None:
    """Raise `BadInput` where all points of one are points of another, in whatever order and file."""
    if len(sweeps) > 1:
        _refuse_shared(paths, [_points_of(sweep) for sweep in sweeps], "points")


def refuse_same_modes(paths: Sequence[Path], tables: Sequence[ModalTable]) -> None:
    """The same of tables of modes; `paths` has a table's file, and may have it again. Raises `BadInput`."""
    _refuse_shared(paths, [_rows(t.mode, t.frequency_hz, t.loss_factor) for t in tables], "modes")


def _points_of(sweep: Sweep) -> frozenset[tuple[str, ...]]:
    velocity = np.asarray(sweep.velocity_m_s)
    base = np.zeros(len(sweep)) if sweep.base_m_s2 is None else sweep.base_m_s2
    return _rows(sweep.frequency_hz, velocity.real, velocity.imag, base.real, base.imag)


def _rows(*columns: Array) -> frozenset[tuple[str, ...]]:
    """Shape (rows,) each."""
    return frozenset(zip(*([f"{x:.{_DIGITS}g}" for x in column] for column in columns), strict=True))


def _refuse_shared(paths: Sequence[Path], rows: Sequence[frozenset[tuple[str, ...]]], what: str) -> None:
    for (one, mine), (other, theirs) in combinations(zip(paths, rows, strict=True), 2):
        if mine and theirs and (mine <= theirs or theirs <= mine):
            which = "the same" if mine == theirs else "all of the fewer"
            raise BadInput(f"{other}: {which} {what} as in {one}: expected a measurement once")


def _refuse(paths: Sequence[Path]) -> None:
    seen: dict[str, Path] = {}
    for path in paths:
        try:
            with open(path, "rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
        except OSError:
            continue
        if digest in seen:
            raise BadInput(
                f"{path}: the same data as {seen[digest]}, to the last byte: expected a measurement once"
            )
        seen[digest] = path
