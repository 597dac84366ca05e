"""A file while it is being edited: its text with every comment, its values, its faults. No Qt."""

import os
import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import BaseModel, ValidationError
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Item

from fitting.errors import OutsideModel
from gui.file_stamp import Stamp, stamp_of
from gui.form.fields import FILES, Field, FormSection, Kind, Place, form_of, shown
from instrument.errors import BadInput, system_words
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.law_table import with_rows
from instrument.files.rig_file import RigDocument
from instrument.files.structure_file import AnyDocument, described, document_type
from instrument.files.text import read_text
from instrument.files.toml import faults

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
            raise BadInput(f"{path}: not TOML: {' '.join(str(error).split())}") from None

    @classmethod
    def of(cls, path: Path, model: type[BaseModel]) -> "Draft":
        """Read a file. Raises `BadInput` where it is none that can be edited."""
        # Looked at first: what is written while it is read is news.
        stamp = stamp_of(path)
        found = cls(path, model, read_text(path))
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


@dataclass
class Drafts:
    """Of an experiment and the files it names."""

    experiment: Draft
    rig: Draft | None
    specimen: Draft | None
    problems: tuple[str, ...] = ()
    """Why one of the named files is missing here."""
    _beside: dict[Path, Stamp | None] = field(default_factory=dict)
    """Files that these name and no form shows, as they were looked at."""

    @classmethod
    def of(cls, path: Path) -> "Drafts":
        """Read them. Raises `BadInput` where the experiment itself cannot be edited."""
        experiment = Draft.of(path, ExperimentDocument)
        found: dict[str, Draft | None] = {}
        problems: list[str] = []
        missing: dict[Path, Stamp | None] = {}
        for name in ("rig", "specimen"):
            said = experiment.value((name,))
            found[name] = None
            if not isinstance(said, str):
                continue
            named = path.parent / said
            stamp = stamp_of(named)
            try:
                found[name] = Draft.of(named, RigDocument) if name == "rig" else Draft.of_specimen(named)
            except BadInput as error:
                problems.append(str(error))
                missing[named] = stamp
        drafts = cls(experiment, found["rig"], found["specimen"], tuple(problems), missing)
        drafts._look_beside()
        return drafts

    @property
    def all(self) -> dict[str, Draft]:
        """Those there are, by what they describe."""
        drafts = {"experiment": self.experiment, "rig": self.rig, "specimen": self.specimen}
        return {name: draft for name, draft in drafts.items() if draft is not None}

    @property
    def changed(self) -> bool:
        """Whether one of them differs from its file."""
        return any(draft.changed for draft in self.all.values())

    @property
    def changed_elsewhere(self) -> list[Path]:
        """Files that another program has written, or taken away, since they were read or saved here."""
        return [path for path, stamp in self._stamps.items() if stamp_of(path) != stamp]

    @property
    def files(self) -> list[Path]:
        """All of them, those that no form shows too."""
        return list(self._stamps)

    @property
    def _stamps(self) -> dict[Path, Stamp | None]:
        return self._beside | {draft.path: draft.stamp for draft in self.all.values()}

    def _look_beside(self) -> None:
        """At tables and sensors: a dry run is of them too."""
        for draft in filter(None, (self.rig, self.specimen)):
            for named in _names_in(draft.plain()):
                path = draft.path.parent / named
                self._beside.setdefault(path, stamp_of(path))

    @property
    def fault_count(self) -> int:
        """In all of them."""
        return sum(len(draft.faults()) for draft in self.all.values()) + len(self.problems)

    def parts(self) -> tuple[str, ...]:
        """Which parts the experiment has."""
        return tuple(p for p in ("hammer", "sweep") if isinstance(self.experiment.value((p,)), dict))

    def save(self) -> Path:
        """Each to its file; the experiment's path. Raises `BadInput`."""
        for draft in self.all.values():
            if draft.changed:
                draft.save()
        self._look_beside()
        return self.experiment.path

    def save_as(self, path: Path) -> Path:
        """All three beside each other, under the names they have. Raises `BadInput`."""
        if path.resolve() == self.experiment.path.resolve():
            return self.save()
        beside: dict[str, Path] = {}
        for name, draft in self.all.items():
            if name == "experiment":
                continue
            to = path.parent / draft.path.name
            if to.resolve() != draft.path.resolve() and to.exists() and read_text(to) != draft.text:
                raise BadInput(f"{to}: is there already and is another {name}: choose another folder")
            beside[name] = to
        for name, to in beside.items():
            self.all[name].save(to)
            self.experiment.write((name,), Field(name, "text"), to.name)
        self.experiment.save(path)
        self._look_beside()
        return path


def _first(found: Any) -> Any:
    """Of `[[pickup]]` the form shows the first; the others stay as the file has them."""
    return found[0] if isinstance(found, AoT) and len(found) else found


def _names_in(values: Any) -> Iterator[str]:
    """Files that these values name, at any depth."""
    if isinstance(values, dict):
        yield from (said for key, said in values.items() if key in FILES and isinstance(said, str) and said)
        values = list(values.values())
    for inside in values if isinstance(values, list) else ():
        yield from _names_in(inside)


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
