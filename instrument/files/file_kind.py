"""What a file is that was named in the place of another: a folder, one of this program's own, a table."""

import json
from pathlib import Path
from typing import Any

from instrument.errors import BadInput
from instrument.files.text import TABLE_ENDINGS, read_text
from instrument.files.toml_kind import kind_of_toml

HAMMER_TEST = "a hammer test's modes ('viscorig damping')"
LAWS = ("a law ('viscorig identify')", "a diagnosis ('viscorig diagnose')")
_TABLES = (".csv", ".tsv")
_SESSIONS = (".h5", ".hdf5")
_BY_KEYS = (
    ({"modes", "hits"}, HAMMER_TEST),
    ({"standing", "words"}, "a run's result, in short"),
    ({"verdict", "after"}, LAWS[1]),
    ({"law_kind", "parameters"}, LAWS[0]),
)
"""Of this program's JSON: keys that it has, and what it is then."""
ANY_JSON = ("JSON", *(kind for _, kind in _BY_KEYS))
"""Kinds of JSON, known or not."""


def kind_of_file(path: Path) -> str:
    """In words, by its content or its ending.

    Empty where nothing is known of it, or where it cannot be read: what is wrong with it is said elsewhere.
    """
    if path.is_dir():
        return "a folder"
    if not path.is_file():
        return ""
    match path.suffix.lower():
        case ".toml":
            return kind_of_toml(path)
        case ".json":
            return kind_of_facts(_facts(path)) or ANY_JSON[0]
        case ending if ending in _TABLES:
            return "a table"
        case ending if ending in _SESSIONS:
            return "a session"
        case _:
            return ""


def kind_of_facts(facts: Any) -> str:
    """Which of this program's JSON it is; empty for none."""
    if not isinstance(facts, dict):
        return ""
    return next((kind for keys, kind in _BY_KEYS if keys <= set(facts)), "")


def no_json(path: Path, error: json.JSONDecodeError) -> str:
    """What a file is that is no JSON, by its name; else where it stops being JSON."""
    ending = path.suffix.lower()
    if ending == ".toml":
        return kind_of_toml(path) or "a TOML file"
    if ending in TABLE_ENDINGS and not error.doc.lstrip().startswith(("{", "[")):
        return "a table"
    return f"line {error.lineno}: not JSON ({error.msg})"


def refuse_another(path: Path, own: str | tuple[str, ...], expected: str) -> None:
    """Raise `BadInput` for a file that is known to be something else than `own`, as `kind_of_file` has it."""
    found = kind_of_file(path)
    if found not in ("", *((own,) if isinstance(own, str) else own)):
        raise BadInput(f"{path}: {found}, expected {expected}")


def _facts(path: Path) -> Any:
    try:
        return json.loads(read_text(path))
    except (BadInput, ValueError, RecursionError):
        return None
