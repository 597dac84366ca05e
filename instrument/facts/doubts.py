"""Which remarks of a result are doubts, of files as well that were written before results said so."""

from collections.abc import Iterable, Mapping
from typing import Any, Protocol

_WHEN_UNSAID = "the law may be biased beyond its band", "the fit does not follow the"
"""How doubts read in files without the key `doubts`: as they were written then, whatever is said today."""


class Remarks(Protocol):
    """A result that remarks on itself."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """All remarks."""

    @property
    def doubts(self) -> tuple[str, ...] | None:
        """Remarks by which the law may be wrong; None in files of older versions."""


def doubts_of(result: Remarks) -> tuple[str, ...]:
    """Remarks of a result by which its law may be wrong by more than is known of it."""
    return _doubts(result.warnings, result.doubts)


def doubts_in(facts: Mapping[str, Any]) -> tuple[str, ...]:
    """As `doubts_of`, of a result's JSON, which may be anybody's."""
    warnings, doubts = facts.get("warnings"), facts.get("doubts")
    return _doubts(_words(warnings) or (), _words(doubts))


def _words(given: object) -> tuple[str, ...] | None:
    return tuple(map(str, given)) if isinstance(given, list | tuple) else None


def _doubts(warnings: Iterable[str], doubts: tuple[str, ...] | None) -> tuple[str, ...]:
    if doubts is not None:
        return doubts
    return tuple(said for said in warnings if any(words in said for words in _WHEN_UNSAID))
