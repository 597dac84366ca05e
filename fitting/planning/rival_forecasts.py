"""What rivals expect of a further measurement: the posterior of each, carried to readings not yet made.

The unknowns of a rival are those of its fit and the model's own errors in each segment, which it shares with
further passes of the same segments: what a fit took for the plate's error at one level it expects at another.
Everything is linear about the rival's likeliest values. A *rival* is one explanation of a diagnosis; a
*member* is one file's sweep among those that were diagnosed together.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.verdict.result import Rivals, name_of
from fitting.planning.forms import forms_of
from fitting.planning.further_readings import FurtherReadings, Places, UnknownsOfReadings, unknowns_of
from fitting.planning.learnt import LearntRival, learnt, scales
from fitting.planning.rivalry import Forecast
from fitting.planning.sensitivity import ReadingNoise
from fitting.planning.struck_forecast import struck_forecast
from fitting.specimen import PlateSpecimen


@dataclass(frozen=True, eq=False)
class _Raw:
    """Phasors that a rival predicts, and their standard deviations by source."""

    v: Complex
    """Shape (points,)."""
    by_known: Complex
    """Changes by one standard deviation of what the rival has learnt. Shape (k, points)."""
    by_new: Complex
    """Changes by one standard deviation of what the readings bring anew. Shape (any, points)."""


class RivalForecasts:
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
        self.learnt = [
            learnt(self.problem, self.evidence, fitted, self._over_sigma) for _, fitted, _ in forms
        ]

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
        return tuple(s.pickup_m for s in stated if isinstance(s, PlateSpecimen) and s.pickup_m is not None)

    @property
    def struck_already(self) -> bool:
        """Whether a force has driven the plate in some file."""
        return any(m.points.drive == "force" for m in self.members)

    @property
    def in_time(self) -> bool:
        """Whether a rival has an effect that changes with time."""
        return any(e.enters == "time" for rival in self.learnt for e in rival.fitted.effects)

    @cached_property
    def part(self) -> slice:
        """Its points among all."""
        if isinstance(self.problem, SeveralProblem):
            return self.problem.starts_at[0]
        return slice(0, len(self.problem.sweep))

    def forecasts(self, further: FurtherReadings, noise: ReadingNoise) -> list[Forecast]:
        """Of each form of each rival."""
        raw = [self._raw(rival, further) for rival in self.learnt]
        v, channels = raw[0].v, further.noise or noise
        sigma = np.hypot(channels.std_m_s(v, further.dwell_s), SHARE * np.abs(v))
        return [self._over(one, sigma) for one in raw]

    def rows(self, part: Places, count: int) -> Places:
        """Where data of some points stand in a forecast of `count` points. Shape (data,)."""
        return np.concatenate([part, part + count]) if self.evidence.has_phase else part

    def velocity_m_s(self, further: FurtherReadings) -> Array:
        """Amplitudes that the likeliest rival expects. Shape (points that are read,)."""
        return np.abs(self._raw(self.learnt[0], further).v)

    def struck(self, bare: BareModes) -> list[Forecast]:
        """Of each form, of a hammer test of the bare plate. Only its frequencies are asked."""
        nuisances = self.member.nuisances
        return [struck_forecast(rival, bare, nuisances, self._stated, self._place) for rival in self.learnt]

    def _raw(self, rival: LearntRival, further: FurtherReadings) -> _Raw:
        unknowns = unknowns_of(rival.fitted, further, self._place, self._names)
        response = SweepResponse(further.member, unknowns.with_mass(unknowns.effects), every=True)
        every, by_every = response.with_derivatives(rival.fitted.law, unknowns.u)
        v, dv = every[further.at], by_every[:, further.at]
        by = _by_fitted(rival.fitted, unknowns, dv)
        fresh = _by_fresh(rival.fitted, further, unknowns, dv)
        if further.other_reference:
            v, doubt = self._either_channel(rival, further, unknowns, v)
            fresh += doubt
        again, anew = self._model_errors(rival, further, every, v)
        mean = v + rival.errors @ again
        by_known = rival.root.T @ np.concatenate([by, again])
        fresh += list(anew[np.any(anew != 0, axis=1)])
        by_new = np.array(fresh) if fresh else np.zeros((0, len(v)), complex)
        return _Raw(mean, by_known, by_new)

    def _model_errors(
        self, rival: LearntRival, further: FurtherReadings, every: Complex, v: Complex
    ) -> tuple[Complex, Complex]:
        """What the model errs in the readings as in the first sweep, and what it errs anew.

        `every` are phasors at all of the member's points, `v` those that are read. Shapes (errors, points).
        """
        if further.reduced is not None:
            law = self.learnt[0].fitted.law
            anew = model_error(further.member, further.reduced, law, every)[:, further.at]
            return np.zeros((len(rival.errors), len(v)), complex), anew
        near = further.at if further.like is None else further.like
        e = self._errors[:, self.part][:, near] * (v / rival.fitted.velocity_m_s[self.part][near])
        again = e * further.same_errors
        return again, e - again

    def _either_channel(
        self, rival: LearntRival, further: FurtherReadings, unknowns: UnknownsOfReadings, v: Complex
    ) -> tuple[Complex, list[Complex]]:
        """Phasors, and what nobody knows: what is wrong in a channel is in the new ones too, or not."""
        each = list(zip(unknowns.effects, unknowns.places, strict=True))
        kept = [(e, p) for e, p in each if e.enters != "channel"]
        if len(kept) == len(each):
            return v, []
        u, count, mass = unknowns.u, len(unknowns.stated), unknowns.at_mass - unknowns.of_law
        right = np.concatenate([u[:count], *(rival.fitted.u[p] for _, p in kept), u[mass:]])
        response = SweepResponse(further.member, unknowns.with_mass([e for e, _ in kept]))
        without = response.velocity(rival.fitted.law, right)[further.at]
        return (v + without) / 2, [(v - without) / 2]

    @property
    def _stated(self) -> Places:
        """Where the member's stated numbers are among all."""
        if isinstance(self.problem, SeveralProblem):
            return self.problem.places[0]
        return np.arange(len(self.problem.nuisances))

    @cached_property
    def _names(self) -> dict[str, int]:
        """The member's stated numbers, and where each is among all."""
        return {q.name: int(g) for q, g in zip(self.member.nuisances.each, self._stated, strict=True)}

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


def _by_fitted(fitted: Refitted, unknowns: UnknownsOfReadings, dv: Complex) -> Complex:
    """Derivatives of the readings to what is fitted, as it is fitted. Shape (columns, points)."""
    n, column, scale = unknowns.of_law, np.cumsum(fitted.free) - 1 + unknowns.of_law, scales(fitted)
    by = np.zeros((n + int(fitted.free.sum()), dv.shape[1]), complex)
    by[:n] = dv[:n]
    for k, g in enumerate(unknowns.stated):
        if g is not None:
            by[column[g]] += dv[n + k]
    for _, g, row in unknowns.of_effects():
        if fitted.free[g]:
            by[column[g]] += scale[g] * dv[row]
    return by


def _by_fresh(
    fitted: Refitted, further: FurtherReadings, unknowns: UnknownsOfReadings, dv: Complex
) -> list[Complex]:
    """One standard deviation of each number that the fit does not know. Shape (points,) each."""
    scale = scales(fitted)
    fresh = [dv[unknowns.of_law + k] for k, g in enumerate(unknowns.stated) if g is None]
    if further.remounted:
        for parameter, g, row in unknowns.of_effects():
            if fitted.free[g] and parameter.mounting is not None:
                fresh.append(parameter.mounting * scale[g] * dv[row])
    if unknowns.mass is not None:
        at, mass = unknowns.at_mass, unknowns.mass
        fresh += [mass.sigma_kg * dv[at], mass.off_m * dv[at + 1], mass.off_m * dv[at + 2]]
    return fresh
