"""A sensor on wax or a bracket rises with its own resonance, far above what is measured.

Below its resonance what is mounted softly moves 1/(1 - r^2) times what carries it. Of an accelerometer on
the moving mass, or of a bracket between the base's accelerometer and the pads, the transmissibility is so
much too large; of the base's own accelerometer too small.
"""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import BASE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

_DAMPING_RATIO = 0.03
"""Of wax and of bolted brackets, to begin with."""
_BEGIN = (2.0, 4.0)
"""Times the highest frequency, to begin with."""


_MOUNTED = (
    EffectParameter("frequency", "Hz", 200.0, 2e4, 3000.0, logarithmic=True, neutral=float("inf")),
    EffectParameter("damping_ratio", "1", 0.0, 0.3, _DAMPING_RATIO, shape=True, spread=0.05),
)
_ON_BASE = EffectParameter("on_base", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True)
_REACTION = EffectParameter("reaction", "1/kg", 0.0, 20.0, 0.5, shape=True, spread=2.0)


class SensorMountingEffect(Effect):
    """Transmissibility T = x/u of a mass over what carries its pads; r = f / frequency.

    What carries them moves u = 1 / (1 - r^2 (1 + M reaction T) + 2 i zeta r) times the base: M w^2 x pulls at
    a bracket, whose own mass is 1/reaction. Where it is `on_base` the base's accelerometer moves more than
    the base, and nothing pulls at it. Plates and beams have `fixture_resonance` for it.
    """

    name = "sensor_mounting"
    enters = "channel"
    source = "ISO 5348: mounting an accelerometer, a mass on the spring of its mounting"
    structures = frozenset({"shear-pair"})
    needs = BASE
    parameters: tuple[EffectParameter, ...] = (*_MOUNTED, _ON_BASE, _REACTION)
    chance = 0.03
    discriminating_test = (
        "the accelerometers screwed on, or exchanged; one of them on the base beside the other"
    )

    def __init__(self, *, on_base: bool = False) -> None:
        self.on_base = on_base
        if on_base:
            self.parameters = (*_MOUNTED, _ON_BASE)

    def variants(self) -> tuple[Effect, ...]:
        return (self, type(self)(on_base=True))

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        top = points.omega.max() / (2 * np.pi)
        more = (1.0,) if self.on_base else (0.0, 0.0)
        return [np.array([times * top, _DAMPING_RATIO, *more]) for times in _BEGIN]

    def scaled(self, u: Array, a: float) -> Array:
        """As in `Effect`; r^2 says how strong it is."""
        found = u.copy()
        found[0] = u[0] / np.sqrt(abs(a))
        return found

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        r = points.omega / (2 * np.pi * u[0])
        moves = points.drive_amplitude / (1j * points.omega)
        relative = 1.0 if points.reads == "relative" else 0.0
        T, alone = v / moves + relative, 1 - r**2 + 2j * u[1] * r
        pulled = 0.0 if self.on_base else r**2 * (points.mass_kg or 0.0) * u[3] * T
        T = T * alone if self.on_base else T / (alone - pulled)
        return np.asarray((T - relative) * moves)

    def story(self, u: Mapping[str, float]) -> str:
        what = "the base's accelerometer" if u["on_base"] else "a sensor or bracket beyond the base's"
        return f"{what} rises towards its own resonance at {u['frequency']:.3g} Hz"
