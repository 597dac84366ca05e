"""The result of `viscorig diagnose`, and of the diagnosis a run ends with."""

from collections.abc import Mapping
from math import nan
from typing import Literal

from instrument.facts.follow_up import FollowUp
from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result
from instrument.facts.rows import AdjustedNumber, HeldOut, LawKnown, LawRow, PointSetAside, StretchSetAside

Verdict = Literal["none", "effect", "ambiguous", "unknown"]
StageName = Literal["before", "after"]
STAGES: tuple[StageName, ...] = ("before", "after")


class ParameterFound(Result):
    """Of an effect, in `unit`."""

    value: Number
    standard_error: Number
    """NaN where the data do not fix it, or it sits at a limit."""
    unit: str


class EffectFound(Result):
    """An accepted effect, or what a channel shows by itself."""

    name: str
    parameters: Mapping[str, ParameterFound]
    probability: Number = nan
    """That it is there, alone or beside another."""


class CandidateFitted(Result):
    """One effect, or two together, fitted with the law."""

    name: str
    """`none`, an effect's name, or two joined by " + "."""
    delta_bic: Number
    """-2 ln of prior times marginal likelihood, above the best one's: no BIC, the key is an old name."""
    probability: Number = nan
    """One of all that were tried being right."""
    chi2_per_dof: MaybeNumber = None
    parameters: Mapping[str, ParameterFound]
    """Of two effects together, each key with its effect's name before it."""
    law: tuple[LawRow, ...] = ()
    """At a few frequencies, its own."""
    checks: Mapping[str, Number] = {}
    """Tail probabilities of posterior predictive checks, by what was looked at."""


class StageFitted(Result):
    """The fit without any effect, or with the effects accepted."""

    rms_percent: Number
    max_percent: Number
    chi2_per_dof: MaybeNumber = None
    held_out: tuple[HeldOut, ...] = ()
    held_out_rms_percent: MaybeNumber = None
    """The error on data not seen, whichever way it was found."""
    leave_one_out_rms_percent: MaybeNumber = None
    law_kind: str = ""
    parameters: Mapping[str, Number] = {}
    standard_errors: Mapping[str, Number] = {}
    correlations: Mapping[str, Mapping[str, Number]] = {}
    """Of the logarithms of the parameters."""
    law: tuple[LawRow, ...]
    law_known: LawKnown | None = None
    structure: tuple[str, ...] = ()
    """Tests that find the residuals not random, in words."""
    adjusted: tuple[AdjustedNumber, ...] = ()


class Residual(Result):
    """Of one point: 100 (predicted / measured - 1)."""

    amplitude_percent: Number
    re_percent: Number = nan
    """Amplitude to first order; not given where phase was not kept."""
    im_percent: Number = nan
    """Phase to first order; not given where phase was not kept."""
    whitened: tuple[Number, ...] = ()
    """In units of noise and model error, a number a part."""

    @property
    def has_phase(self) -> bool:
        """Whether there are parts besides the amplitude."""
        return "re_percent" in self.model_fields_set


class PointLeft(Result):
    """What either fit leaves of one point."""

    frequency_hz: Number
    segment: int
    sweep: int
    level_m_s2: Number
    noise_percent: Number
    before: Residual
    after: Residual
    file: int | None = None
    """From 1, of several."""
    pickup: int | None = None
    """From 0, of several."""

    def stage(self, name: StageName) -> Residual:
        """What one stage's fit leaves of the point."""
        return self.before if name == "before" else self.after


class ModeLeft(Result):
    """A mode of a table beside the model's, without and with the effects accepted."""

    file: int
    """From 1."""
    mode: int
    frequency_hz: Number
    loss_factor: Number
    before_hz: Number
    before_loss_factor: Number
    after_hz: Number
    after_loss_factor: Number


class UnseenEffect(Result):
    """An effect that may be there without being named, and what it would do to the law."""

    name: str
    chance: Number
    """That a laboratory's set-up has it at all, before any data."""
    parameter: str | None = None
    """That says how strong it is; None for an effect that is there or not."""
    size: MaybeNumber = None
    """The largest that would not be seen, no larger than it is expected to be where a laboratory has it."""
    unit: str | None = None
    storage_modulus_percent: Number
    """By how much it would shift G', where in the band it shifts it most."""
    loss_factor_percent: Number
    standard_errors: Number
    """The larger of both, in standard errors of the law's band."""


class DiagnosisResult(Result):
    """What the specimen's law cannot explain, traced to an effect."""

    verdict: Verdict
    effects: tuple[EffectFound, ...]
    """Accepted ones, the best one of an ambiguous group, and what the channels show by themselves."""
    equivalent: Mapping[str, tuple[str, ...]]
    """Accepted name to the names that these data cannot tell from it, itself included."""
    candidates: tuple[CandidateFitted, ...]
    """Best first; `none` among them."""
    before: StageFitted
    after: StageFitted
    """The same as `before` where nothing is accepted."""
    adjusted: tuple[AdjustedNumber, ...] = ()
    p_value: MaybeNumber = None
    """Chance that data without any effect gain as much, the data counted among them; None where not asked
    for."""
    resamples: int = 0
    """Sweeps without any effect that it was found from; 0 in files of older versions too."""
    nested_held_out_rms_percent: MaybeNumber = None
    """Held out with the selection repeated."""
    next_measurement: str = ""
    next_measurements: tuple[FollowUp, ...] = ()
    """What would tell the explanations left apart, best first; empty where one is left."""
    unseen: tuple[UnseenEffect, ...] = ()
    """What may be there without being named and would shift the law beyond its 95 % band, worst first."""
    explanation: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    doubts: tuple[str, ...] | None = None
    """Those warnings by which the law may be wrong by more than is known of it; None in files of older
    versions."""
    by_hand: bool = False
    """Accepted or declined on someone's word."""
    points: tuple[PointLeft, ...]
    points_set_aside: tuple[PointSetAside, ...] = ()
    """Readings that are none, by themselves or in a stretch: not fitted, and not in `points`."""
    set_aside_hz: tuple[Number, ...] = ()
    """Their frequencies."""
    seconds: MaybeNumber = None
    """A run does not say."""
    setup_seconds: MaybeNumber = None
    modes: tuple[ModeLeft, ...] | None = None
    """Of tables of modes, which have no points: differences in percent are then of frequencies."""
    files: tuple[str, ...] | None = None
    """Of several under one law."""
    set_aside: tuple[StretchSetAside, ...] | None = None
    """Of several files, what takes no part."""
    session: str | None = None
    """Whose points these are; None for a sweep's file."""
    reads: str | None = None
    """What the session's laser sees: `absolute` or `relative` velocity."""

    @property
    def likeliest_first(self) -> tuple[CandidateFitted, ...]:
        """Candidates by probability, which is not by the fit alone: what may stand in for anything shares."""
        return tuple(sorted(self.candidates, key=lambda c: -c.probability))

    @property
    def stages(self) -> tuple[StageFitted, StageFitted]:
        """The fit without effects, and the one with those found."""
        return self.before, self.after

    def stage(self, name: StageName) -> StageFitted:
        """The fit without effects (`before`) or with those found (`after`)."""
        return self.before if name == "before" else self.after

    @property
    def untimed(self) -> "DiagnosisResult":
        """Without how long it took: the same whenever it is computed again."""
        return self.without("seconds", "setup_seconds")
