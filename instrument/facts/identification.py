"""The result of `viscorig identify`, and of the live identification of a run."""

from collections.abc import Mapping

from pydantic import Field

from instrument.facts.beside import BesideTable
from instrument.facts.budget import BudgetRow
from instrument.facts.intervals import IntervalsFound
from instrument.facts.number import MaybeNumber, Number
from instrument.facts.pointwise import BandFound, CausalityTest
from instrument.facts.result import Result
from instrument.facts.rows import AdjustedNumber, HeldOut, LawKnown, LawRow, PointSetAside, StretchSetAside
from instrument.facts.session_result import SessionResult


class PointFitted(Result):
    """Amplitude of one point as it was measured and as the fit has it."""

    frequency_hz: Number
    segment: int
    measured_m_s: Number
    predicted_m_s: Number
    difference_percent: Number
    file: int | None = None
    """From 1, of several."""
    pickup: int | None = None
    """From 0, of several."""


class Bend(Result):
    """How a law was bent, in standard deviations at its knots: storage, then loss."""

    knots_hz: tuple[Number, ...]
    whitened: tuple[Number, ...]


class PosteriorFound(Result):
    """Covariance of all that was fitted: logarithms of the law's parameters, the rest in its own sizes."""

    names: tuple[str, ...]
    rows: tuple[tuple[Number, ...], ...]
    """Of the lower triangle, the diagonal last in each."""


class TheoryErrorRow(Result):
    """How far the plate's theory is off exact elasticity at one resonance, relative."""

    frequency_hz: Number
    frequency_error: Number
    loss_factor_error: Number


class BareMode(Result):
    """A natural frequency of the hammer test beside the model's."""

    measured_hz: Number
    fitted_hz: Number


class BarePlateFound(Result):
    """What the hammer test gives by itself."""

    substrate_young_pa: Number
    substrate_young_standard_error_pa: Number
    substrate_young_over_stated: Number
    clamp_percent_of_mode_1: Number
    modes: tuple[BareMode, ...]
    left_out_hz: tuple[Number, ...] = ()
    modal_ratios: tuple[Number, ...]


class IdentificationResult(Result):
    """The core's law, how well it is known, and what it leaves of the data."""

    method: str = "direct"
    law_kind: str
    parameters: Mapping[str, Number]
    """Of the law, in SI units, which the keys end with."""
    standard_errors: Mapping[str, Number]
    """Of the parameters; NaN for one at its limit."""
    correlations: Mapping[str, Mapping[str, Number]]
    """Of the logarithms of the parameters."""
    points: tuple[PointFitted, ...]
    points_set_aside: tuple[PointSetAside, ...] = ()
    """Readings that are none, by themselves or in a stretch: not fitted, and not in `points`."""
    rms_percent: Number
    """Of the differences in amplitude."""
    max_percent: Number
    chi2_per_dof: MaybeNumber = None
    """None where the noise is not known."""
    noise: str = ""
    """Where the noise is known from."""
    leave_one_out_rms_percent: MaybeNumber = None
    held_out: tuple[HeldOut, ...] = ()
    held_out_rms_percent: MaybeNumber = None
    iterations: int = 0
    evaluations: int = 0
    seconds: MaybeNumber = None
    """Of the fit; a live identification does not say."""
    setup_seconds: MaybeNumber = None
    validation_seconds: MaybeNumber = None
    converged: bool = True
    criterion_met: bool | None = None
    """Of the paper's method alone."""
    warnings: tuple[str, ...] = ()
    doubts: tuple[str, ...] | None = None
    """Those warnings by which the law may be wrong by more than is known of it; None in files of older
    versions."""
    law: tuple[LawRow, ...]
    """Over the measured band."""
    law_known: LawKnown | None = None
    """None where it has no standard errors."""
    adjusted: tuple[AdjustedNumber, ...] = ()
    bend: Bend | None = None
    """None where the law was not free to bend."""
    posterior: PosteriorFound | None = None
    theory_error: tuple[TheoryErrorRow, ...] | None = None
    """None for the paper's method."""
    hammer: BarePlateFound | None = None
    """Where a hammer test took part."""
    budget: tuple[BudgetRow, ...] | None = None
    """By source, where it was asked for; None too where these data give no uncertainty."""
    uncertainty: tuple[IntervalsFound, ...] | None = None
    """By profile, posterior or bootstrap, an item each, where it was asked for (docs/uncertainty.md)."""
    pointwise: tuple[BandFound, ...] | None = None
    """Where it was asked for."""
    kramers_kronig: CausalityTest | None = None
    """None where causality could not be judged, too."""
    beside: BesideTable | None = Field(default=None, alias="with")
    """Somebody's measurement, where one was given; None too where the law has no band."""
    temperature_c: MaybeNumber = None
    """At which the law holds; of a run with a sensor."""
    temperature_range_c: tuple[Number, Number] | None = None
    files: tuple[str, ...] | None = None
    """Of several under one law."""
    set_aside: tuple[StretchSetAside, ...] | None = None
    """Of several files, what takes no part."""
    session: str | None = None
    """Whose points these are; None for a sweep's file."""
    session_result: SessionResult | None = None
    """Of a session that was diagnosed: the law to sign, and not this one."""
    reads: str | None = None
    """What the session's laser sees: `absolute` or `relative` velocity."""

    @property
    def untimed(self) -> "IdentificationResult":
        """Without how long it took: the same whenever it is computed again."""
        return self.without("seconds", "setup_seconds", "validation_seconds")
