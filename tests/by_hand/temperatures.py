"""Five temperatures on the 3D solid plate: how many shift factors lie in their intervals, what is refused.

    python tests/by_hand/temperatures.py [--seeds 5] [--points 60]

Prints a row a case: WLF and Arrhenius truth as they are and with a vibrometer 1.1 ms late, and a core of two
processes, which has no one law. Temperatures are exact.
"""

import sys
from dataclasses import replace
from pathlib import Path

import click
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
from temperature_cases import (
    LAW,
    NOISE,
    REFERENCE,
    OneProcess,
    T,
    TwoProcesses,
    arrhenius,
    wlf,
)

from campaign.plant.response import steady
from drivers.simulated.plant.effects import Effects
from fitting.sweep import Sweep
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file
from instrument.temperatures.shifted import AtTemperature, identify_shifted

DELAY_S = 1.1e-3
LEVEL_M_S2 = 9.81


@click.command()
@click.option("--seeds", default=5)
@click.option("--points", default=60)
def main(seeds: int, points: int) -> None:
    plate = replace(read_specimen(case_file("specimen.toml")), exact=False)
    plate = replace(plate, reads="relative")
    for kind, truth in (("wlf", wlf()), ("arrhenius", arrhenius())):
        laws = [OneProcess(a) for a in truth]
        for late_s in (0.0, DELAY_S):
            covered(plate, kind, truth, laws, late_s, seeds if late_s == 0 else 1, points)
    two = [TwoProcesses(a, b) for a, b in zip(arrhenius(4e4), arrhenius(1.6e5), strict=True)]
    found = identify_shifted(sweeps(two, 0, points), plate, "free", REFERENCE, temperature_k=0.0)
    print(f"two processes: simple {found.verdict.simple}; {found.verdict.words}")


def covered(plate, kind, truth, laws, late_s, seeds, points):
    moved, off, worst, said = T != REFERENCE, [], [], []
    for seed in range(seeds):
        found = identify_shifted(
            sweeps(laws, seed, points, late_s), plate, kind, REFERENCE, temperature_k=0.0
        )
        off += ((found.fit.log_shift - truth)[moved] / found.fit.log_shift_errors[moved]).tolist()
        G = LAW.modulus(2 * np.pi * found.band.frequency_hz)
        law = found.band.storage_modulus_pa * (1 + 1j * found.band.loss_factor)
        worst.append(100 * np.max(np.abs(law / G - 1)))
        cause = found.cause.effect.name if found.cause is not None else "no cause"
        said.append(f"{found.verdict.simple} ({cause})")
    inside = int(np.sum(np.abs(off) < 1.96))
    print(
        f"{kind}, late by {1e3 * late_s:g} ms: {inside} of {len(off)} factors within 95 %, rms of error over "
        f"standard error {np.sqrt(np.mean(np.square(off))):.2f}; law off by at most {max(worst):.2g} %; "
        f"simple: {', '.join(said)}",
        flush=True,
    )


def sweeps(laws, seed, points, late_s=0.0):
    f, rng = np.geomspace(14.0, 300.0, points), np.random.default_rng(seed)
    made = []
    for t, law in zip(T, laws, strict=True):
        level = np.full(points, LEVEL_M_S2)
        v = steady(Effects(), law.modulus, f, level, np.zeros(points)).velocity_per_acceleration_s * level
        v = v * np.exp(-2j * np.pi * f * late_s)
        std = NOISE * np.abs(v)
        v = v + std * (rng.standard_normal(points) + 1j * rng.standard_normal(points))
        one = np.ones(points, dtype=np.intp)
        made.append(AtTemperature(Sweep(f, v, level, one, one, std_m_s=std), float(t), f"{t:g}"))
    return made


if __name__ == "__main__":
    main()
