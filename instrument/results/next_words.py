"""What would tell explanations apart, as people read it: one sentence for the best, a row for each."""

from collections.abc import Sequence
from math import log

from fitting.digits import times
from instrument.facts.follow_up import FollowUp, FollowUpKind

NEXT_TITLE = "what would tell the explanations apart if one of them is true, best first"
NEXT_COLUMNS = ("what to measure", "s of rig and hands", "settles it", "likelier by")

_FOLLOWING: dict[FollowUpKind, str] = {
    "frequencies": "more steps",
    "level": "another level",
    "reversed": "the steps in reversed order",
    "spot": "another spot",
    "added_mass": "a known mass",
    "clamping": "clamping anew",
    "bare_hammer": "the bare plate's hammer test",
    "damped_struck": "the damped plate struck",
}

_BEYOND_DOUBT = log(1.001e6)
"""Of odds: no explanation, nor the program, is known well enough for more to mean anything."""
_MOST_NAMED = 3
"""Of a group, in a sentence: its table names all."""


def advice(offer: FollowUp) -> str:
    """Which explanations, by which measurement, where, why, what it costs and what may be hoped for."""
    what = f"{offer.todo[0].lower()}{offer.todo[1:]}"
    takes, settles = f"It takes {offer.seconds:.0f} s", f"settles the matter with {_percent(offer)} chance"
    cost = f"{takes} and, if one of these is true, {settles}"
    cost += f"; if not, {_FOLLOWING[offer.then]} should follow." if offer.then else "."
    return f"T{apart_words(offer.between)[1:]}, {what} {offer.why} {cost}"


def kind_words(kind: FollowUpKind) -> str:
    """What kind of measurement it is, as a person calls it."""
    return _FOLLOWING[kind].capitalize()


def next_row(offer: FollowUp) -> tuple[str, ...]:
    """One row under `NEXT_COLUMNS`."""
    return offer.todo, f"{offer.seconds:.0f}", _percent(offer), times(min(offer.separation, _BEYOND_DOUBT))


def apart_words(between: Sequence[str]) -> str:
    """What a measurement is for."""
    return f"to tell {separated_words(between)} apart"


def separated_words(between: Sequence[str], most: int = _MOST_NAMED) -> str:
    """Explanations, `none` in words; of many more than `most` the first ones, and how many more there are."""
    said = ["no effect" if n == "none" else n for n in between]
    if len(said) > most + 1:
        said = [*said[:most], f"{len(said) - most} more"]
    return " and ".join([", ".join(said[:-1]), said[-1]]) if len(said) > 1 else "".join(said)


def _percent(offer: FollowUp) -> str:
    return f"{100 * offer.probability_resolved:.0f} %"
