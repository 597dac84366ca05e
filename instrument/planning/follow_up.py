"""Which measurement would tell the explanations of a sweep apart, for its noise and its cost."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import groupby

import numpy as np

from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.result import Rivals
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.rivalry import Forecast, Outcome, outcome
from fitting.specimen import PlateSpecimen
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import FollowUp
from instrument.finding.diagnosis import Diagnosed
from instrument.planning.damped_struck import damped_struck
from instrument.planning.made_before import made_before
from instrument.planning.measurable import Template
from instrument.planning.measurement import HANDS_S, Measurable
from instrument.planning.order import Asked, best_courses
from instrument.planning.struck import bare_modes_expected
from instrument.results.next_words import advice
from instrument.stepped_sine.settings import SweepSettings

__all__ = ["FollowUp", "Possible", "rank_follow_ups", "with_follow_ups"]

_MOST_RIVALS = 6
"""The likeliest: a bound on time; what is less likely than five others does not decide what to measure."""
_TELLS = 3.0
"""Nats from which two explanations count as told apart: odds of twenty."""
_EVEN = 0.5
"""Probability of none up to which something is likelier than nothing."""
_WORTH = 0.02
"""Nats of the entropy of which is right, below which a measurement is not offered."""


@dataclass(frozen=True)
class Possible:
    """What can be done on this rig."""

    settings: SweepSettings = field(default_factory=SweepSettings)
    hands: bool = True
    """Whether somebody is there."""
    mass_kg: float | None = 5e-3
    """A known mass at hand, of a small accelerometer's size; None for none."""
    measurements: int = 2
    """How many may still be made: with one left nothing can follow it."""
    most_s: float = np.inf
    """What one of them may take, hands included."""
    whole_length_m: float | None = None
    """Of the treated plate, what its clamp grips included; None: as it stands out of it."""
    done: tuple[FollowUp, ...] = ()
    """What was measured after earlier diagnoses of the same data: it is not asked for once more."""


def rank_follow_ups(diagnosed: Diagnosed, possible: Possible | None = None) -> tuple[FollowUp, ...]:
    """Next measurements, best first: the best of each kind; none where one explanation is left.

    Ordered by the time until the explanations are told apart, as expected (`instrument.planning.order`).
    """
    possible = possible or Possible()
    rivals = diagnosed.result.rivals
    if rivals is None or not _doubtful(diagnosed, rivals):
        return ()
    expecting = RivalForecasts(rivals, _MOST_RIVALS)
    worth = [one for one in _asked(expecting, possible) if one.told.information > _WORTH]
    return tuple(
        course.first.measurable.follow_up(*_said(course.first.told, expecting)).but(
            then=course.then, expected_seconds=course.expected_s
        )
        for course in best_courses(worth, expecting, possible.measurements)
    )


def with_follow_ups(
    result: DiagnosisResult, diagnosed: Diagnosed, possible: Possible | None = None
) -> DiagnosisResult:
    """The result of a diagnosis with what would tell explanations apart; as it is where one is left.

    The one that is advised is then the first of them.
    """
    ranked = rank_follow_ups(diagnosed, possible)
    return result.but(next_measurement=advice(ranked[0]), next_measurements=ranked) if ranked else result


def _doubtful(diagnosed: Diagnosed, rivals: Rivals) -> bool:
    """Whether several explanations are left of which one matters."""
    if len(rivals.each) < 2 or not rivals.evidence.scale_known:
        return False
    stated = rivals.problem.nuisances.specimen
    if not isinstance(stated, PlateSpecimen) or stated.drive != "base":
        # Of beams, shear pairs and what a force drives nothing is foretold.
        return False
    result = diagnosed.result
    # Where nothing is named it is worth asking where something is likelier than nothing.
    none = sum(share for f, share in rivals.each if not f.effects)
    return result.verdict == "ambiguous" or (result.verdict == "none" and none < _EVEN)


def _asked(expecting: RivalForecasts, possible: Possible) -> Iterator[Asked]:
    for measurable, forecasts in _forecast(expecting, possible):
        if made_before(measurable, possible.done):
            continue
        told = outcome(forecasts, expecting.probabilities, expecting.temper, VERDICT.credible, expecting.of)
        yield Asked(measurable, forecasts, told)


def _forecast(expecting: RivalForecasts, possible: Possible) -> Iterator[tuple[Measurable, list[Forecast]]]:
    template = Template.of(expecting, possible.settings)
    limits = possible.settings.limits
    every = template.measurable(possible.mass_kg, hands=possible.hands)
    for further, each in groupby(every, key=lambda m: m.further):
        measurable = [m for m in each if m.seconds <= possible.most_s]
        if not measurable:
            continue
        # All steps of a place at once: each measurement reads some of them.
        v = expecting.velocity_m_s(further)
        whole = expecting.forecasts(further, template.noise)
        for one in measurable:
            if one.spot_m is not None:
                if v[one.part].max() > limits.warn * limits.velocity_m_s:
                    continue
                one = replace(one, velocities_m_s=tuple(v[one.part].tolist()))
            rows = expecting.rows(one.part, len(v))
            yield one, [forecast.of(rows) for forecast in whole]
    if possible.hands and HANDS_S["damped_struck"] <= possible.most_s:
        lines = template.plain.steps.of(next(template.plain.lengths()).at)
        for one in damped_struck(expecting, lines, possible.settings, possible.whole_length_m):
            yield one, expecting.forecasts(one.further, template.noise)
    struck = template.struck()
    if possible.hands and struck.seconds <= possible.most_s and expecting.evidence.bare is None:
        bare = bare_modes_expected(expecting.member)
        if bare is not None:
            yield struck, expecting.struck(bare)


def _said(told: Outcome, expecting: RivalForecasts) -> tuple[float, float, tuple[str, ...]]:
    """Separation of the two best that it separates best, chance to resolve, and who is told from whom."""
    count = len(expecting.names)
    p = np.bincount(expecting.of, expecting.probabilities)
    pairs = [(i, j) for i in range(count) for j in range(i)]
    i, j = max(pairs, key=lambda one: p[one[0]] * p[one[1]] * min(told.between(*one), _TELLS))
    apart = [k for k in range(count) if any(told.between(k, m) > _TELLS for m in range(count) if m != k)]
    names = sorted({i, j, *apart})
    return told.between(i, j), told.resolved, tuple(expecting.names[k] for k in names)
