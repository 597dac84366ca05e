"""What rivals expect of a further measurement: the posterior of each, carried to readings not yet made.

The unknowns of a rival are those of its fit and the model's own errors in each segment, which it shares with
further passes of the same segments: what a fit took for the plate's error at one level it expects at another.
Everything is linear about the rival's likeliest values. A *rival* is one explanation of a diagnosis; a
*member* is one file's sweep among those that were diagnosed together.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.inference.evidence import BareModes, Evidence
from fitting.diagnosis.inference.marginal import prior_precision
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.several.of_files import Place, inner_of, own_unknowns
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.verdict.result import Rivals, name_of
from fitting.effects.base import Effect, EffectParameter
from fitting.planning.forms import forms_of
from fitting.planning.known_mass import KnownMass
from fitting.planning.rivalry import Forecast
from fitting.planning.sensitivity import ReadingNoise
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import Specimen

Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Further:
    """Readings at frequencies of a sweep that was made, otherwise than they were made."""

    member: DiagnosisProblem
    """The sweep's, at another level, time or spot. All its points; those not in `at` are not asked for."""
    at: Places
    """Points that are read."""
    dwell_s: Array
    """How long each of these points is read."""
    same_errors: bool | Mask = True
    """Whether the model errs as in the first sweep, in proportion to what it reads; else anew. Of each of
    these points where they differ."""
    new: frozenset[str] = frozenset()
    """Kinds of stated numbers that are others (`fitting.stated.tolerances`): as uncertain as they are
    stated."""
    without: frozenset[str] = frozenset()
    """Effects that are not in it."""
    remounted: bool = False
    """Whether the specimen is clamped anew: numbers that a mounting changes are others by so much."""
    mass: KnownMass | None = None
    noise: ReadingNoise | None = None
    """Of channels of its own; None: as the sweep's."""
    reduced: ReducedPlate | None = None
    """Where the model errs anew in a way of its own: the plate that says how. None: as in the first sweep."""
    other_reference: bool = False
    """Whether another channel is the reference: what was wrong in one may have been in the first one's."""
    like: Places | None = None
    """Of frequencies that were not measured: the first sweep's points that the model errs like."""


@dataclass(frozen=True, eq=False)
class Known:
    """What one rival has learnt."""

    fitted: Refitted
    root: Array
    """Covariance is R R^T: of the fitted numbers, then of the model's errors. Shape (k, k)."""
    errors: Array
    """Their posterior mean, in standard deviations. Shape (errors,)."""


@dataclass(frozen=True, eq=False)
class _Raw:
    """Phasors that a rival expects, and how they vary."""

    v: Complex
    """Shape (points,)."""
    by_known: Complex
    """One standard deviation each. Shape (k, points)."""
    by_new: Complex
    """The same, of what is new. Shape (any, points)."""


@dataclass(frozen=True, eq=False)
class _Unknowns:
    """The unknowns of readings in a response's order: law, stated numbers, effects, a known mass."""

    of_law: int
    """How many the law has."""
    stated: list[int | None]
    """Where each stated number is among those fitted; None for one that the fit does not know."""
    effects: list[Effect]
    """The fit's that the readings have."""
    places: list[Places]
    """Where the unknowns of each are among those fitted."""
    mass: KnownMass | None
    u: Array
    """All but the law's. Shape (unknowns,)."""

    def with_mass(self, effects: list[Effect]) -> list[Effect]:
        """The known mass, where there is one, at the end of `effects`."""
        return effects if self.mass is None else [*effects, self.mass]

    @property
    def at_mass(self) -> int:
        """Row of the known mass's first derivative."""
        return self.of_law + len(self.stated) + sum(len(p) for p in self.places)

    def of_effects(self) -> Iterator[tuple[EffectParameter, int, int]]:
        """Each unknown of an effect, where it is among those fitted, and the row of its derivative."""
        row = self.of_law + len(self.stated)
        for effect, place in zip(self.effects, self.places, strict=True):
            for parameter, g in zip(effect.parameters, place.tolist(), strict=True):
                yield parameter, g, row
                row += 1


class Expecting:
    """The rivals of a diagnosis, asked about measurements one after the other."""

    def __init__(self, rivals: Rivals, most: int) -> None:
        """`most`: how many rivals are asked, the likeliest first."""
        self.problem, self.evidence, self.temper = rivals.problem, rivals.evidence, rivals.temper
        each = (*rivals.each, *rivals.beyond)[:most]
        self.names = tuple(name_of(fitted) for fitted, _ in each)
        forms = [
            (k, fitted, p * share)
            for k, (one, p) in enumerate(each)
            for fitted, share in forms_of(rivals, one)
        ]
        self.of = [k for k, _, _ in forms]
        """Whose each of the forms is that are asked."""
        self.probabilities = np.array([p for _, _, p in forms]) / sum(p for _, _, p in forms)
        """Probabilities of the forms. Shape (forms,)."""
        first = each[0][0]
        several = self.problem if isinstance(self.problem, SeveralProblem) else None
        self.reduced = several.reduced[0] if several and several.reduced else rivals.reduced
        """The plate that frequencies not yet measured are asked of; None where there is none."""
        self._errors = model_error(self.problem, rivals.reduced, first.law, first.velocity_m_s)
        # The evidence's are of another law, which may have another resonance at a segment's edge.
        known = 1.0 if self.evidence.scale_known else 0.0
        self._over_sigma = known * self.evidence.over_sigma(first.velocity_m_s, self._errors).T
        self.known = [self._learnt(fitted) for _, fitted, _ in forms]

    @cached_property
    def members(self) -> tuple[DiagnosisProblem, ...]:
        """All that was read."""
        return self.problem.members if isinstance(self.problem, SeveralProblem) else (self.problem,)

    @property
    def member(self) -> DiagnosisProblem:
        """The first sweep of the first file."""
        return self.members[0]

    @cached_property
    def read_m(self) -> tuple[tuple[float, float], ...]:
        """Spots that were read, as stated."""
        stated = [m.nuisances.specimen for m in self.members if m.points.drive == "base"]
        return tuple(s.pickup_m for s in stated if isinstance(s, Specimen) and s.pickup_m is not None)

    @property
    def struck_already(self) -> bool:
        """Whether a force has driven the plate in some file."""
        return any(m.points.drive == "force" for m in self.members)

    @property
    def in_time(self) -> bool:
        """Whether a rival has an effect that changes with time."""
        return any(e.enters == "time" for known in self.known for e in known.fitted.effects)

    @cached_property
    def part(self) -> slice:
        """Its points among all."""
        if isinstance(self.problem, SeveralProblem):
            return self.problem.starts_at[0]
        return slice(0, len(self.problem.sweep))

    def forecasts(self, further: Further, noise: ReadingNoise) -> list[Forecast]:
        """Of each form of each rival."""
        raw = [self._raw(known, further) for known in self.known]
        v, channels = raw[0].v, further.noise or noise
        sigma = np.hypot(channels.std_m_s(v, further.dwell_s), SHARE * np.abs(v))
        return [self._over(one, sigma) for one in raw]

    def rows(self, part: Places, count: int) -> Places:
        """Where data of some points stand in a forecast of `count` points. Shape (data,)."""
        return np.concatenate([part, part + count]) if self.evidence.has_phase else part

    def velocity_m_s(self, further: Further) -> Array:
        """Amplitudes that the likeliest rival expects. Shape (points that are read,)."""
        return np.abs(self._raw(self.known[0], further).v)

    def struck(self, bare: BareModes) -> list[Forecast]:
        """Of each form, of a hammer test of the bare plate. Only its frequencies are asked."""
        return [self._struck(known, bare) for known in self.known]

    def _learnt(self, fitted: Refitted) -> Known:
        response = response_of(self.problem, fitted.effects)
        v, dv = response.with_derivatives(fitted.law, fitted.u)
        A = self.evidence.over_sigma(v, self._columns(fitted, dv)).T
        B = self._over_sigma
        left = self.evidence.over_sigma(v, _rest(self.evidence, v))
        rest = fitted.jacobian[fitted.data :]
        k, errors = A.shape[1], B.shape[1]
        P = np.zeros((k + errors, k + errors))
        P[:k, :k] = A.T @ A + rest.T @ rest + np.diag(prior_precision(fitted, self.problem.plate))
        P[:k, k:], P[k:, :k] = A.T @ B, B.T @ A
        P[k:, k:] = B.T @ B + np.eye(errors)
        chi2 = fitted.chi2_per_dof
        # As a fit's covariance: a misfit widens, a good fit narrows nothing.
        wider = np.sqrt(max(1.0, chi2)) if np.isfinite(chi2) else 1.0
        d = 1 / np.sqrt(np.diag(P))
        L = np.linalg.cholesky(P * np.outer(d, d) + 1e-12 * np.eye(len(P)))
        root = wider * d[:, None] * la.solve_triangular(L, np.eye(len(P)), lower=True).T
        mean = np.asarray(np.linalg.solve(B.T @ B + np.eye(errors), B.T @ left), dtype=float)
        return Known(fitted, root, mean)

    def _columns(self, fitted: Refitted, dv: Complex) -> Complex:
        """Derivatives to what is fitted, as it is fitted. Shape (columns, points)."""
        n = len(fitted.law.names)
        scale = _scales(fitted)
        return np.concatenate([dv[:n], (dv[n:] * scale[:, None])[fitted.free]])

    def _raw(self, known: Known, further: Further) -> _Raw:
        unknowns = self._unknowns(known.fitted, further)
        response = SweepResponse(further.member, unknowns.with_mass(unknowns.effects), every=True)
        every, by_every = response.with_derivatives(known.fitted.law, unknowns.u)
        v, dv = every[further.at], by_every[:, further.at]
        by = self._by_fitted(known.fitted, unknowns, dv)
        fresh = _by_fresh(known.fitted, further, unknowns, dv)
        if further.other_reference:
            v, doubt = self._either_channel(known, further, unknowns, v)
            fresh += doubt
        again, anew = self._model_errors(known, further, every, v)
        mean = v + known.errors @ again
        by_known = known.root.T @ np.concatenate([by, again])
        fresh += list(anew[np.any(anew != 0, axis=1)])
        by_new = np.array(fresh) if fresh else np.zeros((0, len(v)), complex)
        return _Raw(mean, by_known, by_new)

    def _unknowns(self, fitted: Refitted, further: Further) -> _Unknowns:
        """Those of the readings, at the fit's values where the fit has them."""
        member = further.member
        effects, places = self._effects(fitted, further.without)
        # Where each of its stated numbers is among those fitted; nowhere if the first sweep did not have it.
        names = {q.name: int(g) for q, g in zip(self.member.nuisances.each, self._stated, strict=True)}
        stated = [None if q.kind in further.new else names.get(q.name) for q in member.nuisances.each]
        z = [0.0 if g is None else fitted.u[g] for g in stated]
        u = np.concatenate([z, *(fitted.u[p] for p in places)])
        if further.mass is not None:
            longer = sum(e.longer_m(fitted.u[p]) for e, p in zip(effects, places, strict=True))
            u = np.concatenate([u, further.mass.unknowns_on(member.plate.length_m, longer)])
        return _Unknowns(len(fitted.law.names), stated, effects, places, further.mass, u)

    def _by_fitted(self, fitted: Refitted, unknowns: _Unknowns, dv: Complex) -> Complex:
        """Derivatives of the readings to what is fitted, as it is fitted. Shape (columns, points)."""
        n, column, scale = unknowns.of_law, np.cumsum(fitted.free) - 1 + unknowns.of_law, _scales(fitted)
        by = np.zeros((n + int(fitted.free.sum()), dv.shape[1]), complex)
        by[:n] = dv[:n]
        for k, g in enumerate(unknowns.stated):
            if g is not None:
                by[column[g]] += dv[n + k]
        for _, g, row in unknowns.of_effects():
            if fitted.free[g]:
                by[column[g]] += scale[g] * dv[row]
        return by

    def _model_errors(
        self, known: Known, further: Further, every: Complex, v: Complex
    ) -> tuple[Complex, Complex]:
        """What the model errs in the readings as in the first sweep, and what it errs anew.

        `every` are phasors at all of the member's points, `v` those that are read. Shapes (errors, points).
        """
        if further.reduced is not None:
            law = self.known[0].fitted.law
            anew = model_error(further.member, further.reduced, law, every)[:, further.at]
            return np.zeros((len(known.errors), len(v)), complex), anew
        near = further.at if further.like is None else further.like
        e = self._errors[:, self.part][:, near] * (v / known.fitted.velocity_m_s[self.part][near])
        again = e * further.same_errors
        return again, e - again

    def _either_channel(
        self, known: Known, further: Further, unknowns: _Unknowns, v: Complex
    ) -> tuple[Complex, list[Complex]]:
        """Phasors, and what nobody knows: what is wrong in a channel is in the new ones too, or not."""
        each = list(zip(unknowns.effects, unknowns.places, strict=True))
        kept = [(e, p) for e, p in each if e.enters != "channel"]
        if len(kept) == len(each):
            return v, []
        u, count, mass = unknowns.u, len(unknowns.stated), unknowns.at_mass - unknowns.of_law
        right = np.concatenate([u[:count], *(known.fitted.u[p] for _, p in kept), u[mass:]])
        response = SweepResponse(further.member, unknowns.with_mass([e for e, _ in kept]))
        without = response.velocity(known.fitted.law, right)[further.at]
        return (v + without) / 2, [(v - without) / 2]

    @property
    def _stated(self) -> Places:
        """Where the member's stated numbers are among all."""
        if isinstance(self.problem, SeveralProblem):
            return self.problem.places[0]
        return np.arange(len(self.problem.nuisances))

    def _effects(self, fitted: Refitted, without: frozenset[str]) -> tuple[list[Effect], list[Places]]:
        """Effects that the readings have, and where their unknowns are."""
        effects, places = [], []
        for e, part in fitted.each():
            own, inner = own_unknowns(e, self._place), inner_of(e)
            if own is not None and inner.name not in without:
                effects.append(inner)
                places.append(part.start + own)
        return effects, places

    @property
    def _place(self) -> Place:
        return self.problem.belongs[0] if isinstance(self.problem, SeveralProblem) else Place(1)

    def _over(self, raw: _Raw, sigma: Array) -> Forecast:
        """In standard deviations of the noise, parts side by side."""
        both, known = np.concatenate([raw.by_known, raw.by_new]), len(raw.by_known)
        if self.evidence.has_phase:
            mean, root = raw.v / sigma, both / sigma
            return Forecast(np.r_[mean.real, mean.imag], np.hstack([root.real, root.imag]).T, known)
        size = np.abs(raw.v)
        return Forecast(size / sigma, (np.real(np.conj(raw.v) * both) / (size * sigma)).T, known)

    def _struck(self, known: Known, bare: BareModes) -> Forecast:
        fitted, nuisances = known.fitted, self.member.nuisances
        n, z = len(fitted.law.names), fitted.u[self._stated]
        shift = bare.stated_shift(nuisances, z)
        column = np.cumsum(fitted.free) - 1 + n
        by = np.zeros((n + int(fitted.free.sum()), len(shift)))
        by_z = bare.by_stated(nuisances, z)
        for k, g in enumerate(self._stated):
            by[column[g]] += by_z[k]
        scale, fresh = _scales(fitted), []
        # The bare plate is that of the first file: what is in another one it does not feel.
        for inner, places in zip(*self._effects(fitted, frozenset()), strict=True):
            u = fitted.u[places]
            felt = _felt(inner, u)
            shifts = np.array([inner.bare_shift(bare, one) for one in felt])
            shift = shift + shifts.mean(axis=0)
            if len(felt) > 1:
                fresh.append((shifts[1] - shifts[0]) / 2)
            for m, (q, g) in enumerate(zip(inner.parameters, places.tolist(), strict=True)):
                if fitted.free[g]:
                    h = 1e-4 * (abs(u[m]) if q.logarithmic else q.typical or 1.0)
                    moved = [np.where(np.arange(len(u)) == m, one + h, one) for one in felt]
                    there = np.mean([inner.bare_shift(bare, one) for one in moved], axis=0)
                    by[column[g]] += scale[g] * (there - shifts.mean(axis=0)) / h
        rows = known.root[: len(by)].T @ by
        every = np.concatenate([rows, np.array(fresh)]) if fresh else rows
        return Forecast(bare.whitened_change(shift), bare.whitened_change(every.T), len(rows))


def _rest(evidence: Evidence, v: Complex) -> Complex:
    """Measured less predicted, such that `over_sigma` puts it over the noise. Shape (points,)."""
    if evidence.has_phase:
        return np.asarray(evidence.measured_m_s - v)
    return np.asarray((evidence.measured_m_s - np.abs(v)) * v / np.abs(v))


def _by_fresh(fitted: Refitted, further: Further, unknowns: _Unknowns, dv: Complex) -> list[Complex]:
    """One standard deviation of each number that the fit does not know. Shape (points,) each."""
    scale = _scales(fitted)
    fresh = [dv[unknowns.of_law + k] for k, g in enumerate(unknowns.stated) if g is None]
    if further.remounted:
        for parameter, g, row in unknowns.of_effects():
            if fitted.free[g] and parameter.mounting is not None:
                fresh.append(parameter.mounting * scale[g] * dv[row])
    if unknowns.mass is not None:
        at, mass = unknowns.at_mass, unknowns.mass
        fresh += [mass.sigma_kg * dv[at], mass.off_m * dv[at + 1], mass.off_m * dv[at + 2]]
    return fresh


def _scales(fitted: Refitted) -> Array:
    """Derivative of u to u as it is fitted. Shape of `u`."""
    q = [q for e in fitted.effects for q in e.parameters]
    logarithmic = np.array([False] * fitted.stated + [one.logarithmic for one in q], dtype=bool)
    return np.where(logarithmic, fitted.u, 1.0)


def _felt(effect: Effect, u: Array) -> list[Array]:
    """Forms of an effect that nobody knows of which to expect on a bare plate."""
    found = [u]
    for k, q in enumerate(effect.parameters):
        if q.fixed and q.key == "bare_plate_too":
            found = [np.where(np.arange(len(u)) == k, value, u) for value in (q.lower, q.upper)]
    return found
