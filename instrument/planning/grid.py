"""Candidates of an adaptive sweep: laid out for a law, and laid out anew where the law has moved far."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex, Integers
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.several.responses import response_of
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.planning.candidates import Candidates, candidate_frequencies, regions, resonances_hz
from fitting.planning.exact_problem import exact_problem
from fitting.planning.signatures import Signature, signatures_of
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.models.set_up import Hammer, set_up
from instrument.planning.costs import as_run, dwell_seconds, step_seconds
from instrument.planning.outlook import first_hz, visible
from instrument.planning.plan import catalogue
from instrument.stepped_sine.settings import SweepSettings

_LOWEST_HZ = 5.0
"""From here on resonances below the band count for settling."""


@dataclass(frozen=True, eq=False)
class Ground:
    """What stays through a sweep: models of the specimen, its band, the regions of the law it starts from."""

    specimen: PlateSpecimen
    settings: SweepSettings
    band_hz: tuple[float, float]
    level_m_s2: float
    reduced: ReducedPlate
    plate: EnrichedReducedPlate
    carries_effects: EnrichedReducedPlate
    bare: BareModes | None
    centres_hz: Complex
    """Resonances whose regions the steps' segments are."""

    @classmethod
    def of(
        cls,
        specimen: PlateSpecimen,
        settings: SweepSettings,
        band_hz: tuple[float, float],
        level_m_s2: float,
        hammer: Hammer | None = None,
    ) -> "Ground":
        """Models made or loaded. Raises as `instrument.models.set_up.set_up`."""
        ends = np.array(band_hz)
        few = Sweep(ends, np.ones(2, complex), np.ones(2), np.ones(2, np.intp), np.ones(2, np.intp))
        plain = set_up(few, specimen, hammer, with_effects=False)
        rich = set_up(few, specimen, hammer)
        assert specimen.core is not None
        poles = PlatePoles(plain.problem.plate, specimen.core.law.lifted())
        every = resonances_hz(poles, *band_hz)
        every = every[(every.real >= band_hz[0]) & (every.real <= band_hz[1])]
        seen = every[visible(plain, every)]
        return cls(
            plain.specimen,
            settings,
            band_hz,
            level_m_s2,
            plain.reduced,
            plain.problem.plate,
            rich.problem.plate,
            plain.bare,
            seen,
        )

    @property
    def law(self) -> CoreLaw:
        """The stated one, as the joint fit has it: free to bend, unless everything stated is exact."""
        assert self.specimen.core is not None
        law = self.specimen.core.law.lifted()
        return law if self.specimen.exact else BentLaw.over(law, np.array(self.band_hz))

    def region(self, frequency_hz: Array) -> Integers:
        """Number of each frequency's region, the same whatever the law has become. Shape as given."""
        ends = np.array(self.band_hz)
        return regions(np.concatenate([ends[:1], frequency_hz, ends[1:]]), self.centres_hz)[1:-1]

    def problem(
        self, frequency_hz: Array, time_s: Array | None = None, *, effects: bool = False
    ) -> DiagnosisProblem:
        """The problem of readings at distinct, ascending frequencies. Shape (points,)."""
        plate = self.carries_effects if effects else self.plate
        return exact_problem(
            frequency_hz,
            self.region(frequency_hz),
            self.level_m_s2,
            self.specimen,
            plate,
            self.reduced,
            time_s,
        )


@dataclass(frozen=True)
class Grid:
    """Candidates and measured frequencies under one law."""

    candidates: Candidates
    problem: DiagnosisProblem
    velocity_m_s: Complex
    """Velocities at the candidates by that law. Shape (candidates,)."""
    errors: Complex
    """The model's own, one standard deviation each. Shape (any, candidates)."""
    signatures: tuple[Signature, ...]
    """Of effects without a place: the cheap ones, and the likeliest."""

    @classmethod
    def of(cls, ground: Ground, law: CoreLaw, z: Array, measured_hz: Sequence[float]) -> "Grid":
        """Laid out for a law that may bend and stated numbers (shape (stated numbers,))."""
        low, high = ground.band_hz
        of_plate = PlatePoles(ground.plate, law)
        poles = resonances_hz(of_plate, min(low, _LOWEST_HZ), high)
        f = candidate_frequencies(poles, low, high)
        f = np.unique(np.concatenate([f, np.array(measured_hz)]))
        s = ground.settings
        seconds = step_seconds(f, as_run(poles if len(poles) else first_hz(of_plate), ground.specimen), s)
        candidates = Candidates(f, ground.region(f), dwell_seconds(f, s), seconds)
        problem = ground.problem(f)
        v = response_of(problem, ()).velocity(law, z)
        errors = model_error(problem, ground.reduced, law, v)
        rich = ground.problem(f, np.cumsum(candidates.seconds), effects=True)
        here = dict(zip((n.name for n in problem.nuisances.each), z.tolist(), strict=True))
        # A plate that carries effects hears modes that this one does not: they stay as stated.
        found = signatures_of(
            rich, law, np.array([here.get(n.name, 0.0) for n in rich.nuisances.each]), _likely(rich.specimen)
        )
        return cls(candidates, problem, v, errors, tuple(found))


def _likely(specimen: StatedSpecimen) -> list[Effect]:
    each = catalogue(specimen)
    return [e for e in each if not any(q.neutral is None and not q.fixed for q in e.parameters)]


def far(law: CoreLaw, other: CoreLaw, band_hz: tuple[float, float], share: float) -> bool:
    """Whether two laws' moduli differ by more than a share anywhere in a band."""
    omega = 2 * np.pi * np.geomspace(*band_hz, 9)
    return bool(np.max(np.abs(law.modulus(omega) / other.modulus(omega) - 1)) > share)
