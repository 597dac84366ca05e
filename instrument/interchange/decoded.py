"""Another program's text, whatever its encoding: UTF-8, UTF-16, or Windows' Western one."""

import codecs
from pathlib import Path

from instrument.errors import BadInput
from instrument.files.text import read_content, refuse_packed

_MARKED = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
_MINUS = "\N{MINUS SIGN}"
"""In numbers as typesetting programs write them."""
_UNMARKED = ("utf-8", "cp1252", "latin-1")
"""Windows' own beside UTF-8: of what is looked for only degrees, micro and superscripts are beyond ASCII, and
these are alike in it and in Latin-1."""


def decoded(path: Path) -> str:
    """The text of a file, whatever its encoding.

    Raises `BadInput` for an empty file and for one that is no text.
    """
    content = read_content(path)
    refuse_packed(path, content)
    named = next((encoding for mark, encoding in _MARKED.items() if content.startswith(mark)), "")
    for encoding in (named,) if named else _UNMARKED:
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" in text:
            raise BadInput(f"{path}: byte {content.index(0)}: a NUL byte, expected a text file")
        if not text.strip():
            raise BadInput(f"{path}: the file is empty")
        return text.replace(_MINUS, "-")
    raise BadInput(f"{path}: not {named} text as its first bytes say")
