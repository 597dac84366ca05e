"""The stated numbers of a specimen as unknowns of a fit, in standard deviations of their tolerances.

Each is zero as stated, with a prior of unit width. They enter by the coefficients of the plate's parts, by
the row that reads the pickup, by the modal ratios and by the velocity channel. Coefficients are exact;
derivatives of the response follow from theirs by the chain rule.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.bare_numbers import BareNumbers
from fitting.nuisances.channel import StatedChannel
from fitting.nuisances.modal_ratios import StatedRatios
from fitting.nuisances.narrow import NarrowResonances
from fitting.nuisances.nuisance import Nuisance, felt
from fitting.nuisances.placed import Masses, PlacedPoints
from fitting.nuisances.spots import Place, Spot, StatedSpots
from fitting.nuisances.stated_coefficients import PlateCoefficients, StatedCoefficients
from fitting.nuisances.sums import SideBySide, between
from fitting.plate.parts import loaded
from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


def nuisances_of(
    specimen: PlateSpecimen,
    plate: EnrichedReducedPlate,
    *,
    has_phase: bool,
    reference: PlateSpecimen | None = None,
) -> "Nuisances":
    """All stated numbers of a specimen that its sweep can feel.

    `plate` is of `reference`, one like it, where that is given.
    """
    return Nuisances(specimen, felt(specimen, plate, has_phase=has_phase), reference)


@dataclass(frozen=True)
class Nuisances:
    """The stated numbers of one specimen that a fit may move, and what they change.

    `z` has shape (count,) throughout, in standard deviations.
    """

    specimen: PlateSpecimen
    each: tuple[Nuisance, ...] = ()
    like: PlateSpecimen | None = None
    """Specimen whose mesh, parts and row the reduced plate uses; None: this one."""
    narrow: NarrowResonances = field(default_factory=NarrowResonances, kw_only=True)
    """Narrow resonances fitted as unknowns; their numbers are the last of `each`."""

    def __len__(self) -> int:
        return len(self.each)

    @property
    def change_nothing(self) -> bool:
        """Whether the plate stays as its model is."""
        return not self.each and self.like is None and not self.masses

    @property
    def masses(self) -> tuple[PlacedMass, ...]:
        """Known masses that are placed on the plate."""
        return self.specimen.masses

    @property
    def reference(self) -> PlateSpecimen:
        """Specimen that the reduced plate was built for."""
        return self.like or self.specimen

    @cached_property
    def _sigma(self) -> Array:
        return np.array([n.sigma for n in self.each], dtype=float)

    @cached_property
    def of_parts(self) -> StatedCoefficients:
        """What they make of the coefficients of the plate's parts."""
        return PlateCoefficients(self.each, self.specimen, self.reference)

    @cached_property
    def _bare(self) -> BareNumbers:
        return BareNumbers(self._plate_coefficients)

    @property
    def _plate_coefficients(self) -> PlateCoefficients:
        assert isinstance(self.of_parts, PlateCoefficients)
        return self.of_parts

    @cached_property
    def of_bare_plate(self) -> list[int]:
        """Those that a hammer test of the bare plate feels."""
        return self._bare.places

    def bare_coefficients(self, z: Array) -> tuple[Array | Complex, Array]:
        """Of the bare plate's stiffness and mass, its length as stated. Shapes of `STIFFNESS` and `MASS`."""
        return self._bare.coefficients(z)

    def moved_specimen(self, z: Array) -> PlateSpecimen:
        """The specimen, the numbers of its plate moved by `z` standard deviations. Shape (nuisances,)."""
        return self._plate_coefficients.moved_specimen(z)

    @cached_property
    def channel(self) -> StatedChannel:
        """What they make of the velocity channel."""
        return StatedChannel(self.each)

    @cached_property
    def ratios(self) -> StatedRatios:
        """What they make of the modal damping."""
        return StatedRatios(self.each)

    @cached_property
    def spots(self) -> StatedSpots:
        """Where it is read, and where a force drives it."""
        return StatedSpots(self._points, *self._spots_of())

    def _spots_of(self) -> tuple[dict[Spot, Place], dict[Spot, Place]]:
        """As stated, and of the reference."""
        return _spots_of(self.specimen), _spots_of(self.reference)

    @cached_property
    def _places(self) -> dict[str, int]:
        return {n.name: k for k, n in enumerate(self.each)}

    @cached_property
    def _kept_parts(self) -> SideBySide:
        return SideBySide()

    def change(self, plate: EnrichedReducedPlate, z: Array) -> Change:
        """What they change of a plate that has the parts of `specimen`."""
        c = self.of_parts.change(z)
        K, K_1, M = self.of_parts.counts.summed(c, plate.parts)
        moved: Complex | float = 0.0
        if self.narrow:
            s = self._narrow_sides(plate)
            moved = (s * self.narrow.stiffer(z[self._of_narrow])) @ s.T
        own = Change(
            K=K + moved,
            K_1=K_1.real,
            M=M.real,
            load=self._load(plate, c) + self.spots.force_change(plate, z),
            observe=self.spots.row_change(plate, z),
            damping=self.ratios.factor(len(plate.d), z),
        )
        return own.and_then(self._masses.change(plate, z)) if self.masses else own

    def masses_moved(self, plate: EnrichedReducedPlate, z: Array, longer_m: float) -> Change:
        """What masses change more where an effect makes the free length another one (`Masses.moved`).

        `z` of shape (numbers,).
        """
        return self._masses.moved(plate, z, longer_m)

    @cached_property
    def _of_narrow(self) -> list[int]:
        return [self._places[n.name] for n in self.narrow.numbers]

    def _narrow_sides(self, plate: EnrichedReducedPlate) -> Array:
        """Shape (k, resonances)."""
        return plate.U[:, plate.U.shape[1] - len(self.narrow) :]

    def with_narrow(self, narrow: NarrowResonances) -> "Nuisances":
        """The same with where some resonances lie; the plate has their sides (`NarrowResonances`)."""
        return replace(self, each=(*self.each, *narrow.numbers), narrow=narrow)

    @cached_property
    def _points(self) -> PlacedPoints:
        return PlacedPoints(self.specimen, self.reference, self._places, self._sigma)

    @cached_property
    def _masses(self) -> Masses:
        return Masses(self.masses, self._points)

    def _load(self, plate: EnrichedReducedPlate, c: Array) -> Array:
        """Additional load. Shape (k,)."""
        return self.of_parts.load_sign * loaded(c[self.of_parts.counts.load].real, plate.load_part)

    def by_response(
        self,
        plate: EnrichedReducedPlate,
        omega: Array,
        G: Complex,
        q: Complex,
        adjoint: Complex,
        z: Array,
        *,
        loads: bool = True,
        reads: bool = True,
    ) -> Complex:
        """Derivatives of adjoint . (load - A q) + observe . q. Shapes (points, k) of both; (count, points).

        Without `loads` or `reads` of a load or a row that does not depend on the stated numbers.
        """
        found = self._by_matrices(plate, omega, G, q, adjoint, z)
        if reads:
            for k, row in self.spots.rows_by("pickup", plate, z).items():
                found[k] += q @ row
        if loads:
            found += self._by_load(plate, adjoint, z)
            for k, moved_load in self._masses.by_load(plate, adjoint, z).items():
                found[k] += moved_load
            for k, row in self.spots.rows_by("force", plate, z).items():
                found[k] += adjoint @ row
        return found

    def _by_load(self, plate: EnrichedReducedPlate, adjoint: Complex, z: Array) -> Complex:
        by = self.of_parts.load_sign * self.of_parts.by(z)[:, self.of_parts.counts.load].real
        if plate.load_part.ndim > 1:
            return np.asarray(by @ (plate.load_part @ adjoint.T))
        return np.asarray(by * (adjoint @ plate.load_part))

    def _by_matrices(
        self, plate: EnrichedReducedPlate, omega: Array, G: Complex, q: Complex, adjoint: Complex, z: Array
    ) -> Complex:
        each = between(self._kept_parts.of(plate.parts), q, adjoint)
        counts = self.of_parts.counts
        counts.weigh(each, G, -(omega**2))
        by = self.of_parts.by(z)[:, counts.matrices]
        found = np.asarray(-(by @ each), dtype=complex)
        for k, moved_mass in self._masses.by_mass(plate, q, adjoint, z).items():
            found[k] += omega**2 * moved_mass
        if self.narrow:
            s, at = self._narrow_sides(plate), self._of_narrow
            found[at] -= self.narrow.by(z[at]) @ ((adjoint @ s) * (q @ s)).T
        damped = self.ratios.by(len(plate.d), z)
        modes = [mode for mode, _ in damped.values()]
        strength = np.array([slope for _, slope in damped.values()]) * plate.d[modes]
        # All modes at once: each by itself is a product too small for its call.
        found[list(damped)] -= (
            1j * omega * (strength * (adjoint @ plate.U[:, modes]) * (q @ plate.U[:, modes])).T
        )
        return found

    def reading(self, v: Complex, omega: Array, z: Array) -> Complex:
        """What the velocity channel makes of a velocity. Shape (points,)."""
        return self.channel.reading(v, omega, z)

    def by_reading(self, read: Complex, omega: Array, z: Array) -> dict[int, Complex]:
        """Derivatives of what has been read. Shape (..., points) each, of `z` (..., numbers)."""
        return self.channel.by_reading(read, omega, z)


def _spots_of(specimen: PlateSpecimen) -> dict[Spot, Place]:
    stated: dict[Spot, Place | None] = {"pickup": specimen.pickup_m, "force": specimen.force_m}
    return {spot: place for spot, place in stated.items() if place is not None}
