"""A plan as facts, and as the [sweep] of an experiment file."""

import numpy as np

from instrument.facts.plan import (
    EffectForecast,
    LawOutlook,
    LevelCompared,
    LimitingNumber,
    NotJudged,
    PlannedPart,
    PlannedStep,
    PlanResult,
    RivalEffect,
    SettlingForecast,
    SpotCompared,
)
from instrument.planning.plan import Plan
from instrument.planning.wish import Wish

_MOST_LIMITS = 5


def result_of(plan: Plan, wish: Wish) -> PlanResult:
    """The result of `viscorig plan`."""
    steps, spot = _steps(plan), plan.outlook.here.spot_m
    worst = float(plan.errors.max())
    return PlanResult(
        target_percent=100 * wish.target,
        band_low_hz=plan.outlook.band_hz[0],
        band_high_hz=plan.outlook.band_hz[1],
        reached=worst <= wish.target,
        worst_percent=100 * worst,
        limit_percent=100 * plan.level.choice.limit,
        limited_by=tuple(
            LimitingNumber(name=name, worst_percent=100 * left) for name, left in plan.limits[:_MOST_LIMITS]
        ),
        seconds=float(plan.seconds.sum()),
        settling=plan.settling,
        level_g=plan.level.level_g,
        x_mm=1e3 * spot[0],
        y_mm=1e3 * spot[1],
        noise_floor_m_s=wish.noise.floor_m_s,
        noise_share_percent=100 * wish.noise.share,
        steps=steps,
        segments=_segments(steps),
        law=_law(plan),
        levels=_levels(plan),
        spots=_spots(plan),
        effects=_effects(plan),
        not_judged=tuple(NotJudged(name=name, why=why) for name, why in plan.not_judged),
        sweep_toml=sweep_toml(steps, plan.level.level_g, plan.settling),
        notes=plan.notes,
    )


def _steps(plan: Plan) -> tuple[PlannedStep, ...]:
    c, law = plan.outlook.candidates, set(plan.for_law.tolist())
    return tuple(
        PlannedStep(
            frequency_hz=float(c.frequency_hz[k]),
            segment=int(c.region[k]),
            seconds=float(seconds),
            teaches="law" if k in law else "causes",
        )
        for k, seconds in zip(np.flatnonzero(plan.taken), plan.seconds, strict=True)
    )


def _law(plan: Plan) -> tuple[LawOutlook, ...]:
    return tuple(
        LawOutlook(frequency_hz=float(f), storage_modulus_percent=100 * g, loss_factor_percent=100 * e)
        for f, g, e in zip(plan.aims.frequency_hz, *plan.errors.tolist(), strict=True)
    )


def _levels(plan: Plan) -> tuple[LevelCompared, ...]:
    return tuple(
        LevelCompared(
            level_g=x.level_g,
            steps=len(x.choice.taken),
            seconds=float(x.choice.seconds[-1]),
            worst_percent=100 * float(x.choice.worst[-1]),
            why_not=x.why_not,
        )
        for x in plan.levels
    )


def _spots(plan: Plan) -> tuple[SpotCompared, ...]:
    return tuple(
        SpotCompared(
            x_mm=1e3 * s.x_m,
            y_mm=1e3 * s.y_m,
            steps=s.steps,
            seconds=s.seconds,
            worst_percent=100 * s.worst,
            limit_percent=100 * s.limit,
            reached=s.reached,
            stated=s.stated,
        )
        for s in plan.spots
    )


def _effects(plan: Plan) -> tuple[EffectForecast, ...]:
    return tuple(
        EffectForecast(
            name=e.name,
            parameter=e.key,
            unit=e.unit,
            seen_at=e.seen_at,
            seen_at_best=e.seen_at_best,
            chance_seen=e.chance_seen,
            rivals=tuple(RivalEffect(name=r.name, times=r.times) for r in e.rivals),
        )
        for e in plan.effects
    )


def sweep_toml(
    steps: tuple[PlannedStep, ...], level_g: float, settling: SettlingForecast | None = None
) -> str:
    """The steps as the [sweep] of an experiment file, with the patience that they need."""
    lines = ["[sweep]", f"level_g = {level_g:g}"]
    for part in _segments(steps):
        listed = ", ".join(f"{s.frequency_hz:g}" for s in steps if s.segment == part.segment)
        lines += ["", "[[sweep.segments]]", f"frequencies_hz = [{listed}]"]
    if settling is not None:
        lines += ["", "[sweep.settle]", f"most_s = {settling.most_s:g}"]
    return "\n".join(lines) + "\n"


def _segments(steps: tuple[PlannedStep, ...]) -> tuple[PlannedPart, ...]:
    found = []
    for number in sorted({s.segment for s in steps}):
        inside = [s for s in steps if s.segment == number]
        f = [s.frequency_hz for s in inside]
        seconds = sum(s.seconds for s in inside)
        found.append(
            PlannedPart(segment=number, low_hz=min(f), high_hz=max(f), steps=len(f), seconds=seconds)
        )
    return tuple(found)
