"""A blow's record was weighted by exp(-t / tau), and nobody took off again what that adds to every decay."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import FORCE, PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.given import ModulusAt, Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_H = 1e-3
"""Step of ln omega for the modulus' slope."""


class ExponentialWindowEffect(Effect):
    """Readings at s = i omega + 1 / tau in the place of i omega; the modulus there to first order.

    A pulse is over before the window has fallen: it weights the motion alone.

        A = s^2 M + s C_1 + K_0 + G K_1,   G = G(omega) - i dG/d omega / tau
    """

    name = "exponential_window"
    enters = "damping"
    source = "the transform's shift; Fladung and Rost, Mech. Syst. Signal Process. 11 (1997)"
    structures = PLATE_AND_BEAM
    needs = FORCE
    parameters = (
        EffectParameter("tau", "s", 0.02, 5.0, 0.3, logarithmic=True, neutral=float("inf")),
        EffectParameter("integrations", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True),
    )
    chance = 0.04
    discriminating_test = "the same blows without a window, in a record that is long enough to die away in"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, integrations]) for integrations in (0.0, 1.0)]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        per_s = 1 / u[0]
        return Change(K=per_s**2 * plate.M + per_s * plate.viscous(), C=2 * per_s * plate.M)

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        slope = (G(1 + _H) - G(1 - _H)) / (2 * _H)
        return np.asarray(G() - 1j * slope / (points.omega * u[0]))

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        # A transducer of acceleration gives s^2 x, which is divided by i omega where it should be by s.
        return np.asarray(v * (1 + 1 / (1j * points.omega * u[0])) ** (1 + u[1]))

    def story(self, u: Mapping[str, float]) -> str:
        what = "accelerations" if u["integrations"] else "velocities"
        return f"{what} were weighted by an exponential window of {u['tau']:.3g} s, which is in every decay"
