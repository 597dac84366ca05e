"""The fixture has a resonance of its own: the base pitches through it."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fitting.effects.base import Effect, Points, Unknown
from fitting.effects.base_rocking import BaseRocking
from fitting.effects.spanned import SpannedPlate

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_OUTSIDE = (0.6, 1.6)
_STEP = 0.02


class FixtureResonance(Effect):
    """Pitch = gain w0^2 / (w0^2 - w^2 + 2 i zeta w0 w) times the base's acceleration."""

    name = "fixture_resonance"
    enters = "load"
    source = "one mode of the fixture between shaker and clamp"
    unknowns = (
        Unknown("frequency", "Hz", 1.0, 5000.0, 100.0, logarithmic=True, neutral=None),
        Unknown("damping_ratio", "1", 1e-3, 0.3, 0.02, logarithmic=True, neutral=None),
        Unknown("gain", "rad/m", -1.0, 1.0, 0.02, spread=0.1),
    )
    spans = BaseRocking.spans
    extends = "base_rocking"
    splits = "two accelerometers on the base; the sweep repeated with a mass on the fixture"

    def starts(self, plate: SpannedPlate, points: Points) -> list[Array]:
        f = points.omega / (2 * np.pi)
        low, high = _OUTSIDE[0] * f.min(), _OUTSIDE[1] * f.max()
        grid = np.geomspace(low, high, int(np.log(high / low) / _STEP))
        # Between the segments a resonance far from any point looks the same anywhere.
        near = np.abs(np.log(grid[:, None] / f)).min(axis=1) < 0.3
        return [np.array([f0, zeta, 0.02]) for f0 in grid[near] for zeta in (0.01, 0.05)]

    def pitch(self, omega: Array, u: Array) -> Complex:
        w0 = 2 * np.pi * u[0]
        return np.asarray(u[2] * w0**2 / (w0**2 - omega**2 + 2j * u[1] * w0 * omega))

    def story(self, u: Mapping[str, float]) -> str:
        f, zeta = u["frequency"], u["damping_ratio"]
        return f"the fixture resonates at {f:.4g} Hz (damping ratio {zeta:.2g}) and turns the base"
