"""What laws of one specimen are off by together: its own stated numbers, wrong by as much in each."""

from collections.abc import Sequence

from instrument.material.found_law import MaterialLaw
from instrument.material.stated_part import Stated, stays_with_the_specimen


def alike_in(laws: Sequence[MaterialLaw]) -> tuple[str, ...]:
    """Numbers of the specimen itself that all laws state alike, with one tolerance; their names, sorted.

    None where one law does not say what its stated numbers pass on to it.
    """
    if any(law.known is None for law in laws):
        return ()
    in_all = set.intersection(*({_said(one) for one in law.stated} for law in laws))
    passed_on = set.intersection(*(set(law.known.stated) for law in laws if law.known is not None))
    return tuple(sorted(name for name, *_ in in_all if name in passed_on and stays_with_the_specimen(name)))


def stated_unlike(laws: Sequence[MaterialLaw]) -> tuple[str, ...]:
    """Numbers of the specimen itself that two laws state as different ones; their names, sorted."""
    values: dict[str, set[float]] = {}
    for one in (one for law in laws for one in law.stated):
        values.setdefault(one.name, set()).add(one.stated)
    return tuple(sorted(n for n, of in values.items() if len(of) > 1 and stays_with_the_specimen(n)))


def _said(one: Stated) -> tuple[str, float, float]:
    return one.name, one.stated, one.tolerance
