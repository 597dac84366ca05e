"""The score of the campaign on many plates as Markdown."""

from collections.abc import Sequence

import numpy as np

from campaign.plates.answers import PlateOutcome
from campaign.plates.score import (
    MOST_IN_GROUP,
    Coverage,
    PlateScore,
    Trace,
    in_group,
    named,
    reliability,
    scores,
    traces,
)
from campaign.tables import markdown


def summary(outcomes: Sequence[PlateOutcome], of: str = "plates") -> str:
    """The whole score of specimens that are solid plates, or what `of` calls them."""
    drawn, outcomes = len(outcomes), [o for o in outcomes if o.asked]
    found = scores(outcomes)
    plates = len({o.plate for o in outcomes})
    parts = [f"# {len(outcomes)} sweeps of {plates} solid {of}"]
    if drawn > len(outcomes):
        parts.append(f"{drawn - len(outcomes)} more were drawn in which what is hidden shows too little.")
    if any(o.said is not None for o in outcomes):
        parts += [
            "## Naming\n"
            "first: an effect that is there was named first (clean: nothing; in no catalogue: refused). "
            f"in group: the same, or in its group of at most {MOST_IN_GROUP}. "
            "whole: all that is there and nothing else.",
            _naming(found),
        ]
    shown = traces(outcomes)
    if shown:
        parts += [
            "## One effect, by how plainly it shows\n"
            "trace: chi-square that law and tolerances leave of the sweep without noise, beyond that of no "
            "effect. spoken of: something named, or unknown.",
            _traces(shown),
        ]
    parts += [
        "## The law at three frequencies\n"
        "Share of true values within the 68 % and the 95 % band; rms of error over standard error; error.",
        _coverages(found),
    ]
    bins = reliability(outcomes)
    if bins:
        rows = [[f"{b.low:g} to {b.high:g}", str(b.count), f"{b.stated:.3f}", f"{b.true:.3f}"] for b in bins]
        parts += ["## Stated probabilities", markdown(["stated", "explanations", "mean", "true"], rows)]
    wrong = _wrong(outcomes)
    return "\n\n".join(parts + (["## Not right", wrong] if wrong else [])) + "\n"


def _naming(found: Sequence[PlateScore]) -> str:
    columns = ["hidden", "cases", "first", "in group", "whole", "falsely named", "too many", "refused"]
    rows = []
    for s in found:
        counts = (s.cases, s.first, s.in_group, s.whole, s.false_named, s.false_second, s.refused, s.failed)
        rows.append([s.name, *(str(n) for n in counts)])
    return markdown([*columns, "no answer"], rows)


def _traces(found: Sequence[Trace]) -> str:
    columns = ["trace", "cases", "spoken of", "first", "in group"]
    rows = []
    for t in found:
        within = f"below {t.high:g}" if np.isneginf(t.low) else f"{t.low:g} to {t.high:g}"
        within = f"above {t.low:g}" if np.isinf(t.high) else within
        rows.append([within, *(str(n) for n in (t.cases, t.named, t.first, t.in_group))])
    return markdown(columns, rows)


def _coverages(found: Sequence[PlateScore]) -> str:
    columns = ["hidden", "of", "values", "G' in 68 %", "in 95 %", "rms pull", "error: median, worst %"]
    columns += ["eta in 68 %", "in 95 %", "rms pull", "error: median, worst %"]
    rows = []
    for s in found:
        for name, stage in (("identify", s.identified), ("before", s.before), ("after", s.after)):
            if stage:
                storage, loss = stage["storage"], stage["loss"]
                rows.append([s.name, name, str(storage.points), *_figures(storage), *_figures(loss)])
    return markdown(columns, rows)


def _figures(c: Coverage) -> list[str]:
    shares = [f"{c.inside_68:.2f}", f"{c.inside_95:.2f}", f"{c.rms_pull:.2f}"]
    return [*shares, f"{c.median_percent:.2f}, {c.worst_percent:.1f}"]


def _wrong(outcomes: Sequence[PlateOutcome]) -> str:
    rows = []
    for o in outcomes:
        if o.said is not None and in_group(o):
            continue
        if o.said is None and not o.error:
            continue
        said = o.error if o.said is None else " + ".join(named(o)) or o.said.verdict
        group = "" if o.said is None or not named(o) else ", ".join(o.said.group_of(named(o)[0]))
        rows.append([o.kind, str(o.seed), o.plate, " + ".join(o.truth) or "none", said, group])
    columns = ["kind", "seed", "plate", "hidden", "said", "group"]
    return markdown(columns, sorted(rows)) if rows else ""
