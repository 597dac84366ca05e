"""Everything about one set of data that does not change from candidate to candidate."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Self

import numpy as np

from fitting.arrays import Array, Complex
from fitting.data.times import is_timed
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.narrow_resonances import Errs, narrow_of
from fitting.diagnosis.problem.nodes import HZ_A_NODE, Nodes
from fitting.diagnosis.problem.plate_poles import PlatePoles, cuts_between
from fitting.diagnosis.problem.pole_following import KnownPoles
from fitting.discrepancy.model_error import model_error_at
from fitting.effects.added_mass import AddedMassEffect
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.identification.adjusted import Adjusted, adjusted
from fitting.laws import CoreLaw
from fitting.nuisances.narrow import NarrowResonances
from fitting.nuisances.nuisances import Nuisances, nuisances_of
from fitting.reduced.rational import RationalSweep
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.sweep import Sweep
from fitting.widened.condensing import CONDENSED, Training, condensed
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

DENSE, FINE, COARSE = 16, 10, 6
"""Nodes a cluster of frequencies: of strains, for fits, and for a first look."""
_SIZES = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Times the modulus begun with, that a condensed plate answers for: a decade, with a margin."""
_ANGLES = (0.2, 0.6, 1.0)
"""Of the modulus' argument, rad."""
_EVERY = 2
"""Of the nodes, those that a condensed plate answers at."""
_MOST = 500
"""Frequencies that it answers at: of a small structure every point is a node, and its motions are few."""
_SMALL = 40
"""Columns of a plate that is not condensed: a small structure, or one whose basis was never large."""
_PLACES, _REACH, _PLACES_SEED = 4, 2.0, 5
"""Of the tolerances' box, that a condensed plate answers for: how many, how far in standard deviations."""
_BESIDE = 0.25
"""Of a cluster's width: so far beside it poles are taken out of strains; what is further, nodes follow."""
_SECONDS_A_POINT = 10.0
"""Pace assumed where no time is kept."""


@dataclass(frozen=True)
class NodeGrid:
    """Nodes and the unchanged plate's exact answer there."""

    nodes: Nodes
    rational: RationalSweep
    poles: PlatePoles | None = None
    """Of the unchanged plate, as the nodes are made for them."""

    def known_poles(self, G: Complex) -> KnownPoles | None:
        """Those of the unchanged plate, the modulus given at the nodes. Shape (nodes,)."""
        return None if self.poles is None else self.poles.under(self.nodes, G)[0]

    def unchanged_poles(self, G: Complex) -> Complex:
        """Of the unchanged plate under a modulus, given at the nodes. Shape (poles,), of `G` (nodes,)."""
        return self.nodes.poles if self.poles is None else self.poles.under(self.nodes, G)[1]


@dataclass(frozen=True)
class DiagnosisProblem:
    """A sweep with the plate it was measured on."""

    sweep: Sweep
    specimen: StatedSpecimen
    plate: EnrichedReducedPlate
    points: Points
    rational: RationalSweep
    """The unchanged plate's exact answer at every point."""
    fine: NodeGrid
    coarse: NodeGrid
    dense: Nodes
    """For strains of the core, which are squares of motions."""
    nuisances: Nuisances
    """The stated numbers that may move."""
    found: Array | None = field(default=None, kw_only=True)
    """Nuisance values at which the model error is evaluated; None: as stated. Shape (numbers,)."""

    @classmethod
    def of(
        cls,
        sweep: Sweep,
        specimen: PlateSpecimen,
        plate: EnrichedReducedPlate,
        rational: Callable[[Array], RationalSweep],
        reference: PlateSpecimen | None = None,
    ) -> "DiagnosisProblem":
        """`rational` gives the unchanged plate's sum on an ascending grid in rad/s, shape (grid,).

        `plate` and `rational` are of `reference`, a specimen like this one, where that is given.
        """
        assert specimen.core is not None
        cuts = cuts_between(plate, specimen.core.law, sweep.omega)
        grids = [
            Nodes.of(sweep.omega, FINE, cuts=cuts),
            Nodes.of(sweep.omega, COARSE, cuts=cuts, hz_a_node=2 * HZ_A_NODE),
        ]
        omega = np.unique(np.concatenate([sweep.omega, *(g.omega for g in grids)]))
        whole = rational(omega)

        def at(some: Array) -> RationalSweep:
            return whole.at(np.searchsorted(omega, some * (1 - 1e-12)))

        fine, coarse = (NodeGrid(g, at(g.omega)) for g in grids)
        points, dense = points_of(sweep, specimen), Nodes.of(sweep.omega, DENSE, cuts=cuts)
        nuisances = nuisances_of(specimen, plate, has_phase=sweep.has_phase, reference=reference)
        return cls(sweep, specimen, plate, points, at(sweep.omega), fine, coarse, dense, nuisances)

    @cached_property
    def each_point(self) -> NodeGrid:
        """Every point for itself, as where an effect gives each a modulus of its own."""
        return NodeGrid(EveryPoint.at(self.sweep.omega), self.rational)

    @property
    def files_without_time(self) -> tuple[int, ...]:
        """Numbers, from 1, of those among several files whose points carry no time while others' do."""
        return ()

    @property
    def stated_law(self) -> CoreLaw:
        """The specimen's: where identification starts."""
        assert self.specimen.core is not None
        return self.specimen.core.law.lifted()

    def condensed(self, law: CoreLaw, sides: Sequence[Array] = ()) -> "DiagnosisProblem":
        """The same, its plate condensed to moduli within a decade or so of a law, and to the tolerances.

        `sides` are further loads that it shall answer. Shape (k,) each.
        """
        nothing = not len(self.plate.names) and not sides
        if nothing and (self.nuisances.change_nothing or len(self.plate.load) <= _SMALL):
            return self
        # With several sides each point has as many answers: fewer points have as much to say.
        omega = self.coarse.nodes.omega[:: _EVERY * max(2, len(sides)) // 2]
        if len(omega) > _MOST:
            omega = np.sort(omega)[np.linspace(0, len(omega) - 1, _MOST).astype(int)]
        size = np.abs(law.modulus(omega))
        factors = [s * np.exp(1j * angle) for s in _SIZES for angle in _ANGLES]
        G = np.concatenate([size * f for f in factors])
        random = np.random.default_rng(_PLACES_SEED)
        places = _REACH * random.standard_normal((_PLACES if self.nuisances else 0, len(self.nuisances)))
        changes = [self.nuisances.change(self.plate, z) for z in places]
        if self.nuisances.masses:
            # What sits on it is no part of the plate: its motions are stirred however exact all is.
            changes.append(self.nuisances.change(self.plate, self.as_stated))
            sides = [*sides, *(self.plate.row(m.x_m, m.y_m) for m in self.nuisances.masses)]
        around = np.tile(omega, len(factors))
        training = Training(around, G, changes, omega, law.modulus(omega))
        return replace(self, plate=condensed(self.plate, training, sides, self.left_out))

    @property
    def left_out(self) -> float:
        """Of the largest singular value, by its condensed plate."""
        return CONDENSED

    @property
    def resonances(self) -> Complex:
        """Poles of the structure without any effect, in and near the points, rad/s. Shape (poles,)."""
        return self.fine.nodes.poles

    @property
    def pickup_x_m(self) -> float:
        """How far from the clamp it is stated to be read; the plate's own pickup may be another one's."""
        stated = self.nuisances.specimen
        if isinstance(stated, PlateSpecimen) and stated.pickup_m is not None:
            return stated.pickup_m[0]
        return float(self.plate.pickup[0])

    @property
    def freedom(self) -> float:
        """How much more than usual the law may bend."""
        return 1.0

    @property
    def misfit(self) -> float:
        """Of the reading, relative: what a fit has left that nothing explains."""
        return 0.0

    @property
    def errs_in_level(self) -> bool:
        """Whether files differ by levels, of gain, phase and the core's modulus, where noise leaves more."""
        return False

    @property
    def errs_as_found(self) -> bool:
        """Whether the model error is evaluated at the fitted stated numbers (`as_found`).

        A struck plate's: its resonances are narrow, many and seen over hundreds of lines each.
        """
        struck = self.specimen.drive == "force" and len(self.nuisances) > 0
        return struck or len(self.nuisances.narrow) > 0

    @property
    def errs(self) -> Errs | None:
        """What the theory of its structure gets wrong of a resonance; None where that is of no account."""
        return partial(model_error_at, self.specimen) if isinstance(self.specimen, PlateSpecimen) else None

    def with_narrow(self, law: CoreLaw, sweeps: Sequence[Sweep] = ()) -> Self:
        """The same with where its narrow resonances lie, under a law, among its numbers.

        `sweeps`: all that are of its plate, its own alone by default.
        """
        if self.errs is None:
            return self
        narrow, plate = narrow_of(self.errs, self.plate, sweeps or [self.sweep], law)
        return self.moving_each_of(narrow, plate) if narrow else self

    def moving_each_of(self, narrow: NarrowResonances, plate: EnrichedReducedPlate) -> Self:
        """The same with where some resonances lie among its numbers; `plate` is its own with their sides."""
        return replace(self, plate=plate, nuisances=self.nuisances.with_narrow(narrow))

    def as_found(self, z: Array) -> "DiagnosisProblem":
        """The same, its model error evaluated at these stated numbers. `z` of shape (numbers,)."""
        return replace(self, found=np.array(z))

    def model_error(self, law: CoreLaw, v: Complex) -> Complex | None:
        """Changes of the velocity `v` by what the model gets wrong; None for a plate, see `model_error`.

        Shape (causes, points).
        """
        return None

    def feels(self, law: CoreLaw, v: Complex) -> Complex:
        """How the reading feels the core, d ln v / d ln G*, the specimen as stated. Shape (points,)."""
        G = law.modulus(self.sweep.omega)
        _, by_G = self.rational.with_derivative(G)
        return np.asarray(1j * self.sweep.omega * by_G * G * self.points.drive_amplitude / v)

    def adjusted(self, z: Array, errors: Array) -> tuple[Adjusted, ...]:
        """The stated numbers as a fit has them, and their errors, in standard deviations of tolerances.

        Shape (numbers,) each.
        """
        return adjusted(self.specimen, self.nuisances.each, z, errors)

    @property
    def as_stated(self) -> Array:
        """Where every stated number is what it is stated to be. Shape (numbers,)."""
        return np.zeros(len(self.nuisances))

    @cached_property
    def with_stated_fixed(self) -> "DiagnosisProblem":
        """The same, its stated numbers taken at their word: an evaluation takes half the time.

        Itself where they are few, or more than numbers of one plate.
        """
        if not self.nuisances.each:
            return self
        return replace(self, nuisances=replace(self.nuisances, each=(), narrow=NarrowResonances()))

    def around(self, law: CoreLaw, poles: PlatePoles | None = None) -> "DiagnosisProblem":
        """The same, its grids made for the poles that the plate has under a law.

        `poles` where they are at hand.
        """
        found = poles or PlatePoles(self.plate, law)

        def made_for(grid: NodeGrid) -> NodeGrid:
            return replace(grid, nodes=grid.nodes.around(found.near), poles=found)

        def close(low: float, high: float) -> Complex:
            p, reach = found.near(low, high), _BESIDE * (high - low)
            return p[(p.real > low - reach) & (p.real < high + reach)]

        fine, coarse = (made_for(g) for g in (self.fine, self.coarse))
        return replace(self, fine=fine, coarse=coarse, dense=self.dense.around(close))


def points_of(sweep: Sweep, specimen: StatedSpecimen) -> Points:
    """What effects may ask of a sweep's points."""
    timed = is_timed(sweep)
    if sweep.time_s is not None and timed:
        time = sweep.time_s - sweep.time_s.min()
    else:
        time = _SECONDS_A_POINT * np.argsort(np.argsort(sweep.frequency_hz, kind="stable")).astype(float)
    return Points(
        omega=sweep.omega,
        drive_amplitude=sweep.commanded_m_s2,
        time_s=time,
        timed=timed,
        has_phase=sweep.has_phase,
        reads=specimen.reads,
        drive=specimen.drive,
        force_n=np.abs(sweep.base_m_s2)
        if specimen.drive == "force" and sweep.base_m_s2 is not None
        else None,
        segment=sweep.segment,
        level_m_s2=_another_level(sweep) if specimen.drive == "base" else None,
        mass_kg=specimen.carried_kg,
    )


def _another_level(sweep: Sweep) -> Array | None:
    """What the base did; None where that is what was commanded."""
    return None if np.array_equal(sweep.level_m_s2, sweep.commanded_m_s2) else sweep.level_m_s2


def spans_of(problem: DiagnosisProblem, effects: Sequence[Effect]) -> list[Span]:
    """What a problem's plate must span for some effects and for what is stated to sit on it."""
    spans = {s.name: s for e in effects for s in e.spans}
    if problem.nuisances.masses:
        spans |= {s.name: s for s in AddedMassEffect.spans}
    return list(spans.values())
