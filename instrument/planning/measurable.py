"""What may be measured after a sweep, with what it costs: the same steps otherwise, or more of them."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.plate_poles import PlatePoles
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.diagnosis.sharing import OF_EACH_FILE, OF_EACH_PLATE, OF_EACH_SPOT
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.planning.candidates import resonances_hz
from fitting.planning.elsewhere import read_elsewhere
from fitting.planning.exact_problem import exact_problem
from fitting.planning.further import Expecting, Further
from fitting.planning.known_mass import KnownMass
from fitting.planning.measured import noise_seen
from fitting.planning.sensitivity import ReadingNoise
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen
from fitting.tolerances import STATED
from instrument.facts.follow_up import FollowUpKind
from instrument.planning.costs import dwell_seconds, step_seconds
from instrument.planning.gaps import gaps_of, nearest, steps_between
from instrument.planning.measurement import HANDS_S, Measurable
from instrument.planning.steps import Steps, about, twists_hz, where
from instrument.stepped_sine.settings import SweepSettings

STEPS_A_SEGMENT = 20
"""Of a further sweep: enough that scatter shows its noise (15 are needed), a third of a usual segment."""
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
OF_THE_SPOT = frozenset({"spot_offset"})
_OF_A_MOUNTING = frozenset({*OF_EACH_SPOT, *OF_EACH_FILE, *OF_EACH_PLATE})
"""Stated numbers that are other ones in a file of its own, as the joint fit has them."""
_LEAST_HZ, _MOST_HZ = 5.0, 2000.0


@dataclass(frozen=True)
class Template:
    """The steps of the first sweep, thinned, as they would be made again."""

    member: DiagnosisProblem
    at: NDArray[np.intp]
    """Of its points, in the order in which they would be made."""
    settings: SweepSettings
    noise: ReadingNoise
    seconds: Array
    """Of each step."""
    poles_hz: Complex
    """Of the likeliest explanation."""
    twists: Steps
    """About resonances that the base does not excite, where the plate is alike at either side of its axis."""
    twists_at: str
    """Their frequencies in words; empty where there are none."""
    read_m: tuple[tuple[float, float], ...]
    """Spots that were read."""
    in_time: bool
    """Whether a rival changes with time: else the order of the steps tells nothing."""
    reduced: ReducedPlate | None
    """For frequencies between the segments; None where these are not asked about."""

    @classmethod
    def of(cls, expecting: Expecting, settings: SweepSettings) -> "Template":
        """Of the first file's sweep."""
        member, first = expecting.member, expecting.known[0].fitted
        sweep = member.sweep
        at = _thinned(member)
        f = sweep.frequency_hz[at]
        # Poles as the likeliest law has them, without its effects: good for a time of settling.
        poles = resonances_hz(
            PlatePoles(member.plate, first.law), max(_LEAST_HZ, 0.5 * f.min()), min(1.2 * f.max(), _MOST_HZ)
        )
        twists = twists_hz(member.plate, first.law, float(sweep.frequency_hz.min()), float(f.max()))
        every = np.concatenate([poles, twists])
        dwell = dwell_seconds(sweep.frequency_hz, settings)
        part = expecting.part
        noise = noise_seen(first.velocity_m_s[part], expecting.evidence.noise_m_s[part], dwell)
        return cls(
            member,
            at,
            settings,
            noise,
            step_seconds(f, poles, settings),
            poles,
            about(twists, int(sweep.segment.max()) + 1, every, settings),
            where(twists),
            expecting.read_m,
            expecting.in_time,
            expecting.reduced,
        )

    @property
    def level_m_s2(self) -> float:
        """Of the first sweep, its highest."""
        return float(self.member.sweep.commanded_m_s2[self.at].max())

    def measurable(self, mass_kg: float | None) -> Iterator[Measurable]:
        """Everything that is worth asking about."""
        yield from self._levels()
        yield self._again("frequencies", self.at, "Make the same sweep once more.")
        if self.in_time:
            latest = self.at[np.argsort(-self._time(self.at), kind="stable")]
            yield self._again("reversed", latest, "Make the same steps once more, the last ones first.")
        specimen = self.member.nuisances.specimen
        if isinstance(specimen, Specimen):
            if self.reduced is not None:
                yield from self._between(specimen, self.reduced)
                yield from self._spots(specimen, self.reduced)
            if mass_kg is not None:
                yield from self._masses(specimen, mass_kg)
            if specimen.boundary == "cantilever":
                yield from self._clampings(specimen)

    def struck(self) -> Measurable:
        """The bare plate's hammer test."""
        todo = "Clamp the bare plate and strike it: viscorig damping, then diagnose with --hammer."
        nothing = Further(self.member, self.at[:0], np.zeros(0))
        return Measurable("bare_hammer", nothing, (), (), 0.0, HANDS_S["bare_hammer"], todo, needs_hands=True)

    def _levels(self) -> Iterator[Measurable]:
        done = np.unique(np.round(self.member.sweep.commanded_m_s2, 9))
        for times in LEVELS:
            level = times * self.level_m_s2
            if np.any(np.abs(done / level - 1) < 0.01) or self._exceeds(level, times):
                continue
            member = _at_level(self.member, level)
            level_g = level / PUBLISHED_G_M_S2
            todo = f"Make the same steps at {level_g:.3g} g."
            yield self._measurable(
                "level", Further(self._later(member, self.at), *self._read(self.at)), self.at, level_g, todo
            )

    def _again(self, kind: FollowUpKind, order: NDArray[np.intp], todo: str) -> Measurable:
        further = Further(self._later(self.member, order), *self._read(order))
        return self._measurable(kind, further, order, self.level_m_s2 / PUBLISHED_G_M_S2, todo)

    def _between(self, specimen: Specimen, reduced: ReducedPlate) -> Iterator[Measurable]:
        """Further segments, in the gaps of those that were measured."""
        sweep = self.member.sweep
        begins = float(self.member.points.time_s.max()) + _PAUSE_S
        for number, gap in enumerate(gaps_of(sweep.frequency_hz), start=int(sweep.segment.max()) + 1):
            f = steps_between(*gap, self.poles_hz)
            seconds, region = step_seconds(f, self.poles_hz, self.settings), np.full(len(f), number)
            time = begins + np.cumsum(seconds)
            there = exact_problem(f, region, self.level_m_s2, specimen, self.member.plate, reduced, time)
            yield Measurable(
                "frequencies",
                Further(
                    replace(there, nuisances=self.member.nuisances),
                    np.arange(len(f)),
                    dwell_seconds(f, self.settings),
                    same_errors=False,
                    like=nearest(f, sweep.frequency_hz),
                ),
                tuple(f.tolist()),
                (number,) * len(f),
                self._level_g,
                float(seconds.sum()),
                f"Measure {len(f)} steps from {f[0]:.4g} to {f[-1]:.4g} Hz too, between the segments.",
                reason="Where nothing was read yet each explanation goes its own way.",
            )

    def _spots(self, specimen: Specimen, reduced: ReducedPlate) -> Iterator[Measurable]:
        for share in _SPOTS:
            spot = _on(specimen, share)
            if min(np.hypot(spot[0] - a, spot[1] - b) for a, b in self.read_m) >= _ELSEWHERE_M:
                todo = f"Point the laser at {_words(spot)} and make the same steps."
                yield self._elsewhere("spot", spot, reduced, self._same, todo)
        for spot in self._beside(specimen):
            todo = f"Point the laser at {_words(spot)} and measure its twist, about {self.twists_at} Hz."
            yield self._elsewhere("spot", spot, reduced, self.twists, todo)

    def _beside(self, specimen: Specimen) -> list[tuple[float, float]]:
        """Spots from which a twist is seen, where there is one to be seen."""
        return [_on(specimen, share) for share in _BESIDE] if self.twists_at else []

    def _elsewhere(
        self,
        kind: FollowUpKind,
        spot: tuple[float, float],
        reduced: ReducedPlate,
        steps: Steps,
        todo: str,
        new: frozenset[str] = frozenset(OF_EACH_SPOT),
    ) -> Measurable:
        """Another spot is read, of a plate clamped anew where that is what is done."""
        _, places = np.unique(steps.frequency_hz, return_inverse=True)
        further = Further(
            self._read_at(spot, reduced, steps),
            places,
            dwell_seconds(steps.frequency_hz, self.settings),
            same_errors=False,
            new=new,
            without=OF_THE_SPOT,
            remounted=kind == "clamping",
            like=nearest(steps.frequency_hz, self.member.sweep.frequency_hz),
        )
        return Measurable(
            kind,
            further,
            tuple(steps.frequency_hz.tolist()),
            tuple(steps.segment.tolist()),
            self._level_g,
            float(steps.seconds.sum()) + HANDS_S[kind],
            todo,
            needs_hands=True,
            spot_m=spot,
        )

    @property
    def _same(self) -> Steps:
        sweep = self.member.sweep
        return Steps(sweep.frequency_hz[self.at], sweep.segment[self.at], self.seconds)

    def _read_at(self, spot_m: tuple[float, float], reduced: ReducedPlate, steps: Steps) -> DiagnosisProblem:
        """The plate read at another spot, at each of the frequencies once."""
        member = self.member
        f, first = np.unique(steps.frequency_hz, return_index=True)
        plate, reduced, moved = read_elsewhere(member.plate, reduced, member.nuisances, spot_m)
        specimen = moved.specimen
        assert isinstance(specimen, Specimen)
        time = float(member.points.time_s.max()) + _PAUSE_S + np.cumsum(steps.seconds)[first]
        there = exact_problem(f, steps.segment[first], self.level_m_s2, specimen, plate, reduced, time)
        return replace(there, nuisances=moved)

    def _masses(self, specimen: Specimen, mass_kg: float) -> Iterator[Measurable]:
        for x, y in _MASS_AT:
            known = STATED["mass"].typical, STATED["place"].typical
            mass = KnownMass(mass_kg, _on(specimen, (x, y)), *known)
            further = Further(
                self._later(self.member, self.at),
                *self._read(self.at),
                same_errors=False,
                new=_OF_A_MOUNTING,
                mass=mass,
            )
            place = _words((mass.values[1], mass.values[2]))
            grams = f"{1e3 * mass_kg:.3g} g"
            todo = f"Put {grams} on the plate at {place}, state it as [[mass]], make the same steps."
            yield self._measurable("added_mass", further, self.at, self._level_g, todo, mass=mass)

    def _clampings(self, specimen: Specimen) -> Iterator[Measurable]:
        further = Further(
            self._later(self.member, self.at),
            *self._read(self.at),
            same_errors=False,
            new=_OF_A_MOUNTING,
            without=OF_THE_SPOT,
            remounted=True,
        )
        todo = f"{_ANEW}, and make the same steps."
        yield self._measurable("clamping", further, self.at, self._level_g, todo)
        if self.reduced is not None:
            for spot in self._beside(specimen):
                todo = f"{_ANEW}, point the laser at {_words(spot)}, make the same steps there, and measure "
                todo += f"its twist, about {self.twists_at} Hz."
                steps = self._same.then(self.twists)
                yield self._elsewhere("clamping", spot, self.reduced, steps, todo, _OF_A_MOUNTING)

    def _measurable(
        self,
        kind: FollowUpKind,
        further: Further,
        order: NDArray[np.intp],
        level_g: float,
        todo: str,
        mass: KnownMass | None = None,
    ) -> Measurable:
        sweep = self.member.sweep
        return Measurable(
            kind,
            further,
            tuple(sweep.frequency_hz[order].tolist()),
            tuple(sweep.segment[order].tolist()),
            level_g,
            float(self.seconds.sum()) + HANDS_S.get(kind, 0.0),
            todo,
            kind in HANDS_S,
            mass=mass,
        )

    @property
    def _level_g(self) -> float:
        return self.level_m_s2 / PUBLISHED_G_M_S2

    def _read(self, order: NDArray[np.intp]) -> tuple[NDArray[np.intp], Array]:
        return order, dwell_seconds(self.member.sweep.frequency_hz[order], self.settings)

    def _time(self, at: NDArray[np.intp]) -> Array:
        return self.member.points.time_s[at]

    def _later(self, member: DiagnosisProblem, order: NDArray[np.intp]) -> DiagnosisProblem:
        """Its steps made after everything that was measured, in an order."""
        where = {int(k): n for n, k in enumerate(self.at)}
        seconds = np.array([self.seconds[where[int(k)]] for k in order])
        begins = float(self.member.points.time_s.max()) + _PAUSE_S
        time = np.full(len(member.sweep), begins)
        time[order] = begins + np.cumsum(seconds)
        return replace(member, points=replace(member.points, time_s=time))

    def _exceeds(self, level_m_s2: float, times: float) -> bool:
        limits, sweep = self.settings.limits, self.member.sweep
        travel = level_m_s2 / float(sweep.omega.min()) ** 2
        fastest = times * float(np.abs(sweep.response_m_s[self.at]).max())
        share = limits.warn
        return (
            level_m_s2 > share * limits.base_m_s2
            or travel > share * limits.travel_m
            or fastest > share * limits.velocity_m_s
        )


def _thinned(member: DiagnosisProblem) -> NDArray[np.intp]:
    """Points of one pass of each segment, at the highest level, evenly thinned, in the order of time."""
    sweep, found = member.sweep, []
    for number in np.unique(sweep.segment):
        inside = np.flatnonzero(sweep.segment == number)
        high = inside[sweep.commanded_m_s2[inside] > 0.999 * sweep.commanded_m_s2[inside].max()]
        _, first = np.unique(sweep.frequency_hz[high], return_index=True)
        one = high[first]
        found.append(one[np.unique(np.linspace(0, len(one) - 1, STEPS_A_SEGMENT).round().astype(int))])
    at = np.concatenate(found)
    return at[np.argsort(member.points.time_s[at], kind="stable")]


def _on(specimen: Specimen, share: tuple[float, float]) -> tuple[float, float]:
    return share[0] * specimen.length_m, share[1] * specimen.width_m


def _words(place_m: tuple[float, float]) -> str:
    return f"({1e3 * place_m[0]:.0f}, {1e3 * place_m[1]:.0f}) mm"


def _at_level(member: DiagnosisProblem, level_m_s2: float) -> DiagnosisProblem:
    level = np.full(len(member.sweep), level_m_s2)
    return replace(member, points=replace(member.points, acceleration_m_s2=level))
