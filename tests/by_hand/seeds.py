"""The identified law against the simulated plant's own, over many seeds of a clean rig.

python tests/by_hand/seeds.py --seeds 20
"""

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drivers.simulated.plant.law import ZN1
from fitting.numerics.chances import Z_95
from instrument.run.experiment import Finished, run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import FILES, case_file

AT_HZ = (20.0, 100.0, 280.0)


@dataclass(frozen=True)
class Outcome:
    """One seed: errors in percent and over the stated standard error, at `AT_HZ`."""

    storage_percent: NDArray[np.float64]
    loss_percent: NDArray[np.float64]
    storage_z: NDArray[np.float64]
    loss_z: NDArray[np.float64]

    @property
    def inside(self) -> bool:
        """All of it inside the stated 95 % band."""
        return bool(np.abs([self.storage_z, self.loss_z]).max() < Z_95)


def run_seed(folder: Path, seed: int, effects: str = "") -> Finished:
    """The simulated case with a seed, and what it hides."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        (folder / name).write_text(case_file(name).read_text())
    rig = folder / "rig.toml"
    rig.write_text(rig.read_text().replace("seed = 1", f"seed = {seed}\n{effects}"))
    return run_experiment(read_whole_experiment(folder / "experiment.toml"), folder, ("hammer", "sweep"))


def outcome(finished: Finished) -> Outcome:
    """Against the plant's law."""
    assert finished.fit is not None
    assert finished.fit.result is not None
    law = {row.frequency_hz: row for row in finished.fit.result.law}
    rows = [law[f] for f in AT_HZ]
    G = ZN1.modulus(2 * np.pi * np.array(AT_HZ))
    storage = np.array([r.storage_modulus_pa for r in rows])
    loss = np.array([r.loss_factor for r in rows])
    storage_error = storage - G.real
    loss_error = loss - G.imag / G.real
    return Outcome(
        100 * storage_error / G.real,
        100 * loss_error / (G.imag / G.real),
        storage_error / np.array([r.storage_modulus_standard_error_pa for r in rows]),
        loss_error / np.array([r.loss_factor_standard_error for r in rows]),
    )


def main() -> None:
    """Run the seeds and print their worst and their coverage."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--seeds", type=int, default=20)
    found = []
    for seed in range(options.parse_args().seeds):
        with tempfile.TemporaryDirectory() as folder:
            one = outcome(run_seed(Path(folder), seed))
        found.append(one)
        print(seed, np.round(one.storage_percent, 2), np.round(one.loss_percent, 2), one.inside, flush=True)
    print("worst G' %", np.abs([o.storage_percent for o in found]).max(axis=0).round(2))
    print("worst eta %", np.abs([o.loss_percent for o in found]).max(axis=0).round(2))
    print("inside the band:", sum(o.inside for o in found), "of", len(found))


if __name__ == "__main__":
    main()
