"""Reading a TOML file against its model: every key known, every fault named with its place."""

import tomllib
from pathlib import Path
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from instrument.errors import BadInput
from instrument.files.text import read_text

Positive = Annotated[float, Field(gt=0, le=1e9, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]
Number = Annotated[float, Field(ge=-1e20, le=1e20, allow_inf_nan=False)]
Percent = Annotated[float, Field(ge=0, lt=100, allow_inf_nan=False)]

_MOST_SHOWN = 3
_LONGEST = 80


class TomlTable(BaseModel):
    """A table of a file: unknown keys and wrong types are refused. What stands below a key describes it."""

    model_config = ConfigDict(extra="forbid", strict=True, use_attribute_docstrings=True)


T = TypeVar("T", bound=BaseModel)


def read_document(path: Path, model: type[T]) -> T:
    """Read and check a file. Raises `BadInput` with one line."""
    return parse_document(path, read_text(path), model)


def parse_document(path: Path, text: str, model: type[T]) -> T:
    """Check what a file says or is going to say. Raises `BadInput` with one line."""
    try:
        return model.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{path}: not TOML: {error}") from None
    except ValidationError as error:
        raise BadInput(f"{path}: {one_line(error)}") from None
    except (RecursionError, OverflowError, ValueError) as error:
        kind = model.__name__.removesuffix("Document").lower()
        raise BadInput(f"{path}: not a {kind}: {str(error)[:_LONGEST]}") from None


def document_faults(path: Path, model: type[BaseModel]) -> list[str]:
    """Everything wrong with a file at once; empty for a good one."""
    try:
        model.model_validate(tomllib.loads(read_text(path)))
    except BadInput as error:
        return [str(error)]
    except tomllib.TOMLDecodeError as error:
        return [f"{path}: not TOML: {error}"]
    except ValidationError as error:
        return [f"{path}: {fault}" for fault in faults(error)]
    except (RecursionError, OverflowError, ValueError) as error:
        return [f"{path}: {str(error)[:_LONGEST]}"]
    return []


def faults(error: ValidationError, prefix: str = "") -> list[str]:
    """Place, what was found, what is expected: one line a fault."""
    return [_said(dict(fault), prefix) for fault in error.errors()]


def one_line(error: ValidationError, prefix: str = "") -> str:
    """What is wrong where, the first few faults in one line."""
    said = faults(error, prefix)
    more = len(said) - _MOST_SHOWN
    return "; ".join(said[:_MOST_SHOWN]) + (f"; and {more} more" if more > 0 else "")


def _said(fault: dict[str, Any], prefix: str) -> str:
    place = prefix + ".".join(str(part) for part in fault["loc"])
    message = str(fault["msg"]).removeprefix("Value error, ")
    found = "" if isinstance(fault["input"], dict | list) else f"{fault['input']!r}"[:_LONGEST] + ", "
    if fault["type"] == "missing":
        return f"{place}: missing"
    if fault["type"] == "extra_forbidden":
        return f"{place}: unknown key"
    if place == prefix:
        return message
    return f"{place}: {found}{message.lower()}"
