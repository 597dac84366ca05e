"""The plate that a joint fit has found: the stated one with every number moved to where the fit has it.

It is moved on its reduced model, by the parts of its matrices, exactly as the fit moves it: the models of
the stated plate serve, and nothing is made anew.
"""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.moved_plate import moved_plate
from fitting.nuisances.nuisances import Nuisances
from fitting.plate.mesh import Mesh
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.widened.enriched_plate import EnrichedReducedPlate
from instrument.models.specimen_models import Models


@dataclass(frozen=True)
class FittedPlate:
    """One specimen with its stated numbers moved by `z`, in standard deviations of their tolerances."""

    specimen: PlateSpecimen
    """The specimen as its file states it."""
    nuisances: Nuisances
    z: Array

    def moved_specimen(self) -> PlateSpecimen:
        """What the fit says the plate is: layers, lengths and modal ratios."""
        found = self.nuisances.moved_specimen(self.z)
        by = {n.name: n.sigma * float(z) for n, z in zip(self.nuisances.each, self.z, strict=True)}
        ratios = [
            r * float(np.exp(by.get(f"damping_{k + 1}", 0.0))) for k, r in enumerate(found.modal_ratios)
        ]

        def moved(spot: str, at: tuple[float, float] | None) -> tuple[float, float] | None:
            if at is None:
                return None
            return at[0] + by.get(f"{spot}_x", 0.0), at[1] + by.get(f"{spot}_y", 0.0)

        s = self.specimen
        return replace(
            found,
            modal_ratios=tuple(ratios),
            pickup_m=moved("pickup", s.pickup_m),
            force_m=moved("force", s.force_m),
        )

    def reduced(self, models: Models) -> ReducedPlate:
        """The reduced plate moved; `models` are those of the stated one."""
        return moved_plate(models.reduced, self.nuisances, self._plain(models), self.z)

    def _plain(self, models: Models) -> EnrichedReducedPlate:
        s, reduced = self.specimen, models.reduced
        assert s.pickup_m is not None
        plate = EnrichedReducedPlate.plain(reduced, Mesh(s.length_m, s.width_m, *s.mesh), s.pickup_m)
        count = len(s.modal_ratios)
        # A ratio for every mode, those that these motions do not hear among them.
        U, d = np.zeros((len(reduced.load), count)), np.zeros(count)
        U[:, reduced.mode], d[reduced.mode] = reduced.U, reduced.d
        return replace(plate, U=U, d=d)

    def by_moved(self, models: Models, omega: Array, G: Complex) -> Complex:
        """Derivatives of the displacement to what is moved. Shape (count, points)."""
        if not len(self.z):
            return np.zeros((0, len(omega)), complex)
        moved = self.reduced(models)
        sides = np.stack([moved.load, moved.observe], axis=1).astype(complex)
        both = np.broadcast_to(sides, (len(omega), *sides.shape))
        q, adjoint = np.moveaxis(np.linalg.solve(moved.matrices(omega, G), both), 2, 0)
        return self.nuisances.by_response(self._plain(models), omega, G, q, adjoint, self.z)

    def read(self, velocity: Complex, frequency_hz: Array) -> Complex:
        """What the velocity channel, its gain and delay as found, makes of a velocity. Shape (points,)."""
        return self.nuisances.reading(velocity, 2 * np.pi * frequency_hz, self.z)

    def by_reading(self, velocity: Complex, frequency_hz: Array) -> Complex:
        """Derivatives of what has been read to what the channel does. Shape (count, points)."""
        found = np.zeros((len(self.z), len(frequency_hz)), complex)
        for k, d in self.nuisances.by_reading(velocity, 2 * np.pi * frequency_hz, self.z).items():
            found[k] = d
        return found
