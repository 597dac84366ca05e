"""The tags of a MATLAB 5 file: one that is none takes the library that reads it and the program down.

A file is a chain of elements: a tag of type and size, then the data, padded to 8 bytes; of up to 4 bytes they
share the tag. A matrix is a chain itself: flags with its class, dimensions, name, then data or more matrices.
What is compressed has a checksum of its own.
"""

import os
import struct
from pathlib import Path
from typing import BinaryIO, NamedTuple

from instrument.errors import BadInput

_HEAD_BYTES = 128
_ORDERS = {b"\x00\x01IM": "<", b"\x01\x00MI": ">"}
"""By the last bytes of the head: version 5 and the byte order. Other versions are read without tags."""
_MATRIX = 14
_NUMBERS = (*range(1, 8), 9, 12, 13)
_TEXTS = (*_NUMBERS, 16, 17, 18)
_ANY = (*_TEXTS, _MATRIX)
"""Types of data."""
_FLAGS, _INTEGERS = 6, (5, 6)
"""Types of a matrix's flags and dimensions."""
_CHARACTERS, _SPARSE, _LAST_NUMERIC, _OPAQUE = 4, 5, 15, 17
"""Classes of matrices: numbers are from sparse ones to the last; an opaque one has no dimensions."""
_COMPLEX = 0x800
"""Of the flags."""
_PADDED = 7
"""Bytes at most."""
_BEFORE_DATA = 3
"""Flags, dimensions and name."""


class _Tag(NamedTuple):
    at: int
    kind: int
    length: int
    is_small: bool

    @property
    def end(self) -> int:
        return self.at + 8 + (0 if self.is_small else self.length + -self.length % 8)


def check_tags(path: Path) -> None:
    """Raise `BadInput` where a tag that is not compressed is none of a MATLAB file; `OSError`."""
    with path.open("rb") as file:
        order = _ORDERS.get(file.read(_HEAD_BYTES)[-4:])
        if order is None:
            return
        size = os.fstat(file.fileno()).st_size
        while file.tell() + 8 <= size:
            tag = _read(file, order)
            end = min(tag.at + 8 + tag.length, size)
            if tag.kind == _MATRIX:
                _check_chain(path, file, order, end)
            file.seek(end)


def _read(file: BinaryIO, order: str) -> _Tag:
    at = file.tell()
    kind, length = struct.unpack(f"{order}II", file.read(8))
    small = kind >> 16
    return _Tag(at, kind & 0xFFFF, small, True) if small else _Tag(at, kind, length, False)


def _check_chain(path: Path, file: BinaryIO, order: str, end: int) -> None:
    """Of a matrix, up to `end`; a matrix within is followed as the library does, whatever size it says."""
    place, flags = 0, 0
    while file.tell() + 8 <= end:
        tag = _read(file, order)
        kinds, shortest = _expected(place, flags)
        # The last one of a file may lack what pads it.
        is_long = tag.kind != _MATRIX and tag.end > end + _PADDED
        is_short = tag.length < shortest or (shortest and tag.is_small)
        if tag.kind not in kinds or is_short or is_long:
            raise BadInput(
                f"{path}: damaged: byte {tag.at}: {tag.length} bytes of type {tag.kind}, expected as MATLAB "
                "writes them"
            )
        if tag.kind == _MATRIX:
            # An empty one has nothing of its own: what follows is the next beside it.
            place, flags = (0, 0) if tag.length else (place, flags)
            continue
        if place == 0:
            (flags,) = struct.unpack(f"{order}I", file.read(4))
        place += 1
        file.seek(tag.end)


def _expected(place: int, flags: int) -> tuple[tuple[int, ...], int]:
    """Types that a matrix's element in this place may have, and its least size in bytes."""
    matrix_class = flags & 0xFF
    if place == 0:
        return (_FLAGS,), 8
    if matrix_class == _OPAQUE:
        return _ANY, 0
    if place < _BEFORE_DATA:
        return (_INTEGERS, 8) if place == 1 else (_TEXTS, 0)
    is_numeric = _SPARSE <= matrix_class <= _LAST_NUMERIC
    if not is_numeric and matrix_class != _CHARACTERS:
        return _ANY, 0
    count = 1 + (bool(flags & _COMPLEX) + 2 * (matrix_class == _SPARSE) if is_numeric else 0)
    if place >= _BEFORE_DATA + count:
        return (_MATRIX,), 0
    return _NUMBERS if is_numeric else _TEXTS, 0
