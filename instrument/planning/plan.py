"""A plan before any metal is clamped: steps for a wanted uncertainty, and what they could not tell apart."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Integers
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.planning.aims import Aims
from fitting.planning.causes import Causes
from fitting.planning.confusion import EffectOutlook, outlooks
from fitting.planning.limits import limited_by
from fitting.planning.sensitivity import Sensitivity, bent
from fitting.planning.signatures import judged_elsewhere, signatures_of
from fitting.specimen import PlateSpecimen, StatedSpecimen
from instrument.facts.plan import SettlingForecast
from instrument.models.set_up import Hammer
from instrument.planning.levels import Level, chosen_level, levels_of
from instrument.planning.outlook import Outlook, outlook_of
from instrument.planning.spots import Spot, spots_of
from instrument.planning.waits import settling_forecast
from instrument.planning.wish import Wish
from instrument.progress import Progress, quiet
from instrument.remarks.theory import theory_remark
from instrument.stepped_sine.expected_time import loop_checks_s
from instrument.stepped_sine.settings import SweepSettings

LEAST_A_REGION = 5
"""Steps in every resonance region, wanted for the law or not: with fewer nothing checks it."""


@dataclass(frozen=True)
class Plan:
    """A proposed sweep, and what it is expected to teach."""

    outlook: Outlook
    settings: SweepSettings
    aims: Aims
    sensitivity: Sensitivity
    levels: tuple[Level, ...]
    level: Level
    for_law: Integers
    """Candidates."""
    for_causes: Integers
    errors: Array
    """Relative, of G' and eta at the frequencies of `aims`. Shape (2, frequencies)."""
    limits: tuple[tuple[str, float], ...]
    """Stated numbers, with what everything measured would leave if each were exact."""
    spots: tuple[Spot, ...]
    effects: tuple[EffectOutlook, ...]
    not_judged: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]

    @property
    def taken(self) -> Array:
        """Readings at each candidate. Shape (candidates,)."""
        return counted(len(self.outlook.candidates), [*self.for_law, *self.for_causes])

    @property
    def seconds(self) -> Array:
        """Rig time of each step in the order of frequency, with the loop checks. Shape (steps,)."""
        c, at = self.outlook.candidates, np.flatnonzero(self.taken)
        checks = loop_checks_s(c.frequency_hz[at].tolist(), self.settings)
        return np.asarray(c.seconds[at] + np.array(checks))

    @property
    def settling(self) -> SettlingForecast | None:
        """Where steps need more time to settle than a sweep usually gives them."""
        f = self.outlook.candidates.frequency_hz[np.flatnonzero(self.taken)]
        return settling_forecast(f, self.outlook.poles_hz, self.settings)


def make_plan(
    specimen: PlateSpecimen,
    wish: Wish,
    hammer: Hammer | None = None,
    progress: Progress = quiet,
    *,
    with_spots: bool = True,
) -> Plan:
    """Steps, level and spot for a wish. Raises `OutsideModel` for what cannot be planned."""
    outlook = outlook_of(specimen, wish.settings, wish.band_hz, hammer, progress, with_effects=True)
    law = outlook.sensitivity(1.0, wish.noise).law
    aims = Aims.over(law, *outlook.band_hz)
    levels = levels_of(outlook, aims, wish)
    level = chosen_level(levels)
    s, c = level.sensitivity, outlook.candidates
    for_law = completed(level.choice.taken, outlook, s)
    taken = counted(len(c), for_law)
    problem = outlook.problem(level.level_g * PUBLISHED_G_M_S2, outlook.here)
    effects = catalogue(outlook.specimen)
    with progress("what effects would change") as report:
        bent_law = bent(specimen.core.law, problem)  # type: ignore[union-attr]
        signatures = signatures_of(problem, bent_law, problem.as_stated, effects, report)
    budget = float(c.seconds @ taken) * wish.causes_share / (1 - wish.causes_share)
    for_causes = Causes(s, signatures).choose(c.seconds, taken, budget)
    taken = counted(len(c), [*for_law, *for_causes])
    spots: list[Spot] = []
    if with_spots:
        with progress("comparing spots") as report:
            spots = spots_of(outlook, aims, wish, level.level_g, float(c.seconds @ taken), report)
    remark = theory_remark(outlook.specimen, law, np.array(outlook.band_hz))
    return Plan(
        outlook,
        wish.settings,
        aims,
        s,
        tuple(levels),
        level,
        for_law,
        for_causes,
        aims.errors(s.covariance(taken)),
        # Of everything measured, as the limit is: the plan's own steps would leave more than it in any case.
        tuple(limited_by(s, aims, np.ones(len(c)), problem.nuisances.each)),
        tuple(spots),
        tuple(outlooks(s, taken, signatures)),
        tuple(_not_judged(effects, problem)),
        (f"with the law to start from, {remark}",) if remark else (),
    )


def catalogue(specimen: StatedSpecimen) -> list[Effect]:
    """Effects that a plate may have beside the law, in the order of their names."""
    forms = (e.standing_on(specimen) for _, e in sorted(CATALOGUE.items()))
    return [form for form in forms if form is not None and not judged_elsewhere(form)]


def counted(size: int, chosen: Sequence[int] | Integers) -> Array:
    """Readings at each candidate. Shape (size,)."""
    return np.bincount(np.asarray(chosen, dtype=np.intp), minlength=size).astype(float)


def completed(chosen: Integers, outlook: Outlook, s: Sensitivity) -> Integers:
    """Chosen steps, and what no plan is without: the band's ends, enough in each region. Shape (steps,)."""
    c = outlook.candidates
    found = list(dict.fromkeys([*chosen.tolist(), 0, len(c) - 1]))
    for region in np.unique(c.region):
        inside = np.flatnonzero(c.region == region)
        # Where the response is large, spread over the region: its flanks and its top.
        order = inside[np.argsort(-np.abs(s.velocity_m_s[inside]) / s.sigma_m_s[inside])]
        missing = LEAST_A_REGION - sum(k in inside for k in found)
        found += [int(k) for k in order if k not in found][: max(0, missing)]
    return np.array(found, dtype=np.intp)


def _not_judged(effects: Sequence[Effect], problem: DiagnosisProblem) -> list[tuple[str, str]]:
    found = []
    for effect in effects:
        why = effect.objection(problem.points, problem.plate)
        if why is not None:
            found.append((effect.name, why))
    return found
