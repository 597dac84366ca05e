"""Reading a TOML file against its model: every key known, every fault named with its place."""

import re
import tomllib
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from instrument.errors import BadInput
from instrument.files.nearest import nearest
from instrument.files.text import read_text

Positive = Annotated[float, Field(gt=0, le=1e9, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]
Number = Annotated[float, Field(ge=-1e20, le=1e20, allow_inf_nan=False)]
Percent = Annotated[float, Field(ge=0, lt=100, allow_inf_nan=False)]

_LARGEST_BYTES = 1_000_000
"""What people write has some thousands; to read as many takes a second."""
_MOST_SHOWN = 3
_LONGEST = 80
_NO_TABLE = ("model_type", "model_attributes_type", "dict_type")
"""Faults of what is no table where one is expected."""
_PLAIN = {
    "float_type": "a number",
    "float_parsing": "a number",
    "finite_number": "a finite number",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "string_type": "text in quotes",
    "list_type": "a list",
    "tuple_type": "a list",
}
"""What a file should say where pydantic speaks of valid inputs, by the type of its fault."""
_TWICE = ("Cannot overwrite a value", "Cannot declare")
"""How Python says that a key or a table stands twice."""
_AT_LINE = re.compile(r"at line (\d+)")
_TABLE = re.compile(r"(\[+[^\]]+\]+)")
_COMMA = re.compile(r"(?m)^\s*[\w.-]+\s*=\s*(-?\d+,\d+)\s*(?:#.*)?$")


class TomlTable(BaseModel):
    """A table of a file: unknown keys and wrong types are refused. What stands below a key describes it."""

    model_config = ConfigDict(extra="forbid", strict=True, defer_build=True)


T = TypeVar("T", bound=BaseModel)


def toml_text(path: Path) -> str:
    """The text of a file, whatever stands in it. Raises `BadInput`, also for one too large to be TOML."""
    return read_text(path, most_bytes=_LARGEST_BYTES)


def read_tables(path: Path) -> dict[str, Any]:
    """What a file says, unchecked. Raises `BadInput`, and as `tomllib.loads` does."""
    return tomllib.loads(toml_text(path))


def read_document(path: Path, model: type[T]) -> T:
    """Read and check a file. Raises `BadInput` with one line."""
    return parse_document(path, toml_text(path), model)


def parse_document(path: Path, text: str, model: type[T]) -> T:
    """Check what a file says or is going to say. Raises `BadInput` with one line."""
    try:
        return model.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{path}: {_not_toml(error, text)}{_decimal_comma(text)}") from None
    except ValidationError as error:
        raise BadInput(f"{path}: {one_line(error, model=model)}") from None
    except (RecursionError, OverflowError, ValueError) as error:
        kind = model.__name__.removesuffix("Document").lower()
        raise BadInput(f"{path}: not a {kind}: {str(error)[:_LONGEST]}") from None


def document_faults(path: Path, model: type[BaseModel]) -> list[str]:
    """Everything wrong with a file at once; empty for a good one."""
    try:
        text = toml_text(path)
    except BadInput as error:
        return [str(error)]
    try:
        model.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        return [f"{path}: {_not_toml(error, text)}"]
    except ValidationError as error:
        return [f"{path}: {fault}" for fault in faults(error, model=model)]
    except (RecursionError, OverflowError, ValueError) as error:
        return [f"{path}: {str(error)[:_LONGEST]}"]
    return []


def faults(error: ValidationError, prefix: str = "", model: type[BaseModel] | None = None) -> list[str]:
    """Place, what was found, what is expected: one line a fault.

    `model`, of a file for people, has the keys that are known; what is repeated there is counted from 1.
    """
    return [_said(dict(fault), prefix, model) for fault in error.errors()]


def one_line(error: ValidationError, prefix: str = "", model: type[BaseModel] | None = None) -> str:
    """What is wrong where, the first few faults in one line."""
    said = faults(error, prefix, model)
    more = len(said) - _MOST_SHOWN
    return "; ".join(said[:_MOST_SHOWN]) + (f"; and {more} more" if more > 0 else "")


def _not_toml(error: tomllib.TOMLDecodeError, text: str) -> str:
    """What is wrong with a text; of a key that stands twice which one it is."""
    if not str(error).startswith(_TWICE):
        return f"not TOML: {error}"
    lines = text.rstrip().splitlines()
    at = _AT_LINE.search(str(error))
    number = min(int(at[1]), len(lines)) if at is not None else len(lines)
    line = lines[number - 1].strip()
    table = _TABLE.match(line)
    key = table[1] if table is not None else line.partition("=")[0].strip()
    return f"line {number}: {key} stands twice, expected it once"


def _decimal_comma(text: str) -> str:
    """A hint where a line has a number with one."""
    found = _COMMA.search(text)
    if found is None:
        return ""
    line = text.count("\n", 0, found.start(1)) + 1
    return f"; line {line}: {found[1]}, expected a decimal point"


def _keys_at(model: type[BaseModel] | None, place: tuple[int | str, ...]) -> list[str]:
    """The keys of the table that a place is in."""
    for part in place[:-1]:
        if model is None:
            return []
        if isinstance(part, int) or part not in model.model_fields:
            continue
        model = next(_models_in(model.model_fields[part].annotation), None)
    return list(model.model_fields) if model is not None else []


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models_in(part)


def _expected(fault: dict[str, Any]) -> str:
    """What a value should have been, in this program's words."""
    if (plain := _PLAIN.get(str(fault["type"]))) is not None:
        return f"expected {plain}"
    message = str(fault["msg"]).removeprefix("Value error, ")
    wanted = message.removeprefix("Input should be ")
    if wanted == message:
        return message
    number = "a number " if wanted.startswith(("greater than", "less than")) else ""
    return f"expected {number}{wanted}"


def _counted(place: tuple[int | str, ...]) -> str:
    """`sweep.segments, number 1, points`, as other faults of a file have it."""
    said = ""
    for before, part in pairwise(("", *place)):
        if isinstance(part, int):
            said += f", number {part + 1}"
        else:
            said += f"{', ' if isinstance(before, int) else '.' if said else ''}{part}"
    return said


def _said(fault: dict[str, Any], prefix: str, model: type[BaseModel] | None = None) -> str:
    place = prefix + (_counted(fault["loc"]) if model is not None else ".".join(map(str, fault["loc"])))
    message = _expected(fault)
    found = "" if isinstance(fault["input"], dict | list) else f"{fault['input']!r}"[:_LONGEST] + ", "
    if fault["type"] == "missing":
        return f"{place}: missing"
    if fault["type"] == "extra_forbidden":
        near = nearest(str(fault["loc"][-1]), _keys_at(model, fault["loc"]))
        return f"{place}: unknown key" + (f", the nearest is {near}" if near else "")
    if fault["type"] in _NO_TABLE:
        if any(isinstance(part, int) for part in fault["loc"][-1:]):
            return f"{place}: {found}expected a table"
        several = isinstance(fault["input"], list)
        return f"{place}: {'[[' + place + ']], ' if several else found}expected one table [{place}]"
    if place == prefix:
        return message
    in_pa = fault["type"] == "less_than_equal" and place.endswith(("_gpa", "_mpa"))
    return f"{place}: {found}{message[:1].lower()}{message[1:]}{': is it in Pa?' if in_pa else ''}"
