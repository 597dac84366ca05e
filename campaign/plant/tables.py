"""The score as Markdown."""

from collections.abc import Sequence
from math import isnan

from campaign.plant.cases import NONE, PAIR
from campaign.plant.outcome import Outcome
from campaign.plant.score import (
    MOST_IN_GROUP,
    LawErrors,
    Score,
    answer,
    confusion,
    in_group,
    scores,
)
from campaign.tables import markdown


def summary(outcomes: Sequence[Outcome]) -> str:
    """The whole score of a campaign."""
    found = scores(outcomes)
    parts = [
        f"# Diagnosis of {len(outcomes)} sweeps of the 3D plant",
        "## Naming\n"
        "right: named first (clean: nothing named; pair: both and nothing else). in group: the same, or in a "
        f"declared group of at most {MOST_IN_GROUP}. of these: likeliest of what effects that are hidden in "
        "some sweep explain. taken out: diagnosed again without the true effect in "
        "the catalogue; refused: then unknown; misnamed: then another effect named, and no group declared.",
        _naming(found),
        "## The material and the fit\nErrors of G' and eta at 20, 100 and 280 Hz against the truth.",
        _material(found),
        "## What was said first",
        _confusion(outcomes),
    ]
    wrong = _wrong(outcomes)
    if wrong:
        parts += ["## Not right\nits chi2: what no law takes up of the hidden effect.", wrong]
    return "\n\n".join(parts) + "\n"


def _naming(found: Sequence[Score]) -> str:
    columns = ["hidden", "cases", "right", "in group", "of these", "one of two", "too many"]
    columns += ["taken out", "refused", "misnamed", "no answer"]
    rows = []
    for s in found:
        alike = [str(n) for n in (s.cases, s.right, s.in_group, s.of_hidden)]
        pair = str(s.part) if s.name == PAIR else ""
        again = [str(n) for n in (s.taken_out, s.refused, s.misnamed)] if s.taken_out else ["", "", ""]
        rows.append([s.name, *alike, pair, str(s.too_many), *again, str(s.failed or "")])
    return markdown(columns, rows)


def _material(found: Sequence[Score]) -> str:
    columns = ["hidden", "law error before: median, worst %", "after: median, worst %", "chi2/dof after"]
    columns += ["held out before %", "after %", "seconds", "set-up s"]
    rows = [
        [
            s.name,
            _errors(s.law_before),
            _errors(s.law_after),
            _figure(s.chi2_after),
            _figure(s.held_out_before_percent),
            _figure(s.held_out_after_percent),
            _figure(s.seconds),
            _figure(s.setup_seconds),
        ]
        for s in found
    ]
    return markdown(columns, rows)


def _errors(errors: LawErrors) -> str:
    return "" if isnan(errors.median) else f"{errors.median:.2f}, {errors.worst:.1f}"


def _figure(value: float) -> str:
    """Nothing where there is none."""
    return "" if isnan(value) else f"{value:.2f}"


def _confusion(outcomes: Sequence[Outcome]) -> str:
    table = confusion(outcomes)
    answers = [kind for kind in table if any(kind in row for row in table.values())]
    answers += sorted({a for row in table.values() for a in row} - set(answers))
    rows = [[kind, *(str(row[a] or "") for a in answers)] for kind, row in table.items()]
    return markdown(["hidden", *answers], rows)


def _wrong(outcomes: Sequence[Outcome]) -> str:
    rows = []
    for o in outcomes:
        if o.said is not None and in_group(o, o.said):
            continue
        said = " + ".join(o.said.effects) or answer(o.said) if o.said else o.error
        verdict = o.said.verdict if o.said else "no answer"
        group = ", ".join(o.said.group) if o.said else ""
        chi2 = _figure(o.said.after.chi2_per_dof) if o.said else ""
        hidden = " + ".join(o.truth) or NONE
        rows.append([o.kind, str(o.seed), hidden, f"{o.visible_chi2:.3g}", verdict, said, group, chi2])
    if not rows:
        return ""
    columns = ["kind", "seed", "hidden", "its chi2", "verdict", "said", "group", "chi2/dof after"]
    return markdown(columns, sorted(rows))
