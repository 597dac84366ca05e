"""Steps of a further measurement: those of the first sweep, or others about resonances that it does not show.

A base that heaves drives no motion that is odd across the width, and a spot on the axis reads none. Where a
plate twists, a spot beside the axis sees at once whether anything is uneven: there and nowhere else.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.plate_poles import ODD, PlatePoles
from fitting.laws import CoreLaw
from fitting.planning.candidates import resonances_hz
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.planning.costs import step_seconds
from instrument.stepped_sine.settings import SweepSettings

_TWISTS = 2
"""Resonances at most, the lowest: of those above them a further one tells little."""
_STEPS = 20
"""About each: enough that scatter shows its noise."""
_HALF_WIDTHS, _LEAST = 3.0, 0.03
"""How far steps go to either side: of its half width, and of its frequency at least. A choice."""


@dataclass(frozen=True)
class Steps:
    """In the order in which they are made. Shape (steps,) each."""

    frequency_hz: Array
    segment: NDArray[np.intp]
    seconds: Array

    def then(self, other: "Steps") -> "Steps":
        """Both, one after the other."""
        pairs = ((getattr(self, n), getattr(other, n)) for n in ("frequency_hz", "segment", "seconds"))
        return Steps(*(np.concatenate(pair) for pair in pairs))

    def of(self, at: NDArray[np.intp]) -> "Steps":
        """Some of them. Shape (any,)."""
        return Steps(self.frequency_hz[at], self.segment[at], self.seconds[at])

    def __len__(self) -> int:
        return len(self.frequency_hz)


def twists_hz(plate: EnrichedReducedPlate, law: CoreLaw, low_hz: float, high_hz: float) -> Complex:
    """The lowest resonances odd across the width, in a band. Shape (any,), as `resonances_hz`."""
    if not np.any(plate.group == ODD):
        return np.zeros(0, dtype=complex)
    found = resonances_hz(PlatePoles(plate, law, ODD), low_hz, high_hz)
    return found[(found.real > low_hz) & (found.real < high_hz)][:_TWISTS]


def about(poles_hz: Complex, first: int, every_hz: Complex, settings: SweepSettings) -> Steps:
    """Steps about some resonances, each a segment, numbered from `first`; `every_hz` set how long it rings.

    Shapes (any,).
    """
    each = [
        p.real + max(_HALF_WIDTHS * abs(p.imag), _LEAST * p.real) * np.linspace(-1, 1, _STEPS)
        for p in poles_hz
    ]
    f = np.round(np.concatenate([np.zeros(0), *each]), 3)
    segment = first + np.repeat(np.arange(len(each)), _STEPS)
    return Steps(f, segment, step_seconds(f, every_hz, settings))


def no_steps() -> Steps:
    """None at all."""
    return Steps(np.zeros(0), np.zeros(0, dtype=np.intp), np.zeros(0))


def where(poles_hz: Sequence[complex] | Complex) -> str:
    """Their frequencies in words; shape (any,)."""
    return " and ".join(f"{p.real:.4g}" for p in poles_hz)
