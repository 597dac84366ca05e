"""What a sweep reads of a plate with some effects, and how that changes with law and unknowns.

The stated numbers come first among the unknowns (`fitting.nuisances.nuisances`), then those of each effect.

The unchanged plate is exact at every point (a rational sum in G*). What effects change of the plate is
solved at a few nodes and interpolated; at every point where an effect gives each a modulus of its own.
Channels, sharp factors, a part that swings (`swinging_part`) and the law itself act at every point.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import reduce
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid, spans_of
from fitting.diagnosis.problem.plate_answer import Asked, Motions, PlateAnswer, Receptance, motions
from fitting.diagnosis.problem.plate_poles import PLAIN
from fitting.diagnosis.response.at_one_place import At, ByChange, OfPlate
from fitting.diagnosis.response.channels import Channels
from fitting.diagnosis.response.plate_changes import PlateChanges
from fitting.diagnosis.response.point_modulus import PointModulus
from fitting.diagnosis.response.strains import Reference
from fitting.diagnosis.response.swinging_part import SwingingPart, WithPart
from fitting.diagnosis.response.unknowns import Unknowns, stepped
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class SweepResponse:
    """The sweep of a problem under a law and effects: a `Response`."""

    derivatives_cost_extra: ClassVar[bool] = True

    def __init__(
        self,
        problem: DiagnosisProblem,
        effects: Sequence[Effect],
        grid: NodeGrid | None = None,
        plate: EnrichedReducedPlate | None = None,
        reference: Reference | None = None,
        *,
        every: bool = False,
    ) -> None:
        """Where they are at hand: `plate`, as far as these effects need it, and softening's `reference`.

        `every`: derivatives to unknowns that a fit leaves alone too; else they are zero.
        """
        self.problem, self.effects, self.nuisances = problem, tuple(effects), problem.nuisances
        self._unknowns = Unknowns(len(self.nuisances), self.effects)
        self.parameters = self._unknowns.parameters
        self._channels = Channels(problem, self._unknowns)
        spans = spans_of(problem, effects)
        self.plate: EnrichedReducedPlate = plate or problem.plate.take(spans)
        if grid is problem.coarse and grid is not problem.fine:
            self.plate = self.plate.roughly
        swings = [k for k, e in enumerate(self.effects) if e.sharp]
        self._part: SwingingPart | None = None
        if swings:
            of_base = problem.points.drive == "base"
            self._part = SwingingPart(self._unknowns, swings[0], problem.points.omega, at_base=of_base)
        self._changes = self._straining = PlateChanges(problem, self._unknowns, self.plate, without=swings)
        if swings and any(s.strains for s in spans):
            self._straining = PlateChanges(problem, self._unknowns, self.plate.with_part)
        of_strain = self._straining, spans, reference or Reference()
        self._modulus = PointModulus(problem, self._unknowns, *of_strain)
        self._pitching = [k for k, e in enumerate(self.effects) if type(e).pitch is not Effect.pitch]
        self._fitted = [n for n, q in enumerate(self.parameters) if every or not q.fixed]
        self._moving_it = [n for k in self._changes.effects for n in self._fitted_of(k)]
        self._of_part = self._fitted_of(self._part.of) if self._part else []
        self.grid = grid or problem.fine
        if self._modulus.effects:
            # Each point has a modulus of its own: nothing is smooth between them.
            self.grid = problem.each_point
        self._last: tuple[bytes, OfPlate] | None = None
        self._latest: tuple[CoreLaw, Array, At] | None = None
        self._ready: tuple[Array, Asked, Motions] | None = None

    def velocity(self, law: CoreLaw, u: Array) -> Complex:
        """Phasors in m/s. Shape (points,)."""
        return self._at(law, u).v

    def with_derivatives(self, law: CoreLaw, u: Array) -> tuple[Complex, Complex]:
        """Phasors, and their derivatives to log parameters and then to `u`. Shape (parameters, points)."""
        at = self._with_slopes(law, u)
        by_law = self._modulus.by_law(law, u) * at.per_G
        count = len(self.nuisances)
        by_z = self._by_stated(law, u, at) if count else np.zeros((0, len(at.raw)))
        of_effects = [k for k in self._fitted if k >= count]
        raw = np.zeros((len(by_law) + len(self.parameters), len(at.raw)), complex)
        raw[: len(by_law)] = by_law
        raw[len(by_law) : len(by_law) + count] = by_z
        for k in of_effects:
            raw[len(by_law) + k] = self._by(k, law, u, at)
        moved = self._channels.along(at.raw, at.v, raw, u)
        for k in of_effects:
            moved[len(by_law) + k] += self._channels.by(k, at.raw, u)
        if count:
            by_reading = self.nuisances.by_reading(at.v, self.problem.points.omega, u[self._unknowns.stated])
            for k, d in by_reading.items():
                moved[len(by_law) + k] += d
        return at.v, moved

    def signatures(self, law: CoreLaw, known: Array, starts: Sequence[Array]) -> Complex:
        """To first order, what the last effect changes as it comes in. Shape (starts, points).

        It changes the plate alone; `known` are the unknowns of the others.
        """
        others = SweepResponse(self.problem, self.effects[:-1], self.grid)
        at = others._at(law, known)
        grid, last = others.grid, self.effects[-1]
        found = [others._changes.of(k, known, self.plate) for k in others._changes.effects]
        G = others._at_nodes(law, at.plate.G)
        change = reduce(Change.and_then, [*found, *self._changes.stated(known)], Change())
        asked = self._asked(G, change, others._place(self.plate, known), grid)
        each = [self._changes.moving(last.coming_in(self.plate, u)) for u in starts]
        # What is sharp starts at many frequencies in one place: one change serves them all.
        of = [np.asarray(c.M).tobytes() if last.sharp else k for k, c in enumerate(each)]
        number = {key: n for n, key in enumerate(dict.fromkeys(of))}
        by_start = [(each[of.index(key)], Change(), 1.0) for key in number]
        solved = PlateAnswer(asked, motions([asked])[0], by_start)
        heave, turned = others._along(solved, at.plate.part, lambda r: r.by_u)
        raw = at.per_x * (heave + at.pitch * turned)
        if last.sharp:
            factors = [last.sharply(self.problem.points.omega, u) for u in starts]
            raw = raw[[number[key] for key in of]] * np.array(factors)
        return others._channels.along(at.raw, at.v, raw, known)

    # The parts of the response.

    def _at(self, law: CoreLaw, u: Array) -> At:
        """The latest is kept: derivatives are asked for where the phasors were."""
        if self._latest is None or self._latest[0] is not law or not np.array_equal(self._latest[1], u):
            self._latest = law, u.copy(), self._at_anew(law, u)
        return self._latest[2]

    def _at_anew(self, law: CoreLaw, u: Array) -> At:
        points = self.problem.points
        omega, a = points.omega, points.drive_amplitude
        plate = self._of_plate(law, u)
        pitch = np.zeros(len(omega), complex)
        for k in self._pitching:
            h = self.effects[k].pitch(omega, self._unknowns.of(k, u))
            pitch = pitch + (h if h is not None else 0.0)
        per_x: Complex = np.asarray(1j * omega * a, dtype=complex)
        lever = self.problem.pickup_x_m * a / (1j * omega)
        raw = per_x * (plate.x + pitch * plate.turned) + lever * pitch
        if points.reads == "absolute":
            raw = raw + a / (1j * omega)
        return At(self._channels.read(raw, u), raw, per_x, pitch, lever, plate)

    def _with_slopes(self, law: CoreLaw, u: Array) -> At:
        """The same, its plate's derivatives worked out."""
        at = self._at(law, u)
        if at.plate.solved is not None and at.plate.by is None:
            assert self._last is not None
            plate = self._slopes_of(at.plate, u)
            at = replace(at, plate=plate)
            self._last, self._latest = (self._last[0], plate), (law, u.copy(), at)
        return at

    def _of_plate(self, law: CoreLaw, u: Array) -> OfPlate:
        """What goes with the plate and its core: one for all that only turns its base or reads it."""
        G_law = self._modulus.of_law(law)
        key = self._key(G_law, u)
        if self._last is None or self._last[0] != key:
            self._last = key, self._of_plate_anew(law, u)
        return self._last[1]

    def _of_plate_anew(self, law: CoreLaw, u: Array) -> OfPlate:
        G = self._modulus.at(law, u)
        x, slope = self.problem.rational.with_derivative(G)
        if not self._moves:
            return OfPlate(G, x, slope, np.zeros(len(G), complex), None, None, None)
        G_nodes = self._at_nodes(law, G)
        asked, moved = self._solved(u, G_nodes)
        solved, nodes = PlateAnswer(asked, moved), self.grid.nodes
        pitch = 0 * G_nodes if solved.pitch is None else solved.pitch.value
        changed = np.array([solved.heave.value - self.grid.rational.displacement(G_nodes), pitch])
        more, turned = nodes.spread(changed, self.grid.unchanged_poles(G_nodes), solved.poles)
        x = x + more
        if self._part is None:
            return OfPlate(G, x, slope, turned, (asked, moved), None, None)
        of_place = self._spread(np.array([r.value for r in solved.of_place]), solved)
        part = self._part.on(self.plate, u, x, turned, *of_place)
        return OfPlate(G, part.heave.x, slope, part.turned.x, (asked, moved), None, part)

    def _along(
        self, solved: PlateAnswer, part: WithPart | None, rows: Callable[[Receptance], Complex]
    ) -> tuple[Complex, Complex]:
        """Derivatives of the answers to a base that moves, or to a force, and to one that turns.

        `rows` takes a receptance's. Shape (any, points) each.
        """
        heave = self._spread(rows(solved.heave), solved)
        turned = 0 * heave if solved.pitch is None else self._spread(rows(solved.pitch), solved)
        if part is None:
            return heave, turned
        return part.along(heave, turned, *(self._spread(rows(r), solved) for r in solved.of_place))

    def _spread(self, values: Complex, solved: PlateAnswer) -> Complex:
        """From the nodes to every point of what has the poles of the changed plate alone, once or twice."""
        return self.grid.nodes.spread(values, solved.poles, solved.poles)

    def _slopes_of(self, plate: OfPlate, u: Array) -> OfPlate:
        """The same with its derivatives."""
        assert plate.solved is not None
        asked, moved = plate.solved
        nearby = []
        for n in self._moving_it:
            k, h = self._unknowns.owner(n), self._unknowns.step(n, u)
            up, down = (self._changes.of(k, stepped(u, n, s * h), self.plate) for s in (1, -1))
            nearby.append((up, down, 2 * h))
        stated = (self.nuisances, u[self._unknowns.stated]) if self.nuisances else None
        solved = PlateAnswer(asked, moved, nearby, stated)
        heave, turned = self._along(
            solved, plate.part, lambda r: np.concatenate([r.by_G[None], r.by_z, r.by_u])
        )
        by = ByChange(heave[1:], turned[1:])
        if self._part is not None and plate.part is not None and self._of_part:

            def spread(values: Complex) -> Complex:
                return self._spread(values, solved)

            own = [self._part.by_own(n, self.plate, u, moved, spread, plate.part) for n in self._of_part]
            by = ByChange(
                np.vstack([by.heave, *(heave for heave, _ in own)]),
                np.vstack([by.turned, *(turned for _, turned in own)]),
            )
        return replace(plate, slope=heave[0], turned_slope=turned[0], by=by)

    def _at_nodes(self, law: CoreLaw, G: Complex) -> Complex:
        """The modulus at the nodes, of one at every point."""
        return G if self._modulus.effects else law.modulus(self.grid.nodes.omega)

    def _solved(self, u: Array, G: Complex) -> tuple[Asked, Motions]:
        """What was asked at the nodes, and how it moves."""
        ready, self._ready = self._ready, None
        if ready is not None and np.array_equal(ready[0], u) and np.array_equal(ready[1].G, G):
            return ready[1:]
        asked = self._asked(G, self._changes.every(u), self._place(self.plate, u))
        return asked, motions([asked])[0]

    @property
    def _moves(self) -> bool:
        """Whether anything changes the plate or the base's motion, or swings on it."""
        acts = self._changes.effects or self._pitching or self._part
        return bool(acts or not self.nuisances.change_nothing)

    def _fitted_of(self, k: int) -> list[int]:
        """Unknowns of effect k that derivatives are asked to."""
        own = self._unknowns.slices[k]
        return [n for n in self._fitted if own.start <= n < own.stop]

    def _place(self, plate: EnrichedReducedPlate, u: Array) -> Array | None:
        """Where a part swings, if one does. Shape (k,)."""
        return None if self._part is None else self._part.row(plate, u)

    def _key(self, G_law: Complex, u: Array) -> bytes:
        moving = self._changes.effects + self._modulus.effects + ([self._part.of] if self._part else [])
        own = [u[self._unknowns.stated], *(self._unknowns.of(k, u) for k in moving)]
        return b"".join(part.tobytes() for part in (G_law, *own))

    def _asked(self, G: Complex, change: Change, place: Array | None, grid: NodeGrid | None = None) -> Asked:
        grid = grid or self.grid
        known, own = grid.known_poles(G), self.plate.group == PLAIN
        if known is not None:
            known = known.on(own)
        return Asked(self.plate, grid.nodes.omega, G, change, known, bool(self._pitching), place)

    def asked(self, law: CoreLaw, u: Array) -> Asked | None:
        """What has to be solved there; None: nothing. `u` of shape (unknowns,)."""
        if not self._moves:
            return None
        G_law = self._modulus.of_law(law)
        if self._last is not None and self._last[0] == self._key(G_law, u):
            return None
        G = self._at_nodes(law, self._modulus.at(law, u))
        return self._asked(G, self._changes.every(u), self._place(self.plate, u))

    def know(self, asked: Asked, moved: Motions, u: Array) -> None:
        """The motions asked for there. `u` of shape (unknowns,)."""
        self._ready = u, asked, moved

    # Derivatives to unknown n.

    def _by(self, n: int, law: CoreLaw, u: Array, at: At) -> Complex:
        """Of the velocity before the channels."""
        k, omega = self._unknowns.owner(n), self.problem.points.omega
        found = np.zeros(len(omega), complex)
        h = self._unknowns.step(n, u)
        up, down = stepped(u, n, h), stepped(u, n, -h)
        moving = [*self._moving_it, *self._of_part]
        if n in moving and at.plate.by is not None:
            place = len(self.nuisances) + moving.index(n)
            by = at.plate.by.heave[place]
            found = found + at.per_x * (by + at.pitch * at.plate.by.turned[place] if self._pitching else by)
        if k in self._pitching:
            effect = self.effects[k]
            above, below = (
                effect.pitch(omega, self._unknowns.of(k, up)),
                effect.pitch(omega, self._unknowns.of(k, down)),
            )
            if above is not None and below is not None:
                found = found + (above - below) / (2 * h) * (at.per_x * at.plate.turned + at.lever)
        if k in self._straining.effects and self._modulus.strained:
            more, less = (self._straining.of(k, one, self._straining.plate) for one in (up, down))
            nearby = more, less, 2 * h
            found = found + at.per_G * self._modulus.along(law, u, nearby)
        if k in self._modulus.effects:
            found = found + at.per_G * self._modulus.by_own(k, law, u, up - u) / (2 * h)
        return found

    def _by_stated(self, law: CoreLaw, u: Array, at: At) -> Complex:
        """Of the velocity before the channels to each stated number."""
        assert at.plate.by is not None
        stated = slice(0, len(self.nuisances))
        by = at.plate.by.heave[stated]
        found = at.per_x * (by + at.pitch * at.plate.by.turned[stated] if self._pitching else by)
        return found + at.per_G * self._modulus.by_stated(law, u) if self._modulus.strained else found
