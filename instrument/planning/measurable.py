"""What may be measured after a sweep, with what it costs: the same segments otherwise, or more steps."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Integers, Mask, Place
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.several.sharing import OF_EACH_MOUNTING, OF_EACH_SPOT
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.planning.candidates import resonances_hz
from fitting.planning.elsewhere import read_elsewhere
from fitting.planning.exact_problem import exact_problem
from fitting.planning.further_readings import FurtherReadings
from fitting.planning.known_mass import KnownMass
from fitting.planning.measured import noise_seen
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.sensitivity import ReadingNoise
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import STATED
from fitting.sweep import Sweep
from instrument.facts.follow_up import FollowUpKind
from instrument.planning.costs import dwell_seconds, step_seconds
from instrument.planning.gaps import gaps_of, nearest, steps_between
from instrument.planning.measurement import HANDS_S, Measurable
from instrument.planning.offered import Choice, Offered, again
from instrument.planning.steps import Steps, about, no_steps, twists_hz, where
from instrument.stepped_sine.settings import SweepSettings

LEVELS = (0.25, 0.5, 2.0, 4.0)
"""Times the level of the sweep."""
_SPOTS = [(0.95, 0.5), (0.6, 0.5), (0.3, 0.5), (0.95, 0.12), (0.5, 0.12)]
"""Of length and width. A base that heaves moves the plate evenly; on the axis twist does not show."""
_BESIDE = [(0.5, 0.12), (0.95, 0.12)]
"""The same, beside the axis: where a plate clamped anew is read, and its twist."""
_MASS_AT = [(0.95, 0.5), (0.6, 0.5)]
_ELSEWHERE_M = 0.03
"""A spot nearer than this to one that was read tells little else."""
_ANEW = "Loosen the clamp, clamp the plate anew with a fifth of the torque"
_PAUSE_S = 60.0
"""Between two sweeps."""
_BETWEEN = "Where nothing was read yet each explanation goes its own way."
OF_THE_SPOT = frozenset({"spot_offset"})
_LEAST_HZ, _MOST_HZ = 5.0, 2000.0


@dataclass(frozen=True)
class Template:
    """The first sweep, and what may be measured beside it."""

    member: DiagnosisProblem
    reduced: ReducedPlate
    settings: SweepSettings
    noise: ReadingNoise
    once: Sweep
    """One pass of each segment, at its highest level."""
    plain: Offered
    """Without twists."""
    beside: Offered
    """With them, where the plate is alike at either side of its axis and a spot beside it sees them."""
    read_m: tuple[Place, ...]
    """Spots that were read."""
    in_time: bool
    """Whether a rival changes with time: else the order of the steps tells nothing."""

    @classmethod
    def of(cls, expecting: RivalForecasts, settings: SweepSettings) -> "Template":
        """Of the first file's sweep, of a plate."""
        member, first = expecting.member, expecting.learnt[0].fitted
        assert expecting.reduced is not None
        places = _places(member)
        once = member.sweep.take(places)
        low, high = float(once.frequency_hz.min()), float(once.frequency_hz.max())
        # Poles as the likeliest law has them, without its effects: good for a time of settling.
        poles = resonances_hz(
            PlatePoles(member.plate, first.law), max(_LEAST_HZ, 0.5 * low), min(1.2 * high, _MOST_HZ)
        )
        twists = twists_hz(member.plate, first.law, low, high)

        def timed(f: Array, segment: Integers) -> Steps:
            return Steps(f, segment, step_seconds(f, poles, settings))

        last, gaps = int(member.sweep.segment.max()), no_steps()
        for number, gap in enumerate(gaps_of(member.sweep.frequency_hz), start=last + 1):
            f = steps_between(*gap, poles)
            gaps = gaps.then(timed(f, np.full(len(f), number)))
        same = timed(*again(once, member.points.time_s[places]))
        first_twist = max([last, *gaps.segment]) + 1
        odd = about(twists, first_twist, np.concatenate([poles, twists]), settings)
        dwell = dwell_seconds(member.sweep.frequency_hz, settings)
        part = expecting.part
        return cls(
            member,
            expecting.reduced,
            settings,
            noise_seen(first.velocity_m_s[part], expecting.evidence.noise_m_s[part], dwell),
            once,
            Offered(same, gaps, no_steps()),
            Offered(same, gaps, odd, where(twists)),
            expecting.read_m,
            expecting.in_time,
        )

    @property
    def level_m_s2(self) -> float:
        """Of the first sweep, its highest."""
        return float(self.once.commanded_m_s2.max())

    def measurable(self, mass_kg: float | None, *, hands: bool = True) -> Iterator[Measurable]:
        """Everything that is worth asking about; without `hands` what the rig does alone.

        Measurements of one place come one after the other, with the same `further`.
        """
        home = self._read(None, self.plain.steps)
        yield from self._levels(home)
        yield from self._frequencies(home)
        if self.in_time:
            yield self._reversed()
        if hands:
            if mass_kg is not None:
                yield from self._masses(home, mass_kg)
            yield from self._prepared(home)

    def _prepared(self, home: DiagnosisProblem) -> Iterator[Measurable]:
        """Other spots, other mountings, or both."""
        clamped = self._specimen.boundary == "cantilever"
        if clamped:
            yield from self._of_hands("clamping", home, self.plain, f"{_ANEW}, and")
        for share in _SPOTS:
            spot, beside = _on(self._specimen, share), share in _BESIDE and len(self.beside.twists) > 0
            far = min(np.hypot(spot[0] - a, spot[1] - b) for a, b in self.read_m) >= _ELSEWHERE_M
            if not far and not (clamped and beside):
                continue
            offered = self.beside if beside else self.plain
            there, aim = self._read(spot, offered.steps), f"point the laser at {_words(spot)} and"
            if far:
                yield from self._of_hands("spot", there, offered, _sentence(aim), spot_m=spot)
            if clamped and beside:
                yield from self._of_hands("clamping", there, offered, f"{_ANEW}, {aim}", spot_m=spot)

    def struck(self) -> Measurable:
        """The bare plate's hammer test."""
        todo = "Clamp the bare plate and strike it: viscorig damping, then diagnose with --hammer."
        none = np.zeros(0, dtype=np.intp)
        nothing, seconds = FurtherReadings(self.member, none, np.zeros(0)), HANDS_S["bare_hammer"]
        return Measurable("bare_hammer", nothing, none, (), (), 0.0, seconds, todo, needs_hands=True)

    def _levels(self, home: DiagnosisProblem) -> Iterator[Measurable]:
        done = np.unique(np.round(self.member.sweep.commanded_m_s2, 9))
        for times in LEVELS:
            level = times * self.level_m_s2
            if np.any(np.abs(done / level - 1) < 0.01) or self._exceeds(level, times):
                continue
            further = self._further(_at_level(home, level), self.plain, same_errors=True)
            for choice in self.plain.lengths():
                todo = f"At {level / PUBLISHED_G_M_S2:.3g} g {choice.words}."
                yield self._measurable("level", further, self.plain, choice, todo, level_m_s2=level)

    def _frequencies(self, home: DiagnosisProblem) -> Iterator[Measurable]:
        """The same segments once more, and further ones in the gaps between those that were measured."""
        further = self._further(home, self.plain, same_errors=self.plain.known)
        for choice in self.plain.lengths():
            todo = f"Once more {choice.words}."
            yield self._measurable("frequencies", further, self.plain, choice, todo)
        for choice in (*self.plain.each_gap(), *self.plain.with_gaps()):
            todo = f"{_sentence(choice.words)}."
            yield self._measurable("frequencies", further, self.plain, choice, todo, reason=_BETWEEN)

    def _reversed(self) -> Measurable:
        shortest = next(self.plain.lengths())
        latest = Offered(self.plain.steps.of(shortest.at[::-1]), no_steps(), no_steps())
        further = self._further(self._read(None, latest.steps), latest, same_errors=True)
        every = Choice(np.arange(len(latest.steps)), "")
        return self._measurable(
            "reversed", further, latest, every, "Make the same steps once more, the last ones first."
        )

    def _masses(self, home: DiagnosisProblem, mass_kg: float) -> Iterator[Measurable]:
        for share in _MASS_AT:
            known = STATED["mass"].typical, STATED["place"].typical
            mass = KnownMass(mass_kg, _on(self._specimen, share), *known)
            words = f"Put {1e3 * mass_kg:.3g} g on the plate at {_words((mass.values[1], mass.values[2]))}, "
            yield from self._of_hands(
                "added_mass", home, self.plain, f"{words}state it as [[mass]], and", mass=mass
            )

    def _of_hands(
        self,
        kind: FollowUpKind,
        there: DiagnosisProblem,
        offered: Offered,
        words: str,
        *,
        spot_m: Place | None = None,
        mass: KnownMass | None = None,
    ) -> Iterator[Measurable]:
        """What a person prepares, and then in each of several lengths."""
        new = frozenset(OF_EACH_SPOT) if kind == "spot" else frozenset(OF_EACH_MOUNTING)
        without = frozenset() if kind == "added_mass" else OF_THE_SPOT
        further = self._further(there, offered, same_errors=False)
        further = replace(further, new=new, without=without, remounted=kind == "clamping", mass=mass)
        for choice in offered.choices():
            todo = f"{words} {choice.words}."
            yield self._measurable(kind, further, offered, choice, todo, spot_m=spot_m, mass=mass)

    def _further(
        self, problem: DiagnosisProblem, offered: Offered, *, same_errors: bool | Mask
    ) -> FurtherReadings:
        """All steps of a place, each at the problem's point of its frequency."""
        f = offered.steps.frequency_hz
        return FurtherReadings(
            problem,
            np.searchsorted(problem.sweep.frequency_hz, f),
            dwell_seconds(f, self.settings),
            same_errors=same_errors,
            like=nearest(f, self.member.sweep.frequency_hz),
        )

    def _measurable(
        self,
        kind: FollowUpKind,
        further: FurtherReadings,
        offered: Offered,
        choice: Choice,
        todo: str,
        *,
        level_m_s2: float | None = None,
        spot_m: Place | None = None,
        mass: KnownMass | None = None,
        reason: str = "",
    ) -> Measurable:
        steps = offered.steps.of(choice.at)
        return Measurable(
            kind,
            further,
            choice.at,
            tuple(steps.frequency_hz.tolist()),
            tuple(steps.segment.tolist()),
            (level_m_s2 or self.level_m_s2) / PUBLISHED_G_M_S2,
            float(steps.seconds.sum()) + HANDS_S.get(kind, 0.0),
            todo,
            kind in HANDS_S,
            spot_m,
            mass,
            reason=reason,
        )

    def _read(self, spot_m: Place | None, steps: Steps) -> DiagnosisProblem:
        """The plate read at a spot, or where it was, at each frequency once, after everything else."""
        member = self.member
        f, first = np.unique(steps.frequency_hz, return_index=True)
        plate, reduced, nuisances = member.plate, self.reduced, member.nuisances
        if spot_m is not None:
            plate, reduced, nuisances = read_elsewhere(plate, reduced, nuisances, spot_m)
        time = float(member.points.time_s.max()) + _PAUSE_S + np.cumsum(steps.seconds)[first]
        specimen = nuisances.specimen
        assert isinstance(specimen, PlateSpecimen)
        there = exact_problem(f, steps.segment[first], self.level_m_s2, specimen, plate, reduced, time)
        return replace(there, nuisances=nuisances)

    @property
    def _specimen(self) -> PlateSpecimen:
        stated = self.member.nuisances.specimen
        assert isinstance(stated, PlateSpecimen)
        return stated

    def _exceeds(self, level_m_s2: float, times: float) -> bool:
        limits, sweep = self.settings.limits, self.once
        travel = level_m_s2 / float(sweep.omega.min()) ** 2
        fastest = times * float(np.abs(sweep.response_m_s).max())
        share = limits.warn
        return (
            level_m_s2 > share * limits.base_m_s2
            or travel > share * limits.travel_m
            or fastest > share * limits.velocity_m_s
        )


def _places(member: DiagnosisProblem) -> Integers:
    """Points of one pass of each segment, at its highest level."""
    sweep, found = member.sweep, []
    for number in np.unique(sweep.segment):
        inside = np.flatnonzero(sweep.segment == number)
        high = inside[sweep.commanded_m_s2[inside] > 0.999 * sweep.commanded_m_s2[inside].max()]
        _, first = np.unique(sweep.frequency_hz[high], return_index=True)
        found.append(high[first])
    return np.concatenate(found)


def _on(specimen: PlateSpecimen, share: tuple[float, float]) -> Place:
    return share[0] * specimen.length_m, share[1] * specimen.width_m


def _words(place_m: Place) -> str:
    return f"({1e3 * place_m[0]:.0f}, {1e3 * place_m[1]:.0f}) mm"


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}"


def _at_level(problem: DiagnosisProblem, level_m_s2: float) -> DiagnosisProblem:
    level = np.full(len(problem.sweep), level_m_s2)
    return replace(problem, points=replace(problem.points, drive_amplitude=level, level_m_s2=None))
