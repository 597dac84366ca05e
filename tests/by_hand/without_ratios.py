"""Plates of which nobody says how they ring without their core: how far the loss factor is off.

python tests/by_hand/without_ratios.py --cases 60 --seed 1

The published plate's model with ratios drawn for each mode (0.03 to 0.4 % of critical, evenly in the
logarithm), stated numbers moved within careful tolerances, 0.3 % noise; identified by a file without
`[damping]`, and by one that says there is none. In standard errors.
"""

import argparse
from dataclasses import replace

import numpy as np

from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.sweep import Sweep
from instrument.files.specimen_file import read_specimen
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.models.set_up import set_up
from instrument.paper_case import case_file

LOW, HIGH = 3e-4, 4e-3
NOISE = 3e-3
AT_HZ = (20.0, 100.0, 280.0)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    plate = replace(read_specimen(case_file("zn1.toml")), exact=False)
    f = np.concatenate([np.linspace(*band, 60) for band in ((15.0, 25.0), (85.0, 130.0), (235.0, 295.0))])
    segment = np.repeat([1, 2, 3], 60)
    ones = np.ones(len(f), dtype=int)
    blank = Sweep(f, np.ones(len(f), complex), np.full(len(f), 9.81), segment=segment, sweep=ones)
    off: dict[str, list[np.ndarray]] = {"nothing said": [], "none, it says": []}
    for seed in range(given.seed, given.seed + given.cases):
        rng = np.random.default_rng(seed)
        ratios = tuple(np.exp(rng.uniform(np.log(LOW), np.log(HIGH), 8)).tolist())
        problem = set_up(blank, replace(plate, modal_ratios=ratios)).problem
        z = np.array([rng.normal() * (not n.name.startswith("damping")) for n in problem.nuisances.each])
        v = SweepResponse(problem, ()).velocity(problem.stated_law, z)
        noise = NOISE * np.abs(v) * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f))) / np.sqrt(2)
        true = plate.core.law.modulus(2 * np.pi * np.array(AT_HZ))
        for said, stated in (("nothing said", ()), ("none, it says", (0.0,))):
            band = identify(
                [File(replace(blank, velocity_m_s=v + noise), replace(plate, modal_ratios=stated))]
            ).result.band
            at = [int(np.argmin(np.abs(band.frequency_hz - hz))) for hz in AT_HZ]
            eta, error = band.loss_factor[at], band.loss_factor_standard_error[at]
            off[said].append((eta - true.imag / true.real) / error)
    for said, each in off.items():
        z = np.array(each)
        rms = ", ".join(f"{x:.2f}" for x in np.sqrt((z**2).mean(axis=0)))
        inside = ", ".join(f"{x:.0f}" for x in 100 * (np.abs(z) < 1.96).mean(axis=0))
        print(
            f"{said}: loss factor at 20, 100, 280 Hz, rms in standard errors {rms}; within 1.96 in {inside} %"
        )


if __name__ == "__main__":
    main()
