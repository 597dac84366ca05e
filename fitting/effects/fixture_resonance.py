"""The fixture has a resonance of its own: the base pitches through it."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import BASE, PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.base_rocking import BaseRockingEffect
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

_OUTSIDE = (0.6, 1.6)
"""Times the lowest and the highest frequency: one further off is hardly told from rocking in fixed
proportion."""
_SEEN = 3
"""Frequencies within the half-power width, clear of the plate's own resonances: three make a peak."""
_STEP = 0.02
"""In ln f, between starts: the half-power width of the start with 0.01 of critical damping."""


_NEAR = 0.3
"""In ln f, from a start to the nearest point, at most. A choice."""
_DAMPING_RATIOS = (0.01, 0.05)
"""To begin with. A choice."""


class FixtureResonanceEffect(Effect):
    """With s = 1 / (1 - r^2 + 2 i zeta r), r = w / w0: pitch = gain s a, root = (1 + heave s) a.

    Where the reference sits before the yielding fixture (`before` = 1), s = r^2 / (1 - r^2 + 2 i zeta r).
    """

    name = "fixture_resonance"
    enters = "load"
    structures = PLATE_AND_BEAM
    source = "one mode of the fixture between shaker and clamp"
    needs = BASE
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("frequency", "Hz", 1.0, 5000.0, 100.0, logarithmic=True, neutral=None),
        EffectParameter("damping_ratio", "1", 1e-3, 0.3, 0.02, logarithmic=True, neutral=None),
        EffectParameter("gain", "rad/m", -1.0, 1.0, 0.02, spread=0.1),
        EffectParameter("heave", "1", -0.3, 0.3, 0.01, spread=0.02),
        EffectParameter("before", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True),
    )
    spans: tuple[Span, ...] = BaseRockingEffect.spans
    extends = "base_rocking"
    discriminating_test = "two accelerometers on the base; the sweep repeated with a mass on the fixture"

    def on(self, kind: str) -> Effect | None:
        return LocalDisturbanceEffect() if kind == "shear-pair" else super().on(kind)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        f = points.omega / (2 * np.pi)
        low, high = _OUTSIDE[0] * f.min(), _OUTSIDE[1] * f.max()
        grid = np.geomspace(low, high, int(np.log(high / low) / _STEP))
        # Between the segments a resonance far from any point looks the same anywhere.
        near = np.abs(np.log(grid[:, None] / f)).min(axis=1) < _NEAR
        shapes = [(zeta, before) for zeta in _DAMPING_RATIOS for before in (0.0, 1.0)]
        pitch = self.parameters[2].typical
        return [np.array([f0, zeta, pitch, 0.0, before]) for f0 in grid[near] for zeta, before in shapes]

    def pitch(self, omega: Array, u: Array) -> Complex:
        return np.asarray(u[2] * self._swing(omega, u))

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        # The root moves so much more than the reference says.
        return np.asarray(v * (1 + u[3] * self._swing(points.omega, u)))

    def shows(self, points: Points, resonances: Complex, u: Array) -> bool:
        centre, half_width = 2 * np.pi * u[0] * np.array([1.0, u[1]])
        on_it = np.unique(points.omega[np.abs(points.omega - centre) <= half_width])
        beside = np.abs(resonances.real - centre) > half_width + resonances.imag
        return len(on_it) >= _SEEN and bool(beside.all())

    def _swing(self, omega: Array, u: Array) -> Complex:
        r = omega / (2 * np.pi * u[0])
        return np.asarray((r**2 if u[4] else 1.0) / (1 - r**2 + 2j * u[1] * r))

    def story(self, u: Mapping[str, float]) -> str:
        f, zeta = u["frequency"], u["damping_ratio"]
        return f"the fixture resonates at {f:.4g} Hz (damping ratio {zeta:.2g}) and turns the base"


class LocalDisturbanceEffect(FixtureResonanceEffect):
    """On a shear pair: a stretch of frequencies that is set aside (`fitting.diagnosis.problem.glitch`)."""

    parameters = ()
    spans = ()

    def shows(self, points: Points, resonances: Complex, u: Array) -> bool:
        return True

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows in the readings themselves"

    def story(self, u: Mapping[str, float]) -> str:
        return (
            f"a local disturbance from {u['from']:.0f} to {u['to']:.0f} Hz, as of a fixture's resonance, is "
            "set aside"
        )
