"""Struck plates: FRFs over a whole band of solids, hung free and clamped, and what is found of the law.

    python tests/campaigns/struck.py --seed 2 --count 10

One line a case: error over standard error of G' and of the loss factor at five resonances from the first to
the last. The last line: shares within the bands, and rms of error over standard error.
"""

import argparse

import numpy as np

from fitting.errors import FittingError
from instrument.campaign.plates.answers import Band, band_from
from instrument.campaign.plates.struck_cases import StruckCase, draw_struck
from instrument.models.files import spots_of
from instrument.models.together import identify_together
from instrument.results.identification_from import identification_from


def pulls(case: StruckCase, band: Band) -> np.ndarray:
    """Error over standard error of G' and of the loss factor, in logarithms. Shape (2, frequencies)."""
    G, at = case.truth.modulus_pa, band.at(case.truth.resonances_hz)
    storage, loss = np.array(at.storage_pa), np.array(at.loss)
    return np.array(
        [
            np.log(storage / G.real) * storage / np.array(at.storage_error_pa),
            np.log(loss / (G.imag / G.real)) * loss / np.array(at.loss_error),
        ]
    )


def main() -> None:
    """Draw, identify, compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10)
    asked = parser.parse_args()
    every = []
    for seed in range(asked.seed, asked.seed + asked.count):
        case = draw_struck(seed)
        try:
            found = identify_together(spots_of(case.sweep, case.specimen))
        except FittingError as error:
            print(seed, case.truth.specimen_name, error, flush=True)
            continue
        said = identification_from(found.found, case.specimen)
        each = pulls(case, band_from(said.law))
        every.append(each)
        print(
            f"{seed} {case.truth.specimen_name}, {case.truth.law.kind}, {len(case.sweep)} lines, "
            f"chi2 {said.chi2_per_dof:.2f}, G' {np.round(each[0], 1)}, loss factor {np.round(each[1], 1)}",
            flush=True,
        )
    for name, p in zip(("G'", "loss factor"), np.moveaxis(np.array(every), 1, 0), strict=True):
        within = [100 * np.mean(np.abs(p) < k) for k in (1.0, 1.96)]
        print(f"{name}: 68 % {within[0]:.0f}, 95 % {within[1]:.0f}, rms {np.sqrt(np.mean(p**2)):.2f}")


if __name__ == "__main__":
    main()
