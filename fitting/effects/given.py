"""What an effect is given: the points of a sweep, law and strain there, the modes of a hammer test."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.data.levels import by_level, count_of_levels
from fitting.laws import CoreLaw
from fitting.specimen import Drive, Reading
from fitting.stated.layers import Face


@dataclass(frozen=True)
class Points:
    """What is known of each point of a sweep apart from its reading. Shape (points,) each."""

    omega: Array
    drive_amplitude: Array
    """Commanded, zero to peak: m/s^2 of the base, or newtons where a force drives."""
    time_s: Array
    """Since the first point; by frequency, evenly, where no time is kept."""
    timed: bool
    has_phase: bool
    reads: Reading
    drive: Drive = "base"
    force_n: Array | None = None
    """Amplitude of the force that was measured, where one drives and its size is told."""
    segment: NDArray[np.intp] | None = None
    """Number of the segment each is of; None where nothing is known of segments."""
    at_rest: NDArray[np.bool_] | None = None
    """Which points have a base at rest, a force driving them; None where `drive` says it of all."""
    level_m_s2: Array | None = None
    """What a base did, where that is not what was commanded."""
    mass_kg: float | None = None
    """Of a shear pair: what its pads carry, as stated."""

    @property
    def levels(self) -> int:
        """How many levels there are, a tenth apart and more."""
        if self.level_m_s2 is None:
            return count_of_levels(self.drive_amplitude)
        # What was reached scatters, or follows the frequency: neither is a level for each point.
        of_each = [float(np.median(self.level_m_s2[at])) for at in by_level(self.level_m_s2)]
        return count_of_levels(np.array(of_each))

    @property
    def straining(self) -> Array:
        """What strains a core: the base's acceleration as it was, or the force. Shape (points,)."""
        if self.force_n is not None:
            return self.force_n
        return self.drive_amplitude if self.level_m_s2 is None else self.level_m_s2

    @property
    def struck(self) -> NDArray[np.bool_]:
        """Which points a force drives. Shape (points,)."""
        return np.full(len(self.omega), self.drive == "force") if self.at_rest is None else self.at_rest

    @property
    def base_m_s(self) -> Complex | float:
        """The base's own velocity, as far as it is read. Shape (points,), or zero."""
        if self.reads == "relative":
            return 0.0
        moving = self.drive_amplitude / (1j * self.omega)
        return moving if self.at_rest is None else np.where(self.at_rest, 0.0, moving)


@dataclass(frozen=True)
class Swings:
    """A part that swings on a plate, without its frequency."""

    mass_kg: float
    row: Array
    """Reads the plate where it sits. Shape (k,)."""


class Strain(Protocol):
    """The core's strain at every point, in shares of the largest at 1 g of a core as it is."""

    def __call__(self, softened: Array, gained: Array | None = None) -> Array:
        """Of a core that is softened by fractions of its modulus, its loss modulus being larger by `gained`.

        In shares of sqrt(G' G'') before it softens. Shape (..., points) each: ways to soften it are asked
        for in one go.
        """

    def __hash__(self) -> int:
        """By which it is known again."""


Ways = Callable[[Array, Array | None], Array]
"""Derivatives of ln strain along some ways, of a core softened and with its loss gained so, as `Strain` takes
them. Shapes (points,) to (ways, points)."""


@dataclass(frozen=True)
class ModulusAt:
    """The law's modulus at every point of a sweep."""

    law: CoreLaw
    points: Points
    strain: Strain
    logs: Array | None = None
    """Of many laws of its kind instead: the logarithms of their parameters. Shape (laws, parameters)."""

    def __call__(self, frequency_scale: Array | float = 1.0) -> Complex:
        """G* at omega times `frequency_scale`. Shape (points,), of many laws (laws, points)."""
        omega = self.points.omega * frequency_scale
        return np.asarray(self.law.modulus(omega) if self.logs is None else self.law.moduli(self.logs, omega))


class BarePlateModes(Protocol):
    """What effects may ask of the modes of a hammer test."""

    @property
    def lowering_per_density(self) -> Array:
        """Fall of ln f for unit density of air. Shape (modes,)."""

    @property
    def stiffness(self) -> Complex:
        """phi^T P_p phi for the parts of K_0 (`fitting.plate.part_names.STIFFNESS`). Shape (modes, parts)."""

    @property
    def substrate(self) -> Face:
        """The substrate as its file states it."""
