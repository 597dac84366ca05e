"""How often what was said was true, and how honest its bands and probabilities were."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from campaign.plates.answers import LAW, Band, PlateOutcome, explains
from campaign.plates.cases import KINDS, NONE, PAIR
from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.numerics.chances import Z_95

UNKNOWN = "unknown"
MOST_IN_GROUP = 3
"""A larger group names nothing."""
_ONE_SIGMA, _TWO_SIGMA = 1.0, Z_95
_TRACES = (-np.inf, 10.0, 20.0, 40.0, 100.0, np.inf)
"""Of chi-square: a rare effect costs some 6, the numbers that it brings as much."""
_EDGES = (0.0, 0.05, 0.2, 0.5, 0.8, 0.95, 1.0)


@dataclass(frozen=True)
class Coverage:
    """Of bands against the truth, at three frequencies of each case, G' and eta apart."""

    points: int
    inside_68: float
    inside_95: float
    rms_pull: float
    """Root of the mean square of error over standard error; one where the bands are honest."""
    median_percent: float
    """Size of the error."""
    worst_percent: float


@dataclass(frozen=True)
class PlateScore:
    """How diagnoses of some cases did. Counts are out of `cases`."""

    name: str
    cases: int
    failed: int
    """No answer."""
    first: int
    """Named first: an effect that is there. Clean: nothing named. In no catalogue: refused."""
    in_group: int
    """The same, or in the group of the first named, if that is no larger than three."""
    whole: int
    """All that is there was named, and nothing else."""
    false_named: int
    """The first named is not there, nor is anything of its group."""
    false_second: int
    """More was named than is there."""
    refused: int
    """Verdict `unknown`."""
    identified: dict[str, Coverage]
    """Of `identify`, for G' and eta."""
    before: dict[str, Coverage]
    after: dict[str, Coverage]


@dataclass(frozen=True)
class Bin:
    """Explanations whose stated probability lies between two values."""

    low: float
    high: float
    count: int
    stated: float
    """Mean."""
    true: float
    """Share that is the truth."""


@dataclass(frozen=True)
class Trace:
    """Cases with one effect whose trace in chi-square lies between two values. Counts are out of `cases`."""

    low: float
    high: float
    cases: int
    named: int
    """Something was, or the verdict is `unknown`: that there is nothing was not said."""
    first: int
    """As `PlateScore` counts it."""
    in_group: int


def traces(outcomes: Sequence[PlateOutcome]) -> list[Trace]:
    """How often what is hidden is named, by how plainly it shows; of single effects of the catalogue."""
    single = [o for o in outcomes if len(o.truth) == 1 and not o.strange and o.said is not None]
    found = []
    for low, high in pairwise(_TRACES):
        inside = [o for o in single if o.visible_chi2 is not None and low <= o.visible_chi2 < high]
        if inside:
            counts = (sum(map(holds, inside)) for holds in (_speaks, first_right, in_group))
            found.append(Trace(low, high, len(inside), *counts))
    return found


def _speaks(outcome: PlateOutcome) -> bool:
    return outcome.said is not None and (bool(named(outcome)) or outcome.said.verdict == UNKNOWN)


def scores(outcomes: Sequence[PlateOutcome]) -> list[PlateScore]:
    """One for each kind present, then all single ones of the catalogue, those of none, and everything."""
    known = dict.fromkeys((*KINDS, *sorted({o.kind for o in outcomes})))
    found = [score(k, [o for o in outcomes if o.kind == k]) for k in known if _any(outcomes, k)]
    single = [o for o in outcomes if o.kind not in (NONE, PAIR)]
    parts = (
        ("all single, in the catalogue", [o for o in single if not o.strange]),
        ("all in no catalogue", [o for o in single if o.strange]),
        ("all", list(outcomes)),
    )
    return [*found, *(score(name, part) for name, part in parts if part)]


def _any(outcomes: Sequence[PlateOutcome], kind: str) -> bool:
    return any(o.kind == kind for o in outcomes)


def score(name: str, outcomes: Sequence[PlateOutcome]) -> PlateScore:
    """The score of some cases together."""
    said = [o for o in outcomes if o.said is not None]

    def count(holds: Callable[[PlateOutcome], bool]) -> int:
        return sum(map(holds, said))

    return PlateScore(
        name=name,
        cases=len(outcomes),
        failed=sum(bool(o.error) or (o.said is None and o.identified is None) for o in outcomes),
        first=count(first_right),
        in_group=count(in_group),
        whole=count(lambda o: explains(o, named(o))),
        false_named=count(lambda o: bool(named(o)) and not _true(o, named(o)[0]) and not in_group(o)),
        false_second=count(lambda o: len(named(o)) > max(1, len(o.truth))),
        refused=count(lambda o: o.said is not None and o.said.verdict == UNKNOWN),
        identified=coverages((o, o.identified) for o in outcomes),
        before=coverages((o, o.said.before) for o in outcomes if o.said),
        after=coverages((o, o.said.after) for o in outcomes if o.said),
    )


def named(outcome: PlateOutcome) -> tuple[str, ...]:
    """Effects that were named; none where the diagnosis refused. Another law counts where it is false."""
    said = outcome.said
    if said is None or said.verdict in (UNKNOWN, NONE):
        return ()
    return tuple(n for n in said.effects if outcome.usual_law or n != LAW)


def _true(outcome: PlateOutcome, name: str) -> bool:
    return any(name == there or name in outcome.near[there] for there in outcome.truth)


def first_right(outcome: PlateOutcome) -> bool:
    """Whether what was said first is true: see `PlateScore.first`."""
    names = named(outcome)
    if outcome.strange and not names:
        return outcome.said is not None and outcome.said.verdict == UNKNOWN
    if not outcome.truth:
        return not names and outcome.said is not None and outcome.said.verdict != UNKNOWN
    return bool(names) and _true(outcome, names[0])


def in_group(outcome: PlateOutcome) -> bool:
    """Whether `first_right` holds with the group of the first named standing for each of its names."""
    if first_right(outcome):
        return True
    names = named(outcome)
    if not names or outcome.said is None:
        return False
    group = [name for name in outcome.said.group_of(names[0]) if name != UNLISTED]
    clean = not outcome.truth and NONE in group
    return len(group) <= MOST_IN_GROUP and (clean or any(_true(outcome, name) for name in group))


def coverages(pairs: Iterable[tuple[PlateOutcome, Band | None]]) -> dict[str, Coverage]:
    """Of G' and of eta; nothing where there is no band."""
    known = [(o, band) for o, band in pairs if band is not None]
    if not known:
        return {}
    return {
        "storage": _coverage([(o.storage_pa, b.storage_pa, b.storage_error_pa) for o, b in known]),
        "loss": _coverage([(o.loss, b.loss, b.loss_error) for o, b in known]),
    }


def _coverage(rows: Sequence[tuple[Sequence[float], Sequence[float], Sequence[float]]]) -> Coverage:
    true, found, error = (np.concatenate([np.asarray(r[k], dtype=float) for r in rows]) for k in range(3))
    size = 100 * np.abs(found / true - 1)
    usable = np.isfinite(error) & (error > 0) & np.isfinite(found)
    # In the logarithm: a modulus is positive, and wide bands of it are lopsided.
    pull = np.abs(np.log(found[usable] / true[usable]) / (error[usable] / found[usable]))
    nothing = float("nan")
    return Coverage(
        points=int(usable.sum()),
        inside_68=float(np.mean(pull < _ONE_SIGMA)) if pull.size else nothing,
        inside_95=float(np.mean(pull < _TWO_SIGMA)) if pull.size else nothing,
        rms_pull=float(np.sqrt(np.mean(pull**2))) if pull.size else nothing,
        median_percent=float(np.nanmedian(size)),
        worst_percent=float(size[np.isfinite(size)].max(initial=0.0)),
    )


def reliability(outcomes: Sequence[PlateOutcome]) -> list[Bin]:
    """Stated probabilities of explanations against how often they are the truth."""
    pairs = [
        (p, explains(o, tuple(name.split(" + "))))
        for o in outcomes
        if o.said is not None
        for name, p in o.said.probabilities.items()
        if name != UNLISTED
    ]
    bins = []
    for low, high in pairwise(_EDGES):
        inside = [(p, true) for p, true in pairs if low <= p < high or p == high == 1.0]
        if inside:
            stated, true = np.mean(inside, axis=0)
            bins.append(Bin(low, high, len(inside), float(stated), float(true)))
    return bins
