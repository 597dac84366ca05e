"""The problem of one sweep of a small structure: exact at every point, no grid between."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.data.noise import Noise
from fitting.diagnosis.problem.base import DiagnosisProblem, NodeGrid, points_of
from fitting.diagnosis.problem.channel_error import channel_rows
from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.narrow_resonances import Errs
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.problem.small_error import octaves, theory_rows
from fitting.discrepancy.model_error import ModelError
from fitting.laws import CoreLaw
from fitting.structures.small import (
    SmallNuisances,
    SmallSpecimen,
    SmallSystem,
    check_driven,
    nuisances_of,
    widened_system_of,
)
from fitting.structures.small_sum import rational_of
from fitting.sweep import Sweep
from fitting.widened.condensing import Training, condensed
from fitting.widened.enriched_plate import EnrichedReducedPlate

_PLACES, _FEWEST = 24, 8
"""Frequencies that a beam's first sum is made to hold at, four to each resonance; the least of a band."""
_SIZES, _ANGLES = (0.01, 0.1, 0.5, 2.0, 10.0, 100.0), (0.1, 0.8, 1.4)
"""Moduli that it is made to hold at: sizes, over the law's, times arguments in rad. A decade or less apart,
from hardly any loss to mostly loss."""
_LEFT_OUT = 5e-7
"""Of its largest singular value: off by 1e-7, by 1e-4 in the depth of an anti-resonance without losses."""
_CONDENSED = 1e-6
"""The same of what it is condensed to for a fit: of a first mode that loses 0.002 as much as plates may leave
out is a tenth of the loss."""
FEW = 10
"""Unknowns that are not worth condensing."""
WANDERING = 0.3
"""Share of a misfit that gain and phase wander by from one octave to the next."""
LEVEL = 0.05
"""Of the modulus from one file to the next, where files disagree: less than a kelvin of a damping polymer."""
REACH = 0.12
"""In ln f: how far a misfit goes on; so many neighbouring points say it only once."""
BENT_MORE = 2.0
"""Times the usual freedom of the law, where there is a misfit."""
DEAF = 0.15
"""Where ln of the reading changes by less for a change of ln G*, a misfit leaves nothing of the core."""


def _compact(own: EnrichedReducedPlate, omega: Array, size_pa: float, share: float) -> EnrichedReducedPlate:
    """A beam as far as it answers in a band, for any core within two decades of a size.

    Shape (points,) of `omega`, rad/s: a `share` of all that there are.
    """
    if len(own.load) <= FEW:
        return own
    some = np.geomspace(omega.min(), omega.max(), max(_FEWEST, int(share * _PLACES)))
    place, size = (one.ravel() for one in np.indices((len(some), len(_SIZES))))
    # Every size at every place, each by one argument in turn: what they answer differs little by argument.
    G = size_pa * np.array(_SIZES)[size] * np.exp(1j * np.array(_ANGLES)[(place + size) % len(_ANGLES)])
    return condensed(own, Training(some[place], G), left_out=_LEFT_OUT)


@dataclass(frozen=True)
class SmallProblem(DiagnosisProblem):
    """A sweep with the small structure it was measured on."""

    specimen: SmallSpecimen
    misfit: float = 0.0
    """Of the reading, relative: what a fit has left that nothing explains."""

    @classmethod
    def of_small(cls, sweep: Sweep, specimen: SmallSpecimen) -> "SmallProblem":
        """Everything made, which takes milliseconds."""
        parts = specimen.parts()
        check_driven(parts, specimen)
        system = widened_system_of(specimen, parts)
        assert specimen.core is not None
        size = float(np.exp(np.mean(np.log(np.abs(specimen.core.law.modulus(sweep.omega))))))

        def compact(own: EnrichedReducedPlate, omega: Array) -> EnrichedReducedPlate:
            return _compact(own, omega, size, len(omega) / len(sweep))

        rational = rational_of(system.take([]), sweep.omega, size, compact)
        nodes = EveryPoint.at(sweep.omega)
        grid = NodeGrid(nodes, rational)
        points = points_of(sweep, specimen)
        stated = nuisances_of(specimen, parts, has_phase=sweep.has_phase)
        return cls(sweep, specimen, system, points, rational, grid, grid, nodes, stated)

    def condensed(self, law: CoreLaw, sides: Sequence[Array] = ()) -> "SmallProblem":
        """A beam condensed to moduli about a law's; a pair is small as it is."""
        if len(self.plate.load) <= FEW:
            return self
        found = super().condensed(law, sides)
        assert isinstance(found, SmallProblem)
        return found

    @property
    def with_stated_fixed(self) -> "SmallProblem":
        """Itself."""
        return self

    def around(self, law: CoreLaw, poles: PlatePoles | None = None) -> "SmallProblem":
        """The same under any law."""
        return self

    @property
    def errs(self) -> Errs | None:
        """Its theory, where a resonance may be narrow."""
        return self._theory_error if self.specimen.narrow_resonances else None

    def _theory_error(self, frequency_hz: Array, G: Complex) -> ModelError:
        found = self.specimen.theory_error(frequency_hz, G)
        assert found is not None
        return found

    @property
    def left_out(self) -> float:
        """Of the largest singular value, by its condensed beam."""
        return _CONDENSED

    @property
    def resonances(self) -> Complex:
        """None are looked for: a disturbance shows in the readings themselves. Shape (0,)."""
        return np.zeros(0, complex)

    @property
    def freedom(self) -> float:
        """More where no law of the usual freedom will do."""
        return BENT_MORE if self.misfit else 1.0

    def noise(self, noise: Noise) -> Noise:
        """With the misfit: of one size over `REACH`, however many points are there."""
        if not self.misfit:
            return noise
        f = self.sweep.frequency_hz
        order = np.argsort(f, kind="stable")
        a_point = np.empty(len(f))
        a_point[order] = np.gradient(np.log(f[order])) if len(f) > 1 else REACH
        together = np.sqrt(np.maximum(1.0, REACH / np.maximum(a_point, 1e-9)))
        more = self.misfit * together * np.abs(self.sweep.response_m_s)
        return Noise(np.hypot(noise.std_m_s, more) if noise.is_known else more, "misfit")

    @property
    def errs_in_level(self) -> bool:
        """Files of small structures differ by levels."""
        return True

    @property
    def errs_as_found(self) -> bool:
        """Where a resonance is narrower than its stated numbers may be off."""
        return self.specimen.narrow_resonances and len(self.nuisances) > 0

    def _system(self) -> SmallSystem:
        """With its stated numbers where they were found."""
        system, stated = self.plate, self.nuisances
        assert isinstance(system, SmallSystem)
        if self.found is None or not isinstance(stated, SmallNuisances):
            return system
        change = stated.change(system, self.found)
        return replace(
            system,
            K_0=system.K_0 + change.K,
            K_1=system.K_1 + change.K_1,
            M=system.M + change.M,
            load=system.load + change.load,
            observe=system.observe + change.observe,
        )

    def model_error(self, law: CoreLaw, v: Complex) -> Complex:
        """Gain and phase of the instruments, how they drift, and what the structure's theory gets wrong.

        Shape (any, points).
        """
        has_phase = self.points.has_phase
        segments = [self.sweep.segment == number for number in np.unique(self.sweep.segment)]
        rows = [row for s in segments for row in channel_rows(self.sweep, s, v, has_phase=has_phase)]
        if isinstance(self.plate, SmallSystem):
            drive, omega = self.points.drive_amplitude, self.sweep.omega
            narrow = self.nuisances.narrow
            rows += theory_rows(self.specimen, self._system(), omega, law, drive, narrow)
        if self.misfit:
            hats = octaves(self.sweep.omega)
            size = WANDERING * self.misfit
            rows += [*(size * hats * v), *(1j * size * hats * v)]
            rows.append(LEVEL * self.feels(law, v) * v)
        return np.array(rows)
