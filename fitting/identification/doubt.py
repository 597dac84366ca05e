"""A remark by which a fit says that its law may be wrong by more than is known of it."""

from collections.abc import Iterable

BIASED, ASTRAY = "the law may be biased beyond its band", "the fit does not follow the"
"""Words that doubts have in common. Nothing is read from them: what is a doubt, is a `Doubt`."""


class Doubt(str):
    """A remark like any other, of a kind of its own: whoever passes the law on has to know.

    It is a string, so that it goes wherever remarks go; put into another string it is a doubt no more.
    """

    __slots__ = ()


def doubts_among(remarks: Iterable[str]) -> tuple[str, ...]:
    """Doubts among remarks, in their order, as plain strings."""
    return tuple(str(said) for said in remarks if isinstance(said, Doubt))
