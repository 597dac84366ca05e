"""Soft, thick and thick-faced plates against exact elasticity: inside the stated model error, or refused.

python tests/by_hand/exact_elasticity.py --specimens 200 --seed 1

Simply supported plates, whose exact modes are waves through the thickness: plane strain by quadratic elements
of plain displacements, six and more in each layer, nothing of it the program's own. Six modes each as a table
with errors of 0.02 % and 0.5 %, everything stated exact: what is left is the model's error. Judged are each
mode that the program predicts of the true law, and the law that it finds, in the standard deviations it says.
"""

import argparse
from collections import Counter
from dataclasses import dataclass

import numpy as np
import scipy.linalg as la
from rich.progress import track

from fitting.discrepancy.model_error import model_error_at
from fitting.dynamics.complex_modes import complex_modes
from fitting.errors import FittingError, OutsideModel
from fitting.laws import LAWS, CoreLaw
from fitting.mode_tables.table import ModalTable
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from instrument.finding.modal import identify_tables
from instrument.remarks.theory import theory_over

MODES = 6
STD = 2e-4, 5e-3
METALS = ((70e9, 0.33, 2700.0), (205e9, 0.29, 7850.0), (70e9, 0.22, 2500.0), (3.3e9, 0.37, 1190.0))
"""Aluminium, steel, glass, acrylic."""
ELEMENTS = 6
"""Of a layer; more where it is thin against none: all are resolved alike."""


@dataclass(frozen=True)
class Case:
    """What is true."""

    kind: str
    plate: PlateSpecimen
    law: CoreLaw


def drawn(rng: np.random.Generator) -> Case:
    """One of three kinds, sizes evenly in their logarithms."""

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    kind = ("soft", "thick", "thick-faced")[rng.integers(3)]
    side = between(0.1, 0.6)
    sides = (side, side * between(0.5, 1.0))
    faces = [between(0.3e-3, 3e-3), between(0.1e-3, 2e-3)]
    core_m, G = between(0.05e-3, 1e-3), between(0.2e6, 20e6)
    if kind == "soft":
        G = between(5e3, 0.2e6)
    elif kind == "thick":
        core_m = between(1e-3, 12e-3)
    else:
        faces = [between(2e-3, 10e-3), between(0.5e-3, 8e-3)]
    layers = [Face(h, E, nu, rho) for h, (E, nu, rho) in zip(faces, _metals(rng), strict=True)]
    law = LAWS["fractional-zener"](G, G * between(3, 100), between(1e-5, 1e-2), float(rng.uniform(0.35, 0.8)))
    core = Core(core_m, float(rng.uniform(0.4, 0.495)), between(700, 1600), law)
    return Case(kind, PlateSpecimen(*sides, "simply-supported", *layers, core, exact=True), law)


def _metals(rng: np.random.Generator) -> list[tuple[float, float, float]]:
    return [METALS[k] for k in rng.integers(len(METALS), size=2)]


def wavenumbers(plate: PlateSpecimen) -> np.ndarray:
    """Of its first modes, rad/m: of simply supported edges. Shape (modes,)."""
    m = np.arange(1, 8) * np.pi
    k = np.hypot(m[:, None] / plate.length_m, m / plate.width_m).ravel()
    return np.sort(k)[:MODES]


def exact_mode(case: Case, k: float) -> complex:
    """Lambda of the wave with that number, the core as it is at its own frequency."""
    omega = 2 * np.pi * 100.0
    for _ in range(60):
        value = lowest(case.plate, k, complex(case.law.modulus(np.array([omega]))[0]))
        new = float(np.sqrt(value.real))
        if abs(new - omega) < 1e-10 * new:
            break
        omega = new
    return value


def lowest(plate: PlateSpecimen, k: float, G: complex) -> complex:
    """Of u = U(z) sin kx, w = W(z) cos kx, by inverse iteration: bending lies far below all else."""
    K, M = matrices(plate, k, G)
    factored, x = la.lu_factor(K), np.tile([0.0, 1.0], len(K) // 2).astype(complex)
    value = 0j
    for _ in range(60):
        y = la.lu_solve(factored, M @ x)
        before, value = value, (x @ (M @ x)) / (x @ (M @ y))
        x = y / np.linalg.norm(y)
        if abs(value - before) < 1e-13 * abs(value):
            break
    return complex(value)


def matrices(plate: PlateSpecimen, k: float, G: complex) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and mass through the thickness; U and W of every node in turn."""
    b, v, c = plate.substrate, plate.core, plate.constraining
    assert v is not None
    assert c is not None
    shear = [b.young_pa / 2 / (1 + b.poisson), G, c.young_pa / 2 / (1 + c.poisson)]
    size = 2 * (3 * ELEMENTS * 2 + 1)
    K, M = np.zeros((size, size), complex), np.zeros((size, size))
    points, weights = np.polynomial.legendre.leggauss(3)
    at = 0
    for layer, mu in zip((b, v, c), shear, strict=True):
        nu, h = layer.poisson, layer.thickness_m / ELEMENTS
        lame = 2 * mu * nu / (1 - 2 * nu)
        D = np.array([[lame + 2 * mu, lame, 0], [lame, lame + 2 * mu, 0], [0, 0, mu]])
        for _ in range(ELEMENTS):
            its = slice(at, at + 6)
            for s, weight in zip(points, weights * h / 2, strict=True):
                N = np.array([s * (s - 1) / 2, 1 - s**2, s * (s + 1) / 2])
                dN = np.array([s - 0.5, -2 * s, s + 0.5]) * 2 / h
                B = np.zeros((3, 6))
                B[0, 0::2], B[1, 1::2] = k * N, dN
                B[2, 0::2], B[2, 1::2] = dN, -k * N
                K[its, its] += weight * B.T @ D @ B
                moved = np.zeros((2, 6))
                moved[0, 0::2], moved[1, 1::2] = N, N
                M[its, its] += weight * layer.density_kg_m3 * moved.T @ moved
            at += 4
    return K, M


@dataclass(frozen=True)
class Judged:
    """Of one specimen; deviations in what is said, empty where it was refused."""

    said: str
    modes: np.ndarray
    """Of frequencies and loss factors. Shape (2, modes)."""
    law: np.ndarray
    """Of G' and eta at the modes' ends and middle. Shape (2, 3)."""
    largest: float = 0.0
    """Relative error of a mode's frequency."""


def judge(case: Case, rng: np.random.Generator) -> Judged:
    """Its table identified, where nothing refuses it."""
    values = np.array([exact_mode(case, k) for k in wavenumbers(case.plate)])
    f, eta = np.sqrt(values.real) / (2 * np.pi), values.imag / values.real
    own = complex_modes(Plate(case.plate), case.law, MODES)
    own_f, own_eta = np.array([m.frequency_hz for m in own]), np.array([m.loss_factor for m in own])
    largest = float(np.abs(own_f / f - 1).max())
    none = np.zeros((2, 0))
    try:
        theory_over(case.plate, case.law, f)
    except OutsideModel:
        return Judged("refused for the true law", none, none, largest)
    error = model_error_at(case.plate, f, case.law.modulus(2 * np.pi * f))
    modes = np.array([(own_f / f - 1) / error.frequency, (own_eta / eta - 1) / error.loss])
    read = [x * (1 + std * rng.standard_normal(MODES)) for x, std in zip((f, eta), STD, strict=True)]
    table = ModalTable(
        np.arange(1.0, MODES + 1),
        *read,
        frequency_std_hz=STD[0] * read[0],
        loss_factor_std=STD[1] * read[1],
        read="model",
    )
    try:
        found = identify_tables([table], [case.plate]).fit
    except FittingError as refused:
        return Judged(f"{type(refused).__name__} of the fit", modes, none, largest)
    if not found.converged:
        return Judged("not converged", modes, none, largest)
    omega = 2 * np.pi * np.array([f[0], np.sqrt(f[0] * f[-1]), f[-1]])
    pairs = zip(
        found.law.storage_and_loss(omega),
        case.law.storage_and_loss(omega),
        found.uncertainty.law_band(found.law, omega),
        strict=True,
    )
    return Judged("identified", modes, np.array([(a - b) / e for a, b, e in pairs]), largest)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--specimens", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    found: list[tuple[Case, Judged]] = []
    for seed in track(range(given.seed, given.seed + given.specimens), "specimens"):
        rng = np.random.default_rng(seed)
        case = drawn(rng)
        found.append((case, judge(case, rng)))
    for kind in ("soft", "thick", "thick-faced", "all"):
        some = [j for c, j in found if kind in (c.kind, "all")]
        if not some:
            continue
        print(f"{kind}, {len(some)}: {dict(Counter(j.said for j in some))}")
        refused = [j.largest for j in some if j.said.startswith("refused")]
        if refused:
            print(f"  refused: frequencies off by {100 * np.median(refused):.2g} % (median of the largest)")
        for what in ("modes", "law"):
            z = np.hstack([getattr(j, what) for j in some])
            for name, one in zip(("f", "eta") if what == "modes" else ("G'", "eta"), z, strict=True):
                if len(one):
                    within = 100 * np.mean(np.abs(one) < 1.96)
                    print(
                        f"  {what}, {name}: rms {np.sqrt(np.mean(one**2)):.2f} of what is said, within 1.96 "
                        f"in {within:.1f} %, largest {np.abs(one).max():.1f}"
                    )


if __name__ == "__main__":
    main()
