"""What a diagnosis said of a case, beside the truth, as one line of JSON."""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.law import TrueLaw
from campaign.plant.cases import Case
from fitting.diagnosis.verdict.result import Diagnosis, Stage
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from fitting.laws import CoreLaw
from instrument.stream.jsonable import to_jsonable


@dataclass(frozen=True)
class StageFacts:
    """The fit before or after."""

    chi2_per_dof: float
    held_out_percent: float
    """Median over the segments; leave-one-out where there are few points."""
    held_out_over_noise: float
    """Median over the segments of rms over noise."""
    structures: int
    """Tests that found structure in the residual."""
    storage_error_percent: tuple[float, ...]
    """Of G' against the truth at 20, 100 and 280 Hz."""
    loss_error_percent: tuple[float, ...]
    """Of eta, relative."""


@dataclass(frozen=True)
class Said:
    """What one diagnosis concluded, as it is scored."""

    verdict: str
    effects: tuple[str, ...]
    channels: tuple[str, ...]
    equivalent: dict[str, tuple[str, ...]]
    candidates: tuple[tuple[str, float, float], ...]
    """Of every one: name, delta BIC, chi-square per degree of freedom."""
    before: StageFacts
    after: StageFacts
    seconds: float
    setup_seconds: float

    @property
    def group(self) -> tuple[str, ...]:
        """What is not to be told from the first effect, itself included; empty where none is named."""
        return self.group_of(self.effects[0]) if self.effects else ()

    def group_of(self, name: str) -> tuple[str, ...]:
        """The names these data cannot tell from an accepted one, itself included."""
        return self.equivalent.get(name, (name,))


@dataclass(frozen=True)
class Outcome:
    """A case and what was said of it."""

    kind: str
    seed: int
    truth: tuple[str, ...]
    hammer: bool
    levels: int
    visible_chi2: float
    """What no law takes up of the effect, in units of the noise."""
    said: Said | None
    without: Said | None
    """With the true effect out of the catalogue; of single effects only."""
    error: str = ""
    """Why there is no answer."""


def said_of(case: Case, found: Diagnosis, seconds: float, setup_seconds: float) -> Said:
    """The facts of a diagnosis that the score needs."""
    return Said(
        verdict=found.verdict,
        effects=tuple(e.name for e in found.effects),
        channels=tuple(e.name for e in found.channels),
        equivalent={name: tuple(group) for name, group in found.equivalent.items()},
        candidates=tuple((c.name, c.delta_cost, c.chi2_per_dof) for c in found.candidates),
        before=_stage(case.truth.law, found.before),
        after=_stage(case.truth.law, found.after),
        seconds=seconds,
        setup_seconds=setup_seconds,
    )


def _stage(truth: TrueLaw, stage: Stage) -> StageFacts:
    segments = [s.rms_percent for s in stage.validation.held_out]
    one_by_one = stage.validation.leave_one_out_rms_percent
    held_out = float(np.median(segments)) if segments else math.nan if one_by_one is None else one_by_one
    over_noise = [s.rms_percent / s.noise_percent for s in stage.validation.held_out]
    ratio = float(np.median(over_noise)) if over_noise else math.nan
    shown = len(stage.structure)
    return StageFacts(stage.chi2_per_dof, held_out, ratio, shown, *law_errors_percent(stage.law, truth))


def law_errors_percent(law: CoreLaw, truth: TrueLaw) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Of G' and of eta at 20, 100 and 280 Hz."""
    omega = 2 * np.pi * np.array(REFERENCE_FREQUENCIES_HZ)
    found, true = law.modulus(omega), truth.modulus(omega)
    storage = found.real / true.real
    loss = (found.imag / found.real) / (true.imag / true.real)
    return _off(storage), _off(loss)


def _off(ratio: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(float(100 * (r - 1)) for r in ratio)


def line_of(outcome: Outcome) -> dict[str, Any]:
    """The outcome as JSON has it."""
    facts: dict[str, Any] = to_jsonable(asdict(outcome))
    return facts


def outcome_of(line: dict[str, Any]) -> Outcome:
    """The outcome that `line_of` has written."""
    said, without = (_said(line[key]) for key in ("said", "without"))
    known = {**line, "truth": tuple(line["truth"]), "visible_chi2": _number(line["visible_chi2"])}
    return Outcome(**{**known, "said": said, "without": without})


def _said(facts: dict[str, Any] | None) -> Said | None:
    if facts is None:
        return None
    return Said(
        verdict=facts["verdict"],
        effects=tuple(facts["effects"]),
        channels=tuple(facts["channels"]),
        equivalent={name: tuple(group) for name, group in facts["equivalent"].items()},
        candidates=tuple((name, _number(delta), _number(chi2)) for name, delta, chi2 in facts["candidates"]),
        before=_stage_facts(facts["before"]),
        after=_stage_facts(facts["after"]),
        seconds=facts["seconds"],
        setup_seconds=facts["setup_seconds"],
    )


def _stage_facts(facts: dict[str, Any]) -> StageFacts:
    return StageFacts(
        _number(facts["chi2_per_dof"]),
        _number(facts["held_out_percent"]),
        _number(facts["held_out_over_noise"]),
        facts["structures"],
        tuple(_number(v) for v in facts["storage_error_percent"]),
        tuple(_number(v) for v in facts["loss_error_percent"]),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
