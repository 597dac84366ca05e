"""One measuring chain turns the phase by an angle that is the same at every frequency."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate


class PhaseOffsetEffect(Effect):
    """v e^{i phase}."""

    name = "phase_offset"
    enters = "channel"
    source = "conditioners of two accelerometers, an integrator: matched to a degree, not better"
    structures = frozenset({"plate", "beam", "shear-pair"})
    parameters = (EffectParameter("phase", "rad", -0.5, 0.5, 0.02, spread=0.026),)
    chance = 0.02
    discriminating_test = "both sensors on one spot, or exchanged"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if points.has_phase else "amplitudes do not show a phase"

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        return np.asarray(v * np.exp(1j * u[0]))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the velocity channel leads by {np.degrees(u['phase']):+.2g} degrees at every frequency"
