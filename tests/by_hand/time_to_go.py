"""Runs of the simulated rig in virtual time: the time to go foretold at 10, 30 and 60 % of each.

    python tests/by_hand/time_to_go.py [--runs 10] [--seed 100]

Every run has a plan of its own by chance: points, width, level, sweeps, hammer test, sentinel, calibration.
Printed is how far off each forecast was; exit status 1 where one was off by over 15 %.
"""

import argparse
import random
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from foretold import SHARES, told_of

WITHIN = 0.15


def any_plan(chance: random.Random) -> tuple[str, Callable[[str], str]]:
    """What is changed of the published experiment, in words, and the change."""
    points, span, level = chance.randint(9, 31), chance.uniform(15.0, 60.0), chance.uniform(0.3, 1.0)
    without = [key for key in ("sentinel", "calibration") if chance.random() < 0.3]
    sweeps = 2 if chance.random() < 0.3 else 1

    def change(text: str) -> str:
        text = re.sub(r"points = \d+", f"points = {points}", text)
        text = re.sub(r"span_percent = [\d.]+", f"span_percent = {span:.1f}", text)
        text = re.sub(r"level_g = [\d.]+", f"level_g = {level:.2f}", text, count=1)
        added = "".join(f"{key} = false\n" for key in without) + f"sweeps = {sweeps}\n"
        return text.replace("[sweep]\n", f"[sweep]\n{added}")

    words = f"{points} points, {span:.0f} %, {level:.2f} g, {sweeps} sweeps"
    return ", ".join([words, *(f"no {key}" for key in without)]), change


def main() -> int:
    """A line a run, and the worst."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--seed", type=int, default=100)
    given = parser.parse_args()
    chance, worst = random.Random(given.seed), 0.0
    for number in range(given.runs):
        words, change = any_plan(chance)
        parts = ("hammer", "sweep") if chance.random() < 0.5 else ("sweep",)
        with tempfile.TemporaryDirectory() as folder:
            watched = told_of(Path(folder), parts, given.seed + number, change)
        off = watched.errors()
        worst = max(worst, *map(abs, off.values()))
        said = ", ".join(f"{100 * share:.0f} %: {100 * off[share]:+.1f} %" for share in SHARES)
        print(f"{number + 1}: {said} of {watched.now_s:.0f} s ({'+'.join(parts)}, {words})", flush=True)
    print(f"worst {100 * worst:.1f} %")
    return 1 if worst > WITHIN else 0


if __name__ == "__main__":
    sys.exit(main())
