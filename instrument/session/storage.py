"""Session files: every path inside them is here, writer and reader side by side. Layout version 1.

    /                     format, layout_version
    /configuration        one string: JSON of `Configuration`
    /parts/000001/events  one JSON line an event, in order, with `sha256` of the lines
    /parts/000001/samples int32 (channels, samples): the counts of the part's blocks, end to end
    /points/<quantity>    one value a point, with `units`
    /calibration/<range>  gain, delay_s, their standard deviations (attributes)

While a run goes on each part is a sealed file of its own (`part-000001.h5`, the same two data sets), named in
a journal with its checksum. A file is written under another name, flushed to the disk and renamed, so that it
is whole or not there. What the journal does not name does not count.
"""

import errno
import hashlib
import os
import re
import shlex
import shutil
from collections.abc import Iterator
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from pydantic import ValidationError

from instrument.errors import BadInput
from instrument.files.point_columns import stored
from instrument.files.text import refuse_endless
from instrument.files.toml import one_line
from instrument.session.configuration import Configuration
from instrument.session.heaps import check_heaps
from instrument.stream.derived import CalibrationFound, PointMeasured
from instrument.stream.event import Event, UnknownEvent, from_line, to_line
from instrument.stream.raw import BlockAcquired

FORMAT = "viscorig session"
LAYOUT_VERSION = 1

_MOST_PACKED = 1100
"""No deflated byte stands for more."""
_ROOM, _OVERHEAD_BYTES = 1.1, 1_000_000
"""A session takes as much as its parts and a little more."""


def write_part(path: Path, events: list[Event]) -> str:
    """Seal some events in a file of their own; its SHA-256."""
    # Made in memory: HDF5 takes a full disk so badly that the program may not survive it.
    with h5py.File(path.name, "w", driver="core", backing_store=False) as file:
        file.attrs["format"], file.attrs["layout_version"] = FORMAT, LAYOUT_VERSION
        _write_events(file, events)
        file.flush()
        image = file.id.get_file_image()
    temporary = path.with_suffix(".tmp")
    temporary.write_bytes(image)
    return seal(temporary, path)


def write_session(path: Path, configuration: Configuration, parts: list[Path]) -> None:
    """Put a session together from its sealed parts.

    Raises `OSError` where the disk is too full for it, `BadInput` where a part is of a later version.
    """
    needed = _ROOM * sum(part.stat().st_size for part in parts) + _OVERHEAD_BYTES
    if (free := shutil.disk_usage(path.parent).free) < needed:
        room = f"{free / 1e6:.0f} MB free, {needed / 1e6:.0f} MB needed for {path.name}"
        raise OSError(errno.ENOSPC, f"disk full: {room}")
    temporary = path.with_suffix(".tmp")
    try:
        _put_together(temporary, configuration, parts)
        seal(temporary, path)
    except (OSError, RuntimeError) as error:
        # What is cut is no session: the parts are all that there is.
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise _by_the_system(error, path) from error
    except BaseException:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise


_ERRNO = re.compile(r"errno = (\d+)")
"""As the library says which error the system gave it."""


def _by_the_system(error: OSError | RuntimeError, path: Path) -> OSError:
    """The system's error under one of the library, whose words are of its inside."""
    number = error.errno if isinstance(error, OSError) else None
    if number is None and (said := _ERRNO.search(str(error))):
        number = int(said[1])
    if number is None:
        return OSError(errno.EIO, "it cannot be written: is the disk full?", str(path))
    return OSError(number, os.strerror(number), str(path))


def _put_together(temporary: Path, configuration: Configuration, parts: list[Path]) -> None:
    with h5py.File(temporary, "w") as file:
        file.attrs["format"], file.attrs["layout_version"] = FORMAT, LAYOUT_VERSION
        file["configuration"] = configuration.model_dump_json()
        kept: list[PointMeasured | CalibrationFound] = []
        for number, part in enumerate(parts, start=1):
            group = file.create_group(f"parts/{number:06d}")
            _copy(part, group)
            kept += [e for e in part_events(part) if isinstance(e, PointMeasured | CalibrationFound)]
        _write_points(file, [event for event in kept if isinstance(event, PointMeasured)])
        for found in kept:
            if isinstance(found, CalibrationFound):
                group = file.require_group(f"calibration/{found.range_name.replace('/', ' per ')}")
                group.attrs.update({k: v for k, v in found.facts().items() if k != "range_name"})


def _copy(part: Path, group: h5py.Group) -> None:
    with h5py.File(part, "r") as source:
        for name in source:
            source.copy(name, group)


_CUT = re.compile(r"truncated file: eof = (\d+),.* stored_eof = (\d+)")
"""As the library says it of a file that ends before its data do."""


def _why_not(path: Path, said: str) -> str:
    """The library's own words for people: why a file that is there cannot be opened."""
    if path.is_dir():
        of_a_run = path.name.endswith(".running")
        command = shlex.join(["viscorig", "recover", str(path)])
        return f"a run's folder: {command} puts its session together" if of_a_run else "a folder"
    if cut := _CUT.search(said):
        return f"it ends after {int(cut[1]):,} of {int(cut[2]):,} bytes, expected all of it: copy it again"
    if "signature not found" in said:
        return "what is in it is no HDF5"
    return said.splitlines()[0][:80]


class SessionFile:
    """A recorded session, read. Use as a context."""

    def __init__(self, path: Path) -> None:
        self.path = path
        refuse_endless(path)
        try:
            self._file = h5py.File(path, "r")
        except OSError as error:
            if not path.exists():
                raise BadInput(f"{path}: no such file") from None
            raise BadInput(f"{path}: not a session file: {_why_not(path, str(error))}") from None
        try:
            ours = str(self._file.attrs.get("format")) == FORMAT
            version = int(self._file.attrs.get("layout_version", 0))
            whole = isinstance(self._file.get("configuration"), h5py.Dataset)
            whole = whole and isinstance(self._file.get("parts"), h5py.Group)
        except (ValueError, TypeError):
            ours, version, whole = False, 0, False
        if not (ours and whole and version > 0):
            self._file.close()
            raise BadInput(f"{path}: an HDF5 file, but not a session of this program")
        if version > LAYOUT_VERSION:
            self._file.close()
            raise BadInput(
                f"{path}: layout version {version}, expected at most {LAYOUT_VERSION}: update viscorig"
            )

    def __enter__(self) -> "SessionFile":
        return self

    def __exit__(self, kind: object, error: BaseException | None, *_: object) -> None:
        """Numbers and names that no run writes are said as such, whatever they make go wrong."""
        self._file.close()
        if isinstance(error, _BY_WRONG_VALUES):
            said = " ".join(str(error).split())[:_LONGEST] or type(error).__name__
            raise BadInput(f"{self.path}: damaged: {said}") from error

    @property
    def part_count(self) -> int:
        """How many parts it was put together from."""
        return len(self._file["parts"])

    @property
    def configuration(self) -> Configuration:
        """What it was made with. Raises `BadInput`."""
        try:
            return Configuration.model_validate_json(_text(self._file["configuration"][()]))
        except ValueError as error:
            raise BadInput(f"{self.path}: configuration: {str(error).splitlines()[0]}") from None

    def events(self, *, with_samples: bool = True) -> Iterator[Event]:
        """Every event in order. Raises `BadInput` where the file is damaged."""
        for number in range(self.part_count):
            yield from self.part(number, with_samples=with_samples)

    def part(self, number: int, *, with_samples: bool = True) -> Iterator[Event]:
        """The events of one part, counted from 0. Raises `BadInput` where it is damaged."""
        try:
            for event in _events(self._file["parts"][self._part_names[number]], with_samples):
                if isinstance(event, PointMeasured) and not abs(event.base_m_s2) > 0:
                    raise ValueError(f"point of step {event.step}: nothing at the base")
                yield event
        except ValidationError as error:
            raise BadInput(f"{self.path}: damaged: {one_line(error)}") from None
        except _BY_WRONG_VALUES as error:
            said = (str(error).splitlines() or [type(error).__name__])[0][:_LONGEST]
            raise BadInput(f"{self.path}: damaged: {said}") from None

    @cached_property
    def _part_names(self) -> list[str]:
        return sorted(self._file["parts"])


_BY_WRONG_VALUES = (OSError, RuntimeError, ValueError, LookupError, ArithmeticError)
"""Of the HDF5 library and of numbers."""
_LONGEST = 100
"""Of what is said of damage, in characters."""


def part_events(path: Path) -> list[Event]:
    """The events of a sealed part, without samples. Raises `BadInput` where it is of a later version."""
    with h5py.File(path, "r") as file:
        return list(_events(file, with_samples=False))


def checksum(path: Path) -> str:
    """SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def seal(temporary: Path, path: Path) -> str:
    """Flush a closed file to the disk and give it its name: whole or not there. Its SHA-256."""
    with temporary.open("rb") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
        os.fsync(file.fileno())
    temporary.replace(path)
    sync_folder(path.parent)
    return digest


def sync_folder(folder: Path) -> None:
    """Flush the names in a folder."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _write_events(group: Any, events: list[Event]) -> None:
    lines = [to_line(event) for event in events]
    written = group.create_dataset(
        "events", data=lines, dtype=h5py.string_dtype(), compression="gzip", compression_opts=1
    )
    # HDF5's own sums do not cover strings of any length.
    written.attrs["sha256"] = _digest(lines)
    counts = [e.counts for e in events if isinstance(e, BlockAcquired)]
    if counts:
        samples = np.concatenate(counts, axis=1)
        data = group.create_dataset(
            "samples", data=samples, compression="gzip", compression_opts=1, shuffle=True, fletcher32=True
        )
        data.attrs["units"] = "converter counts; volts_per_count of the block gives V"


def _events(group: Any, with_samples: bool) -> Iterator[Event]:
    samples = _array(group, "samples", 2) if with_samples and "samples" in group else None
    at = 0
    lines = [_text(line) for line in _array(group, "events", 1)]
    stated = group["events"].attrs.get("sha256")
    if stated is not None and _text(stated) != _digest(lines):
        raise ValueError("events: not as they were written")
    for line in lines:
        try:
            event = from_line(line)
        except UnknownEvent as error:
            if stated is None:
                raise
            # Written so: what else it may have changed is not known, so nothing is read past it.
            raise BadInput(
                f"{group.file.filename}: of a later version of viscorig (its event {error.name} is not known "
                "here), expected this version or an earlier one: update viscorig"
            ) from None
        if isinstance(event, BlockAcquired) and samples is not None:
            counts = samples[:, at : at + event.samples]
            at += event.samples
            if not 0 <= event.samples == counts.shape[1]:
                raise ValueError(f"samples: {counts.shape[1]} in a block of {event.samples}")
            facts = {**event.facts(), "counts": counts}
            event = BlockAcquired(**facts)
        yield event


def _array(group: Any, name: str, dimensions: int) -> Any:
    """What a data set holds. Raises `ValueError` where there is none of this shape."""
    found = group.get(name) if isinstance(group, h5py.Group) else None
    if not isinstance(found, h5py.Dataset) or found.ndim != dimensions:
        raise ValueError(f"{name}: expected a data set with {dimensions} dimension{'s'[: dimensions - 1]}")
    if found.external or found.is_virtual or not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError(f"{name}: lies in another file")
    claimed, held = found.size * found.dtype.itemsize, found.id.get_storage_size()
    if claimed > _MOST_PACKED * held + _OVERHEAD_BYTES:
        raise ValueError(f"{name}: claims {claimed} bytes, holds {held}")
    if found.dtype.kind == "O":
        check_heaps(found)
    return found[()]


def _write_points(file: Any, points: list[PointMeasured]) -> None:
    group = file.create_group("points")
    for column in stored():
        values = [getattr(p, column.field) for p in points]
        group[column.field] = np.array([np.nan if v is None else v for v in values], dtype=float)
        group[column.field].attrs["units"] = column.unit
    group.create_dataset("purpose", data=[p.purpose for p in points], dtype=h5py.string_dtype())


def _digest(lines: list[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
