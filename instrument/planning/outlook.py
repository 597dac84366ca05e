"""The models a plan is made with: a specimen's resonances, candidates, and what readings there would say."""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.errors import OutsideModel
from fitting.planning.candidates import Candidates, candidate_frequencies, regions, resonances_hz
from fitting.planning.exact_problem import exact_problem
from fitting.planning.sensitivity import ReadingNoise, Sensitivity, bent, sensitivity
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.models.set_up import Hammer, SetUp, set_up
from instrument.planning.costs import as_run, dwell_seconds, step_seconds
from instrument.progress import Progress, quiet
from instrument.stepped_sine.settings import SweepSettings

_WIDEST_HZ = (5.0, 600.0)
"""Where resonances are looked for while no band is given."""
_SEEN = 0.01
"""Of the largest resonance's response at the spot: a smaller one is no region of its own to begin with."""
_USUAL = 3
"""Resonances of a band that nobody asked for."""
_EDGE = (0.08, 0.22)
"""How far such a band goes beyond its outer resonances, in shares of their frequency, by their loss
factor."""
_LOSSLESS = 1e-9
"""Loss factor below which there is none: a law with as good as none is taken at its word."""

Band = tuple[float, float]


@dataclass(frozen=True)
class Outlook:
    """Of one specimen, one spot, one band."""

    specimen: PlateSpecimen
    setup: SetUp
    poles_hz: Complex
    """Of the plate, by the law it starts from, and as it rings."""
    band_hz: Band
    candidates: Candidates

    @property
    def bare(self) -> BareModes | None:
        """The hammer test, where there was one."""
        return self.setup.bare

    @property
    def here(self) -> "At":
        """The plate as read at the stated spot."""
        assert self.specimen.pickup_m is not None
        return At(self.setup.problem.plate, self.setup.reduced, self.specimen.pickup_m)

    def problem(self, level_m_s2: float, at: "At") -> DiagnosisProblem:
        """The problem of readings at all candidate frequencies."""
        c = self.candidates
        return exact_problem(
            c.frequency_hz,
            c.region,
            level_m_s2,
            replace(self.specimen, pickup_m=at.spot_m),
            at.plate,
            at.reduced,
            np.cumsum(c.seconds),
        )

    def sensitivity(self, level_m_s2: float, noise: ReadingNoise, at: "At | None" = None) -> Sensitivity:
        """What readings at the candidates say, of the specimen's spot or of another."""
        at = at or self.here
        problem = self.problem(level_m_s2, at)
        law = bent(self.specimen.core.law, problem)  # type: ignore[union-attr]
        return sensitivity(
            problem,
            at.reduced,
            law,
            z=problem.as_stated,
            noise=noise,
            dwell_s=self.candidates.dwell_s,
            bare=self.bare,
        )


@dataclass(frozen=True)
class At:
    """A plate read at one spot."""

    plate: EnrichedReducedPlate
    reduced: ReducedPlate
    spot_m: tuple[float, float]


def outlook_of(
    specimen: PlateSpecimen,
    settings: SweepSettings,
    band_hz: Band | None = None,
    hammer: Hammer | None = None,
    progress: Progress = quiet,
    *,
    with_effects: bool = False,
) -> Outlook:
    """Of a plate with the law it starts from. Raises `OutsideModel` where there is none, or no answer."""
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to plan for, expected [core] and [constraining]")
    law = specimen.core.law
    if not law.names:
        raise OutsideModel(
            f"core law {law.kind} has no numbers that a sweep could find, expected one that has, as "
            "fractional-zener"
        )
    ends = np.array(band_hz or _WIDEST_HZ)
    few = Sweep(ends, np.ones(2, complex), np.ones(2), np.ones(2, np.intp), np.ones(2, np.intp))
    setup = set_up(few, specimen, hammer, progress, with_effects=with_effects)
    poles = PlatePoles(setup.problem.plate, law.lifted())
    low, high = band_hz or usual_band(setup, resonances_hz(poles, *_WIDEST_HZ))
    if np.max(law.storage_and_loss(2 * np.pi * np.geomspace(low, high))[1]) < _LOSSLESS:
        raise OutsideModel(
            f"the core's law has no loss from {low:g} to {high:g} Hz, and nothing is a percentage of it: "
            "expected the loss that is supposed"
        )
    every = resonances_hz(poles, min(low, _WIDEST_HZ[0]), high)
    f = candidate_frequencies(every, low, high)
    seen = every[visible(setup, every)]
    ringing = as_run(every if len(every) else first_hz(poles), setup.specimen)
    seconds = step_seconds(f, ringing, settings)
    candidates = Candidates(f, regions(f, seen), dwell_seconds(f, settings), seconds)
    return Outlook(setup.specimen, setup, ringing, (float(f[0]), float(f[-1])), candidates)


def first_hz(poles: PlatePoles) -> Complex:
    """The lowest resonance: it rings below it too. Shape (1,). Raises `OutsideModel` without any."""
    found = resonances_hz(poles, *_WIDEST_HZ)[:1]
    if not len(found):
        raise OutsideModel(f"no resonance between {_WIDEST_HZ[0]:g} and {_WIDEST_HZ[1]:g} Hz: nothing rings")
    return found


def usual_band(setup: SetUp, poles_hz: Complex) -> Band:
    """Around the first three poles, shape (any,), that the spot sees. Raises `OutsideModel` without any."""
    seen = poles_hz[visible(setup, poles_hz)][:_USUAL]
    if not len(seen):
        raise OutsideModel(
            f"no resonance between {_WIDEST_HZ[0]:g} and {_WIDEST_HZ[1]:g} Hz: give the band to be measured"
        )
    low, high = seen[0], seen[-1]
    below, above = (float(np.clip(2.6 * p.imag / p.real, *_EDGE)) for p in (low, high))
    return round(low.real * (1 - below), 2), round(high.real * (1 + above), 2)


def visible(setup: SetUp, poles_hz: Complex) -> Array:
    """Which resonances stand out at the spot. Shape of `poles_hz`, true or false."""
    if not len(poles_hz):
        return np.zeros(0, dtype=bool)
    omega = 2 * np.pi * poles_hz.real
    core = setup.specimen.core
    assert core is not None
    v = omega * np.abs(setup.reduced.displacement(omega, core.law.modulus(omega)))
    return np.asarray(v > _SEEN * v.max())
