"""The stated numbers of a specimen as unknowns of a fit, in standard deviations of their tolerances.

Each is zero as stated, with a prior of unit width. They enter by the coefficients of the plate's parts, by
the row that reads the pickup, by the modal ratios and by the velocity channel. Coefficients are exact;
derivatives of the response follow from theirs by the chain rule.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.bare_numbers import BareNumbers
from fitting.nuisances.channel import StatedChannel
from fitting.nuisances.narrow import NarrowResonances
from fitting.nuisances.nuisance import Nuisance, felt
from fitting.nuisances.placed import Masses, Placed, PlacedPoints
from fitting.nuisances.stated_coefficients import PlateCoefficients, StatedCoefficients
from fitting.nuisances.sums import SideBySide, between
from fitting.plate.parts import loaded
from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

Spot = Literal["pickup", "force"]
SPOTS: tuple[Spot, ...] = get_args(Spot)
Place = tuple[float, float]
"""X and y, in m."""


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
    def _places(self) -> dict[str, int]:
        return {n.name: k for k, n in enumerate(self.each)}

    @cached_property
    def _damped(self) -> list[tuple[int, int]]:
        """Nuisance and mode."""
        return [(k, int(n.name.split("_")[1]) - 1) for k, n in enumerate(self.each) if n.kind == "damping"]

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
            load=self._load(plate, c) + self._force_change(plate, z),
            observe=self._row_change(plate, z),
            damping=self._damping(len(plate.d), z),
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

    def _row_change(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        return (
            self.row(plate, z) - plate.pickup_row if "pickup" in self._spots else np.zeros(len(plate.observe))
        )

    def row(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        """Reads w at the pickup, where it is on the plate as long and as wide as it is. Shape (k,)."""
        (x, _), (y, _) = self._spot("pickup", z)
        return plate.row(x, y)

    def rows_by(self, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        """Derivatives of `row` to those that move it, by number. Shape (k,) each, of `z` (numbers,)."""
        return self._rows_by("pickup", plate, z)

    def _force_change(self, plate: EnrichedReducedPlate, z: Array) -> Array | float:
        """Additional load of a force. Shape (k,)."""
        if "force" not in self._spots:
            return 0.0
        (x, _), (y, _) = self._spot("force", z)
        return plate.row(x, y) - plate.row(*self._spots_of(self.reference)["force"])

    def _rows_by(self, spot: Spot, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        if spot not in self._spots:
            return {}
        (x, by_x), (y, by_y) = self._spot(spot, z)
        found: dict[int, Array] = {}
        for slopes, (dx, dy) in ((by_x, (1, 0)), (by_y, (0, 1))):
            if slopes:
                slope = plate.row(x, y, dx, dy)
                found |= {k: size * slope for k, size in slopes.items()}
        return found

    @cached_property
    def _spots(self) -> Mapping[Spot, Place]:
        return self._spots_of(self.specimen)

    def _spots_of(self, specimen: PlateSpecimen) -> Mapping[Spot, Place]:
        """Where one like it is read, and where a force drives it."""
        stated: dict[Spot, Place | None] = {"pickup": specimen.pickup_m, "force": specimen.force_m}
        return {spot: place for spot, place in stated.items() if place is not None}

    def _spot(self, spot: Spot, z: Array) -> Placed:
        """X and y in m of the point on the plate of `reference`, and how they go with z."""
        return self._points.at(self._spots[spot], spot, z)

    def _damping(self, modes: int, z: Array) -> Array:
        found = np.ones(modes)
        for k, mode in self._damped:
            found[mode] = np.exp(self._sigma[k] * z[k])
        return found

    def by_damping(self, modes: int, z: Array) -> dict[int, tuple[int, float]]:
        """Of each number that is a modal ratio: its mode, and the derivative of that mode's factor."""
        factor = self._damping(modes, z)
        return {k: (mode, float(self._sigma[k] * factor[mode])) for k, mode in self._damped}

    def by_response(
        self, plate: EnrichedReducedPlate, omega: Array, G: Complex, q: Complex, adjoint: Complex, z: Array
    ) -> Complex:
        """Derivatives of adjoint . (load - A q) + observe . q. Shapes (points, k) of both; (count, points).

        For a load that does not depend on the stated numbers take `by_pitch`.
        """
        found = self._by_matrices(plate, omega, G, q, adjoint, z)
        found += self._by_load(plate, adjoint, z)
        for k, moved_load in self._masses.by_load(plate, adjoint, z).items():
            found[k] += moved_load
        for k, row in self._rows_by("force", plate, z).items():
            found[k] += adjoint @ row
        return found

    def _by_load(self, plate: EnrichedReducedPlate, adjoint: Complex, z: Array) -> Complex:
        by = self.of_parts.load_sign * self.of_parts.by(z)[:, self.of_parts.counts.load].real
        if plate.load_part.ndim > 1:
            return np.asarray(by @ (plate.load_part @ adjoint.T))
        return np.asarray(by * (adjoint @ plate.load_part))

    def by_pitch(
        self, plate: EnrichedReducedPlate, omega: Array, G: Complex, p: Complex, adjoint: Complex, z: Array
    ) -> Complex:
        """The same for the answer `p` to a turning base."""
        return self._by_matrices(plate, omega, G, p, adjoint, z)

    def _by_matrices(
        self, plate: EnrichedReducedPlate, omega: Array, G: Complex, q: Complex, adjoint: Complex, z: Array
    ) -> Complex:
        each = between(self._kept_parts.of(plate.parts), q, adjoint)
        counts = self.of_parts.counts
        counts.weigh(each, G, -(omega**2))
        by = self.of_parts.by(z)[:, counts.matrices]
        found = np.asarray(-(by @ each), dtype=complex)
        for k, row in self.rows_by(plate, z).items():
            found[k] += q @ row
        for k, moved_mass in self._masses.by_mass(plate, q, adjoint, z).items():
            found[k] += omega**2 * moved_mass
        if self.narrow:
            s, at = self._narrow_sides(plate), self._of_narrow
            found[at] -= self.narrow.by(z[at]) @ ((adjoint @ s) * (q @ s)).T
        damped = self.by_damping(len(plate.d), z)
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
