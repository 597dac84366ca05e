"""Which part of the data an effect is in: one file, one spot, one segment, or all of them."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fitting.diagnosis.several.of_files import ALIKE, EACH, FILE, PICKUP
from fitting.effects import CATALOGUE

_EVERY_SPOT = -1
"""In the place of a spot's number."""
_ROUNDING = 1e-9
"""Relative, of a frequency that was written and read."""


@dataclass(frozen=True)
class PartWith:
    """What of the data has an effect."""

    file: float = ALIKE
    """From 1; all alike, or each with a size of its own."""
    pickup: float = _EVERY_SPOT
    low_hz: float = 0.0
    high_hz: float = np.inf

    @property
    def is_all(self) -> bool:
        """Whether all data have it alike: then those that are left foretell those held out."""
        return self == PartWith()

    def has(self, frequency_hz: float, file: int | None, pickup: int | None) -> bool:
        """Whether a point has it."""
        return (
            (self.file in (ALIKE, EACH) or self.file == file)
            and (self.pickup < 0 or self.pickup == pickup)
            and self.low_hz * (1 - _ROUNDING) <= frequency_hz <= self.high_hz * (1 + _ROUNDING)
        )


def part_with(name: str, values: Mapping[str, float]) -> PartWith:
    """Of an effect by its name, and its parameters by their keys."""
    effect = CATALOGUE.get(name)
    band = (values["from"], values["to"]) if effect is not None and effect.of_a_segment else (0.0, np.inf)
    return PartWith(values.get(FILE, ALIKE), values.get(PICKUP, _EVERY_SPOT), *band)
