"""What would tell explanations apart, as people read it: one sentence for the best, a row for each."""

from collections.abc import Sequence
from math import isnan, log, nan

from fitting.digits import times, two_digits
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import FollowUp, FollowUpKind
from instrument.results.standing import standing

NEXT_TITLE = "what would tell the explanations apart if one of them is true, best first"
NEXT_COLUMNS = ("what to measure", "rig and hands", "settles it", "likelier by")

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
_IN_MINUTES_S = 120.0
"""From here on a person thinks in minutes."""
_MOST_NAMED = 3
"""Of a group, in a sentence: its table names all."""


def advice(offer: FollowUp) -> str:
    """Which explanations, by which measurement, where, why, what it costs and what may be hoped for."""
    what = f"{offer.todo[0].lower()}{offer.todo[1:]}"
    cost = f"It takes {duration(offer.seconds)}"
    if may_settle(offer):
        cost += f" and, if one of these is true, settles the matter with {_percent(offer)} chance"
    if offer.then:
        cost += f"; {'if not,' if may_settle(offer) else 'then'} {_FOLLOWING[offer.then]} should follow"
    return f"T{apart_words(offer.between)[1:]}, {what} {offer.why} {cost}."


def duration(seconds: float) -> str:
    """Seconds in words: 45 s, 4 min."""
    return f"{seconds:.0f} s" if seconds < _IN_MINUTES_S else f"{seconds / 60:.0f} min"


def may_settle(offer: FollowUp) -> bool:
    """Whether there is a chance, to a percent, that one explanation is left."""
    return _percent(offer) != "0 %"


def kind_words(kind: FollowUpKind) -> str:
    """What kind of measurement it is, as a person calls it."""
    return _FOLLOWING[kind].capitalize()


def next_row(offer: FollowUp) -> tuple[str, ...]:
    """One row under `NEXT_COLUMNS`."""
    odds = times(min(offer.separation, _BEYOND_DOUBT))
    return offer.todo, duration(offer.seconds), _percent(offer), odds


def apart_words(between: Sequence[str]) -> str:
    """What a measurement is for."""
    return f"to tell {separated_words(between)} apart"


def beyond_words(found: DiagnosisResult) -> str:
    """Which explanations a measurement tells apart that the verdict does not name; empty for none.

    The verdict names what has 95 % together. What comes next takes its place once that is ruled out.
    """
    between = dict.fromkeys(name for offer in found.next_measurements[:1] for name in offer.between)
    named = {name for group in found.equivalent.values() for name in group}
    beyond = [n for n in between if n not in named and standing(n, found) in ("other", "none")]
    if not found.equivalent or not beyond:
        return ""
    shares = [c.probability for c in found.candidates if c.name in beyond]
    share = sum(shares) if len(shares) == len(beyond) else nan
    has = "" if isnan(share) else f" ({two_digits(100 * share)} %{' together' * (len(beyond) > 1)})"
    return f"Less likely than what the verdict names, and told apart too: {separated_words(beyond)}{has}."


def separated_words(between: Sequence[str], most: int = _MOST_NAMED) -> str:
    """Explanations, `none` in words; of many more than `most` the first ones, and how many more there are."""
    said = ["no effect" if n == "none" else n for n in between]
    if len(said) > most + 1:
        said = [*said[:most], f"{len(said) - most} more"]
    return " and ".join([", ".join(said[:-1]), said[-1]]) if len(said) > 1 else "".join(said)


def _percent(offer: FollowUp) -> str:
    return f"{100 * offer.probability_resolved:.0f} %"
