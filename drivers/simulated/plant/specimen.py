"""The plate of the plant: sizes and metals. Its core's law is in `law.py`."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    """One homogeneous layer."""

    thickness_m: float
    young_pa: float
    """Of the core: 2 (1 + nu), which makes its shear modulus one."""
    poisson: float
    density_kg_m3: float


LENGTH_M = 0.3002
"""Along x, from the clamp."""
WIDTH_M = 0.1999
"""Along y."""
SUBSTRATE = Layer(1.9e-3, 68.9e9, 0.3, 2700.0)
CORE = Layer(0.5e-3, 2 * (1 + 0.49), 0.49, 789.5)
CONSTRAINING = Layer(0.3e-3, 209e9, 0.3, 7890.0)
LAYERS = (SUBSTRATE, CORE, CONSTRAINING)
"""From the face at z = 0 upwards."""
BARE_MODAL_RATIOS = (0.0029, 0.0013, 0.0018, 0.0021, 0.0011, 0.0007, 0.0009, 0.0004)
"""Damping of the first eight modes as a fraction of critical, clamp and air together."""
SPOT_M = (0.06, 0.06)
"""Where the laser points: x from the clamp, y from a long edge."""
REFERENCE_MODULUS_PA = 0.5e6
"""The core modulus whose real modes carry the damping ratios of the treated plate."""
