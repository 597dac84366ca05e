"""The result of `viscorig plan`. All of it is predicted, to first order about the law the specimen states."""

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result


class PlannedStep(Result):
    """One step."""

    frequency_hz: Number
    segment: int
    seconds: Number
    """Of rig time, settling from scratch."""
    teaches: str
    """`law`, or `causes` for one that separates what the model may lack."""


class PlannedPart(Result):
    """A resonance region."""

    segment: int
    low_hz: Number
    high_hz: Number
    steps: int
    seconds: Number


class LawOutlook(Result):
    """How well the law will be known at one frequency: one relative standard error."""

    frequency_hz: Number
    storage_modulus_percent: Number
    loss_factor_percent: Number


class SettlingForecast(Result):
    """Steps that the usual `most_s` of a sweep would read before they have come to rest."""

    steps: int
    """So many do not settle within `usual_s`."""
    usual_s: Number
    """`settle.most_s` where an experiment does not name it."""
    left_percent: Number
    """Of the transient, by the bound a run reckons with, if that ended the longest wait."""
    longest_s: Number
    """Expected of the slowest step."""
    most_s: Number
    """What the [sweep] of the plan has instead."""
    never: int
    """So many steps do not settle within `most_s` either: what is predicted does not hold for them."""


class LevelCompared(Result):
    """The plan at another level."""

    level_g: Number
    steps: int
    seconds: Number
    worst_percent: Number
    why_not: str = ""
    """The limit of the rig that it exceeds; empty for none."""


class SpotCompared(Result):
    """The plan read at another spot."""

    x_mm: Number
    y_mm: Number
    steps: int
    """Number of steps of the plan at that spot."""
    seconds: Number
    worst_percent: Number
    """In the rig time of the plan at the stated spot."""
    limit_percent: Number
    reached: bool
    stated: bool = False
    """Whether it is the specimen's own."""


class RivalEffect(Result):
    """Another effect that one is mistaken for."""

    name: str
    times: MaybeNumber
    """How many times its size to be seen the effect must have to be told from this one; null for never."""


class EffectForecast(Result):
    """What the plan could say of one effect."""

    name: str
    parameter: str | None
    """That says how strong it is; null for an effect that is there or not."""
    unit: str | None
    seen_at: MaybeNumber
    """Size at which it shows, at half its places."""
    seen_at_best: MaybeNumber
    """The same where it shows most."""
    chance_seen: Number
    """That it is that large, where a laboratory has it."""
    rivals: tuple[RivalEffect, ...] = ()


class NotJudged(Result):
    """An effect that this plan cannot be asked about."""

    name: str
    why: str


class LimitingNumber(Result):
    """A stated number that keeps the band from being known better."""

    name: str
    worst_percent: Number
    """That everything measured would leave if it were exactly as stated."""


class PlanResult(Result):
    """A sweep that was not made."""

    target_percent: Number
    """One relative standard error of G' and of eta, everywhere in the band."""
    band_low_hz: Number
    band_high_hz: Number
    reached: bool
    """Whether the plan meets the target by its own prediction."""
    worst_percent: Number
    """The largest standard error that the plan leaves, in the terms of `target_percent`."""
    limit_percent: Number
    """The largest standard error that would be left if every candidate step were measured."""
    limited_by: tuple[LimitingNumber, ...] = ()
    seconds: Number
    """Rig time for the steps; calibration, sentinel points and what people do take time besides."""
    settling: SettlingForecast | None = None
    """Null where every step settles within the usual `most_s`."""
    level_g: Number
    x_mm: Number
    y_mm: Number
    noise_floor_m_s: Number
    """Assumed: of each part of a velocity, read over one second."""
    noise_share_percent: Number
    """Assumed: of the reading, each part."""
    steps: tuple[PlannedStep, ...]
    segments: tuple[PlannedPart, ...]
    law: tuple[LawOutlook, ...]
    levels: tuple[LevelCompared, ...] = ()
    spots: tuple[SpotCompared, ...] = ()
    """The stated one and a grid over the plate, best first; empty where they were not asked for."""
    effects: tuple[EffectForecast, ...] = ()
    not_judged: tuple[NotJudged, ...] = ()
    sweep_toml: str
    """The plan as the [sweep] of an experiment file."""
    notes: tuple[str, ...] = ()
