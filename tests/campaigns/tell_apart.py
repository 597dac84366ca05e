"""Groups of one sweep, told apart by the measurements that the ranking proposes; run by hand.

    python tests/campaigns/tell_apart.py --folder FOLDER --groups 20 --seed 920000

What is in FOLDER is not judged again: a campaign that was stopped, or given so many `--cases`, goes on.

Solid plates of the campaign with one weak effect hidden; most stated numbers drawn within 0.3 of a careful
laboratory's tolerances, and stated so. A case whose first sweep does not end in a group is put down as that
and passed over. Of the others the best proposal is measured on the same solid plate, and everything diagnosed
together; twice at the most.
"""

import argparse
import json
from itertools import count
from pathlib import Path
from time import process_time

import numpy as np
from tell_apart_rig import PLATES, draw

from instrument.planning.follow_up import rank_follow_ups

KINDS = (
    "substrate_stiffness",
    "gain_error",
    "clamp_compliance",
    "spot_offset",
    "air_added_mass",
    "amplitude_softening",
)
MOST = 2
"""Measurements after the first sweep."""


def told(rig, found):
    """What a diagnosis says, beside the truth."""
    r = found.result
    names = [e.name for e in r.effects]
    truth = list(rig.truth.names)
    right = "right" if names == truth else "wrong"
    said = right if r.verdict == "effect" else r.verdict
    group = {n: round(p, 3) for n, (_, p) in zip(r.rivals.names, r.rivals.each, strict=True)}
    return {"said": said, "names": names, "group": group}


def judged(kind, seed, plates):
    """One case from its first sweep to the last verdict; None where it cannot be drawn."""
    rig = draw(kind, seed, plates)
    if rig is None:
        return None
    began = process_time()
    found = rig.diagnosed()
    line = {"kind": kind, "seed": seed, "plate": rig.truth.plate.name, "facts": rig.truth.facts["effects"]}
    line |= {"first": told(rig, found), "first_s": rig.seconds, "measured": []}
    line["diagnosis_cpu_s"] = process_time() - began
    for number in range(MOST):
        began = process_time()
        ranked = rank_follow_ups(found)
        cpu = process_time() - began
        if not ranked:
            break
        best = ranked[0]
        rig = rig.after(best, np.random.default_rng([seed, *kind.encode(), 90 + number]))
        found = rig.diagnosed()
        line["measured"].append(
            {
                "kind": best.kind,
                "level_g": best.level_g,
                "spot_mm": best.spot_mm,
                "seconds": best.seconds,
                "separation": best.separation,
                "probability_resolved": best.probability_resolved,
                "others": [f.kind for f in ranked[1:3]],
                "ranking_cpu_s": cpu,
                **told(rig, found),
            }
        )
    return line


def table(lines):
    """What is said of it in docs/diagnosis.md."""
    groups = [line for line in lines if line["measured"]]
    last = [line["measured"][-1]["said"] for line in groups]
    said = [f"{len(lines)} cases, {len(groups)} groups"]
    for word in sorted(set(last)):
        said.append(f"  {word}: {last.count(word)}")
    one = sum(len(line["measured"]) == 1 for line in groups)
    times = [sum(m["seconds"] for m in line["measured"]) for line in groups]
    said.append(f"  one measurement did: {one}; time median {np.median(times or [0]):.0f} s")
    for kind in KINDS:
        mine = [line for line in groups if line["kind"] == kind]
        how = [(m["kind"], m["said"]) for line in mine for m in line["measured"]]
        right = sum(line["measured"][-1]["said"] == "right" for line in mine)
        said.append(f"  {kind}: {right} of {len(mine)}; {how}")
    return "\n".join(said)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--folder", type=Path, required=True)
    options.add_argument("--groups", type=int, default=20)
    options.add_argument("--seed", type=int, default=920000)
    options.add_argument("--cases", type=int, help="new ones, then stop")
    options.add_argument("--kinds", default=",".join(KINDS))
    options.add_argument("--plates", default=",".join(PLATES))
    asked = options.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    kept = asked.folder / "lines.jsonl"
    lines = [json.loads(text) for text in kept.read_text().splitlines()] if kept.exists() else []
    done = {(line["kind"], line["seed"]) for line in lines}
    kinds, plates = asked.kinds.split(","), asked.plates.split(",")
    begun = len(lines)
    for kind, seed in ((kind, seed) for seed in count(asked.seed) for kind in kinds):
        enough = sum(bool(line["measured"]) for line in lines) >= asked.groups
        if enough or len(lines) - begun == asked.cases:
            break
        line = judged(kind, seed, plates) if (kind, seed) not in done else None
        if line is not None:
            lines.append(line)
            with kept.open("a") as file:
                file.write(json.dumps(line) + "\n")
            print(json.dumps(line), flush=True)
    print(table(lines))


if __name__ == "__main__":
    main()
