"""What an identification or a diagnosis said of a case, as plain data, beside the truth."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import product
from math import isnan
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from campaign.law import TrueLaw
from fitting.arrays import Array, Complex
from fitting.sweep import Sweep
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.rows import LawRow
from instrument.stream.jsonable import to_jsonable

Facts = Mapping[str, Any]

LAW = "core_law"
"""No fault where the true law is none that the specimen's kind can follow."""


@dataclass(frozen=True)
class Band:
    """G' in Pa and eta with standard errors, over frequency. Shape (frequencies,) each."""

    frequency_hz: tuple[float, ...]
    storage_pa: tuple[float, ...]
    loss: tuple[float, ...]
    storage_error_pa: tuple[float, ...]
    loss_error: tuple[float, ...]

    def at(self, frequency_hz: Sequence[float]) -> "Band":
        """Interpolated: logarithms over that of the frequency, errors as shares."""
        x, wanted = np.log(self.frequency_hz), np.log(frequency_hz)

        def read(values: ArrayLike) -> Array:
            return np.interp(wanted, x, np.asarray(values, dtype=float))

        storage, loss = np.exp(read(np.log(self.storage_pa))), np.exp(read(np.log(self.loss)))
        shares = np.divide(self.storage_error_pa, self.storage_pa), np.divide(self.loss_error, self.loss)
        errors = storage * read(shares[0]), loss * read(shares[1])
        found = (np.asarray(frequency_hz, dtype=float), storage, loss, *errors)
        return Band(*(tuple(v.tolist()) for v in found))


def band_from(rows: Sequence[LawRow]) -> Band:
    """Of an identification's law, or of a diagnosis's stage."""
    known = sorted(rows, key=lambda row: row.frequency_hz)
    return Band(
        tuple(row.frequency_hz for row in known),
        tuple(row.storage_modulus_pa for row in known),
        tuple(row.loss_factor for row in known),
        tuple(row.storage_modulus_standard_error_pa for row in known),
        tuple(row.loss_factor_standard_error for row in known),
    )


def _number(value: float | None) -> float:
    return float("nan") if value is None else float(value)


@dataclass(frozen=True)
class Answer:
    """What a diagnosis concluded, as it is scored."""

    verdict: str
    effects: tuple[str, ...]
    """Named, the surest first."""
    equivalent: dict[str, tuple[str, ...]]
    """Named one to all that the data cannot tell from it."""
    probabilities: dict[str, float]
    """Of each explanation; names of a pair are joined by " + ", "none" is no effect."""
    before: Band | None
    after: Band | None
    seconds: float = float("nan")
    chi2_after: float | None = None
    """Per degree of freedom, of the fit with what is named."""

    def group_of(self, name: str) -> tuple[str, ...]:
        """What is not told from a named effect, itself included."""
        return self.equivalent.get(name, (name,))


def answer_from(found: DiagnosisResult) -> Answer:
    """The answer of a diagnosis."""
    return Answer(
        verdict=found.verdict,
        effects=tuple(e.name for e in found.effects),
        equivalent=dict(found.equivalent),
        probabilities={c.name: c.probability for c in found.candidates if not isnan(c.probability)},
        before=band_from(found.before.law),
        after=band_from(found.after.law),
        seconds=_number(found.seconds),
        chi2_after=found.after.chi2_per_dof,
    )


class CaseTruth(Protocol):
    """What is asked of a case's truth."""

    @property
    def specimen_name(self) -> str:
        """Which of the campaign's it is."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the hidden effects."""

    @property
    def effects(self) -> Collection[Any]:
        """That are there, each with `name`, `near` and `in_catalogue`."""

    @property
    def law(self) -> TrueLaw:
        """True law of the core's material."""

    @property
    def modulus_pa(self) -> Complex:
        """Of the core where the law is judged. Shape (frequencies,)."""

    @property
    def resonances_hz(self) -> tuple[float, ...]:
        """Where the law is judged."""


class JudgedCase(Protocol):
    """What is asked of a case, whatever specimen it is of."""

    @property
    def kind(self) -> str:
        """Which kind of case it is."""

    @property
    def seed(self) -> int:
        """The seed it was drawn with."""

    @property
    def exact(self) -> bool:
        """Whether the specimen says the truth."""

    @property
    def sweep(self) -> Sweep:
        """The sweep that was measured."""

    @property
    def hammer(self) -> object | None:
        """The bare specimen's test, if there is one."""

    @property
    def truth(self) -> CaseTruth:
        """The truth that was hidden from the diagnosis."""


@dataclass(frozen=True)
class PlateOutcome:
    """A case and what was said of it; bands are read at the three frequencies at which the law is judged."""

    kind: str
    seed: int
    exact: bool
    plate: str
    truth: tuple[str, ...]
    """Effects that are there."""
    near: dict[str, tuple[str, ...]]
    """Effect to other names that would not be wrong."""
    strange: bool
    """Whether one of them is in no catalogue."""
    usual_law: bool
    hammer: bool
    levels: int
    frequency_hz: tuple[float, ...]
    storage_pa: tuple[float, ...]
    loss: tuple[float, ...]
    identified: Band | None = None
    said: Answer | None = None
    error: str = ""
    visible_chi2: float | None = None
    """How plainly what is hidden shows (`visible.visible_chi2`); None where it was not asked."""

    @property
    def asked(self) -> bool:
        """Whether anything was: what is hidden may show too little."""
        return self.identified is not None or self.said is not None or bool(self.error)


def outcome_of(
    case: JudgedCase,
    identified: Band | None,
    said: Answer | None,
    error: str = "",
    visible_chi2: float | None = None,
) -> PlateOutcome:
    """The case beside what was said of it."""
    truth, f = case.truth, case.truth.resonances_hz
    G = truth.modulus_pa
    if said is not None:
        before, after = (b.at(f) if b is not None else None for b in (said.before, said.after))
        said = Answer(**{**vars(said), "before": before, "after": after})
    return PlateOutcome(
        kind=case.kind,
        seed=case.seed,
        exact=case.exact,
        plate=truth.specimen_name,
        truth=truth.names,
        near={h.name: h.near for h in truth.effects},
        strange=any(not h.in_catalogue for h in truth.effects),
        usual_law=truth.law.is_usual,
        hammer=case.hammer is not None,
        levels=len(np.unique(case.sweep.commanded_m_s2)),
        frequency_hz=tuple(f),
        storage_pa=tuple(G.real.tolist()),
        loss=tuple((G.imag / G.real).tolist()),
        identified=identified.at(f) if identified is not None else None,
        said=said,
        error=error,
        visible_chi2=visible_chi2,
    )


def explains(outcome: PlateOutcome, names: Sequence[str]) -> bool:
    """Whether an explanation is the truth: every effect, by a name that is not wrong, and nothing else.

    Another law counts for nothing where the true one is not of the kind that the specimen states.
    """
    said = {n for n in names if n != "none" and (outcome.usual_law or n != LAW)}
    choices = [(name, *outcome.near[name]) for name in outcome.truth]
    return any(said == set(choice) for choice in product(*choices))


def line_of(outcome: PlateOutcome) -> dict[str, Any]:
    """The outcome as JSON has it."""
    facts: dict[str, Any] = to_jsonable(asdict(outcome))
    return facts


def outcome_from(line: Facts) -> PlateOutcome:
    """The outcome that `line_of` has written."""
    tuples = {k: tuple(line[k]) for k in ("truth", "frequency_hz", "storage_pa", "loss")}
    said = line["said"]
    if said is not None:
        lists = {
            "effects": tuple(said["effects"]),
            "equivalent": {k: tuple(v) for k, v in said["equivalent"].items()},
            "before": _band(said["before"]),
            "after": _band(said["after"]),
            "seconds": _number(said["seconds"]),
        }
        said = Answer(**{**said, **lists})
    near = {k: tuple(v) for k, v in line["near"].items()}
    known = {**line, **tuples, "near": near, "identified": _band(line["identified"]), "said": said}
    return PlateOutcome(**known)


def _band(facts: Facts | None) -> Band | None:
    return None if facts is None else Band(**{k: tuple(_number(v) for v in vs) for k, vs in facts.items()})
