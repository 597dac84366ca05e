"""In which order measurements are worth making: the time until explanations are told apart, as expected.

A short measurement that settles little is no bargain where another must follow it, nor a long one where a
short one would do. So each is judged with the one that would follow it best:

    E(a) = t_a + (1 - r_a) t_b + h_ab T

t: seconds of rig and hands; r_a: chance that one explanation holds 95 % after a; h_ab: what share of the
question is open after a and b, whose readings have the specimen's unknowns in common, as entropy of which
explanation is right over that of now; T: what the open question costs. A share, not the chance that it stays
open: of many explanations two measurements may end none, and yet one pair leaves two of them and another
all. Where nothing is worth to follow, t_b = 0 and h_ab = h_a.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.rivalry import Forecast, Outcome, share_left
from instrument.facts.follow_up import FollowUpKind
from instrument.planning.measurement import Measurable

OPEN_S = 3600.0
"""What it costs to leave the question open: another specimen fetched, mounted and measured. A choice."""
ALWAYS_S = 60.0
"""That any further measurement costs, whatever it is: to decide, to start, to diagnose again. A choice."""


@dataclass(frozen=True)
class Asked:
    """A measurement, what each explanation expects of it, and what it would tell."""

    measurable: Measurable
    forecasts: list[Forecast]
    told: Outcome

    @property
    def seconds(self) -> float:
        """With what any measurement costs."""
        return self.measurable.seconds + ALWAYS_S


@dataclass(frozen=True)
class MeasurementSequence:
    """A measurement with what would follow it."""

    first: Asked
    then: FollowUpKind | None
    expected_s: float
    """E(a)."""


def best_courses(
    asked: Sequence[Asked], expecting: RivalForecasts, measurements: int = 2
) -> list[MeasurementSequence]:
    """The best of each kind, the one that is expected to end soonest first.

    `measurements`: how many may still be made; nothing follows the last one.
    """
    each = _best_of_each_kind(asked)
    others = each if measurements > 1 else []
    found = [min(_courses(one, others, expecting), key=lambda c: c.expected_s) for one in each]
    return sorted(found, key=lambda c: c.expected_s)


def _best_of_each_kind(asked: Sequence[Asked]) -> list[Asked]:
    """As if nothing followed it."""
    best: dict[str, Asked] = {}
    for one in sorted(asked, key=_alone_s, reverse=True):
        best[one.measurable.kind] = one
    return list(best.values())


def _alone_s(one: Asked) -> float:
    return one.seconds + one.told.left * OPEN_S


def _courses(first: Asked, each: Sequence[Asked], expecting: RivalForecasts) -> list[MeasurementSequence]:
    alone = first.told.left
    found = [MeasurementSequence(first, None, _alone_s(first))]
    for other in each:
        if other is first:
            continue
        both = [a.then(b) for a, b in zip(first.forecasts, other.forecasts, strict=True)]
        left = share_left(both, expecting.probabilities, expecting.temper, expecting.of)
        # More data never leave more: what exceeds one alone is the draws' own scatter.
        left = min(left, alone)
        expected = first.seconds + (1 - first.told.resolved) * other.seconds + left * OPEN_S
        found.append(MeasurementSequence(first, other.measurable.kind, expected))
    return found
