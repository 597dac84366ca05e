"""What a sweep reads at one law and one set of unknowns: kept while derivatives are asked for there."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Complex
from fitting.diagnosis.problem.plate_answer import Asked, Motions
from fitting.diagnosis.response.swinging_part import WithPart


@dataclass(frozen=True)
class ByChange:
    """Displacement per acceleration at every point, to the stated numbers and then to effects' unknowns."""

    heave: Complex
    """Shape (numbers, points)."""
    turned: Complex
    """The same of a turning base; zero where the base does not turn."""


@dataclass(frozen=True)
class OfPlate:
    """What goes with the plate and its core. Shape (points,) each."""

    G: Complex
    """Of the core, in Pa."""
    x: Complex
    """Displacement per acceleration of the base, or per force."""
    slope: Complex
    """dx/dG; of the unchanged plate until derivatives are asked for."""
    turned: Complex
    """Displacement per pitch acceleration."""
    solved: tuple[Asked, Motions] | None
    """What the nodes were asked, and how they move; None where nothing moves them."""
    by: ByChange | None
    """None: not asked for so far."""
    part: WithPart | None
    """With the part that swings on it; None where none does."""
    turned_slope: Complex | float = 0.0
    """d turned/dG; zero until derivatives are asked for."""


@dataclass(frozen=True)
class At:
    """What is read there, and what it is made of. Shape (points,) each."""

    v: Complex
    """As the file keeps it, m/s."""
    raw: Complex
    """Before the channels, m/s."""
    per_x: Complex
    """Velocity per displacement per acceleration of the base, or per force."""
    pitch: Complex
    """Angular acceleration of the base over its acceleration, rad/m."""
    lever: Complex
    """Velocity that the pitch gives the spot by itself, per rad/m."""
    plate: OfPlate

    @property
    def per_G(self) -> Complex:
        """Derivative of `raw` to the core's modulus. Shape (points,)."""
        return np.asarray(self.per_x * (self.plate.slope + self.pitch * self.plate.turned_slope))
