"""Masses on one set of pads as files: a sweep and a specimen each."""

import csv

import numpy as np
from shear_pair_cases import pair, sweep

SPECIMEN = """
[shear-pair]
mass_kg = {mass_kg}
discs = 2
thickness_mm = 6.0
outer_diameter_mm = 33.5
inner_diameter_mm = 11.8
edges = true

[core]
density_kg_m3 = 1100.0

[core.law]
kind = "fractional-zener"
g0_mpa = 3.0
ginf_mpa = 25.0
tau_s = 1.0e-4
alpha = 0.6

[tolerances]
mass_percent = 0.2
area_percent = 2.0
core_thickness_percent = 2.0
"""
_COLUMNS = ("acceleration_re_m_s2", "acceleration_im_m_s2", "base_accel_re_m_s2", "base_accel_im_m_s2")


def write_pair(folder, name, mass_kg, *, seed=0, points=24, **more):
    """`name`.csv of this mass and `name`.toml, which states it; `more` as `sweep` has it."""
    s = sweep(pair(mass_kg), seed=seed, points=points, **more)
    a, base = 1j * s.omega * s.velocity_m_s, s.base_m_s2
    with (folder / f"{name}.csv").open("w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["frequency_hz", *_COLUMNS])
        out.writerows(np.column_stack([s.frequency_hz, a.real, a.imag, base.real, base.imag]).tolist())
    (folder / f"{name}.toml").write_text(SPECIMEN.format(mass_kg=mass_kg))
    return folder / f"{name}.csv"


def two_masses(folder, **more):
    """The files of a light mass and a heavy one."""
    return [
        write_pair(folder, name, mass_kg, seed=k, **more)
        for k, (name, mass_kg) in enumerate((("light", 0.2533), ("heavy", 1.196)))
    ]
