"""Sweeps of plates from exact elasticity, struck or shaken, read at a point: is the law within its errors?

python tests/by_hand/exact_sweeps.py --specimens 60 --seed 1
python tests/by_hand/exact_sweeps.py --specimens 60 --seed 1 --shaken

Simply supported plates of five kinds (soft, usual, thick, thick-faced, with a stiff core), whose response is
a sum of plain waves through the thickness (`exact_elasticity`): nothing of it is the program's own.
Everything stated is exact, so that what is left is the model's error; modal loss factors go down to `--loss`.
Two to five resonances each, a segment about every one, noise of 0.2 to 0.5 %.
"""

import argparse
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from exact_elasticity import METALS, Case, exact_mode, matrices
from rich.progress import track

from fitting.errors import FittingError
from fitting.laws import LAWS
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from fitting.sweep import Sweep
from instrument.finding.identification import identify
from instrument.models.files import File

KINDS = ("soft", "usual", "thick", "thick-faced", "stiff")
NEAR, MOST = 40, 24
"""Waves that are solved at every frequency, and the half waves along each side that count at all."""
SEEN = 0.12
"""Of the product of a mode's shape at both spots, from which its resonance is swept."""
SEEN_SHAKEN = SEEN * 4 / np.pi**2 / 5
"""Of the product of its mean, 4/pi^2 at most, and its shape at the pickup: a fifth as much of it."""


@dataclass(frozen=True)
class Swept:
    """Of one specimen."""

    case: Case
    sweep: Sweep
    middles_hz: np.ndarray
    least_loss: float


def drawn(rng: np.random.Generator, *, shaken: bool) -> Case:
    """One of the kinds, with its spots; sizes evenly in their logarithms."""

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    kind = KINDS[rng.integers(len(KINDS))]
    side = between(0.15, 0.6)
    sides = (side, side * between(0.55, 1.0))
    faces = [between(0.5e-3, 3e-3), between(0.1e-3, 2e-3)]
    core_m, G = between(0.05e-3, 1e-3), between(0.2e6, 20e6)
    if kind == "soft":
        G = between(5e3, 0.2e6)
    elif kind == "thick":
        core_m = between(1e-3, 8e-3)
    elif kind == "thick-faced":
        faces = [between(2e-3, 8e-3), between(0.5e-3, 6e-3)]
    elif kind == "stiff":
        core_m, G = between(0.1e-3, 4e-3), between(20e6, 1e9)
    metals = [METALS[k] for k in rng.integers(len(METALS), size=2)]
    layers = [Face(h, *metal) for h, metal in zip(faces, metals, strict=True)]
    law = LAWS["fractional-zener"](G, G * between(3, 100), between(1e-5, 1e-2), float(rng.uniform(0.35, 0.8)))
    core = Core(core_m, float(rng.uniform(0.4, 0.495)), between(700, 1600), law)
    spots = [(sides[0] * rng.uniform(0.12, 0.88), sides[1] * rng.uniform(0.12, 0.88)) for _ in range(2)]
    plate = PlateSpecimen(*sides, "simply-supported", *layers, core, exact=True, pickup_m=spots[0])
    if not shaken:
        plate = replace(plate, force_m=spots[1])
    return Case(kind, plate, law)


def waves(plate: PlateSpecimen) -> tuple[np.ndarray, np.ndarray]:
    """Wavenumbers, ascending, and how much of each is driven and read. Shape (waves,) each.

    Driven is the shape at the force, or its mean over the plate: half waves in odd numbers are shaken alone.
    """
    assert plate.pickup_m is not None
    m, n = (x.ravel() for x in np.meshgrid(*[np.arange(1, MOST + 1)] * 2, indexing="ij"))
    a, b = m * np.pi / plate.length_m, n * np.pi / plate.width_m
    order = np.argsort(np.hypot(a, b))
    m, n, a, b = (one[order] for one in (m, n, a, b))

    def at(place: tuple[float, float]) -> np.ndarray:
        return np.asarray(np.sin(a * place[0]) * np.sin(b * place[1]))

    driven = at(plate.force_m) if plate.force_m else 4 / np.pi**2 / (m * n) * (m % 2) * (n % 2)
    return np.hypot(a, b), driven * at(plate.pickup_m)


def compliance(plate: PlateSpecimen, k: float, omega: np.ndarray, G: np.ndarray) -> np.ndarray:
    """Of a wave: mean deflection of the substrate.

    For a pressure that is spread over it as evenly, or for a base that accelerates all there is.
    """
    K, M = matrices(plate, k, 0.0)
    assert plate.constraining is not None
    faces = {name: replace(getattr(plate, name), young_pa=0.0) for name in ("substrate", "constraining")}
    by_G = matrices(replace(plate, **faces), k, 1.0)[0]
    # W of the substrate's nodes, by Simpson's rule over each of its elements.
    count = (len(K) // 2 - 1) // 6
    side = np.zeros(len(K))
    for e in range(count):
        side[4 * e + 1 : 4 * e + 6 : 2] += np.array([1, 4, 1]) / 6 / count
    A = K + G[:, None, None] * by_G - (omega**2)[:, None, None] * M
    given = side if plate.force_m else -M @ np.tile([0.0, 1.0], len(M) // 2)
    load = np.broadcast_to(given.astype(complex)[:, None], (len(omega), len(side), 1))
    return np.asarray(np.linalg.solve(A, load)[:, :, 0] @ side)


def receptance(case: Case, f: np.ndarray, segment: np.ndarray) -> np.ndarray:
    """Per force or per acceleration. Waves far above a segment are solved at its ends and its middle."""
    plate = case.plate
    k, shape = waves(plate)
    omega = 2 * np.pi * f
    G = case.law.modulus(omega)
    x = sum(s * compliance(plate, one, omega, G) for one, s in zip(k[:NEAR], shape[:NEAR], strict=True))
    for number in np.unique(segment):
        its = np.flatnonzero(segment == number)
        some = np.linspace(f[its].min(), f[its].max(), 3)
        G_some = case.law.modulus(2 * np.pi * some)
        rest = sum(
            s * compliance(plate, one, 2 * np.pi * some, G_some)
            for one, s in zip(k[NEAR:], shape[NEAR:], strict=True)
        )
        x[its] += np.polynomial.polynomial.polyval(
            f[its] - some[1], np.polynomial.polynomial.polyfit(some - some[1], rest, 2)
        )
    return np.asarray((4 / (plate.length_m * plate.width_m) if plate.force_m else 4) * x)


def swept(case: Case, rng: np.random.Generator) -> Swept | None:
    """Segments about a few resonances that both spots see; None where there are none."""
    k, shape = waves(case.plate)
    least = SEEN if case.plate.force_m else SEEN_SHAKEN
    seen = [n for n in range(12) if abs(shape[n]) > least][: rng.integers(2, 6)]
    lambdas = np.array([exact_mode(case, k[n]) for n in range(12)])
    f, eta = np.sqrt(lambdas.real) / (2 * np.pi), lambdas.imag / lambdas.real
    parts: list[np.ndarray] = []
    for n in seen:
        half = np.clip(0.8 * eta[n], 0.04, 0.2)
        low, high = f[n] * (1 - half), f[n] * (1 + half)
        if not parts or low > parts[-1][-1]:
            parts.append(np.linspace(low, high, int(rng.integers(14, 26))))
    if not parts:
        return None
    at = np.concatenate(parts)
    segment = np.repeat(np.arange(1, len(parts) + 1), [len(p) for p in parts])
    v = 2j * np.pi * at * receptance(case, at, segment)
    noise = float(np.exp(rng.uniform(np.log(0.002), np.log(0.005)))) * np.abs(v)
    v = v + noise * (rng.standard_normal(len(v)) + 1j * rng.standard_normal(len(v)))
    one = np.ones(len(at))
    sweep = Sweep(at, v, one, segment, one.astype(np.intp), std_m_s=noise)
    return Swept(case, sweep, np.array([p.mean() for p in parts]), float(eta.min()))


@dataclass(frozen=True)
class Judged:
    """Deviations of the law in standard errors. Shape (segments,) each, empty where it was refused."""

    said: str
    storage: np.ndarray
    loss: np.ndarray
    chi2: float = np.nan


def judge(one: Swept) -> Judged:
    """Its law identified from one that is 50 % off."""
    law, plate = one.case.law, one.case.plate
    wrong = LAWS["fractional-zener"](*np.array(law.values) * [1.5, 0.8, 1.5, 0.95])
    none = np.zeros(0)
    try:
        found = identify([File(one.sweep, plate.with_law(wrong))]).result
    except FittingError as refused:
        return Judged(type(refused).__name__, none, none)
    if not found.fit.converged:
        return Judged("not converged", none, none)
    omega, band = 2 * np.pi * one.middles_hz, found.band
    z = [
        (a - b) / np.interp(np.log(one.middles_hz), np.log(band.frequency_hz), error)
        for a, b, error in zip(
            found.fit.law.storage_and_loss(omega),
            law.storage_and_loss(omega),
            (band.storage_modulus_standard_error_pa, band.loss_factor_standard_error),
            strict=True,
        )
    ]
    return Judged("identified", *z, float(found.uncertainty.chi2_per_dof))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--specimens", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--loss", type=float, default=0.004, help="least modal loss factor")
    parser.add_argument("--shaken", action="store_true", help="by its base instead of at a point")
    given = parser.parse_args()
    found: list[tuple[Swept, Judged]] = []
    for seed in track(range(given.seed, given.seed + given.specimens), "specimens"):
        rng = np.random.default_rng(seed)
        one = swept(drawn(rng, shaken=given.shaken), rng)
        if one is not None and one.least_loss > given.loss:
            found.append((one, judge(one)))
            if found[-1][1].chi2 > 2:
                print(f"seed {seed}: chi-square {found[-1][1].chi2:.3g}")
    for name, of in (
        *((kind, lambda s, kind=kind: s.case.kind == kind) for kind in KINDS),
        ("modal loss below 0.02", lambda s: s.least_loss < 0.02),
        ("0.02 to 0.05", lambda s: 0.02 <= s.least_loss < 0.05),
        ("above", lambda s: s.least_loss >= 0.05),
        ("all", lambda s: True),
    ):
        some = [j for s, j in found if of(s)]
        print(f"{name}, {len(some)}: {dict(Counter(j.said for j in some))}")
        for what in ("storage", "loss"):
            z = np.concatenate([np.zeros(0), *(getattr(j, what) for j in some)])
            if len(z):
                print(
                    f"  {what}: rms {np.sqrt(np.mean(z**2)):.2f} standard errors, within 1.96 in "
                    f"{100 * np.mean(np.abs(z) < 1.96):.1f} %, largest {np.abs(z).max():.1f}"
                )


if __name__ == "__main__":
    main()
