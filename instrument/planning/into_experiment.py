"""A plan's [sweep] into an experiment file: the file's own is replaced, all else stays as it is written."""

import os
import re
from pathlib import Path

from instrument.errors import BadInput
from instrument.files.at_once import refuse_unwritable, write_at_once
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.new_file import TEMPLATES
from instrument.files.text import read_text
from instrument.files.toml import parse_document, toml_text

_HEADER = re.compile(r"^\s*\[\[?\s*([A-Za-z0-9_-]+)")


def begun(path: Path, specimen: Path) -> str:
    """The text of `path`, or of a new experiment from the template. Raises `BadInput`."""
    refuse_unwritable(path)
    if path.exists():
        text = toml_text(path)
        parse_document(path, text, ExperimentDocument)
        return text
    if not path.parent.is_dir():
        raise BadInput(f"{path}: no such folder to write to")
    text = read_text(TEMPLATES["experiment"])
    named = os.path.relpath(specimen.resolve(), path.resolve().parent).replace("\\", "/")
    return re.sub(r'^specimen = "[^"]*".*$', f'specimen = "{named}"', text, count=1, flags=re.M)


def write_into(path: Path, text: str, sweep_toml: str) -> None:
    """Put a sweep in the place of that of `text`, which `begun` gave. Raises `BadInput`."""
    whole = without_sweep(text).rstrip("\n") + "\n\n" + sweep_toml
    parse_document(path, whole, ExperimentDocument)
    write_at_once(path, whole)


def without_sweep(text: str) -> str:
    """An experiment's text without [sweep] and the tables in it."""
    kept, inside = [], False
    for line in text.splitlines():
        header = _HEADER.match(line)
        if header is not None:
            inside = header[1] == "sweep"
        if not inside:
            kept.append(line)
    return "\n".join(kept) + "\n"
