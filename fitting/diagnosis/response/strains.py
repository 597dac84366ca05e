"""How strained the core is at every point of a sweep, softened or not: what softening with strain goes by."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.plate_answer import Asked, StrainedCore
from fitting.diagnosis.problem.plate_poles import PLAIN
from fitting.diagnosis.problem.small_problem import FEW
from fitting.diagnosis.response.core_poles import away_from_poles, compliances
from fitting.effects.given import Strain, Ways
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw
from fitting.laws.kraus import strained
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_SOFTENED = np.array([-0.3, 0.0, 0.25, 0.5])
"""Shares by which the core softens where its strain is computed: a cubic through them serves all between.

Where little damps the plate its strain rises near a pole as one over the distance, and the pole moves as the
core softens: times the distance it is smooth, in the frequency and in the share.
"""
_GAINED = np.array([0.0, 0.15, 0.3])
"""The same of the loss modulus that it gains, in shares of sqrt(G' G''): a parabola through them serves.

A rubber that loses a fifth of its modulus gains some 0.25. Times the squared distance from its pole a slope
is quadratic in the gain, as the pole moves with it: a line left slopes 4 to 6 % off.
"""
_MOST_LOG = 50.0
"""Of the logarithm of a strain: no core is so strained, and beyond it numbers end."""
_KEPT = 8
"""Tables of the core's strain for unknowns just asked for; more are begun anew. A choice."""


@dataclass
class Reference:
    """The strain that softening is told for: the largest at 1 g, or at 1 N of a force, when first asked for.

    Sweeps of one core have one, of the first of them: shear pairs with other masses strain otherwise.
    """

    strain: float | None = None


FromPoles = Callable[[Array, Array], Array]
"""Distance from the poles of every point, its core softened by its share and gained.

Shape (..., points) each.
"""


@dataclass(frozen=True)
class _Table:
    """Strain for a unit of what drives it, and the cores that it was read of, one a gain and share.

    Cubics in the softening, the first without any gain of loss, the second, where there is one, with the
    largest.
    """

    cubics: Array
    """Of ln strain times the distance from the poles. Shape (gains, 4, points)."""
    from_poles: FromPoles
    away: Array
    """From the poles, at the nodes of every gain and share. Shape (gains 4 nodes,)."""
    core: StrainedCore


Changes = Callable[[], Change]
Moved = Callable[[StrainedCore], Array]
"""Derivatives of ln strain to what moves, at the nodes of a table. Shape (any, nodes)."""
A = TypeVar("A", Array, Complex)


class Strains:
    """Of one sweep on a plate."""

    def __init__(self, problem: DiagnosisProblem, plate: EnrichedReducedPlate, reference: Reference) -> None:
        self._problem, self._plate, self._reference = problem, plate, reference
        self._known: dict[bytes, _Table] = {}
        self._latest: tuple[bytes, Strain] | None = None

    def under(self, law: CoreLaw, key: bytes, changes: Changes) -> Strain:
        """At every point, softened by a share, over the reference; `changes` of the plate go by `key`.

        Solved for when it is first asked for, and once: who looks for how far a core softens asks many times.
        The latest is kept, by which what was found of it is known again.
        """
        whole = law.values.tobytes() + key
        if self._latest is None or self._latest[0] != whole:
            self._latest = whole, self._of(lambda gains: self._table(law, key, changes, gains))
        return self._latest[1]

    def along(self, law: CoreLaw, key: bytes, changes: Changes, moved: Moved) -> Ways:
        """How what `under` gives changes as what it is of moves."""

        def ways(softened: Array, gained: Array | None = None) -> Array:
            table = self._table(law, key, changes, gained is not None)
            more = np.zeros(len(softened)) if gained is None else gained
            # As a pole moves this changes as one over the distance, and as its conjugate's.
            cubics = [self._cubics(each * table.away**2) for each in moved(table.core)]
            return np.array([_at(c, softened, more) for c in cubics]) / table.from_poles(softened, more) ** 2

        return ways

    def of_laws(self, G: Sequence[Complex]) -> Moved:
        """Of moduli in Pa under laws a step away. Shape (nodes,) each, of `dense`."""

        def moved(core: StrainedCore) -> Array:
            gains = len(core.G) > len(_SOFTENED) * len(G[0])
            return core.by_modulus(
                np.array([np.concatenate(_softened(each, gains=gains)) for each in G]) - core.G
            )

        return moved

    def _of(self, table: Callable[[bool], _Table]) -> Strain:
        """Asked whether the loss gains."""
        drive = self._problem.points.straining
        of = cache(table)

        def strain(softened: Array, gained: Array | None = None) -> Array:
            gains = gained is not None
            known, more = of(gains), np.zeros(softened.shape) if gained is None else gained
            away = known.from_poles(softened, more)
            logs_here = _at(known.cubics, softened, more)
            assert self._reference.strain is not None
            # A step far beyond what the table is of would overflow; what it leads to is refused anyway.
            logs_here = np.clip(logs_here, -_MOST_LOG, _MOST_LOG)
            return np.asarray(np.exp(logs_here) / away * drive / self._reference.strain)

        return strain

    def _table(self, law: CoreLaw, key: bytes, changes: Changes, gains: bool) -> _Table:
        key = law.values.tobytes() + key + bytes([gains])
        if key not in self._known:
            dense = self._problem.dense
            G, change = law.modulus(dense.omega), changes()
            moduli = _softened(G, gains=gains)
            core = StrainedCore(
                self._plate, np.tile(dense.omega, len(moduli)), np.concatenate(moduli), change
            )
            from_poles, away = self._from_poles(G, change, moduli)
            table = _Table(self._cubics(np.log(core.strain * away)), from_poles, away, core)
            if len(self._known) >= _KEPT:
                self._known.clear()
            self._known[key] = table
            if self._reference.strain is None:
                unit = PUBLISHED_G_M_S2 if self._problem.points.drive == "base" else 1.0
                none = np.zeros(len(dense.points))
                largest = np.exp(table.cubics[0, -1]) / table.from_poles(none, none)
                self._reference.strain = float(largest.max()) * unit
        return self._known[key]

    def _from_poles(self, G: Complex, change: Change, moduli: Sequence[Complex]) -> tuple[FromPoles, Array]:
        """Distance from the poles at the points, and at the nodes of each of the `moduli` in turn.

        Of what is small and solved at every point all poles are known exactly, in milliseconds.
        Shapes (nodes,) of `G` and each modulus, (moduli nodes,).
        """
        dense = self._problem.dense
        if isinstance(dense, EveryPoint) and len(self._plate.load) <= FEW:
            by_G = compliances(self._plate, change, dense.omega)
            return (
                lambda softened, gained: away_from_poles(by_G, strained(G, softened, gained)),
                np.concatenate([away_from_poles(by_G, each) for each in moduli]),
            )
        squares: Complex = np.array([self._poles(each, change) for each in moduli]) ** 2
        gains = len(moduli) // len(_SOFTENED)
        cubics = _through(squares.reshape(gains, len(_SOFTENED), *squares.shape[1:]))

        def away(softened: Array, gained: Array) -> Array:
            return dense.away(
                lambda mine, at: _at(cubics[:, :, mine, None], softened[..., None, at], gained[..., None, at])
            )

        return away, np.concatenate([self._away_at_nodes(p) for p in squares])

    def _away_at_nodes(self, squares: Complex) -> Array:
        """The same at the nodes, from poles that are the same for all. Shapes (poles,) to (nodes,)."""
        return self._problem.dense.away(lambda mine, at: squares[mine, None], at_nodes=True)

    def _poles(self, G: Complex, change: Change) -> Complex:
        """That the nodes were made for, under a modulus given there, of the plate as something changes it."""
        dense, poles = self._problem.dense, self._problem.fine.poles
        if poles is None or not len(dense.poles):
            return dense.poles
        known = poles.known(dense, G).on(self._plate.group == PLAIN)
        asked = Asked(self._plate, dense.omega, G, change, known, with_pitch=False)
        return known.followed(asked.matrices)[0]

    def _cubics(self, values: Array) -> Array:
        """Through values at the nodes, share by share and gain by gain. To shape (gains, 4, points)."""
        dense = self._problem.dense
        each = values.reshape(-1, len(dense.omega)) @ dense.plain.T
        return _through(each.reshape(-1, len(_SOFTENED), len(dense.points))).astype(float)


def _softened(G: Complex, *, gains: bool) -> list[Complex]:
    """Moduli of every core of a table, one a gain and share, under a law's `G`. Shape (nodes,) each."""
    return [strained(G, s, g) for g in (_GAINED if gains else _GAINED[:1]) for s in _SOFTENED]


def _through(values: A) -> A:
    """Coefficients of cubics in the share through values at `_SOFTENED`. Shape (gains, 4, ...), as given."""
    return np.linalg.solve(np.vander(_SOFTENED), values)  # type: ignore[return-value]


def _at(cubics: A, softened: Array, gained: Array) -> A:
    """Cubics of shape (gains, 4, ...) at some places; shape (...) joined with that of `softened`."""

    def at(cubic: A) -> A:
        return ((cubic[0] * softened + cubic[1]) * softened + cubic[2]) * softened + cubic[3]

    if len(cubics) == 1:
        return at(cubics[0])
    x = gained / _GAINED[-1]
    none, half, all_ = (at(c) for c in cubics)
    return none * (1 - x) * (1 - 2 * x) + half * 4 * x * (1 - x) + all_ * x * (2 * x - 1)
