"""The two things a set of temperatures is asked: one law shifted, or a law for each.

Either holds all its numbers as parameters of one law, so that every fit of several sweeps can take it.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.several.member_laws import MemberLaws
from fitting.laws.base import CoreLaw, Quantity
from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.shifts import FARTHEST, Shift

_LEAST, _MOST = float(np.exp(-0.5)), float(np.exp(0.5))
_VERTICAL = Quantity("", 1.0, _LEAST, _MOST, (_LEAST, _MOST))
"""A factor on the modulus: beyond a half it is no vertical shift of one material."""
_NEAREST, _FARTHEST = float(np.exp(-FARTHEST)), float(np.exp(FARTHEST))
_WARMER = Quantity("", 1.0, _NEAREST, _FARTHEST, (_NEAREST, _FARTHEST))
"""How far a stated temperature is moved: e to the power of its standard deviations, as a bend is kept."""


@dataclass(frozen=True)
class OneLaw(MemberLaws):
    """G*_k(omega) = b_k G*(a_k omega): the law's parameters, the shift's, the b_k, the bend, temperatures.

    A temperature's departure from what is stated has a prior of variance one, as each number of the bend has,
    and stands with it.
    """

    law: CoreLaw
    """At the reference temperature."""
    shift: Shift
    theta: tuple[float, ...]
    """Of the shift, as `Shift.positive` has them."""
    points: tuple[int, ...]
    b: tuple[float, ...] = ()
    """Of each temperature but the reference; none where no vertical shift is asked for."""
    warmer: tuple[float, ...] = ()
    """Of each sweep, e to the power of standard deviations; none where temperatures are as stated."""

    @property
    def kind(self) -> str:
        """Of the law that is shifted."""
        return self.law.kind

    @property
    def lengths(self) -> tuple[int, ...]:
        """Points of each sweep."""
        return self.points

    @property
    def bend_count(self) -> int:
        """Of the law that is shifted, and what is known of the temperatures alike."""
        return self.law.bend_count + len(self.warmer)

    @property
    def _own(self) -> int:
        return len(self.law.names) - self.law.bend_count

    @property
    def names(self) -> list[str]:
        """The law's own, the shift's, vertical factors, the bend, temperatures."""
        own, n = self.law.names, self._own
        up = [f"vertical_{k + 1}" for k in range(len(self.b))]
        warmer = [f"temperature_{k + 1}" for k in range(len(self.warmer))]
        return [*own[:n], *self.shift.names, *up, *own[n:], *warmer]

    @property
    def values(self) -> Array:
        """In the order of `names`."""
        own, n = self.law.values, self._own
        return np.concatenate([own[:n], self.theta, self.b, own[n:], self.warmer])

    @property
    def limits(self) -> list[Quantity]:
        """In the order of `names`."""
        own, n = self.law.limits, self._own
        low, high = self.shift.positive(self.shift.lowest), self.shift.positive(self.shift.highest)
        shifts = [Quantity("", 1.0, a, b, (a, b)) for a, b in zip(low.tolist(), high.tolist(), strict=True)]
        return [*own[:n], *shifts, *(_VERTICAL,) * len(self.b), *own[n:], *(_WARMER,) * len(self.warmer)]

    @property
    def search_widths(self) -> Array:
        """Of all but the bend: a shift is as likely anywhere within its limits."""
        low, high = np.log([q.search for q in self.limits[: len(self.names) - self.bend_count]]).T
        return np.asarray((high - low) / np.sqrt(12.0))

    def with_values(self, values: Array) -> Self:
        """Law, shift and temperatures with other parameters, in the order of `names`. Shape (names,)."""
        n, m, v, bend = self._own, len(self.theta), len(self.b), self.law.bend_count
        own, theta, b, bent, warmer = np.split(values, np.cumsum([n, m, v, bend]))
        law = self.law.with_values(np.concatenate([own, bent]))
        return replace(
            self, law=law, theta=tuple(theta.tolist()), b=tuple(b.tolist()), warmer=tuple(warmer.tolist())
        )

    @property
    def parameters(self) -> Array:
        """Of the shift, as it names them. Shape (parameters,)."""
        return self.shift.from_positive(np.array(self.theta))

    @property
    def log_shift(self) -> Array:
        """Ln a of every sweep. Shape (sweeps,)."""
        return self.shift.log_shift(self.parameters, self._moved_c)

    @property
    def off(self) -> Array:
        """How far temperatures were moved, in standard deviations. Shape (sweeps,), or (0,) where exact."""
        return np.log(np.array(self.warmer))

    @property
    def _moved_c(self) -> Array | None:
        """None where free factors are of sweeps and not of a temperature."""
        return self.shift.temperature_c + self.shift.error_k * self.off if self.warmer else None

    @property
    def shift_slope(self) -> Array:
        """Derivatives of `log_shift` to the logarithms of `theta`. Shape (sweeps, parameters)."""
        return self.shift.slope(self.parameters, self._moved_c) * self.shift.by_log(self.parameters)

    def vertical_place(self, member: int) -> int | None:
        """Which of `b` a sweep has."""
        at = self.shift.place_of(member)
        return at if self.b and at is not None else None

    def at(self, member: int) -> CoreLaw:
        """Shifted to one sweep's temperature."""
        place = self.vertical_place(member)
        b = 1.0 if place is None else self.b[place]
        return ShiftedLaw(self.law, float(np.exp(self.log_shift[member])), b)

    def chain(self, member: int) -> Array:
        """As `MemberLaws.chain`. Shape (names of the sweep's law, names)."""
        n, m, v, whole = self._own, len(self.theta), len(self.b), len(self.law.names)
        found = np.zeros((whole + 2, whole + m + v + len(self.warmer)))
        found[:n, :n] = np.eye(n)
        found[n:whole, n + m + v : whole + m + v] = np.eye(whole - n)
        found[whole, n : n + m] = self.shift_slope[member]
        moved = self._moved_c
        if moved is not None:
            by_k = self.shift.by_temperature(self.parameters, moved)[member]
            found[whole, whole + m + v + member] = by_k * self.shift.error_k
        place = self.vertical_place(member)
        if place is not None:
            found[whole + 1, n + m + place] = 1.0
        return found


@dataclass(frozen=True)
class OwnLaws(MemberLaws):
    """A law for each sweep: parameters are those of all of them, then the bends of all of them."""

    laws: tuple[CoreLaw, ...]
    points: tuple[int, ...]

    @property
    def kind(self) -> str:
        """Of every one of them."""
        return self.laws[0].kind

    @property
    def lengths(self) -> tuple[int, ...]:
        """Points of each sweep."""
        return self.points

    @property
    def bend_count(self) -> int:
        """Number of coefficients by which all the laws may bend."""
        return sum(law.bend_count for law in self.laws)

    def _places(self) -> list[tuple[NDArray[np.intp], NDArray[np.intp]]]:
        """Where each law's own parameters are, and its bend."""
        own, bend, found = 0, sum(len(law.names) - law.bend_count for law in self.laws), []
        for law in self.laws:
            n, m = len(law.names) - law.bend_count, law.bend_count
            found.append((np.arange(own, own + n), np.arange(bend, bend + m)))
            own, bend = own + n, bend + m
        return found

    def _spread(self, each: list[Array]) -> Array:
        found = np.zeros(sum(len(e) for e in each))
        for (own, bend), values in zip(self._places(), each, strict=True):
            found[own], found[bend] = values[: len(own)], values[len(own) :]
        return found

    @property
    def names(self) -> list[str]:
        """Each with its sweep's number."""
        found = [""] * sum(len(law.names) for law in self.laws)
        for k, ((own, bend), law) in enumerate(zip(self._places(), self.laws, strict=True)):
            for at, name in zip([*own, *bend], law.names, strict=True):
                found[at] = f"{name} [{k + 1}]"
        return found

    @property
    def values(self) -> Array:
        """In the order of `names`."""
        return self._spread([law.values for law in self.laws])

    @property
    def limits(self) -> list[Quantity]:
        """In the order of `names`."""
        each = [law.limits for law in self.laws]
        found = [each[0][0]] * sum(len(e) for e in each)
        for (own, bend), limits in zip(self._places(), each, strict=True):
            for at, q in zip([*own, *bend], limits, strict=True):
                found[at] = q
        return found

    @property
    def search_widths(self) -> Array:
        """Of the laws' own parameters."""
        return np.concatenate([law.search_widths for law in self.laws])

    def with_values(self, values: Array) -> Self:
        """Every law with other parameters, in the order of `names`. Shape (names,)."""
        laws = [
            law.with_values(np.concatenate([values[own], values[bend]]))
            for (own, bend), law in zip(self._places(), self.laws, strict=True)
        ]
        return replace(self, laws=tuple(laws))

    def at(self, member: int) -> CoreLaw:
        """The law of one sweep."""
        return self.laws[member]

    def chain(self, member: int) -> Array:
        """As `MemberLaws.chain`. Shape (names of the sweep's law, names)."""
        own, bend = self._places()[member]
        found = np.zeros((len(own) + len(bend), sum(len(law.names) for law in self.laws)))
        found[np.arange(len(found)), np.concatenate([own, bend])] = 1.0
        return found
