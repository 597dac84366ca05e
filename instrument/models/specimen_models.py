"""The models of a specimen, ready to use: from the cache, or built with progress shown."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.dynamics.damping import LowRankDamping, viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.dynamics.real_mode_response import RealModePlate, real_mode_plate
from fitting.errors import OutsideModel
from fitting.identification.model import velocity
from fitting.laws import CoreLaw
from fitting.plate.plate import Plate
from fitting.reduced.domain import Domain, domain_of
from fitting.reduced.rational import RationalSweep, rational_sweep
from fitting.reduced.reduced_plate import ReducedPlate, reduce_plate
from fitting.specimen import PlateSpecimen
from fitting.widened.enriching import USUAL_HZ, reach_over
from instrument.models.cache import cached
from instrument.progress import Progress, quiet

CERTIFIED = 1e-4
"""Estimated relative error above which the reduced model is not believed."""
_WORST = 3
"""Points that are solved in full where the estimate says so: 50 ms each."""


@dataclass(frozen=True)
class Models:
    """A specimen's plate and reduced models over a domain; heavy ones are made when first asked for."""

    specimen: PlateSpecimen
    domain: Domain
    progress: Progress = quiet
    reach_hz: float = USUAL_HZ
    """How far up the motions hold that effects stir."""

    @classmethod
    def of(cls, specimen: PlateSpecimen, frequency_hz: Array, progress: Progress = quiet) -> "Models":
        """Models that hold over `frequency_hz`, of any shape, for any sensible core.

        Raises `OutsideModel` for a specimen that no base moves or no pickup sees, and beyond what the mesh
        resolves.
        """
        if specimen.masses:
            raise OutsideModel(
                "[[mass]] is for the joint fit of 'identify' and 'diagnose' alone: expected a plate without"
            )
        if specimen.pickup_m is None:
            raise OutsideModel("[pickup] is missing, expected x_mm and y_mm of the measured spot")
        if specimen.boundary == "free" and specimen.drive == "base":
            raise OutsideModel(
                "a free plate has no base to be excited by, expected an edge that is clamped or supported, "
                'or [excitation] kind = "force"'
            )
        return cls(specimen, domain_of(specimen, frequency_hz), progress, reach_over(frequency_hz))

    @cached_property
    def plate(self) -> Plate:
        """The specimen as an assembled plate."""
        return Plate(self.specimen)

    @cached_property
    def damping(self) -> LowRankDamping:
        """The viscous damping that remains beside the core's."""
        return viscous_damping(self.plate)

    @cached_property
    def reduced(self) -> ReducedPlate:
        """The plate reduced to a few motions."""

        def build() -> ReducedPlate:
            with self.progress("reducing the plate model") as report:
                return reduce_plate(self.plate, self.damping, self.domain, report)

        return cached("reduced", [self.without_law, self.domain], ReducedPlate, build)

    @cached_property
    def real_modes(self) -> RealModePlate:
        """The plate as the paper's response sees it.

        Raises `OutsideModel` where that response does not hold.
        """
        if self.specimen.drive == "force" or not self.specimen.only_even:
            raise OutsideModel("the paper's real modes need a base and long edges that are alike")

        def build() -> RealModePlate:
            with self.progress("spanning the real modes") as report:
                return real_mode_plate(self.plate, self.domain.modulus, report)

        return cached("real-modes", [self.without_law, self.domain], RealModePlate, build)

    def rational(self, omega: Array) -> RationalSweep:
        """The sweep on an ascending grid in rad/s as a rational sum. Shape (points,)."""
        reduced = self.reduced

        def build() -> RationalSweep:
            with self.progress("preparing the frequency grid") as report:
                return rational_sweep(reduced, omega, report)

        return cached("rational", [self.without_law, self.domain, omega], RationalSweep, build)

    @property
    def without_law(self) -> PlateSpecimen:
        """The specimen as far as these models depend on it: neither law nor level nor reading."""
        core = replace(self.specimen.core, law=None) if self.specimen.core else None  # type: ignore[arg-type]
        return replace(
            self.specimen, core=core, base_acceleration_m_s2=1.0, reads="relative", tolerances={}, exact=True
        )

    def predict(self, law: CoreLaw | None, frequency_hz: Array, *, real_modes: bool = False) -> Complex:
        """Velocity phasors at the pickup in m/s; a point that is not certified is solved in full.

        Shape (points,).
        """
        omega = 2 * np.pi * frequency_hz
        G = law.modulus(omega) if law is not None else np.zeros(len(omega), dtype=complex)
        if real_modes:
            x = self.real_modes.displacement(omega, G)
        else:
            x = self.reduced.displacement(omega, G)
            doubtful = np.flatnonzero(self.reduced.estimated_error(omega, G) > CERTIFIED)
            with self.progress("solving uncertified points in full") as report:
                for done, k in enumerate(doubtful):
                    x[k] = displacement_direct(self.plate, self.damping, omega[k : k + 1], G[k : k + 1])[0]
                    report((done + 1) / len(doubtful))
        return velocity(omega, x, self.specimen.reads) * self.specimen.drive_amplitude

    def uncertified(self, law: CoreLaw, frequency_hz: Array) -> bool:
        """Whether some point of a law is beyond what the reduced model is certified for. Shape (points,).

        Estimated by residuals, an error is a thousand times too large on a plate that is held nowhere:
        where it is large the worst points are solved in full.
        """
        omega = 2 * np.pi * frequency_hz
        G = law.modulus(omega)
        estimate = self.reduced.estimated_error(omega, G)
        worst = np.argsort(estimate)[-_WORST:]
        worst = worst[estimate[worst] > CERTIFIED]
        if not len(worst):
            return False
        exact = displacement_direct(self.plate, self.damping, omega[worst], G[worst])
        reduced = self.reduced.displacement(omega[worst], G[worst])
        return bool(np.any(np.abs(reduced - exact) > CERTIFIED * np.abs(exact)))
