"""A session to the files of another program."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from instrument.errors import BadInput, system_words
from instrument.interchange.csv_export import export_csv
from instrument.interchange.mat_export import export_mat
from instrument.interchange.uff_export import export_uff
from instrument.session.contents import Contents

Format = Literal["uff", "csv", "mat"]
FORMATS: tuple[str, ...] = get_args(Format)


@dataclass(frozen=True)
class Exported:
    """What was written, and what the format could not carry."""

    files: tuple[Path, ...]
    notes: tuple[str, ...] = ()


def export_session(contents: Contents, to: Format, folder: Path) -> Exported:
    """Write a session's sweep, hits and results into a folder. Raises `BadInput` where nothing is there."""
    if not contents.points and not contents.hits:
        raise BadInput(f"{contents.path}: neither points nor hits, there is nothing to export")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return _written(contents, to, folder)
    except OSError as error:
        raise BadInput(f"{folder}: {system_words(error)}") from None


def _written(contents: Contents, to: Format, folder: Path) -> Exported:
    if to == "csv":
        return Exported(tuple(export_csv(contents, folder)))
    if to == "mat":
        return Exported(tuple(export_mat(contents, folder)))
    files, notes = export_uff(contents, folder)
    return Exported(tuple(files), tuple(notes))
