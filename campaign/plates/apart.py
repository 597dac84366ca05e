"""Groups of one sweep, told apart by the measurements that the ranking proposes.

What is proposed first is made on the same solid plate, and everything diagnosed together; twice at the most.
A case whose first sweep ends in no group is put down as that.
"""

from collections.abc import Sequence
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from campaign.plates.remeasured import RemeasuredPlate
from campaign.plates.weak_effects import draw_weak
from campaign.run import Job, keep_summary, run_campaign
from instrument.finding.diagnosis import Diagnosed
from instrument.planning.follow_up import Possible, rank_follow_ups
from instrument.progress import Progress, quiet

_MOST = 2
"""Measurements after the first sweep."""
_STREAM = 90
"""Of random numbers of the first of them: no other draw of a case has it."""
_GROUP = 0.01
"""Probability from which a member of a group is put into the table."""
Line = dict[str, Any]


def judge_apart(job: Job) -> Line:
    """One case from its first sweep to the last verdict."""
    rig = draw_weak(job.kind, job.seed)
    found = rig.diagnosed()
    facts = rig.truth.facts
    line: Line = {"kind": job.kind, "seed": job.seed, "plate": facts["plate"], "effects": facts["effects"]}
    line |= {"first": _said(rig, found), "first_s": rig.seconds, "measured": []}
    for number in range(_MOST):
        began = process_time()
        ranked = rank_follow_ups(found, Possible(measurements=_MOST - number))
        cpu = process_time() - began
        if not ranked:
            break
        best = ranked[0]
        rig = rig.after(best, np.random.default_rng([job.seed, *job.kind.encode(), _STREAM + number]))
        found = rig.diagnosed()
        how = best.model_dump(include={"kind", "level_g", "spot_mm", "seconds", "separation"})
        how |= {"probability_resolved": best.probability_resolved, "ranking_cpu_s": cpu}
        how |= {"steps": len(best.frequencies_hz), "todo": best.todo}
        line["measured"].append({**how, **_said(rig, found)})
    return line


def run_apart(
    jobs: Sequence[Job], folder: Path, *, workers: int = 2, progress: Progress = quiet
) -> list[Line]:
    """Lines of all jobs, with those an earlier run left. Raises `BadInput`, `StoppedByUser`."""
    return run_campaign(jobs, folder, judge_apart, {"apart": True}, workers=workers, progress=progress)


def write_apart_summary(lines: Sequence[Line], folder: Path) -> str:
    """What became of every group as Markdown, kept in the folder."""
    groups = [line for line in lines if line["measured"]]
    others = [line["first"]["said"] for line in lines if not line["measured"]]
    last = [line["measured"][-1]["said"] for line in groups]
    times = [sum(m["seconds"] for m in line["measured"]) for line in groups]
    made = [m for line in groups for m in line["measured"]]
    ended = sum(m["said"] != "ambiguous" for m in made)
    foretold = sum(m["probability_resolved"] for m in made)
    text = [
        f"{len(lines)} cases; {_counted(others)} after one sweep; {len(groups)} groups: {_counted(last)}.",
        f"Rig time and hands: median {np.median(times or [0]):.0f} s, longest {max(times or [0]):.0f} s. "
        f"Of {len(made)} measurements {foretold:.1f} were foretold to settle the matter, {ended} did.",
        "",
        "| hidden | after one sweep | measured, rig time and hands | chance foretold | after |",
        "|---|---|---|---|---|",
        *(row for line in groups for row in _rows(line)),
        "",
    ]
    return keep_summary("\n".join(text), folder)


def _said(rig: RemeasuredPlate, found: Diagnosed) -> Line:
    """What a diagnosis says, beside the truth."""
    result = found.result
    names = [e.name for e in result.effects]
    right = "right" if sorted(names) == sorted(rig.truth.names) else "wrong"
    group: dict[str, float] = {}
    if result.rivals is not None:
        each = zip(result.rivals.names, result.rivals.each, strict=True)
        group = {name: round(p, 3) for name, (_, p) in each if p > _GROUP}
    said = right if result.verdict == "effect" else result.verdict
    return {"said": said, "names": names, "group": group}


def _counted(said: Sequence[str]) -> str:
    return ", ".join(f"{said.count(word)} {word}" for word in sorted(set(said))) or "none"


def _rows(line: Line) -> list[str]:
    before, rows = f"{line['kind']} | {_words(line['first'])}", []
    for m in line["measured"]:
        how = f"{m['kind']}, {m['seconds']:.0f} s | {m['probability_resolved']:.2f}"
        rows.append(f"| {before} | {how} | {_words(m)} |")
        before = " | "
    return rows


def _words(said: Line) -> str:
    names = " + ".join(said["names"])
    if said["said"] in ("right", "wrong"):
        return names if said["said"] == "right" else f"{names}: wrong"
    group = ", ".join(f"{name} {p:.2f}" for name, p in said["group"].items())
    return f"{said['said']}: {group}" if group else str(said["said"])
