"""Who does the work on candidates. This process alone, unless something better is given."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from fitting.progress import Report, unheard

A = TypeVar("A")
B = TypeVar("B")
Call = tuple[Callable[[Any], Any], Any]
"""A bound method and what it is asked for."""


class Executor:
    """One process."""

    def each(self, do: Callable[[A], B], wanted: Sequence[A], report: Report = unheard) -> Iterator[B]:
        """What a bound method makes of each, in order. It may change nothing but what it can do again."""
        return self.together([(do, one) for one in wanted], report)

    def together(self, calls: Sequence[Call], report: Report = unheard) -> Iterator[Any]:
        """The same of several methods of one object: what needs nothing of each other, in one go."""
        for done, (do, one) in enumerate(calls):
            yield do(one)
            report((done + 1) / len(calls))


ALONE = Executor()
