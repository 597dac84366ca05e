"""The core warms during the sweep, or in a pause, or comes and goes with the room: its times shorten."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.digits import two_digits
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import ModulusAt, Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

C_1, C_2_K = 9.0, 120.0
"""Of a damping polymer well above its glass transition; another pair scales the kelvins found."""

_FASTEST_K_S = 0.1
"""Ten minutes' drift in one: faces and core of a millimetre take minutes to follow the air, and what is
driven warms no faster. A choice."""
_CYCLES = (
    EffectParameter("swing_sine", "K", -8.0, 8.0, 0.3, spread=1.0, mounting=1.4),
    EffectParameter("swing_cosine", "K", -8.0, 8.0, 0.3, spread=1.0, mounting=1.4),
    EffectParameter("period", "s", 100.0, 7200.0, 900.0, logarithmic=True, neutral=None, mounting=0.1),
)
"""Of a room whose air conditioning goes on and off: every few minutes to an hour or two. A choice."""
_UNEVEN = (
    EffectParameter("uneven_sine", "K", -2.0, 2.0, 0.1, spread=0.2, mounting=0.3),
    EffectParameter("uneven_cosine", "K", -2.0, 2.0, 0.1, spread=0.2, mounting=0.3),
)
"""Twice in a period: it warms in a third of it and cools in two, say. A choice."""
_SHORTEST_S, _TIME_CONSTANTS = 40.0, (0.2, 0.6, 3.0)
"""A sweep's duration, at least, and shares of it that a search begins with: from what settles early in it to
what warms it evenly. A choice."""
_PAUSE_S = 300.0
"""Without readings: shorter ones are those between segments. A choice."""
_LEAST_CYCLES, _MOST_CYCLES, _STEP = 0.75, 12.0, 0.5
"""Looked for in a sweep: fewer are what settles; a step apart a linear one finds those between."""

_FEW_ENOUGH = 30
"""Points without times of which an even sweep upwards is assumed, and said: a published table, read by hand.
A file of more has lost its times; what it measured when, nobody knows. A choice."""


def time_scale(warmer_k: Array | float) -> Array:
    """a_T: what a core's times shorten by where it is so much warmer. Of the shape of `warmer_k`."""
    return np.asarray(10 ** (-C_1 * warmer_k / (C_2_K + warmer_k)))


class TemperatureDriftEffect(Effect):
    """tau times a_T, log10 a_T = -C_1 T / (C_2 + T), T = warming (1 - exp(-t / time_constant)).

    The law is that of the first point.
    """

    name = "temperature_drift"
    enters = "time"
    needs_time = True
    source = "Williams, Landel and Ferry, J. Am. Chem. Soc. 77 (1955)"
    structures = EVERY_STRUCTURE
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("warming", "K", -25.0, 25.0, 2.0, spread=5.0, mounting=4.0),
        EffectParameter("time_constant", "s", 20.0, 1e5, 600.0, logarithmic=True, neutral=None, mounting=0.3),
    )
    chance = 0.04
    anew = True
    discriminating_test = (
        "the first segment repeated at the end, or the order of the segments reversed, beside a thermometer"
    )

    def variants(self) -> tuple[Effect, ...]:
        return (
            TemperatureDriftEffect(),
            TemperatureStepEffect(),
            TemperatureCycleEffect(),
            TemperatureCycleEffect(uneven=True),
        )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if not points.timed and len(points.omega) > _FEW_ENOUGH:
            return "the points carry no time"
        return None

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        duration = max(float(np.ptp(points.time_s)), _SHORTEST_S)
        return [np.array([self.parameters[0].typical, share * duration]) for share in _TIME_CONSTANTS]

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        return G(time_scale(self.kelvin(points.time_s, u)))

    def kelvin(self, time_s: Array, u: Array) -> Array:
        """Warmer than the temperature of the law. Shape of `time_s`."""
        return np.asarray(-u[0] * np.expm1(-time_s / u[1]))

    def is_beyond(self, u: Array) -> bool:
        return bool(abs(u[0]) > _FASTEST_K_S * u[1])

    def story(self, u: Mapping[str, float]) -> str:
        warming, minutes = two_digits(abs(u["warming"])), two_digits(u["time_constant"] / 60)
        verb = "warms" if u["warming"] > 0 else "cools"
        return f"the core {verb} by {warming} K in the end, within {minutes} min"


class TemperatureStepEffect(TemperatureDriftEffect):
    """The same where the sweep went on after a pause, another day: T = 0 before it, `step` after it."""

    discriminating_test = "the segments from before the pause measured once more, beside a thermometer"
    parameters = (
        EffectParameter("step", "K", -25.0, 25.0, 1.0, spread=3.0, mounting=3.0),
        EffectParameter("after", "s", 0.0, np.inf, 0.0, neutral=None, fixed=True),
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if not len(_pauses_s(points)):
            return "the sweep has no pause"
        return super().objection(points, plate)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, s]) for s in _pauses_s(points)]

    def kelvin(self, time_s: Array, u: Array) -> Array:
        return np.asarray(np.where(time_s > u[1], u[0], 0.0))

    def is_beyond(self, u: Array) -> bool:
        # A pause is long enough for all that its limits allow.
        return False

    def story(self, u: Mapping[str, float]) -> str:
        step, than = two_digits(abs(u["step"])), "warmer" if u["step"] > 0 else "colder"
        return f"the core is {step} K {than} after the pause at {two_digits(u['after'] / 60)} min"


def _pauses_s(points: Points) -> Array:
    """Middle of each. Shape (pauses,)."""
    if not points.timed:
        return np.zeros(0)
    time_s = np.sort(points.time_s)
    k = np.flatnonzero(np.diff(time_s) > _PAUSE_S)
    return np.asarray((time_s[k] + time_s[k + 1]) / 2)


class TemperatureCycleEffect(TemperatureDriftEffect):
    """The same about a mean, that of the law: the room's air conditioning goes on and off.

    T = swing_sine sin(w t) + swing_cosine cos(w t), w = 2 pi / period; `uneven`: and the same of 2 w.
    """

    discriminating_test = (
        "a thermometer at the core; the sweep once more, begun at another moment of the cycle"
    )

    def __init__(self, *, uneven: bool = False) -> None:
        self.uneven = uneven
        self.beside_others = not uneven
        self.parameters = (*_CYCLES, *_UNEVEN) if uneven else _CYCLES

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if not points.timed or np.ptp(points.time_s) < self._shortest_s * _LEAST_CYCLES:
            return "the sweep is too short for a room to cycle"
        return super().objection(points, plate)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        duration = float(np.ptp(points.time_s))
        most = min(_MOST_CYCLES, duration / self._shortest_s)
        typical = np.array([q.typical for q in self.parameters])
        # What is uneven is within reach of its even part.
        step = 2 * _STEP if self.uneven else _STEP
        each = np.arange(_LEAST_CYCLES, most + 1e-9, step)
        return [np.concatenate([typical[:2], [duration / n], typical[3:]]) for n in each]

    @property
    def _shortest_s(self) -> float:
        return self.parameters[2].lower

    def kelvin(self, time_s: Array, u: Array) -> Array:
        turned = 2 * np.pi * time_s / u[2]
        uneven = u[3] * np.sin(2 * turned) + u[4] * np.cos(2 * turned) if self.uneven else 0.0
        return np.asarray(u[0] * np.sin(turned) + u[1] * np.cos(turned) + uneven)

    def is_beyond(self, u: Array) -> bool:
        return bool(2 * np.pi * np.hypot(u[0], u[1]) > _FASTEST_K_S * u[2])

    def story(self, u: Mapping[str, float]) -> str:
        swing, minutes = np.hypot(u["swing_sine"], u["swing_cosine"]), u["period"] / 60
        return (
            f"the core's temperature swings by {swing:.2g} K about its mean, every {two_digits(minutes)} min"
        )
