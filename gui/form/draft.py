"""A file while it is being edited: its text with every comment, its values, its faults. No Qt."""

import os
import re
import tempfile
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import BaseModel, ValidationError
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Item

from fitting.errors import OutsideModel
from gui.files.file_stamp import Stamp, stamp_of
from gui.form.fields import Field, FormSection, Kind, Place, form_of, shown
from instrument.errors import BadInput, system_words
from instrument.files.law_table import with_rows
from instrument.files.structure_file import AnyDocument, described, document_type
from instrument.files.text import read_text
from instrument.files.toml import faults, parse_document, toml_text

Faults = dict[Place, str]
"""What is wrong where, in words; `()` is the whole file."""
_YES = {"yes": True, "no": False}
_COMMA = re.compile(r"[+-]?\d+,\d+")


class Draft:
    """One file.

    Parameters
    ----------
    path : Path
        Where it was read.
    model : type
        What it is checked against.
    text : str
        As it was read.
    """

    def __init__(self, path: Path, model: type[BaseModel], text: str) -> None:
        self.path, self.model = path, model
        self._read = text
        self.stamp: Stamp | None = None
        """Of the file as it was read or saved; None where there was none."""
        try:
            self._toml = tomlkit.parse(text)
        except (TOMLKitError, RecursionError) as error:
            # In the words of the commands, where they do not read it either.
            parse_document(path, text, BaseModel)
            raise BadInput(f"{path}: not TOML: {' '.join(str(error).split())}") from None

    @classmethod
    def of(cls, path: Path, model: type[BaseModel]) -> "Draft":
        """Read a file. Raises `BadInput` where it is none that can be edited."""
        # Looked at first: what is written while it is read is news.
        stamp = stamp_of(path)
        found = cls(path, model, toml_text(path))
        found.stamp = stamp
        return found

    @classmethod
    def of_specimen(cls, path: Path) -> "Draft":
        """Read a specimen's file, whichever structure it describes. Raises as `of`."""
        found = cls.of(path, BaseModel)
        found.model = document_type(found.plain())
        return found

    @cached_property
    def asks(self) -> FormSection:
        """What a form of it asks for: read off the sources of its model, which takes a tenth of a second."""
        return form_of(self.model)

    @property
    def text(self) -> str:
        """As it would be saved."""
        return tomlkit.dumps(self._toml)

    @property
    def changed(self) -> bool:
        """Whether it differs from the file."""
        return self.text != self._read

    def plain(self) -> dict[str, Any]:
        """Its values."""
        return dict(self._toml.unwrap())

    def faults(self) -> Faults:
        """Everything wrong with it; empty for a good one."""
        try:
            document = self.model.model_validate(self.plain())
            if isinstance(document, AnyDocument):
                described(with_rows(document, self.path))
        except ValidationError as error:
            return _by_place(error)
        except (OutsideModel, BadInput) as error:
            return _of_law(str(error).removeprefix(f"{self.path}: "))
        except (RecursionError, OverflowError, ValueError) as error:
            return {(): " ".join(str(error).split())}
        return {}

    def given(self, place: Place) -> bool:
        """Whether there is something at this place, be it `false`."""
        return self._at(place) is not None

    def value(self, place: Place) -> Any:
        """What is there; None where nothing is."""
        found = self._at(place)
        return found.unwrap() if isinstance(found, Item) else found

    def shown(self, place: Place, kind: Kind = "text") -> str:
        """What is there, as a form shows it."""
        found = self._at(place)
        if found is None:
            return ""
        if kind in ("number", "whole") and hasattr(found, "as_string") and not isinstance(found, str):
            return str(found.as_string())
        if kind == "toml" and hasattr(found, "as_string") and not isinstance(found, str):
            return str(found.as_string()).strip()
        return shown(self.value(place))

    def write(self, place: Place, field: Field, text: str) -> None:
        """What a person typed; nothing leaves the value out."""
        if not text.strip():
            self.remove(place)
        else:
            self._set(place, _value(field, text.strip()))

    def switch(self, place: Place, off: bool, as_false: bool) -> None:
        """Have a table or not; `as_false` where `false` says that there is none."""
        self.remove(place)
        if off and as_false:
            self._set(place, False)
        elif not off and not as_false:
            self._set(place, tomlkit.table())

    def add_table(self, place: Place) -> None:
        """One more in a list of tables, like the last one."""
        tables = self._at(place)
        new = tomlkit.table()
        if isinstance(tables, AoT):
            if len(tables):
                new.update(tables[-1].unwrap())
            tables.append(new)
            return
        tables = tomlkit.aot()
        tables.append(new)
        self._set(place, tables)

    def remove(self, place: Place) -> None:
        """Whatever is there."""
        inside = self._at(place[:-1])
        inside = _first(inside) if isinstance(place[-1], str) else inside
        if inside is not None and self._at(place) is not None:
            del inside[place[-1]]

    def save(self, path: Path | None = None) -> None:
        """To its file, or to another. Raises `BadInput` where somebody else has changed it meanwhile."""
        to = path or self.path
        if path is None and self._read and to.exists() and read_text(to) != self._read:
            raise BadInput(f"{to}: was changed by another program since it was read: open it again")
        text = self.text
        self.stamp = _replace(to, text)
        self.path, self._read = to, text

    def _at(self, place: Place) -> Any:
        found: Any = self._toml
        for key in place:
            if isinstance(key, int):
                found = found[key] if isinstance(found, list) and key < len(found) else None
            else:
                found = _first(found)
                found = found.get(key) if isinstance(found, dict) else None
            if found is None:
                return None
        return found

    def _set(self, place: Place, value: Any) -> None:
        inside: Any = self._toml
        for key, after in pairwise(place):
            inside = _first(inside) if isinstance(key, str) else inside
            if isinstance(key, str) and not isinstance(inside.get(key), dict | list):
                if key in inside:
                    del inside[key]
                inside[key] = tomlkit.aot() if isinstance(after, int) else tomlkit.table()
            elif isinstance(key, int) and key == len(inside):
                inside.append(tomlkit.table())
            inside = inside[key]
        last = place[-1]
        (_first(inside) if isinstance(last, str) else inside)[last] = value


def _first(found: Any) -> Any:
    """Of `[[pickup]]` the form shows the first; the others stay as the file has them."""
    return found[0] if isinstance(found, AoT) and len(found) else found


def _value(field: Field, text: str) -> Any:
    """What was typed, as the file keeps it; what cannot be read stays text, and the model says so."""
    try:
        match field.kind:
            case "number" | "whole":
                return _number(text)
            case "numbers":
                return [_number(one.strip()) for one in text.strip("[]").split(",") if one.strip()]
            case "switch":
                return _YES.get(text.lower(), text)
            case "toml":
                return tomlkit.value(text)
    except (ValueError, TOMLKitError):
        return text
    return text


def _number(text: str) -> Any:
    """As it was typed, where the file's grammar has it so."""
    try:
        found = tomlkit.value(text)
    except TOMLKitError:
        return float(text)
    if isinstance(found, bool) or not isinstance(found, int | float):
        raise ValueError(text)
    return found


def _by_place(error: ValidationError) -> Faults:
    found: Faults = {}
    for fault, said in zip(error.errors(), faults(error), strict=True):
        place = ".".join(str(part) for part in fault["loc"])
        words = said.removeprefix(f"{place}: ") if place else said
        given = fault["input"]
        if isinstance(given, str) and _COMMA.fullmatch(given):
            words = f"'{given}': the decimal sign is a point, {given.replace(',', '.')}"
        found.setdefault(tuple(fault["loc"]), words)
    return found


def _of_law(said: str) -> Faults:
    """The law's own model is made when its kind is known: places stand in its words."""
    head, _, words = said.partition(": ")
    place = tuple(head.split("."))
    if place[:2] == ("core", "law") and words:
        return {place: words}
    return {(): said}


def _replace(path: Path, text: str) -> Stamp | None:
    """Write a file whole or not at all; as what. Raises `BadInput`."""
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        if path.exists():
            os.chmod(name, path.stat().st_mode)
        else:
            os.chmod(name, 0o644)
        stamp = stamp_of(Path(name))
        os.replace(name, path)
    except OSError as error:
        raise BadInput(f"{path}: {system_words(error)}") from None
    return stamp
