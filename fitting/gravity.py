"""The two accelerations that are called one g. They differ by 0.03 %: which one is meant is said by name."""

STANDARD_GRAVITY_M_S2 = 9.80665
"""By definition: what sensors, amplifiers and other programs' files mean by g."""
PUBLISHED_G_M_S2 = 9.81
"""As the published case prints its level of 1 g. Levels in g (`level_g`) are multiples of it."""
