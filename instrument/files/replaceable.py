"""What may stand where a file is to be written: nothing, or what was written so before."""

import json
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from instrument.errors import BadInput, system_words
from instrument.files.file_kind import kind_of_file
from instrument.files.text import read_text

_BEGINNING = 4096
"""Bytes of a file that are looked at: a table's head, or the first comments of a card."""
_OF_OTHER_FILES = (
    *(".h5", ".hdf5", ".toml", ".csv", ".tsv", ".uff", ".unv", ".mat", ".lvm"),
    *(".jsonl", ".html", ".htm", ".pdf", ".png"),
)
"""Endings by which this program knows files that are no JSON; every other one may be that of a result."""


@dataclass(frozen=True)
class Written:
    """One kind of file that a command writes: its endings (all, where none is named), and how it begins."""

    begins: re.Pattern[bytes]
    endings: tuple[str, ...] = ()


JSON = Written(re.compile(rb"(\xef\xbb\xbf)?\s*\{"), (".json",))
PAGE = Written(re.compile(rb"\s*<"), (".html", ".htm"))
PDF = Written(re.compile(rb"%PDF-"), (".pdf",))
PNG = Written(re.compile(rb"\x89PNG"), (".png",))
FIGURE = Written(re.compile(rb"\x89PNG.*Software\x00viscorig", re.DOTALL), (".png",))
"""A picture that says in its head who has drawn it."""


def refuse_ending(path: Path, endings: Iterable[str]) -> None:
    """Raise `BadInput` for a name that does not end so. A device or a pipe has any name."""
    there = path.exists() and not path.is_file()
    if not there and path.suffix.lower() not in endings:
        raise BadInput(f"{path}: ending {path.suffix!r}, expected {' or '.join(endings)}")


def refuse_for_json(path: Path) -> None:
    """Raise `BadInput` where a result is not to be written: by its name, or by what stands there.

    Any ending will do that is not another kind of file's.
    """
    if path.suffix.lower() in _OF_OTHER_FILES:
        refuse_ending(path, JSON.endings)
    refuse_to_lose(path, JSON)


def refuse_another_json(path: Path) -> None:
    """Raise `BadInput` for a JSON that stands there and is no result of this program's commands."""
    if not path.is_file() or path.stat().st_size == 0:
        return
    # Only where something stands there: it loads the results of all commands.
    from instrument.facts.schema import is_a_result

    try:
        facts = json.loads(read_text(path))
    except (BadInput, ValueError, RecursionError):
        refuse_another_file(path)
    if not is_a_result(facts):
        refuse_another_file(path)


def refuse_to_lose(path: Path, kind: Written) -> None:
    """Raise `BadInput` where a file stands that is not empty and was not written as `kind`."""
    if not path.is_file():
        return
    try:
        with open(path, "rb") as file:
            head = file.read(_BEGINNING)
    except OSError as error:
        raise BadInput(f"{path}: {system_words(error)}") from None
    if head and not kind.begins.match(head):
        refuse_another_file(path)


def refuse_another_text(path: Path, text: str) -> None:
    """Raise `BadInput` where a file of another content stands, whoever wrote it."""
    if path.is_file() and path.read_bytes().replace(b"\r\n", b"\n") not in (b"", text.encode()):
        refuse_another_file(path)


def refuse_another_file(path: Path) -> NoReturn:
    """Raises `BadInput`: what stands there is kept."""
    what = kind_of_file(path) or "another file"
    raise BadInput(f"{path}: {what} stands there and is not written over, expected another name or folder")
