"""Struck plates: FRFs over a whole band of solids, hung free and clamped, and what is found of the law.

    python tests/by_hand/struck.py --seed 2 --count 10
    python tests/by_hand/struck.py --seed 2 --count 10 --diagnose
    python tests/by_hand/struck.py --seed 300 --count 24 --diagnose --kind added_mass --kind gain_error

One line a case: error over standard error of G' and of the loss factor at five resonances from the first to
the last. The last lines: shares within the bands, and rms of error over standard error.

`--diagnose` searches the whole catalogue, and says its verdict, CERTAIN where one explanation stands alone,
WRONG where what it names first is not what is hidden, the likeliest explanations, and the law after. `--kind`
hides something, kinds and seeds in rotation; `hidden` every kind that there is.
"""

import argparse
from collections.abc import Sequence
from itertools import cycle, islice
from time import process_time

import numpy as np

from campaign.plates.answers import Answer, Band, PlateOutcome, answer_from, band_from, outcome_of
from campaign.plates.hidden.struck import NONE, STRUCK_KINDS
from campaign.plates.score import first_right, in_group, named
from campaign.plates.struck_cases import StruckCase, draw_struck
from campaign.plates.tables import summary
from fitting.errors import FittingError
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import spots_of
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from

EVERY = "hidden"
_LIKELIEST = 4


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


def said_of_law(case: StruckCase) -> tuple[Band, float]:
    """What `identify` says of a case: the law, and chi-square per degree of freedom."""
    found = identify(spots_of(case.sweep, case.specimen))
    said = identification_from(found)
    return band_from(said.law), said.chi2_per_dof


def said_of_cause(case: StruckCase) -> tuple[Answer, Sequence[str]]:
    """What `diagnose` says of it, and its words."""
    files = spots_of(case.sweep, case.specimen)
    found = diagnosis_from(diagnose(files))
    return answer_from(found), found.explanation


def verdict_of(outcome: PlateOutcome) -> str:
    """In a few words, with marks at what matters."""
    said = outcome.said
    assert said is not None
    marks = ["CERTAIN"] if said.verdict == "effect" else []
    if named(outcome) and not first_right(outcome):
        marks.append("in group" if in_group(outcome) else "WRONG")
    likely = sorted(said.probabilities.items(), key=lambda one: -one[1])[:_LIKELIEST]
    each = ", ".join(f"{name} {100 * p:.3g} %" for name, p in likely)
    return " ".join([said.verdict, *marks, " + ".join(said.effects), f"[{each}]"])


def coverage(every: Sequence[np.ndarray]) -> list[str]:
    """Shares within the bands."""
    said = []
    for name, p in zip(("G'", "loss factor"), np.moveaxis(np.array(every), 1, 0), strict=True):
        within = [100 * np.mean(np.abs(p) < k) for k in (1.0, 1.96)]
        said.append(f"{name}: 68 % {within[0]:.0f}, 95 % {within[1]:.0f}, rms {np.sqrt(np.mean(p**2)):.2f}")
    return said


def main() -> None:
    """Draw, identify or diagnose, compare."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--kind", action="append", default=[], choices=[*STRUCK_KINDS, EVERY])
    parser.add_argument("--diagnose", action="store_true")
    asked = parser.parse_args()
    hidden = [kind for kind in STRUCK_KINDS if kind != NONE]
    kinds = [k for kind in asked.kind or [NONE] for k in (hidden if kind == EVERY else [kind])]
    every, outcomes = [], []
    for seed, kind in zip(
        range(asked.seed, asked.seed + asked.count), islice(cycle(kinds), asked.count), strict=True
    ):
        began = process_time()
        case = draw_struck(seed, kind)
        what = f"{seed} {kind} {case.truth.specimen_name}, {case.truth.law.kind}, {len(case.sweep)} lines"
        try:
            if asked.diagnose:
                answer, words = said_of_cause(case)
                outcome = outcome_of(case, None, answer)
                outcomes.append(outcome)
                band, chi2 = answer.after, answer.chi2_after or np.nan
                what += f", {verdict_of(outcome)}"
                if answer.verdict == "unknown":
                    what += f" ({' '.join(words)})"
            else:
                band, chi2 = said_of_law(case)
        except FittingError as error:
            print(what, error, flush=True)
            continue
        assert band is not None
        each = pulls(case, band)
        every.append(each)
        print(
            f"{what}, chi2 {chi2:.2f}, G' {np.round(each[0], 1)}, loss factor {np.round(each[1], 1)} "
            f"({process_time() - began:.0f} s)",
            flush=True,
        )
    print(*coverage(every), sep="\n")
    if outcomes:
        print(summary(outcomes, "struck plates"))


if __name__ == "__main__":
    main()
