"""The known name that an unknown one was probably meant to be."""

from collections.abc import Iterable
from difflib import get_close_matches

_ALIKE = 0.65


def nearest(name: str, known: Iterable[str], alike: float = _ALIKE) -> str | None:
    """The one most alike; None where none is near."""
    found = get_close_matches(name, list(known), n=1, cutoff=alike)
    return found[0] if found else None
