"""A vibrometer whose range for one segment is off, or readings lost: what is named, how far the law is off.

python tests/by_hand/ranges.py --cases 12 --seed 6200000
python tests/by_hand/ranges.py --cases 12 --seed 6200000 --lost 12

Clean sweeps of the ten solid plates, all tolerances of a careful laboratory active. One segment of each, by
lot, is read 2 to 8 % too high or low and up to 15 us late, as another range of a vibrometer with a
filter of its own; or `--lost` readings are spoilt, alone and in runs of up to five: nothing but a floor, or
a factor between 0 and 2 and any phase.
"""

import argparse
from collections import Counter
from dataclasses import replace

import numpy as np

from campaign.plates.cases import NONE, draw_case
from campaign.plates.judged import diagnosed
from fitting.sweep import Sweep

AT_LEAST, AT_MOST, LATE_S = 0.02, 0.08, 15e-6
FLOOR = 0.01


def ranged(sweep: Sweep, rng: np.random.Generator) -> tuple[Sweep, str]:
    """One segment in another range."""
    segment = int(rng.choice(np.unique(sweep.segment)))
    factor = 1 + float(rng.choice([-1, 1]) * rng.uniform(AT_LEAST, AT_MOST))
    late = np.exp(-1j * sweep.omega * float(rng.uniform(0, LATE_S)))
    there = np.where(sweep.segment == segment, factor * late, 1.0)
    return replace(sweep, velocity_m_s=sweep.velocity_m_s * there), f"segment {segment} times {factor:.3f}"


def lost(sweep: Sweep, count: int, rng: np.random.Generator) -> tuple[Sweep, str]:
    """So many readings that are none."""
    v = np.array(sweep.velocity_m_s)
    left = count
    while left > 0:
        run = min(left, int(rng.integers(1, 6)))
        at = int(rng.integers(0, len(v) - run))
        spoilt = slice(at, at + run)
        if rng.random() < 0.5:
            v[spoilt] = FLOOR * np.abs(v).max() * (rng.normal(size=run) + 1j * rng.normal(size=run))
        else:
            v[spoilt] *= rng.uniform(0, 2, run) * np.exp(1j * rng.uniform(-np.pi, np.pi, run))
        left -= run
    return replace(sweep, velocity_m_s=v), f"{count} readings lost"


def main() -> None:
    """Draw, diagnose, count."""
    ask = argparse.ArgumentParser()
    ask.add_argument("--cases", type=int, default=12)
    ask.add_argument("--seed", type=int, default=6200000)
    ask.add_argument("--lost", type=int, default=0)
    asked = ask.parse_args()
    verdicts, errors = Counter[str](), list[float]()
    for seed in range(asked.seed, asked.seed + asked.cases):
        case = draw_case(NONE, seed)
        rng = np.random.default_rng([seed, 1])
        sweep, done = lost(case.sweep, asked.lost, rng) if asked.lost else ranged(case.sweep, rng)
        answer = diagnosed(replace(case, sweep=sweep))
        named = " + ".join(answer.effects) or "-"
        assert answer.after is not None
        band, G = answer.after.at(case.truth.resonances_hz), case.truth.modulus_pa
        off = [
            *(np.array(band.storage_pa) - G.real) / np.array(band.storage_error_pa),
            *(np.array(band.loss) - G.imag / G.real) / np.array(band.loss_error),
        ]
        errors += off
        verdicts[f"{answer.verdict}: {named}"] += 1
        print(
            seed, done, answer.verdict, named, f"at most {np.abs(off).max():.1f} standard errors", flush=True
        )
    for verdict, count in verdicts.most_common():
        print(f"{count:4d}  {verdict}")
    inside = 100 * np.mean(np.abs(errors) < 1.96)
    print(
        f"95 % band contains {inside:.0f} % of {len(errors)}, rms {np.sqrt(np.mean(np.square(errors))):.2f}"
    )


if __name__ == "__main__":
    main()
