"""Shear pairs behind a fixture that resonates: what is set aside, and how far the law is off.

python tests/by_hand/fixtures.py --cases 20 --masses 3

Discs, cores and masses are those of `files_apart.py`, at one temperature. Between the base's accelerometer
and the pads a fixture resonates once or twice, 0.3 to 1 % of it and 2 to 6 % wide, somewhere in the middle of
the band; the two accelerometers are 0.5 % and 0.5 degrees apart (standard deviation), the same ones for every
mass. `--still` leaves the resonances out: nothing is to be set aside then. The law is that of `identify`.
"""

import argparse
from dataclasses import replace

import numpy as np
from files_apart import drawn, pulls, within

from fitting.arrays import Array, Complex
from instrument.finding.identification import identify
from instrument.models.files import File

GAIN, PHASE = 0.005, np.radians(0.5)


def behind(r: np.random.Generator, files: list[File], *, still: bool) -> tuple[list[File], list[float]]:
    """The files as such a rig reads them, and where it resonates, in Hz."""
    low, high = min(f.sweep.frequency_hz.min() for f in files), max(f.sweep.frequency_hz.max() for f in files)
    at = sorted(np.exp(r.uniform(np.log(low) + 0.5, np.log(high) - 0.5, 0 if still else r.integers(1, 3))))
    size, width = r.uniform(0.003, 0.01, len(at)), r.uniform(0.02, 0.06, len(at))
    apart = (1 + GAIN * r.standard_normal()) * np.exp(1j * PHASE * r.standard_normal())

    def factor(f: Array) -> Complex:
        found = np.full(len(f), apart, complex)
        for hz, s, w in zip(at, size, width, strict=True):
            x = f / hz
            found *= 1 + s / (1 - x**2 + 1j * w * x)
        return found

    read = [
        File(replace(f.sweep, velocity_m_s=f.sweep.velocity_m_s * factor(f.sweep.frequency_hz)), f.specimen)
        for f in files
    ]
    return read, [float(hz) for hz in at]


def main() -> None:
    """Draw, identify, score."""
    ask = argparse.ArgumentParser(description=__doc__)
    ask.add_argument("--cases", type=int, default=20)
    ask.add_argument("--masses", type=int, default=3)
    ask.add_argument("--seed", type=int, default=500)
    ask.add_argument("--still", action="store_true")
    given = ask.parse_args()
    z = list[tuple[float, float]]()
    there = seen = elsewhere = 0
    for seed in range(given.seed, given.seed + given.cases):
        files, material, _ = drawn(seed, 0.0, given.masses)
        files, at = behind(np.random.default_rng([seed, 1]), files, still=given.still)
        found = identify(files)
        spans = {(a.file, a.glitch.low_hz, a.glitch.high_hz) for a in found.aside}
        inside = [
            (k + 1, hz)
            for k, f in enumerate(files)
            for hz in at
            if f.sweep.frequency_hz.min() < hz < f.sweep.frequency_hz.max()
        ]
        hit = {(k, hz) for k, hz in inside if any(n == k and lo <= hz <= hi for n, lo, hi in spans)}
        wrong = sum(not any(lo <= hz <= hi for hz in at) for _, lo, hi in spans)
        there, seen, elsewhere = there + len(inside), seen + len(hit), elsewhere + wrong
        band = found.result.band
        assert band is not None
        z += pulls(band, lambda hz, of=material: complex(of.modulus(2 * np.pi * hz, 0.0)))
        print(seed, np.round(at), [(n, round(lo), round(hi)) for n, lo, hi in sorted(spans)], flush=True)
    print(f"set aside {seen} of {there} resonances, {elsewhere} stretches elsewhere")
    print(within(np.array(z)))


if __name__ == "__main__":
    main()
