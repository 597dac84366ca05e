"""How often the intervals of `identify --uncertainty` hold the truth; run by hand.

    python tests/by_hand/intervals.py --folder FOLDER [--specimens 200] [--seed 0]

What is in FOLDER is not fitted again: a campaign that was stopped goes on. Four unlike plates; law, bend,
stated numbers, model error and noise from the fit's own priors (`interval_cases`), and nothing else.
"""

import argparse
import json
import os
import sys
from pathlib import Path
from time import process_time

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
from interval_cases import draw

from fitting.depth.bootstrap import bootstrap
from fitting.depth.many import ManyResiduals
from fitting.depth.posterior import sample
from fitting.depth.profile import profile
from fitting.errors import OutsideModel
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.results.uncertainty_facts import quantities_of

PROFILED = ("at 100 Hz", "at 280 Hz")
"""A profile is dear: of these alone, of G' and eta at the band's upper end, and of parameters that count."""
LEVELS = (68, 95)
IDENTIFIABLE = 0.5
"""Linear standard error of a parameter's logarithm, up to which it counts."""


def looked_at(seed, samples):
    """A line: of every method and quantity, truth, value and bounds."""
    began = process_time()
    plate, drawn = draw(seed)
    line = {"seed": seed, "plate": plate}
    try:
        found = identify([File(drawn.sweep, drawn.stated)])
    except OutsideModel as refused:
        return line | {"refused": str(refused)}
    line["chi2_per_dof"] = found.result.uncertainty.chi2_per_dof
    line["largest_pull"] = max(abs(a.pull) for a in found.result.fit.adjusted)
    quantities = quantities_of(found)
    many = ManyResiduals(found.joint.task, found.joint.reduced)
    error = np.linalg.norm(quantities.gradient(quantities.task.mode) @ quantities.task.root, axis=1)
    only = [
        k
        for k, q in enumerate(quantities.names)
        if q.endswith(PROFILED)
        or k >= len(quantities.names) - 2
        or (" at " not in q and error[k] <= IDENTIFIABLE)
    ]
    drawn_from = sample(quantities, many, samples, seed)
    each = [
        profile(quantities, only=only),
        drawn_from.intervals,
        *(bootstrap(quantities, many, kind, seed=seed) for kind in ("points", "segments")),
    ]
    line["methods"] = {"linear": rows(drawn, each[0], each[0].linear)}
    for one in each:
        at = only if one.method == "profile" else range(len(one.names))
        line["methods"][one.method] = rows(drawn, one, one.bounds, at)
    line |= {"r_hat": float(drawn_from.r_hat.max()), "weight_share": drawn_from.weight_share}
    line["cpu_s"] = process_time() - began
    return line


def rows(drawn, one, bounds, at=None):
    """Of each quantity: the truth, what was found, both ends of both levels."""
    at = range(len(one.names)) if at is None else at
    return {
        one.names[k]: [drawn.truth(one.names[k]), one.found[k], *(b for n in LEVELS for b in bounds[n][k])]
        for k in at
    }


def holds(truth, low, high):
    """Whether an interval does; an open end holds everything on its side."""
    return not (truth < low or truth > high)


def share(each):
    """Percent that hold the truth, and its standard error: quantities of one specimen go together."""
    count = sum(len(one) for one in each)
    p = sum(np.sum(one, axis=0) for one in each) / count
    off = np.array([np.sum(one, axis=0) - p * len(one) for one in each])
    return 100 * p, 100 * np.sqrt(np.sum(off**2, axis=0)) / count, count


def counted(line, group, method, only):
    """A row a quantity of one specimen: whether either interval holds the truth, error over linear error."""
    linear, found = line["methods"]["linear"], []
    for q, (truth, value, *bounds) in line["methods"][method].items():
        error = (linear[q][3] - linear[q][2]) / 2 / linear[q][1]
        what = q.partition(" at ")[0] if " at " in q else "parameters"
        if what != group or q not in line["methods"][only]:
            continue
        if what == "parameters" and error > IDENTIFIABLE:
            continue
        found.append([holds(truth, *bounds[:2]), holds(truth, *bounds[2:]), np.log(value / truth) / error])
    return np.array(found).reshape(-1, 3)


def table(lines):
    """Rows of docs/evidence/uncertainty.md: percent that hold the truth, by method and quantity."""
    fitted = [line for line in lines if "methods" in line]
    said = [f"{len(lines)} specimens, {len(lines) - len(fitted)} refused"]
    names = list(fitted[0]["methods"]) if fitted else []
    for group in ("storage_modulus_pa", "loss_factor", "parameters"):
        for name, only in [(n, n) for n in names] + [(n, "profile") for n in names if n != "profile"]:
            each = [counted(line, group, name, only) for line in fitted]
            if not sum(len(one) for one in each):
                continue
            p, error, count = share([one[:, :2] for one in each])
            pulls = np.concatenate(each)[:, 2]
            where = " where profiled" if only != name else ""
            said.append(
                f"{group:20} {name + where:38} 68 %: {p[0]:.1f} +- {error[0]:.1f}, 95 %: {p[1]:.1f} +- "
                f"{error[1]:.1f}, of {count}; rms of error over linear error {np.sqrt(np.mean(pulls**2)):.2f}"
            )
    return "\n".join(said)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--folder", type=Path, required=True)
    options.add_argument("--specimens", type=int, default=200)
    options.add_argument("--seed", type=int, default=0)
    options.add_argument("--samples", type=int, default=4_000)
    asked = options.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    os.environ["VISCORIG_CACHE"] = str(asked.folder / "cache")
    kept = asked.folder / "lines.jsonl"
    lines = [json.loads(text) for text in kept.read_text().splitlines()] if kept.exists() else []
    done = {line["seed"] for line in lines}
    for seed in range(asked.seed, asked.seed + asked.specimens):
        if seed in done:
            continue
        line = looked_at(seed, asked.samples)
        lines.append(line)
        with kept.open("a") as file:
            file.write(json.dumps(line) + "\n")
        print(json.dumps({k: v for k, v in line.items() if k != "methods"}), flush=True)
    print(table(lines))


if __name__ == "__main__":
    main()
