"""What a diagnosis says."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.data.aside import Reasons
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.verdict.names import joined
from fitting.identification.adjusted import Adjusted
from fitting.identification.result import LawBand
from fitting.identification.validation import Validation, rms
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate

Verdict = Literal["none", "effect", "ambiguous", "unknown"]


@dataclass(frozen=True)
class ParameterEstimate:
    """A parameter of an effect, in the unit it is reported in."""

    value: float
    standard_error: float
    """NaN where the data do not fix it, or it sits at a limit."""
    unit: str


@dataclass(frozen=True)
class FoundEffect:
    """An effect with what the data say of its size."""

    name: str
    parameters: Mapping[str, ParameterEstimate]
    probability: float = 1.0
    """That it is there, alone or beside another."""


@dataclass(frozen=True)
class Candidate:
    """One effect, or two together, fitted with the law."""

    effects: tuple[FoundEffect, ...]
    delta_cost: float
    """-2 ln of prior times marginal likelihood, above the best candidate's; of `none` too."""
    chi2_per_dof: float
    """NaN where the noise is unknown."""
    probability: float = float("nan")
    """One of all that were tried being right."""
    law: LawBand | None = None
    """At a few frequencies, its own."""
    checks: Mapping[str, float] = field(default_factory=dict)
    """Tail probabilities of posterior predictive checks, by what was looked at."""

    @property
    def name(self) -> str:
        """Name of the explanation: its effects joined, or none."""
        return joined(e.name for e in self.effects)


@dataclass(frozen=True)
class Stage:
    """The fit before or after."""

    law: CoreLaw
    standard_errors: Mapping[str, float]
    """Of the law's parameters, in their units; NaN at a limit."""
    band: LawBand
    predicted_m_s: NDArray[np.complex128]
    difference_percent: Array
    """Difference of the amplitudes from the readings. Shape (points,)."""
    whitened: Array
    """Residuals the error model leaves, parts one after the other. Shape (data,)."""
    chi2_per_dof: float
    validation: Validation
    structure: tuple[str, ...]
    """Tests that find the whitened residuals not random, in words."""
    adjusted: tuple[Adjusted, ...] = ()
    """The stated numbers as the fit has them."""
    correlations: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """Of the logarithms of the law's parameters; NaN at a limit."""

    @property
    def rms_percent(self) -> float:
        """Of the differences in amplitude."""
        return rms(self.difference_percent)

    @property
    def max_percent(self) -> float:
        """Largest difference in amplitude."""
        return float(np.max(np.abs(self.difference_percent)))


@dataclass(frozen=True, eq=False)
class Rivals:
    """What explains the data up to 95 %, as it was fitted: where a next measurement begins."""

    problem: DiagnosisProblem
    evidence: Evidence
    each: tuple[tuple[Refitted, float], ...]
    """With their probabilities, which add up to one; the likeliest first."""
    reduced: ReducedPlate | None = None
    """For what the model gets wrong; None for what knows its own error."""
    temper: float = 1.0
    """How much less a difference in chi-square says (`fitting.diagnosis.checks.predictive.temper`)."""
    beyond: tuple[tuple[Refitted, float], ...] = ()
    """What comes next, by the same measure: once some of the others are ruled out, it is in their place."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the explanations that are left."""
        return tuple(name_of(f) for f, _ in self.each)


def name_of(fitted: Refitted) -> str:
    """Of the explanation that was fitted."""
    return joined(e.name for e in fitted.effects)


@dataclass(frozen=True)
class Diagnosis:
    """A diagnosis as it is reported: verdict, effects, fits and candidates."""

    verdict: Verdict
    effects: tuple[FoundEffect, ...]
    """Accepted ones; for `ambiguous` the best one of its group."""
    channels: tuple[FoundEffect, ...]
    """What the channels show by themselves: `level_error`, `mains_hum`."""
    equivalent: Mapping[str, tuple[str, ...]]
    """Accepted name to the names these data cannot tell from it, itself included."""
    candidates: tuple[Candidate, ...]
    """Best first; `none` among them."""
    before: Stage
    after: Stage
    """The same as `before` where nothing is accepted."""
    next_measurement: str
    explanation: tuple[str, ...]
    """As one would tell a colleague, a sentence or two each."""
    why_aside: Reasons
    """Of every point why it took no part. Shape (points,)."""
    warnings: tuple[str, ...]
    by_hand: bool = False
    """Accepted or declined on someone's word."""
    p_value: float | None = None
    """Chance that data without any effect gain as much, by resampling; None where not asked for."""
    resamples: int = 0
    """Sweeps that it was found from."""
    nested_held_out_rms_percent: float | None = None
    """Held out with the selection repeated."""
    rivals: Rivals | None = field(default=None, compare=False, repr=False)
    """None where nothing was weighed."""

    @property
    def used(self) -> Mask:
        """Points that took part. Shape (points,)."""
        return np.asarray(self.why_aside == "")
