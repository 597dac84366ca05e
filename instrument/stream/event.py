"""What an event is: a frozen dataclass that JSON can hold.

Raw events are the truth: what was done and what came back. Derived events follow from them alone, and are
computed again on replay. Arrays of samples travel beside the JSON, never in it.
"""

import json
import re
from dataclasses import asdict, dataclass
from functools import cache
from typing import Annotated, Any, ClassVar

from pydantic import Field, TypeAdapter

Positive = Annotated[float, Field(gt=0)]

_HEAD = re.compile(r'\{"event": ?"(\w+)"')


@dataclass(frozen=True)
class Event:
    """Something that happened. Subclasses name it in the past tense."""

    derived: ClassVar[bool] = False
    known: ClassVar[dict[str, type["Event"]]] = {}
    """Every kind of event by its name."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Event.known[cls.__name__] = cls

    def facts(self) -> dict[str, Any]:
        """Its fields, as JSON knows them."""
        return asdict(self)


@dataclass(frozen=True)
class Derived(Event):
    """An event that follows from raw ones."""

    derived: ClassVar[bool] = True


class UnknownEvent(ValueError):
    """A line of an event whose kind is not known here: a later version's, or damaged."""

    def __init__(self, line: str, name: str) -> None:
        super().__init__(f"no event of this name: {line[:80]}")
        self.name = name


def to_line(event: Event) -> str:
    """One line of JSON. Floats come back to the bit."""
    return json.dumps({"event": type(event).__name__, **event.facts()}, allow_nan=False)


def from_line(line: str) -> Event:
    """The event of a line. Raises `ValueError` for what is none, or not as its kind declares its fields.

    `UnknownEvent` where it is one of a kind that is not known.
    Fields that are not known, of a later version, are dropped.
    """
    head = _HEAD.match(line)
    if head is None:
        raise ValueError(f"no event of this name: {line[:80]}")
    if head[1] not in Event.known:
        raise UnknownEvent(line, head[1])
    event: Event = _adapter(head[1]).validate_json(line, strict=True)
    return event


@cache
def _adapter(name: str) -> TypeAdapter[Any]:
    return TypeAdapter(Event.known[name])
