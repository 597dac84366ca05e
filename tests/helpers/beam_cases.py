"""A sandwich beam as its file has it."""

BEAM = """
[beam]
length_mm = 200.0
width_mm = 20.0
boundary = "clamped-free"
[substrate]
thickness_mm = 2.0
young_gpa = 70.0
poisson = 0.3
density_kg_m3 = 2700.0
[constraining]
thickness_mm = 1.0
young_gpa = 70.0
poisson = 0.3
density_kg_m3 = 2700.0
[core]
thickness_mm = 0.5
poisson = 0.49
density_kg_m3 = 1000.0
[core.law]
kind = "fractional-zener"
g0_mpa = 0.5
ginf_mpa = 20.0
tau_s = 1.0e-4
alpha = 0.6
[pickup]
x_mm = 150.0
"""
