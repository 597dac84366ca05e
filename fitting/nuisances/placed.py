"""Points of a plate that are known within tolerances, and masses that sit at some of them.

All rows are of the plate as it was meshed: one that is longer or wider is that plate stretched.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

Placed = list[tuple[float, dict[int, float]]]
"""X and y in m on the plate as it was meshed, and how each goes with the stated numbers, by their places."""


@dataclass(frozen=True)
class PlacedPoints:
    """The points of a specimen whose places are stated numbers of a fit.

    `z` has shape (numbers,), in standard deviations.
    """

    specimen: PlateSpecimen
    reference: PlateSpecimen
    """The specimen as it was meshed."""
    places: Mapping[str, int]
    """Of stated numbers, by name."""
    sigma: Array
    """Shape (numbers,)."""

    def by(self, name: str, z: Array) -> float:
        """By how much a number is moved, as its tolerance counts; zero for one that is exact."""
        k = self.places.get(name)
        return float(self.sigma[k] * z[k]) if k is not None else 0.0

    def at(self, place_m: tuple[float, float], name: str, z: Array, *, from_tip: bool = False) -> Placed:
        """A point known within the numbers `name`_x and `name`_y.

        It is so many metres from the clamp; or, `from_tip`, from where the free end is as stated.
        """
        found = []
        for side, axis, at in (("length", "x", place_m[0]), ("width", "y", place_m[1])):
            more = self.by(side, z)
            side_m = getattr(self.specimen, f"{side}_m") + more
            stretch = getattr(self.reference, f"{side}_m") / side_m
            goes_along = 1.0 if from_tip and side == "length" else 0.0
            at = at + goes_along * more + self.by(f"{name}_{axis}", z)
            slopes = {f"{name}_{axis}": stretch, side: (goes_along - at / side_m) * stretch}
            by = {
                self.places[n]: v * self.sigma[self.places[n]] for n, v in slopes.items() if n in self.places
            }
            found.append((at * stretch, by))
        return found


@dataclass(frozen=True)
class Masses:
    """Small known masses on a plate: what they change, and how that goes with their stated numbers."""

    each: tuple[PlacedMass, ...]
    points: PlacedPoints

    @property
    def _heave(self) -> float:
        """Load of a unit mass, over that of a base which moves it along."""
        return 1.0 if self.points.specimen.drive == "base" else 0.0

    def rows(self, plate: EnrichedReducedPlate, z: Array) -> list[tuple[float, Array]]:
        """Each mass in kg, and what reads the deflection where it is. Shape (k,), of `z` (numbers,)."""
        found = []
        for k, m in enumerate(self.each):
            (x, _), (y, _) = self._at(k, z)
            found.append((m.mass_kg * float(np.exp(self.points.by(f"mass_{k + 1}", z))), plate.row(x, y)))
        return found

    def _at(self, k: int, z: Array) -> Placed:
        m = self.each[k]
        return self.points.at((m.x_m, m.y_m), f"place_{k + 1}", z, from_tip=True)

    def change(self, plate: EnrichedReducedPlate, z: Array) -> Change:
        """Of the plate without them. `z` of shape (numbers,)."""
        found = Change()
        for mass, w in self.rows(plate, z):
            found = found.and_then(Change(M=mass * np.outer(w, w), load=-self._heave * mass * w))
        return found

    def moved(self, plate: EnrichedReducedPlate, z: Array, longer_m: float) -> Change:
        """What they change more where an effect makes the free length another one: they stay by the tip.

        `z` of shape (numbers,).
        """
        found = Change()
        side_m = self.points.reference.length_m
        for k, (mass, w) in enumerate(self.rows(plate, z)):
            (x, _), (y, _) = self._at(k, z)
            there = plate.row((x + longer_m) * side_m / (side_m + longer_m), y)
            M = mass * (np.outer(there, there) - np.outer(w, w))
            found = found.and_then(Change(M=M, load=-self._heave * mass * (there - w)))
        return found

    def by_load(self, plate: EnrichedReducedPlate, adjoint: Complex, z: Array) -> dict[int, Complex]:
        """Derivatives of adjoint . load by number. Shapes (points, k) and (numbers,); (points,) each."""
        found: dict[int, Complex] = {}
        for k, _, _, by_load, _ in self._ways(plate, z):
            found[k] = found.get(k, 0.0) - self._heave * (adjoint @ by_load)
        return found

    def by_mass(
        self, plate: EnrichedReducedPlate, q: Complex, adjoint: Complex, z: Array
    ) -> dict[int, Complex]:
        """Derivatives of adjoint . M q by number. Shapes (points, k) of both, (numbers,); (points,) each."""
        found: dict[int, Complex] = {}
        for k, mass, w, by_load, by in self._ways(plate, z):
            either = (adjoint @ by_load) * (q @ w) + mass * (adjoint @ w) * (q @ by)
            found[k] = found.get(k, 0.0) + either
        return found

    def _ways(
        self, plate: EnrichedReducedPlate, z: Array
    ) -> Iterator[tuple[int, float, Array, Array, Array]]:
        """Of each number that one feels: it, mass m and row w, and the derivatives of m w and of w."""
        for n, (mass, w) in enumerate(self.rows(plate, z)):
            k = self.points.places.get(f"mass_{n + 1}")
            if k is not None:
                yield k, mass, w, float(self.points.sigma[k]) * mass * w, np.zeros_like(w)
            (x, by_x), (y, by_y) = self._at(n, z)
            for slopes, (dx, dy) in ((by_x, (1, 0)), (by_y, (0, 1))):
                slope = plate.row(x, y, dx, dy) if slopes else w
                for k, size in slopes.items():
                    yield k, mass, w, mass * size * slope, size * slope
