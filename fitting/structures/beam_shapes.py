"""Matrices of a beam of unit length over polynomials of its deflection and of its layers' stretching.

Unknowns are the coefficients of u_b, u_c, w, a and m over 0 < x < 1, a how far the faces move apart across
the core, m how far its middle rises beside them: of each first those that meet the conditions at the ends,
then those that a held end lets go where it yields. There the faces move as one, but where the upper one is
not held. Two more, p_b and p_c, are the faces' own shear: their sections turn by w' - p (Timoshenko).
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from math import comb

import numpy as np
from numpy.polynomial import Polynomial, legendre
from numpy.typing import NDArray

from fitting.arrays import Array

ORDER = 18
"""Polynomials of w, and of each u, that meet the conditions: ten modes to 1e-6."""
ORDER_OF_FORCED = 30
"""Where a force drives at a point, w'' has a kink there. Of a bare beam's receptance between modes 5 and 6
that leaves 0.02 % from one place to another, and 5 % of what little is left at the force's own place (with 18
it was 1.5 and 30 %)."""
PIECES = 40
"""Along the beam: for a core that is another one from place to place."""
Arms = tuple[float, float]
"""Half of each face's thickness over the distance of their middles: what its shear takes off the core's."""
NO_ARMS: Arms = (0.0, 0.0)
IN_A_PIECE = 8
"""Places of quadrature: the shear's square is nearly a cubic over a fortieth of the length."""

_X = Polynomial([0.0, 1.0])
_HELD = {
    "clamped-free": (_X**2, _X),
    "free-free": (Polynomial([1.0]), Polynomial([1.0])),
    "clamped-clamped": (_X**2 * (1 - _X) ** 2, _X * (1 - _X)),
}
"""Factors of w and of u."""
_RELEASED: dict[str, tuple[list[Polynomial], list[Polynomial]]] = {
    "clamped-free": ([_X**0, _X], [_X**0]),
    "free-free": ([], []),
    "clamped-clamped": ([_X**0, _X, _X**2, _X**3], [1 - _X, _X]),
}
"""Of w and of u where held ends yield."""


@dataclass(frozen=True)
class Shapes:
    """The polynomials of a beam, by the name of its ends as one piece."""

    ends: str
    order: int = ORDER

    @cached_property
    def _each(self) -> dict[str, tuple[Polynomial, list[Polynomial]]]:
        """Of each unknown the factor that meets the conditions, and what a held end lets go."""
        (w, u), (loose_w, loose_u) = _HELD[self.ends], _RELEASED[self.ends]
        loose = {"b": (u, loose_u), "c": (u, loose_u), "w": (w, loose_w), "a": (w, loose_w)}
        return loose | {"m": (w, []), "p_b": (u, []), "p_c": (u, [])}

    @cached_property
    def place(self) -> dict[str, slice]:
        """Of each among the unknowns."""
        found, start = {}, 0
        for name, (_, loose) in self._each.items():
            found[name] = slice(start, start + self.order + len(loose))
            start += self.order + len(loose)
        return found

    @property
    def size(self) -> int:
        """How many unknowns there are."""
        return self.place["p_c"].stop

    @cached_property
    def is_held(self) -> NDArray[np.bool_]:
        """Which of them meet the conditions at the ends. Shape (size,)."""
        n = self.order
        return np.concatenate([np.arange(n + len(loose)) < n for _, loose in self._each.values()])

    def is_of(self, which: str) -> NDArray[np.bool_]:
        """Which unknowns are of one of them. Shape (size,)."""
        found = np.zeros(self.size, bool)
        found[self.place[which]] = True
        return found

    @property
    def held_ends(self) -> tuple[float, ...]:
        """Where it is clamped."""
        return {"clamped-free": (0.0,), "free-free": (), "clamped-clamped": (0.0, 1.0)}[self.ends]

    @property
    def rising(self) -> int:
        """The unknown that is w = x, of a beam with a held end."""
        return self.place["w"].start + self.order + 1

    def level(self, which: str) -> slice:
        """The unknowns that together are 1, of a layer's stretching where an end is held."""
        return slice(self.place[which].start + self.order, self.place[which].stop)

    def rows(self, which: str, x: Array, derivative: int = 0) -> Array:
        """Values at some places, or derivatives, of every unknown. Shape (size, places)."""
        factor, loose = self._each[which]
        # By Leibniz: multiplied out, high orders would cancel to a thousandth at the far end.
        held = sum(
            comb(derivative, j) * _derived(factor, j)(x) * _legendre(derivative - j, x, self.order)
            for j in range(derivative + 1)
        )
        found = np.zeros((self.size, len(x)))
        found[self.place[which]] = np.vstack([held, *(_derived(p, derivative)(x)[None] for p in loose)])
        return found

    def turning(self, x: Array, arms: Arms) -> Array:
        """W' less what the faces' own shear takes off, as the core's shear has it. Shape (size, places)."""
        below, above = arms
        return self.rows("w", x, 1) - below * self.rows("p_b", x) - above * self.rows("p_c", x)

    def slip(self, x: Array, weight: Array, arms: Arms) -> Array:
        """The core's shear: (u_c - u_b)^2, 2 (u_c - u_b) t and t^2, integrated, t its faces' `turning`.

        Shape (3, size, size).
        """
        across = self.rows("c", x) - self.rows("b", x)
        turning = self.turning(x, arms)
        crossed = _both(across, turning, weight)
        return np.array([_both(across, across, weight), crossed + crossed.T, _both(turning, turning, weight)])


@dataclass(frozen=True)
class BeamMatrices:
    """Over all unknowns. Shapes (parts, size, size), (size,)."""

    K_0: Array
    """Stretching of u_b and u_c, bending of both as Euler has it, and what a pull along is to w."""
    K_1: Array
    """Three of slip, three of a free layer, three of what moving apart adds to slip, and stretch across."""
    M: Array
    """Of w, u_b and u_c, three of the core between, two of faces that turn, and seven of moving apart."""
    load: Array
    """Of a base that lifts with unit acceleration."""


@lru_cache(maxsize=8)
def shapes_of(ends: str, order: int = ORDER) -> Shapes:
    """By the name of its ends as one piece."""
    return Shapes(ends, order)


@lru_cache(maxsize=64)
def matrices_of(ends: str, share: float = 0.0, arms: Arms = NO_ARMS, order: int = ORDER) -> BeamMatrices:
    """For unit coefficients; the substrate takes `share` of what the faces move apart.

    How a core stretches across is left out: it is one of its sizes.
    """
    s = shapes_of(ends, order)
    x, weight = gauss(2 * order)
    w, b, c = (s.rows(name, x) for name in ("w", "b", "c"))
    slope, bend, stretch = s.rows("w", x, 1), s.rows("w", x, 2), s.rows("b", x, 1)
    a, parting, bent_apart = (s.rows("a", x, d) for d in (0, 1, 2))
    turning, below, above = s.turning(x, arms), s.rows("p_b", x), s.rows("p_c", x)
    m, rising = (s.rows("m", x, d) for d in (0, 1))
    across = c - b

    def squared(a: Array) -> Array:
        return square(a, weight)

    def mixed(a: Array, other: Array) -> Array:
        found = _both(a, other, weight)
        return found + found.T

    total = c + b
    return BeamMatrices(
        K_0=np.array(
            [
                squared(stretch),
                squared(s.rows("c", x, 1)),
                squared(bend - share * bent_apart),
                squared(bend + (1 - share) * bent_apart),
                squared(slope),
            ]
        ),
        K_1=np.array(
            [
                *(*s.slip(x, weight, arms), squared(stretch), -mixed(stretch, bend), squared(bend)),
                *(mixed(across, parting), mixed(turning, parting), squared(parting)),
                *(mixed(across, rising), mixed(turning, rising), mixed(parting, rising), squared(rising)),
                np.zeros((s.size, s.size)),
            ]
        ),
        M=np.array(
            [
                *(squared(w), squared(b), squared(c), squared(total), mixed(total, slope), squared(slope)),
                squared(slope - share * parting - below),
                squared(slope + (1 - share) * parting - above),
                *(mixed(w, a), squared(a), mixed(w, m), mixed(a, m), squared(m)),
                *(squared(across), mixed(across, slope)),
            ]
        ),
        load=-(w @ weight),
    )


@lru_cache(maxsize=8)
def slip_by_pieces(ends: str, arms: Arms, order: int = ORDER) -> Array:
    """Of `PIECES` of the beam, as `Shapes.slip` has it. Shape (pieces, 3, size, size)."""
    s, edges = shapes_of(ends, order), np.linspace(0, 1, PIECES + 1)
    x, weight = np.hstack([gauss(IN_A_PIECE, low, high) for low, high in pairwise(edges)])
    # Their polynomials at all places at once: at eight at a time, calls took longer than sums.
    across, turning = (
        rows.reshape(s.size, PIECES, IN_A_PIECE).swapaxes(0, 1)
        for rows in (s.rows("c", x) - s.rows("b", x), s.turning(x, arms))
    )
    weight = weight.reshape(PIECES, 1, IN_A_PIECE)
    crossed = (across * weight) @ turning.swapaxes(1, 2)
    return np.stack(
        [
            (across * weight) @ across.swapaxes(1, 2),
            crossed + crossed.swapaxes(1, 2),
            (turning * weight) @ turning.swapaxes(1, 2),
        ],
        axis=1,
    )


def gauss(points: int, low: float = 0.0, high: float = 1.0) -> tuple[Array, Array]:
    """Places and weights of Gauss' quadrature between two places. Shape (points,) each."""
    x, weight = _leggauss(points)
    return low + (x + 1) / 2 * (high - low), weight / 2 * (high - low)


@lru_cache(maxsize=8)
def _leggauss(points: int) -> tuple[Array, Array]:
    """Over -1 to 1. Shape (points,) each."""
    return legendre.leggauss(points)


def square(a: Array, weight: Array) -> Array:
    """Integrals of products of rows. `a` of shape (k, places); returns (k, k)."""
    return _both(a, a, weight)


def _derived(p: Polynomial, times: int) -> Polynomial:
    return p.deriv(times) if times else p


def _legendre(derivative: int, x: Array, order: int) -> Array:
    """Of Legendre's polynomials over 0 < x < 1. Shape (order, places)."""
    return _legendre_at(derivative, np.asarray(x, dtype=float).tobytes(), order)


@lru_cache(maxsize=64)
def _legendre_at(derivative: int, places: bytes, order: int) -> Array:
    """The same once for all unknowns that are asked at the same places."""
    found = legendre.legval(2 * np.frombuffer(places) - 1, _coefficients(derivative, order))
    found.setflags(write=False)
    return np.asarray(found)


@lru_cache(maxsize=8)
def _coefficients(derivative: int, order: int) -> Array:
    """Of each, a column; d/dx is twice d/dt of t = 2 x - 1. Shape (terms, order)."""
    each = np.eye(order)
    return np.asarray(legendre.legder(each, derivative, scl=2.0) if derivative else each)


def _both(a: Array, b: Array, weight: Array) -> Array:
    return np.asarray((a * weight) @ b.T)
