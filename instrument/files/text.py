"""Reading a text file, or saying in one line why not."""

import codecs
import re
from pathlib import Path

from instrument.errors import BadInput, system_words

LARGEST_BYTES = 200_000_000
LONGEST_LINE = 1_000_000
"""Letters: no row of a table has as many, and to split one far longer takes minutes."""
IMPORT_READS = "'viscorig import' reads other programs' tables"
"""For people whose tables are written in another way."""
TABLE_ENDINGS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn")
_HDF5 = b"\x89HDF\r\n\x1a\n"
_ARCHIVE = b"PK\x03\x04"
_OLD_WORKBOOK = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_WORKBOOKS = (".xlsx", ".xlsm", ".xls")
_OF_A_WORKBOOK = b"xl/workbook"
"""The name of a file in the archive that a workbook is; names are not packed."""
_PICTURE, _PDF = "a picture", "a PDF document"
_OF_OTHERS = (
    (b"\x89PNG\r\n", _PICTURE),
    (b"\xff\xd8\xff", _PICTURE),
    (b"GIF8", _PICTURE),
    (b"RIFF", "a sound or a picture"),
    (b"%PDF-", _PDF),
)
"""How files begin that are no text, and what they are, whatever their name."""
_LONE_RETURN = re.compile(r"\r(?!\n)")
"""The line end of some old programs: a table is read with it, TOML and patterns know only the others."""


def refuse_endless(path: Path) -> None:
    """Raise `BadInput` for a pipe or a device: opening it may take for ever, and reading it have no end."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise BadInput(f"{path}: a pipe or a device, expected a file")


def read_content(path: Path, most_bytes: int = LARGEST_BYTES) -> bytes:
    """The bytes of a file that is not too large. Raises `BadInput`."""
    refuse_endless(path)
    if path.is_dir():
        raise BadInput(f"{path}: a folder, expected a file")
    try:
        if path.stat().st_size > most_bytes:
            raise BadInput(f"{path}: {path.stat().st_size} bytes, expected at most {most_bytes}")
        return path.read_bytes()
    except OSError as error:
        raise BadInput(f"{path}: {system_words(error)}") from None


def read_text(path: Path, encoding: str = "utf-8-sig", most_bytes: int = LARGEST_BYTES) -> str:
    """The file as text: UTF-8, a byte order mark dropped, a lone carriage return made a newline.

    Raises `BadInput`.
    """
    content = read_content(path, most_bytes)
    refuse_packed(path, content)
    try:
        if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            is_table = path.suffix.lower() in TABLE_ENDINGS
            cure = f'save it as such ("CSV UTF-8"), or {IMPORT_READS}' if is_table else "save it as such"
            raise BadInput(f"{path}: UTF-16 text, expected UTF-8: {cure}")
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        if 0 in content:
            raise BadInput(f"{path}: a binary file, expected text") from None
        raise BadInput(
            f"{path}: byte {error.start}: not UTF-8 text ({error.reason}), expected UTF-8: save it as such"
        ) from None
    if "\0" in text:
        raise BadInput(f"{path}: byte {text.index(chr(0))}: a NUL byte, expected a text file")
    if not text.strip():
        raise BadInput(f"{path}: the file is empty")
    return _LONE_RETURN.sub("\n", text) if "\r" in text else text


def refuse_packed(path: Path, content: bytes) -> None:
    """Raise `BadInput` where a file's content is a workbook, HDF5, an archive or a picture, and no text."""
    if content.startswith(_OLD_WORKBOOK) or (content.startswith(_ARCHIVE) and _OF_A_WORKBOOK in content):
        cure = ": save it as CSV" if path.suffix.lower() != ".toml" else ""
        raise BadInput(f"{path}: an Excel workbook, expected text{cure}")
    if content.startswith(_HDF5):
        raise BadInput(f"{path}: an HDF5 file, expected text; a session's name ends in .h5")
    if content.startswith(_ARCHIVE):
        raise BadInput(f"{path}: a packed archive, expected text")
    for begins, kind in _OF_OTHERS:
        if content.startswith(begins):
            raise BadInput(f"{path}: {kind}, expected text")


def refuse_workbook(path: Path) -> None:
    """Raise `BadInput` for a file that is a workbook by its name."""
    if path.suffix.lower() in _WORKBOOKS:
        raise BadInput(f"{path}: an Excel workbook, expected text: save it as CSV")


def lines_of(path: Path, text: str) -> list[str]:
    """The lines of a file's text, none of them endless. Raises `BadInput`."""
    lines = text.splitlines()
    for number, line in enumerate(lines, start=1):
        if len(line) > LONGEST_LINE:
            raise BadInput(
                f"{path}: line {number}: {len(line)} letters, expected at most {LONGEST_LINE}: a row a line"
            )
    return lines
