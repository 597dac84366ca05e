"""What `viscorig plan` predicts against simulated runs of its plans: stated errors, and errors against the
truth.

python tests/by_hand/plan_predicted.py --cases 20
"""

import argparse
from dataclasses import dataclass

import numpy as np
from planned_cases import PlannedCase, planned_case

from fitting.arrays import Array
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.planning.plan import Plan, make_plan
from instrument.planning.wish import Wish


@dataclass(frozen=True)
class Compared:
    """One case. Shape (2, frequencies): of G' and eta, relative."""

    predicted: Array
    stated: Array
    """By `identify`, of the simulated run."""
    off: Array
    """Of the truth."""

    @property
    def ratio(self) -> float:
        """Stated over predicted, root mean square over the band."""
        return float(np.sqrt(np.mean(self.stated**2) / np.mean(self.predicted**2)))


def compare(case: PlannedCase, target: float, number: int = 0) -> tuple[Plan, Compared]:
    """Plan, measure the plan, identify, compare over the planned band."""
    wish = Wish(target=target, noise=case.noise)
    plan = make_plan(case.specimen, wish, with_spots=False)
    c = plan.outlook.candidates
    kept = np.flatnonzero(plan.taken)
    rng = np.random.default_rng([case.seed, 81, number])
    sweep = case.measured(
        c.frequency_hz[kept],
        c.region[kept],
        c.dwell_s[kept],
        np.cumsum(c.seconds[kept]),
        plan.level.level_g,
        rng,
    )
    band = identify([File(sweep, case.specimen)]).result.band
    f = plan.aims.frequency_hz
    found = np.array([band.storage_modulus_pa, band.loss_factor])
    errors = np.array([band.storage_modulus_standard_error_pa, band.loss_factor_standard_error])

    def at(rows: Array) -> Array:
        return np.array([np.interp(np.log(f), np.log(band.frequency_hz), row) for row in rows])

    return plan, Compared(plan.errors, at(errors / found), at(found) / case.law_at(f) - 1)


def main() -> None:
    """Run the cases, print each and the whole."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--cases", type=int, default=20)
    options.add_argument("--first", type=int, default=0)
    options.add_argument("--target", type=float, default=2.0)
    given = options.parse_args()
    found = []
    for seed in range(given.first, given.first + given.cases):
        case = planned_case(seed)
        plan, one = compare(case, given.target / 100)
        found.append(one)
        print(
            f"{seed:3} {case.truth.plate.name:4} {case.truth.law.kind:18} {int(plan.taken.sum()):3} steps "
            f"{plan.seconds:5.0f} s  predicted {100 * one.predicted.max():5.2f} % "
            f"stated {100 * one.stated.max():5.2f} %  ratio {one.ratio:.2f}  "
            f"off {100 * np.abs(one.off).max():5.2f} %",
            flush=True,
        )
    ratios = np.array([c.ratio for c in found])
    print("stated / predicted: median", ratios.round(2)[np.argsort(ratios)[len(ratios) // 2]], end="; ")
    print("within 25 %:", int(np.sum(np.abs(ratios - 1) <= 0.25)), "of", len(found), ratios.round(2))
    for name in ("predicted", "stated"):
        z = np.concatenate([(c.off / getattr(c, name)).ravel() for c in found])
        beyond = np.mean(np.abs(z) > 1.96)
        print(f"errors over {name}: rms {np.sqrt(np.mean(z**2)):.2f}, beyond 1.96: {beyond:.3f}")


if __name__ == "__main__":
    main()
