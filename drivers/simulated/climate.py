"""The air of a simulated chamber and the plate in it, exact in time: no clock, no wire.

    tau_air dA/dt = S - A,    tau_plate dP/dt = A - P

after each new set point S, from wherever both were.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass

from drivers.errors import Refused

AMBIENT_C = 22.0
"""Of the room; the core's law as it is stated holds there."""
LOWEST_C, HIGHEST_C = 0.0, 50.0


@dataclass(frozen=True)
class _Piece:
    begin_s: float
    set_point_c: float
    air_c: float
    plate_c: float


class Climate:
    """Begins at rest with the room. Times are those of the sample clock."""

    def __init__(self, air_s: float = 120.0, plate_s: float = 300.0) -> None:
        self._air_s, self._plate_s = air_s, plate_s
        self._pieces = [_Piece(0.0, AMBIENT_C, AMBIENT_C, AMBIENT_C)]

    @property
    def set_point_c(self) -> float:
        """The last temperature that was asked for."""
        return self._pieces[-1].set_point_c

    def go_to(self, now_s: float, set_point_c: float) -> None:
        """From now on. `Refused` for what this chamber cannot."""
        if not LOWEST_C <= set_point_c <= HIGHEST_C:
            raise Refused(f"{set_point_c:g} °C: expected {LOWEST_C:g} to {HIGHEST_C:g} °C")
        self._pieces.append(_Piece(now_s, set_point_c, self.air_c(now_s), self.plate_c(now_s)))

    def air_c(self, time_s: float) -> float:
        """What the chamber's thermometer reads."""
        p = self._at(time_s)
        return p.set_point_c + (p.air_c - p.set_point_c) * math.exp(-(time_s - p.begin_s) / self._air_s)

    def plate_c(self, time_s: float) -> float:
        """Plate and core."""
        p, a, b = self._at(time_s), self._air_s, self._plate_s
        t = time_s - p.begin_s
        fast, slow = math.exp(-t / a), math.exp(-t / b)
        # a / (b - a) (slow - fast) has a limit where both times are the same.
        driven = t / b * slow if math.isclose(a, b) else a / (b - a) * (slow - fast)
        return p.set_point_c + (p.plate_c - p.set_point_c) * slow + (p.air_c - p.set_point_c) * driven

    def _at(self, time_s: float) -> _Piece:
        k = bisect_right(self._pieces, time_s, key=lambda p: p.begin_s)
        return self._pieces[max(k - 1, 0)]
