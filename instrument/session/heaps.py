"""Where an HDF5 file keeps strings, looked at before the library does: one without an end holds it for ever.

A heap is `GCOL`, a version and its size, then objects: index, references, size, data padded to 8 bytes.
Object 0 is what is free, and its size is all of it.
"""

import struct
import zlib
from typing import Any, BinaryIO

import numpy as np

_REFERENCE = np.dtype([("length", "<u4"), ("address", "<u8"), ("index", "<u4")])
"""Of a string, as a data set has it."""
_SIGNATURE = b"GCOL"
_HEAD_BYTES = 16
"""Of a heap, and of an object in it."""
_UNPACKED = 1
"""Of a chunk's filter mask."""


def check_heaps(strings: Any) -> None:
    """Raise `ValueError` where a heap that a data set of strings points to does not end; `OSError`."""
    addresses = _addresses(strings)
    with open(strings.file.filename, "rb") as file:
        for address in sorted(addresses):
            if not _ends(file, strings.file.userblock_size + address):
                raise ValueError(f"its strings at byte {address} have no end")


def _addresses(strings: Any) -> set[int]:
    """Of its heaps; empty where it is not in chunks, as no run writes it."""
    found = set[int]()
    for k in range(strings.id.get_num_chunks() if strings.chunks else 0):
        mask, content = strings.id.read_direct_chunk(strings.id.get_chunk_info(k).chunk_offset)
        if strings.compression == "gzip" and not mask & _UNPACKED:
            try:
                content = zlib.decompress(content)
            except zlib.error as error:
                raise ValueError(str(error)) from None
        references = np.frombuffer(content, _REFERENCE, len(content) // _REFERENCE.itemsize)
        found.update(references["address"][references["length"] > 0].tolist())
    return found


def _ends(file: BinaryIO, at: int) -> bool:
    """Whether every object leads to the next; what is no heap the library says itself."""
    file.seek(at)
    head = file.read(_HEAD_BYTES)
    if len(head) < _HEAD_BYTES or not head.startswith(_SIGNATURE):
        return True
    end = at + struct.unpack("<8xQ", head)[0]
    while (place := file.tell()) + _HEAD_BYTES <= end:
        head = file.read(_HEAD_BYTES)
        if len(head) < _HEAD_BYTES:
            return True
        index, size = struct.unpack("<H6xQ", head)
        step = _HEAD_BYTES + size + -size % 8 if index else size
        if step < _HEAD_BYTES or place + step > end:
            return False
        file.seek(place + step)
    return True
