"""Tables of modes: what the law is worth by how they were read, and by whether they say so.

python tests/by_hand/mode_tables.py poles
python tests/by_hand/mode_tables.py solids

`poles`: exact poles of a sandwich beam, the law in the complex plane, of four cores; no noise, 0.1 % and 3 %
stated. `solids`: six modes of plates that are 3D solids, with that noise, every stated number off by its
tolerance, three plates and five draws each; those are eigenvalues with the core as it is at each of them.
Errors are given in percent and over the standard errors that are stated, at five and nine frequencies over
the modes.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
from beam_tables import BEAM, fit_modes, poles_of
from mode_cases import TRUTH, read_off, solid_modes, stated

from fitting.arrays import Array, Complex
from fitting.laws import LAWS
from fitting.laws.base import CoreLaw
from fitting.mode_tables.as_read import Read
from fitting.mode_tables.table import ModalTable
from fitting.structures import AnySpecimen

CORES = ((0.05e6, 40e6, 0.5), (1e6, 300e6, 0.5), (0.3e6, 100e6, 0.65), (20e6, 2000e6, 0.5))
"""g0 and ginf in Pa, and alpha, of fractional Zener laws that relax within 0.3 us."""
READ: Sequence[Read | None] = ("model", None, "poles")


def errors(
    table: ModalTable, specimen: AnySpecimen, omega: Array, true: Complex
) -> tuple[Array, Array, float]:
    """Of G' and eta: relative, and over their standard errors; chi-square per degree. Shape (2, n) each."""
    fit = fit_modes([table], [specimen])
    found, band = fit.law.storage_and_loss(omega), fit.uncertainty.law_band(fit.law, omega)
    off = np.array([found[0] - true.real, found[1] - true.imag / true.real])
    sizes = np.array([true.real, true.imag / true.real])
    return off / sizes, off / np.array(band), float(fit.uncertainty.chi2_per_dof)


def poles() -> None:
    """Every core, read in each way."""
    for g0_pa, ginf_pa, alpha in CORES:
        law: CoreLaw = LAWS["fractional-zener"](g0_pa, ginf_pa, 3e-7, alpha)
        f, eta = poles_of(replace(BEAM, core=replace(BEAM.core, law=law)), 7)
        guess = replace(BEAM.core, law=LAWS["fractional-zener"](3 * g0_pa, ginf_pa, 1e-6, 0.5))
        known = dict.fromkeys(BEAM.numbers, 1e-5)
        specimen = replace(BEAM, core=guess, exact=False, tolerances=known)
        omega = 2 * np.pi * np.geomspace(f[0], f[-1], 5)
        print(f"losses {eta.min():.3f} to {eta.max():.3f}")
        for read in READ:
            table = ModalTable(np.arange(1.0, 8), f, eta, 1e-3 * f, 0.03 * eta, read=read)
            off, pull, chi2 = errors(table, specimen, omega, law.modulus(omega))
            worst = 100 * np.abs(off).max(axis=1), np.abs(pull).max(axis=1)
            print(f"  {read}: off by at most", *np.round(worst[0], 1), "%, in errors", *np.round(worst[1], 1))
            print(f"    chi-square per degree {chi2:.2f}")


def solids() -> None:
    """Rms over the modes' range in errors, within two and within one of 15; the band."""
    for read in READ[:2]:
        rms, width = list[Array](), list[Array]()
        for name in ("P1", "P5", "P8"):
            modes = solid_modes(name)
            omega = 2 * np.pi * np.geomspace(modes[0][0], modes[0][-1], 9)
            for seed in range(5):
                rng = np.random.default_rng([seed, 7])
                table = replace(read_off(modes, rng), read=read)
                off, pull, _ = errors(table, stated(name, rng), omega, TRUTH.modulus(omega))
                rms.append(np.sqrt(np.mean(pull**2, axis=1)))
                width.append(np.mean(np.abs(off / pull), axis=1))
        print(f"{read}: within two", *np.sum(np.array(rms) < 2, axis=0), end=" ")
        print("within one", *np.sum(np.array(rms) < 1, axis=0), f"of {len(rms)}, G' and eta;", end=" ")
        print(
            "bands in %", np.round(100 * np.min(width, axis=0), 1), np.round(100 * np.max(width, axis=0), 1)
        )


if __name__ == "__main__":
    ask = argparse.ArgumentParser(description=__doc__)
    ask.add_argument("what", choices=["poles", "solids"])
    {"poles": poles, "solids": solids}[ask.parse_args().what]()
