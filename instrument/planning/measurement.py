"""One measurement that could be made: what it would read, what it costs, and how it is offered."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.planning.further_readings import FurtherReadings
from fitting.planning.known_mass import KnownMass
from instrument.facts.follow_up import FollowUp, FollowUpKind, Support
from instrument.planning.reasons import why

HANDS_S = {
    "spot": 120.0,
    "added_mass": 180.0,
    "clamping": 300.0,
    "bare_hammer": 600.0,
    "damped_struck": 600.0,
}
"""Of a person's time, and of the laser's; a choice."""


@dataclass(frozen=True)
class Measurable:
    """One measurement that could be made."""

    kind: FollowUpKind
    further: FurtherReadings
    part: NDArray[np.intp]
    """Of the points that `further` reads; those of several measurements of one place are asked at once."""
    frequencies_hz: tuple[float, ...]
    segments: tuple[int, ...]
    level_g: float
    seconds: float
    todo: str
    needs_hands: bool = False
    spot_m: tuple[float, float] | None = None
    mass: KnownMass | None = None
    velocities_m_s: tuple[float, ...] = ()
    """Foreseen at each step, where that matters."""
    reason: str = ""
    """Why, where that does not depend on the explanations."""
    struck_m: tuple[float, float] | None = None
    """Where a hammer hits the treated plate."""
    held: Support | None = None
    """While it does."""

    def follow_up(self, separation: float, resolved: float, between: tuple[str, ...]) -> FollowUp:
        """The measurement as it is offered to people."""
        given = {
            "kind": self.kind,
            "needs_hands": self.needs_hands,
            "frequencies_hz": self.frequencies_hz,
            "segments": self.segments,
            "level_g": self.level_g if self.frequencies_hz else None,
            "seconds": self.seconds,
            "separation": separation,
            "probability_resolved": resolved,
            "between": between,
            "why": self.reason or why(self.kind, between),
            "todo": self.todo,
        }
        if self.velocities_m_s:
            given["velocities_m_s"] = self.velocities_m_s
        if self.spot_m is not None:
            given["spot_mm"] = tuple(1e3 * s for s in self.spot_m)
        if self.struck_m is not None:
            given |= {"struck_mm": tuple(1e3 * s for s in self.struck_m), "held": self.held}
        if self.mass is not None:
            given["mass_kg"] = float(self.mass.values[0])
            given["mass_at_mm"] = tuple((1e3 * self.mass.values[1:]).tolist())
        return FollowUp.model_validate(given)
