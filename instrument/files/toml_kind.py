"""Which of this program's TOML files one is, by the tables it has."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from fitting.specimen import KINDS
from instrument.errors import BadInput
from instrument.files.toml import read_tables

TomlKind = Literal["a specimen", "a rig", "an experiment", "a list of sensors", ""]
_OF_RIGS = ("shaker", "vibrometer", "front_end")
_NAMED_BY_EXPERIMENTS = ("rig", "specimen")


def kind_of_tables(tables: Mapping[str, Any]) -> TomlKind:
    """Empty where they say nothing of it."""
    if any(kind in tables for kind in KINDS) and "rig" not in tables:
        return "a specimen"
    if any(isinstance(tables.get(name), str) for name in _NAMED_BY_EXPERIMENTS):
        return "an experiment"
    if any(part in tables for part in _OF_RIGS):
        return "a rig"
    return "a list of sensors" if "sensor" in tables else ""


def kind_of_toml(path: Path) -> TomlKind:
    """What a file is; empty also for one that cannot be read: what is wrong with it is said elsewhere."""
    try:
        return kind_of_tables(read_tables(path))
    except (BadInput, tomllib.TOMLDecodeError, RecursionError, ValueError):
        return ""
