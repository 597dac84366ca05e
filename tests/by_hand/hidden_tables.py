"""Tables of eight modes of solid plates with something hidden: what is named, and does the band hold the law.

    python tests/by_hand/hidden_tables.py --count 38
    python tests/by_hand/hidden_tables.py --count 38 --without-truth

Ten plates of bricks, causes with formulas of their own in rotation (and none), laws of five kinds, 0.1 %
noise in f and 3 % in eta, every stated number off by its tolerance. A line a table, then the sums: `shows`
where the law alone leaves more than 40 of chi-square. Half a minute to a minute a table.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import scipy.linalg as la

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
from mode_cases import FINE, read_off

from campaign.law import TrueLaw
from campaign.plates.geometry import PLATES
from campaign.plates.hidden import HIDDEN
from campaign.plates.hidden.base import Hidden, Setting
from campaign.plates.judged import left_out
from campaign.plates.materials import draw_law
from campaign.plates.reduced import ReducedSolid
from campaign.plates.simulate import built, moduli_of
from campaign.plates.stated import CAREFUL, draw_stated, specimen_from, toml
from fitting.arrays import Array
from fitting.errors import FittingError
from instrument.facts.diagnosis import DiagnosisResult, StageFitted
from instrument.finding.modal import diagnose_tables
from instrument.results.modal_diagnosis_from import modal_diagnosis_from

_LEFT_OUT = (
    "tether",
    "temperature_drift",
    "amplitude_softening",
    "air_added_mass",
    "loose_part",
    "tip_magnet",
)
"""That a solid by itself does not have, and what changes with time."""
KINDS = (
    "none",
    *(n for n, h in HIDDEN.items() if h.changes_solid and n not in (*_LEFT_OUT, "room_cycles", "room_step")),
)
COUNT, LARGEST_LOSS, SHOWS = 8, 0.35, 40.0


def modes_of(plate: ReducedSolid, law: TrueLaw) -> Array:
    """Frequencies and loss factors, the law at each mode's own frequency. Shape (2, modes)."""
    K_0, found, omega = plate.K_0 + 1j * plate.rubbing, list[tuple[float, float]](), 500.0
    for k in range(COUNT):
        for _ in range(80):
            G = complex(law.modulus(np.array([omega]))[0])
            values = np.sort_complex(la.eigvals(K_0 + G * plate.whole_core, plate.M))
            before, omega = omega, float(np.sqrt(values[k].real))
            if abs(omega / before - 1) < 1e-9:
                break
        found.append((omega / (2 * np.pi), values[k].imag / values[k].real))
    return np.array(found).T


@dataclass(frozen=True)
class Told:
    """What was said of a table."""

    kind: str
    hidden: tuple[Hidden, ...]
    result: DiagnosisResult
    chi2: float
    """That the law alone leaves."""
    off: Array
    """Of the band after, G' and eta at four frequencies, in standard errors."""

    @property
    def is_right(self) -> bool:
        """Whether one that is named is there."""
        there = {name for h in self.hidden for name in (h.name, *h.near)}
        return bool(there & {e.name for e in self.result.effects})


def told_of(seed: int, *, without_truth: bool) -> Told:
    """One table. Raises `FittingError` where the plate is none for the theory."""
    rng, kind = np.random.default_rng([seed, 11]), KINDS[seed % len(KINDS)]
    true = PLATES[int(rng.integers(len(PLATES)))]
    clean = built(true, (), (), FINE)
    while True:
        law = draw_law(rng, (20.0, 1500.0))
        f, eta = modes_of(clean, law)
        if eta.max() < LARGEST_LOSS:
            break
    hidden: tuple[Hidden, ...] = ()
    if kind != "none":
        hidden = (HIDDEN[kind].draw(rng, Setting(true, (f[1], f[3], f[5]), 100.0)),)
        f, eta = modes_of(built(true, hidden, moduli_of(law, f), FINE), law)
    table = replace(read_off((f, eta), rng), read="model")
    head, _, rest = toml(draw_stated(rng, true), CAREFUL, 150.0).partition("[damping]")
    specimen = specimen_from(head + "[pickup]" + rest.partition("[pickup]")[2])
    without = left_out([h.name for h in hidden]) if without_truth else []
    diagnosed = diagnose_tables([table], [specimen], without=without)
    result = modal_diagnosis_from(diagnosed, [table], ["table"])
    at = np.geomspace(f[0], f[-1], 4)
    return Told(kind, hidden, result, diagnosed.found.begun.none.chi2, _off(result.after, at, law))


def _off(stage: StageFitted, frequency_hz: Array, law: TrueLaw) -> Array:
    x, true = np.log(frequency_hz), law.modulus(2 * np.pi * frequency_hz)
    grid = np.log([row.frequency_hz for row in stage.law])

    def said(key: str) -> Array:
        return np.interp(x, grid, [getattr(row, key) for row in stage.law])

    G, eta = true.real, true.imag / true.real
    by_G = (said("storage_modulus_pa") - G) / said("storage_modulus_standard_error_pa")
    return np.concatenate([by_G, (said("loss_factor") - eta) / said("loss_factor_standard_error")])


def main() -> None:
    """Draw and say."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=len(KINDS))
    parser.add_argument("--without-truth", action="store_true")
    given, found = parser.parse_args(), list[Told]()
    for seed in range(given.seed, given.seed + given.count):
        try:
            one = told_of(seed, without_truth=given.without_truth)
        except FittingError as error:
            print(seed, KINDS[seed % len(KINDS)], error)
            continue
        found.append(one)
        names, worst = ", ".join(e.name for e in one.result.effects), np.abs(one.off).max()
        print(
            seed, one.kind, f"{one.chi2:.0f}", one.result.verdict, names, f"law {worst:.1f} off", flush=True
        )
    for shows in (True, False):
        _say(shows, [t for t in found if t.kind != "none" and (t.chi2 > SHOWS) is shows])
    print("clean", [t.result.verdict for t in found if t.kind == "none"])


def _say(shows: bool, some: Sequence[Told]) -> None:
    print("shows" if shows else "does not show", len(some))
    for verdict in ("none", "effect", "ambiguous", "unknown"):
        those = [t for t in some if t.result.verdict == verdict]
        if those:
            off = np.abs(np.concatenate([t.off for t in those]))
            held, rms = np.mean(off < 1.96), np.sqrt(np.mean(off**2))
            right = sum(t.is_right for t in those)
            print(
                f"  {verdict} {len(those)}, right {right}; 95 % band {held:.2f} of {len(off)}, rms {rms:.2f}"
            )


if __name__ == "__main__":
    main()
