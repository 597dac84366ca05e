"""What an event is: a frozen dataclass that JSON can hold.

Raw events are the truth: what was done and what came back. Derived events follow from them alone, and are
computed again on replay. Arrays of samples travel beside the JSON, never in it.
"""

import json
from dataclasses import asdict, dataclass, fields
from typing import Any, ClassVar, Self


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

    @classmethod
    def of_facts(cls, facts: dict[str, Any]) -> Self:
        """The event of these fields; unknown ones, of a later version, are dropped."""
        names = {f.name for f in fields(cls)}
        return cls(**{key: _tuples(value) for key, value in facts.items() if key in names})


@dataclass(frozen=True)
class Derived(Event):
    """An event that follows from raw ones."""

    derived: ClassVar[bool] = True


def to_line(event: Event) -> str:
    """One line of JSON. Floats come back to the bit."""
    return json.dumps({"event": type(event).__name__, **event.facts()}, allow_nan=False)


def from_line(line: str) -> Event:
    """The event of a line. Raises `ValueError` for what is none."""
    facts = json.loads(line)
    kind = Event.known.get(facts.pop("event", ""))
    if kind is None:
        raise ValueError(f"no event of this name: {line[:80]}")
    return kind.of_facts(facts)


def _tuples(value: Any) -> Any:
    return tuple(_tuples(v) for v in value) if isinstance(value, list) else value
