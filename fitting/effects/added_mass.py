"""A point mass on the plate: a sensor, a reflector, a forgotten magnet."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.along_a_beam import AlongABeam
from fitting.effects.base import ONE_PIECE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import Span

_TYPICAL_KG = 5e-3
"""Of a small accelerometer with its wax: the response to it is what is spanned."""
_GRID = [(x, y) for x in (0.25, 0.5, 0.75, 0.97) for y in (0.03, 0.3, 0.7, 0.97)]
"""Shares of length and width: the free end and both edges, where masses matter and are put."""

_ALONG, _ACROSS = (np.arange(8) + 1) / 8.2, (np.arange(5) + 0.5) / 5
"""Shares of length and width to begin with: the last along the plate just short of its free end. A choice."""
_LEAST_OF_PAIR, _MOST_OF_PAIR = -0.5, 10
"""Of the mass that moves in a shear pair: what more of it there may be. A choice."""
_ALONG_A_BEAM = 16
"""Places of it that are looked at: three to half a wave of its fifth mode."""


class PointMass(Span):
    """Motions under the inertia of masses at a few places."""

    name = "mass"
    odd = True

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        s = full.specimen
        rows = np.column_stack([full.loose.observe(x * s.length_m, y * s.width_m) for x, y in _GRID])
        # For reading and for being read: one column serves both, the response to a force there.
        size = np.abs(rows.T @ at.both).max(axis=1)
        return at.omega**2 * _TYPICAL_KG * rows * size


PLACE = (
    EffectParameter("x", "m", 0.0, np.inf, 0.05, neutral=None),
    EffectParameter("y", "m", 0.0, np.inf, 0.05, neutral=None),
)
"""Where on a plate something is."""


def near(u: Mapping[str, float], ending: str = "") -> str:
    """Such a place in words; `ending` of its keys."""
    return f"near ({1e3 * u['x' + ending]:.0f}, {1e3 * u['y' + ending]:.0f}) mm"


class AddedMassEffect(Effect):
    """m w^2 at (x, y)."""

    name = "added_mass"
    enters = "mass"
    source = "mass loading, Ewins, Modal Testing (2000), section 3.5"
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("mass", "kg", 0.0, 0.05, 3e-3, spread=5e-3),
        *PLACE,
    )
    spans: tuple[Span, ...] = (PointMass(),)
    unexplained_share = 0.003
    chance = 0.03
    discriminating_test = "a look at the plate and a balance; a second spot off the axis"
    caution = (
        "a mass is taken for a point: a tape or a strip that is stuck on stiffens the plate as well, which "
        "readings hardly tell, and the law may then be off by up to four standard errors: look at it"
    )

    def on(self, kind: str) -> Effect | None:
        others = {"shear-pair": MassOfPairEffect, "beam": MassOnBeamEffect}
        return others[kind]() if kind in others else super().on(kind)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        typical = self.parameters[0].typical
        return [np.array([typical, x * plate.length_m, y * plate.width_m]) for x in _ALONG for y in _ACROSS]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        return lower, np.minimum(upper, [np.inf, plate.length_m, plate.width_m])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        w = plate.row(u[1], u[2])
        return Change(M=u[0] * np.outer(w, w), load=-u[0] * w)

    def story(self, u: Mapping[str, float]) -> str:
        return f"a mass of {1e3 * u['mass']:.2g} g sits {near(u)}"


class MassOnBeamEffect(AlongABeam, AddedMassEffect):
    """On a beam."""

    parameters = AddedMassEffect.parameters[:2]
    spans = ()
    caution = AddedMassEffect.caution.replace("plate", "beam")
    needs = ONE_PIECE
    discriminating_test = "a look at the beam and a balance; a second spot"

    def variants(self) -> tuple[Effect, ...]:
        return (self, MassAtAnEndEffect())

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        shares = (np.arange(_ALONG_A_BEAM) + 1) / _ALONG_A_BEAM
        return [np.array([self.parameters[0].typical, x * plate.length_m]) for x in shares]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = Effect.limits(self, plate)
        return lower, np.minimum(upper, [np.inf, plate.length_m])

    def story(self, u: Mapping[str, float]) -> str:
        return f"a mass of {1e3 * u['mass']:.2g} g sits at {1e3 * u['x']:.0f} mm"


class MassAtAnEndEffect(MassOnBeamEffect):
    """At one of its ends, where sensors and magnets sit: no place is as likely as that."""

    parameters = (MassOnBeamEffect.parameters[0], replace(MassOnBeamEffect.parameters[1], fixed=True))
    chance = 0.01

    def variants(self) -> tuple[Effect, ...]:
        return (self,)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        # At a clamped one it does nothing.
        return [np.array([self.parameters[0].typical, x]) for x in (plate.length_m, 0.0)]


class MassOfPairEffect(AddedMassEffect):
    """The moving mass of a shear pair is so much heavier than stated: a screw, half a fixture, a cable.

    Seldom lighter: something was weighed that does not move.
    """

    parameters = (EffectParameter("mass", "kg", -0.5, 5.0, 3e-3, spread=0.02, below=0.05),)
    spans = ()
    caution = ""
    discriminating_test = "the mass on a balance; other masses on the same discs, which part mass and modulus"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical])]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        # The first unknown is the mass' own motion.
        moving = float(plate.M[0, 0])
        return np.array([_LEAST_OF_PAIR * moving]), np.array([_MOST_OF_PAIR * moving])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        w = plate.observe
        return Change(M=u[0] * np.outer(w, w), load=-u[0] * w)

    def story(self, u: Mapping[str, float]) -> str:
        return f"the moving mass is {1e3 * u['mass']:+.3g} g off what is stated"
