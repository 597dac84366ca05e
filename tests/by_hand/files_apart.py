"""Masses of a shear pair measured at unlike temperatures: what is named, and how far the law is off.

python tests/by_hand/files_apart.py --cases 12 --kelvin 1.0 --masses 4

Every draw has its own disc, core (Havriliak and Negami), shift with temperature (Williams, Landel and Ferry
with constants of its own, and a vertical one) and masses; the cores' temperatures are normal about the law's
with the standard deviation `--kelvin`. Read through the wave in the pad in closed form, 0.2 % noise; mass,
gain, delay, area and thickness are off by what they are stated to. The law is held against the truth at the
temperature that the verdict says it is of: that of the file, or the mean of the files, that nothing is said
of.
"""

import argparse
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.identification.result import LawBand
from fitting.laws import LAWS
from fitting.stated.layers import Core
from fitting.structures.shear_pair import ShearPair, disc
from fitting.sweep import Sweep
from instrument.finding.diagnosis import Diagnosed, diagnose
from instrument.models.files import File

LEVEL_M_S2, POINTS, NOISE = 9.81, 120, 2e-3
MASSES_KG = (0.1, 0.2, 0.35, 0.6, 1.0, 1.4)
DENSITY_KG_M3 = 1150.0
AT_HZ = np.array([60.0, 100.0, 200.0])
BEGUN = LAWS["fractional-zener"](2e6, 300e6, 1e-5, 0.6)


@dataclass(frozen=True)
class Material:
    """G*(omega) at a temperature above the reference."""

    g0_pa: float
    ginf_pa: float
    tau_s: float
    alpha: float
    beta: float
    c1: float
    c2_k: float

    def modulus(self, omega: Array, warmer_k: float) -> Complex:
        """In Pa, of the shape of `omega`."""
        shift = 10 ** (-self.c1 * warmer_k / (self.c2_k + warmer_k))
        relaxed = (1 + (1j * omega * self.tau_s * shift) ** self.alpha) ** self.beta
        return (1 + 0.0034 * warmer_k) * (self.ginf_pa + (self.g0_pa - self.ginf_pa) / relaxed)


def drawn(seed: int, kelvin: float, masses: int) -> tuple[list[File], Material, Array]:
    """Files, the material, and how much warmer each file's core was. Shape (files,)."""
    r = np.random.default_rng(seed)
    thickness, (area, gyration) = r.uniform(3e-3, 6e-3), disc(30e-3, 10e-3)
    material = Material(
        r.uniform(0.6, 2) * 1e6, r.uniform(200, 800) * 1e6, 10 ** r.uniform(-6, -4.8),
        r.uniform(0.55, 0.75), r.uniform(0.6, 1), r.uniform(6, 12), r.uniform(90, 160),
    )  # fmt: skip
    weighed = r.choice(MASSES_KG, masses, replace=False)
    warmer = kelvin * r.standard_normal(masses)
    true = thickness * (1 + 0.01 * r.standard_normal()), 2 * area * (1 + 0.01 * r.standard_normal())
    files = []
    for mass, own in zip(weighed, warmer, strict=True):
        size = float(np.abs(material.modulus(np.array([2 * np.pi * 150.0]), 0.0))[0])
        about = np.sqrt(2 * size * area / thickness / mass) / (2 * np.pi)
        f = np.geomspace(max(25.0, 0.35 * about), min(1200.0, 2.2 * about), POINTS)
        stated = ShearPair(
            float(mass), 2, area, Core(thickness, 0.49, DENSITY_KG_M3, BEGUN), gyration_m=gyration
        )
        files.append(File(_sweep(r, f, mass, material.modulus(2 * np.pi * f, own), *true), stated))
    return files, material, warmer


def _sweep(r: np.random.Generator, f: Array, mass: float, G: Complex, thickness: float, area: float) -> Sweep:
    w = 2 * np.pi * f
    k = w * np.sqrt(DENSITY_KG_M3 / G)
    shear = area * G * k / np.sin(k * thickness)
    T = shear / (shear * np.cos(k * thickness) - mass * (1 + 1e-3 * r.standard_normal()) * w**2)
    T = T * (1 + 3e-3 * r.standard_normal()) * np.exp(-2e-6j * w * r.standard_normal())
    T = T * (1 + NOISE * (r.standard_normal(len(f)) + 1j * r.standard_normal(len(f))))
    one, level = np.ones(len(f), np.intp), np.full(len(f), LEVEL_M_S2)
    return Sweep(f, T * level / (1j * w), level, one, one, base_m_s2=level + 0j)


def off(found: Diagnosed, material: Material, warmer: Array) -> list[tuple[float, float]]:
    """(found - true) / standard error of G' and eta at each frequency of `AT_HZ` that was measured."""
    result = found.result
    of = [e for e in result.effects if e.name == "temperature_difference"]
    number = int(of[0].parameters["file"].value) if of else 0
    its = warmer[:1] if number < 0 else np.delete(warmer, number - 1) if number else warmer
    return pulls(
        result.after.band, lambda hz: complex(np.mean([material.modulus(2 * np.pi * hz, w) for w in its]))
    )


def pulls(band: LawBand, modulus: Callable[[float], complex]) -> list[tuple[float, float]]:
    """(found - true) / standard error of G' and eta at each frequency of `AT_HZ` that a band has."""
    f, rows = np.log(band.frequency_hz), []
    for hz in (x for x in AT_HZ.tolist() if band.frequency_hz.min() <= x <= band.frequency_hz.max()):
        G = modulus(hz)
        each = (
            (band.storage_modulus_pa, band.storage_modulus_standard_error_pa, G.real),
            (band.loss_factor, band.loss_factor_standard_error, G.imag / G.real),
        )
        z = [(np.interp(np.log(hz), f, v) - truth) / np.interp(np.log(hz), f, e) for v, e, truth in each]
        rows.append((float(z[0]), float(z[1])))
    return rows


def within(values: Array) -> str:
    """Shares within the bands, rms and the worst. `values` of shape (any, 2)."""
    inside = [np.mean(np.abs(values) < limit, axis=0).round(2).tolist() for limit in (1.0, 1.96)]
    rms, worst = np.sqrt(np.mean(values**2, axis=0)).round(2), np.abs(values).max(axis=0).round(1)
    return f"within 68, 95 %, G' and eta: {inside} rms {rms} worst {worst} of {len(values)}"


def main() -> None:
    """Draw, diagnose, score."""
    ask = argparse.ArgumentParser(description=__doc__)
    ask.add_argument("--cases", type=int, default=12)
    ask.add_argument("--kelvin", type=float, default=1.0)
    ask.add_argument("--masses", type=int, default=4)
    ask.add_argument("--seed", type=int, default=20)
    given = ask.parse_args()
    verdicts, first, z = Counter[str](), Counter[str](), list[tuple[float, float]]()
    for seed in range(given.seed, given.seed + given.cases):
        files, material, warmer = drawn(seed, given.kelvin, given.masses)
        found = diagnose(files)
        result = found.result
        names = "+".join(e.name for e in result.effects) or "-"
        verdicts[result.verdict] += 1
        first[names] += 1
        z += off(found, material, warmer) if result.verdict != "unknown" else []
        print(seed, result.verdict, names, "warmer by", np.round(warmer, 2), flush=True)
    print(dict(verdicts), dict(first), within(np.array(z)))


if __name__ == "__main__":
    main()
