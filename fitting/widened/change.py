"""What an effect changes of the reduced plate: additions to its matrices (`fitting.effects.base`)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any


@dataclass(frozen=True)
class Change:
    """What an effect changes of the reduced plate; shapes (k, k) and (k,), 0 for nothing."""

    K: Any = 0.0
    K_1: Any = 0.0
    M: Any = 0.0
    load: Any = 0.0
    observe: Any = 0.0
    C: Any = 0.0
    """Viscous, beside C_1."""
    damping: Any = 1.0
    """Factor on C_1, or one on each of its modes. Shape () or (modes,)."""
    travel_load: Any = 0.0
    """Load per displacement of the base, -1 / omega^2 of its acceleration; N/m. Shape (k,)."""
    travel: Any = 0.0
    """Displacement read per displacement of the base, beside that of the plate."""

    @property
    def at_rest(self) -> Change:
        """The same where the base is at rest: what it changes of the base's load and reading is none."""
        return replace(self, load=0.0, travel_load=0.0, travel=0.0)

    def and_then(self, other: Change) -> Change:
        """Both changes."""
        return Change(
            self.K + other.K,
            self.K_1 + other.K_1,
            self.M + other.M,
            self.load + other.load,
            self.observe + other.observe,
            self.C + other.C,
            self.damping * other.damping,
            self.travel_load + other.travel_load,
            self.travel + other.travel,
        )
