"""Readers of other programs' files, by the ending of the file's name; other packages add theirs."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from fitting.plugins import NoPlugin, Registry
from instrument.errors import BadInput
from instrument.files.guard import checked_frf, checked_hits, said_of
from instrument.files.table import LARGEST, check_size
from instrument.files.text import refuse_workbook
from instrument.interchange.found import CARRIED, EXPECTED, Found
from instrument.interchange.naming import OF_ARRAYS, Naming
from instrument.interchange.provenance import one_line
from instrument.interchange.said_by_name import NotSaid

Reader = Callable[[Path], Found]
"""From a file to what it holds. Raises `BadInput`."""

_OURS = ("csv", "txt")
"""Endings of sweeps as this program writes them, too."""
_TEXTS = (*_OURS, "asc", "dat", "prn", "tsv")
"""Endings of tables as text."""
_NAMED = ("mat", *_TEXTS)
"""Endings of files whose arrays have names that this program goes by."""


def _judge(name: str, found: Any) -> Reader:
    if name != name.lower() or name.startswith("."):
        raise NoPlugin("the entry point's name is no ending in small letters without its dot")
    if not callable(found):
        raise NoPlugin(f"{found!r:.80} is no function from a path to `instrument.interchange.found.Found`")
    reader: Reader = found
    return reader


READERS: Registry[Reader] = Registry(
    "viscorig.readers",
    {
        **dict.fromkeys(("uff", "unv"), "instrument.interchange.read_uff:read_uff"),
        "lvm": "instrument.interchange.read_lvm:read_lvm_hits",
        "mat": "instrument.interchange.read_mat:read_mat",
        **dict.fromkeys(_TEXTS, "instrument.interchange.read_csv:read_csv"),
    },
    _judge,
)
"""By the ending without its dot, in small letters."""


def read_foreign(path: Path, naming: Naming | None = None) -> Found:
    """What a file holds, by its ending; `naming` has names in the place of its own. Raises `BadInput`."""
    if not path.is_file():
        raise BadInput(f"{path}: {'a folder, expected a file' if path.is_dir() else 'no such file'}")
    reader = READERS.get(_ending(path))
    if reader is None:
        refuse_workbook(path)
        raise BadInput(f"{path}: unknown ending {path.suffix!r}, {READERS.expected(_ending(path))}")
    if naming is not None:
        if _ending(path) not in _NAMED:
            raise BadInput(f"{path}: --columns is of arrays with names, expected {', '.join(_NAMED)}")
        named_reader: Callable[..., Found] = reader
        reader = partial(named_reader, naming=naming)
    may_name = naming is None and _ending(path) in _NAMED
    found = _read(reader, path, may_name=may_name)
    if not (found.sweeps or found.frfs or found.hits or found.modes):
        said = "; ".join(found.said) or "no array that says what it is"
        expected = f"; expected {EXPECTED}" if _ending(path) in _NAMED else ""
        expected += f"; {OF_ARRAYS}" if may_name else ""
        raise BadInput(f"{path}: nothing to import: {one_line(said)[:160]}{expected}")
    found.said += [f"column pickup: {k} is {name}" for k, name in enumerate(found.spots)]
    return found


def _read(reader: Reader, path: Path, *, may_name: bool) -> Found:
    """What a reader finds; another package's may fail in ways that ours do not.

    `may_name`: names of columns may be given, and none are yet.
    """
    try:
        with said_of(path):
            return _checked(path, reader(path))
    except NotSaid as error:
        hint = "; 'viscorig import --columns' says it for the file" if may_name else ""
        raise BadInput(f"{error}{hint}") from None
    except BadInput:
        raise
    except Exception as error:  # another package's reader raises whatever it meets
        if READERS.is_own(_ending(path)):
            raise
        raise BadInput(f"{path}: its reader failed: {type(error).__name__}: {one_line(str(error))}") from None


def _checked(path: Path, found: Found) -> Found:
    checked_hits(path, found.hits)
    for name, frf, _ in found.frfs:
        checked_frf(path, name, frf)
    for columns in (*found.sweeps, *(m.columns for m in found.modes)):
        for name, values in columns.items():
            x = np.asarray(values, dtype=float)
            for k in np.flatnonzero(~(np.abs(x) <= LARGEST) & ~(np.isnan(x) & (name in CARRIED))):
                check_size(f"{path}: {found.place(int(k), x.size)}", name, x[k], f"{x[k]:g}")
    return found


def is_foreign(path: Path) -> bool:
    """Whether the ending says that it is another program's file, and somebody reads it."""
    return _ending(path) not in _OURS and _ending(path) in READERS


def foreign_endings() -> tuple[str, ...]:
    """Of all files there is a reader for, with their dots."""
    return tuple(f".{name}" for name in READERS)


def _ending(path: Path) -> str:
    return path.suffix.lower().removeprefix(".")
