"""A cable hangs on the plate, or a magnet pulls at it: a spring with losses, from a point to the floor.

The nearer a magnet, the harder it pulls: its spring is negative.

The floor stands still: the spring feels the plate's motion relative to the base and the base's own,

    force = -(k + i |k| loss) (w + w_base),   w_base = -a / omega^2
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.effects.added_mass import PLACE, PointMass, near
from fitting.effects.along_a_beam import AlongABeam
from fitting.effects.base import ONE_PIECE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

_LOSS = 0.2
"""To begin with: a cable's sheath loses much."""
_ALONG, _ACROSS = (0.3, 0.5, 0.7, 0.85, 0.98), (0.1, 0.5, 0.9)
"""Shares of the length and the width, to begin with."""
_START_N_M = 50.0
"""To begin with: half the spread of the prior."""


class TetherEffect(Effect):
    """A spring k + i |k| loss at (x, y)."""

    name = "tether"
    enters = "stiffness"
    source = "cable stiffness and damping, Ewins, Modal Testing (2000), section 3.5"
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("k", "N/m", -2e3, 2e3, _START_N_M, spread=100.0, below=0.2),
        EffectParameter("loss_factor", "1", 0.0, 2.0, _LOSS, shape=True, spread=0.5),
        *PLACE,
    )
    spans: tuple[Span, ...] = (PointMass(),)
    unexplained_share = 0.003
    chance = 0.015
    discriminating_test = "a look at the plate; the cable taped down elsewhere, the cable or magnet taken off"

    def on(self, kind: str) -> Effect | None:
        own = {"beam": TetherOfBeamEffect, "shear-pair": TetherOfPairEffect}.get(kind)
        return own() if own else super().on(kind)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [
            np.array([_START_N_M, _LOSS, x * plate.length_m, y * plate.width_m])
            for x in _ALONG
            for y in _ACROSS
        ]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        return lower, np.minimum(upper, [np.inf, np.inf, plate.length_m, plate.width_m])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        w, k = plate.row(u[2], u[3]), u[0] + 1j * abs(u[0]) * u[1]
        return Change(K=k * np.outer(w, w), travel_load=-k * w)

    def story(self, u: Mapping[str, float]) -> str:
        spring = f"{u['k']:.2g} N/m, loss factor {u['loss_factor']:.2g}"
        return f"{_puller(u)} pulls at the plate {near(u)} ({spring})"


class TetherOfBeamEffect(AlongABeam, TetherEffect):
    """A tether that is fastened to a beam."""

    parameters = TetherEffect.parameters[:3]
    spans = ()
    needs = ONE_PIECE
    discriminating_test = "a look at the beam; the cable taped down elsewhere, the cable or magnet taken off"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([_START_N_M, _LOSS, x * plate.length_m]) for x in _ALONG]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = Effect.limits(self, plate)
        return lower, np.minimum(upper, [np.inf, np.inf, plate.length_m])

    def story(self, u: Mapping[str, float]) -> str:
        return (
            f"{_puller(u)} pulls at the beam at {1e3 * u['x']:.0f} mm "
            f"({u['k']:.2g} N/m, loss factor {u['loss_factor']:.2g})"
        )


class TetherOfPairEffect(TetherEffect):
    """At the moving mass of a shear pair.

    With one mass it is a gain and a stiffer law, exactly: g K'/(K' - omega^2 m), K' = K + k, g = K/K'.
    """

    parameters = (
        replace(TetherEffect.parameters[0], lower=-1e5, upper=1e5, typical=300.0, spread=1e3),
        TetherEffect.parameters[1],
    )
    spans = ()
    discriminating_test = "a look at what touches the mass; its cable and cords led elsewhere, or taken off"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([q.typical for q in self.parameters])]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        return Effect.limits(self, plate)

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        w, k = plate.observe, u[0] + 1j * abs(u[0]) * u[1]
        return Change(K=k * np.outer(w, w), travel_load=-k * w)

    def story(self, u: Mapping[str, float]) -> str:
        return f"{_puller(u)} pulls at the mass ({u['k']:.2g} N/m, loss factor {u['loss_factor']:.2g})"


def _puller(u: Mapping[str, float]) -> str:
    return "a cable" if u["k"] >= 0 else "a magnet"
