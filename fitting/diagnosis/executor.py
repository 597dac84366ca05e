"""Who does the work on candidates. This process alone, unless something better is given."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, TypeVar, TypeVarTuple

from fitting.progress import Report, unheard

A = TypeVar("A")
B = TypeVar("B")
Arguments = TypeVarTuple("Arguments")
Call = tuple[Callable[..., Any], tuple[Any, ...]]
"""A bound method and its arguments."""


class Executor:
    """One process."""

    def map(self, do: Callable[[A], B], wanted: Iterable[A], report: Report = unheard) -> Iterator[B]:
        """What a bound method makes of each, in order. It may change nothing but what it can do again."""
        return self.together([(do, (one,)) for one in wanted], report)

    def starmap(
        self, do: Callable[[*Arguments], B], wanted: Iterable[tuple[*Arguments]], report: Report = unheard
    ) -> Iterator[B]:
        """The same as `map` of a method with several arguments."""
        return self.together([(do, arguments) for arguments in wanted], report)

    def together(self, calls: Sequence[Call], report: Report = unheard) -> Iterator[Any]:
        """The same of several methods of one object: what needs nothing of each other, in one go."""
        for done, (do, arguments) in enumerate(calls):
            yield do(*arguments)
            report((done + 1) / len(calls))


ALONE = Executor()
