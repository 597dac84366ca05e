"""Who does the work on candidates. This process alone, unless something better is given."""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

A = TypeVar("A")
B = TypeVar("B")
Report = Callable[[float], None]


class Executor:
    """One process."""

    def each(
        self, do: Callable[[A], B], wanted: Sequence[A], report: Report = lambda fraction: None
    ) -> Iterator[B]:
        """What a bound method makes of each, in order. It may change nothing but what it can do again."""
        for done, one in enumerate(wanted):
            yield do(one)
            report((done + 1) / len(wanted))


ALONE = Executor()
