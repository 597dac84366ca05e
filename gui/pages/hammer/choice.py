"""Which hits count, where a person tries another choice than the recorded one. No Qt."""

from collections.abc import Iterable
from dataclasses import replace

from instrument.session.contents import RecordedHit

Blow = tuple[int, float]
"""A hit's number and peak: another test numbers its hits from 1 again."""


def blow_of(hit: RecordedHit) -> Blow:
    """What tells a hit from all others, also in another state of the same session."""
    return hit.number, hit.peak_n


def standing_of(hits: Iterable[RecordedHit]) -> tuple[tuple[Blow, bool], ...]:
    """Which hits there are and which of them count: the same where nothing has to be computed again."""
    return tuple((blow_of(h), h.accepted) for h in hits)


def overruled(hit: RecordedHit) -> bool:
    """Whether the operator's word stands against the program's verdict."""
    return hit.accepted == bool(hit.why)


class WhatIf:
    """Words about single hits that are not recorded."""

    def __init__(self) -> None:
        self._accepted: dict[Blow, bool] = {}

    def say(self, hit: RecordedHit, accepted: bool) -> None:
        """Use a hit as recorded, or leave it out; what agrees with the record is no change."""
        if accepted == hit.accepted:
            self.take_back(hit)
        else:
            self._accepted[blow_of(hit)] = accepted

    def take_back(self, hit: RecordedHit) -> None:
        """As it is recorded again."""
        self._accepted.pop(blow_of(hit), None)

    def clear(self) -> None:
        """All as recorded."""
        self._accepted.clear()

    def changes(self, hit: RecordedHit) -> bool:
        """Whether a hit is taken otherwise than recorded."""
        return self._accepted.get(blow_of(hit), hit.accepted) != hit.accepted

    def applied(self, hits: Iterable[RecordedHit]) -> tuple[RecordedHit, ...]:
        """The hits as they count now."""
        return tuple(replace(h, accepted=self._accepted.get(blow_of(h), h.accepted)) for h in hits)
