"""How an explanation is called: an effect by its own name, two effects together by both."""

from collections.abc import Iterable

NONE = "none"
"""What an explanation without any effect is called."""
_AND = " + "
"""No effect has it in its name."""


def joined(effects: Iterable[str]) -> str:
    """The name of an explanation with these effects."""
    return _AND.join(effects) or NONE


def split(name: str) -> tuple[str, ...]:
    """The effects of an explanation by its name; empty for `NONE`."""
    return () if name == NONE else tuple(name.split(_AND))
