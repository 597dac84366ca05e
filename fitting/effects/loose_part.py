"""Something on the plate swings by itself: a mass on a spring of its own.

Its travel is xi / sqrt(m), and w . q that of the place it sits at, both relative to the base. With
k = m omega_0^2 (1 + i loss) its spring, inertia and load are

    k (w . q - xi / sqrt(m))^2,   xi^2,   -sqrt(m) a

So xi is one motion more of the plate (`EnrichedReducedPlate.with_part`), and the response has a pole more. At
low frequencies it is a mass at that place, far above its own it is gone. A fit needs no such motion: it takes
the part for what it is felt as (`diagnosis/response/swinging_part.py`).
"""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.added_mass import PLACE, AddedMassEffect, MassOnBeamEffect, PointMass, near
from fitting.effects.along_a_beam import AlongABeam
from fitting.effects.base import ONE_PIECE, Effect, EffectParameter
from fitting.effects.given import Points, Swings
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

_START_KG = 1e-3
"""To begin with: a clip, a screw."""
_START_LOSS = 0.06
"""The same: of a part on wax or on its cable."""
_STEP = 0.03
"""In ln f, between starts: half the half-power width that they have."""
_ALONG, _ACROSS = (0.45, 0.7, 0.97), (0.1, 0.5, 0.9)
"""Shares of length and width, to begin with."""
_ALONG_A_BEAM = (0.3, 0.5, 0.7, 0.85, 0.98)
"""The same of a beam."""
_SEEN = 3
"""Frequencies within its half-power width: three make a peak. Without one it is a mass or a tether."""
_LEAST_KG = 1e-6
"""At nothing at all no step tells which way to go."""


class LoosePartEffect(Effect):
    """Felt as m (1 + i loss) / (1 + i loss - r^2) at (x, y), r = w / omega_0."""

    name = "loose_part"
    enters = "mass"
    source = "dynamic vibration absorber, Den Hartog, Mechanical Vibrations (1956), section 3.2"
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("mass", "kg", 0.0, 0.05, _START_KG, spread=2e-3),
        EffectParameter("frequency", "Hz", 1.0, 5000.0, 100.0, logarithmic=True, neutral=None),
        EffectParameter("loss_factor", "1", 2e-3, 1.0, _START_LOSS, logarithmic=True, neutral=None),
        *PLACE,
    )
    spans: tuple[Span, ...] = (PointMass(),)
    sharp = True
    unexplained_share = 0.003
    chance = 0.01
    discriminating_test = "a finger on what may rattle; two accelerometers on the base"

    def on(self, kind: str) -> Effect | None:
        return LoosePartOnBeamEffect() if kind == "beam" else super().on(kind)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [
            np.array([_START_KG, f, _START_LOSS, x * plate.length_m, y * plate.width_m])
            for f in _between_readings(points)
            for x in _ALONG
            for y in _ACROSS
        ]

    def elsewhere(self, plate: EnrichedReducedPlate, u: Array) -> list[Array]:
        # Its frequency shows; of its place and its mass many go together.
        places = [(x * plate.length_m, y * plate.width_m) for x in _ALONG for y in _ACROSS]
        return [np.array([*u[:3], *place]) for place in places]

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        # Far below its own frequency it moves with its place.
        return ((AddedMassEffect(), u[[0, 3, 4]]),)

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        lower[0] = _LEAST_KG
        upper[3:] = plate.length_m, plate.width_m
        return lower, upper

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        m, square = u[0], (2 * np.pi * u[1]) ** 2 * (1 + 1j * u[2])
        part = plate.vector("part")
        stretch = np.sqrt(m) * plate.row(u[3], u[4]) - part
        held = np.outer(part, part)
        # What holds a plate's part that nothing has put on it goes.
        return Change(
            K=square * np.outer(stretch, stretch) - held,
            M=held,
            load=-np.sqrt(m) * part,
        )

    def coming_in(self, plate: EnrichedReducedPlate, u: Array) -> Change | None:
        ((mass, its),) = self.within(u)
        return mass.change(plate, its)

    def sharply(self, omega: Array, u: Array) -> Complex:
        k = 1 + 1j * u[2]
        return np.asarray(k / (k - (omega / (2 * np.pi * u[1])) ** 2))

    def swings(self, plate: EnrichedReducedPlate, u: Array) -> Swings:
        return Swings(float(u[0]), plate.row(u[3], u[4]))

    def shows(self, points: Points, resonances: Complex, u: Array) -> bool:
        f = np.unique(points.omega) / (2 * np.pi)
        return int(np.sum(np.abs(f - u[1]) <= u[1] * u[2] / 2)) >= _SEEN

    def story(self, u: Mapping[str, float]) -> str:
        return (
            f"a part of {1e3 * u['mass']:.2g} g {near(u)} swings by itself at "
            f"{u['frequency']:.4g} Hz (loss factor {u['loss_factor']:.2g})"
        )


class LoosePartOnBeamEffect(AlongABeam, LoosePartEffect):
    """On a beam."""

    parameters = LoosePartEffect.parameters[:4]
    spans = ()
    needs = ONE_PIECE
    discriminating_test = "a finger on what may rattle"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [
            np.array([_START_KG, f, _START_LOSS, x * plate.length_m])
            for f in _between_readings(points)
            for x in _ALONG_A_BEAM
        ]

    def elsewhere(self, plate: EnrichedReducedPlate, u: Array) -> list[Array]:
        return [np.array([*u[:3], x * plate.length_m]) for x in _ALONG_A_BEAM]

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        return ((MassOnBeamEffect(), u[[0, 3]]),)

    def swings(self, plate: EnrichedReducedPlate, u: Array) -> Swings:
        return super().swings(plate, np.array([*u, 0.0]))

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = Effect.limits(self, plate)
        lower[0], upper[3] = _LEAST_KG, plate.length_m
        return lower, upper

    def story(self, u: Mapping[str, float]) -> str:
        return (
            f"a part of {1e3 * u['mass']:.2g} g at {1e3 * u['x']:.0f} mm swings by itself at "
            f"{u['frequency']:.4g} Hz (loss factor {u['loss_factor']:.2g})"
        )


def _between_readings(points: Points) -> Array:
    """Frequencies in Hz within what is read, a step apart. Shape (any,)."""
    f = np.unique(points.omega) / (2 * np.pi)
    grid = np.geomspace(f[0], f[-1], max(2, int(np.log(f[-1] / f[0]) / _STEP)))
    return np.asarray(grid[np.abs(np.log(grid[:, None] / f)).min(axis=1) < _STEP])
