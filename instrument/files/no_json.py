"""What a file is that was given where the JSON of a command is expected, and is none."""

import json
from pathlib import Path

from instrument.files.text import TABLE_ENDINGS
from instrument.files.toml_kind import kind_of_toml


def no_json(path: Path, error: json.JSONDecodeError) -> str:
    """The kind of file that it is, by its name; else where it stops being JSON."""
    ending = path.suffix.lower()
    if ending == ".toml":
        return kind_of_toml(path) or "a TOML file"
    if ending in TABLE_ENDINGS and not error.doc.lstrip().startswith(("{", "[")):
        return "a table"
    return f"line {error.lineno}: not JSON ({error.msg})"
