"""The stated numbers of a specimen as unknowns of a fit, in standard deviations of their tolerances.

Each is zero as stated, with a prior of unit width. They enter by the coefficients of the plate's parts, by
the row that reads the pickup, by the modal ratios and by the velocity channel. Coefficients are exact;
derivatives of the response follow from theirs by the chain rule.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.nuisances.narrow import NarrowResonances
from fitting.nuisances.nuisance import Nuisance, felt
from fitting.nuisances.placed import Masses, Placed, PlacedPoints
from fitting.nuisances.sums import Kept, SideBySide, between
from fitting.plate.part_counts import PartCounts
from fitting.plate.parts import coefficients, loaded, names_of
from fitting.plate.plate_numbers import moved
from fitting.specimen import PlacedMass, Specimen
from fitting.stated.patches import OF_PATCHES
from fitting.stated.tolerances import PLATE

STEP = 1e-2
"""Step of differences, in standard deviations."""
_MOST_BARE = 512
"""Sets of a bare plate's few coefficients kept: derivatives about some twenty places of its numbers."""
_FELT = 0.3
"""Standard deviations from which a plate's derivatives to stated numbers are taken to vary."""
_TREATMENT = ("constraining", "core", "glue", *OF_PATCHES)
_OF_A_MOUNTING = ("length", "axial")
Spot = Literal["pickup", "force"]


def nuisances_of(
    specimen: Specimen, plate: EnrichedReducedPlate, *, has_phase: bool, reference: Specimen | None = None
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

    specimen: Specimen
    each: tuple[Nuisance, ...] = ()
    like: Specimen | None = None
    """Whose parts and row the plate has, where they are not the specimen's own: one as long in elements."""
    narrow: NarrowResonances = field(default_factory=NarrowResonances, kw_only=True)
    """Whose places are numbers of the fit; the last of `each` are theirs."""

    def __len__(self) -> int:
        return len(self.each)

    @property
    def change_nothing(self) -> bool:
        """Whether the plate stays as its model is."""
        return not self.each and self.like is None and not self.masses

    @property
    def masses(self) -> tuple[PlacedMass, ...]:
        """Known masses placed on the plate; empty for beams and shear pairs, whose matrices hold them."""
        return self.specimen.masses if isinstance(self.specimen, Specimen) else ()

    @property
    def reference(self) -> Specimen:
        """Whose parts and row the plate has."""
        return self.like or self.specimen

    @cached_property
    def _sigma(self) -> Array:
        return np.array([n.sigma for n in self.each], dtype=float)

    @cached_property
    def _of_plate(self) -> list[int]:
        return [k for k, n in enumerate(self.each) if n.kind in PLATE]

    @cached_property
    def of_bare_plate(self) -> list[int]:
        """Those that a hammer test of the bare plate feels."""
        return [k for k in self._of_plate if not self.each[k].kind.startswith((*_TREATMENT, *_OF_A_MOUNTING))]

    @cached_property
    def _stated(self) -> Array:
        return np.asarray(coefficients(self.reference, self.reference).all)

    @cached_property
    def counts(self) -> PartCounts:
        """How many parts K_0, K_1 and M have; those of the load follow them."""
        return names_of(self.reference).counts

    @cached_property
    def _places(self) -> dict[str, int]:
        return {n.name: k for k, n in enumerate(self.each)}

    @cached_property
    def _damped(self) -> list[tuple[int, int]]:
        """Nuisance and mode."""
        return [(k, int(n.name.split("_")[1]) - 1) for k, n in enumerate(self.each) if n.kind == "damping"]

    def moved_specimen(self, z: Array) -> Specimen:
        """The specimen, the numbers of its plate moved by `z` standard deviations. Shape (nuisances,)."""
        names = [self.each[k].name for k in self._of_plate]
        return moved(self.specimen, names, (self._sigma * z)[self._of_plate].tolist())

    def _coefficients(self, z: Array) -> Array:
        """Of all parts, and of the load. Complex where a face has a loss factor. Shape (parts + 1,)."""
        return np.asarray(coefficients(self.moved_specimen(z), self.reference).all)

    def bare_coefficients(self, z: Array) -> tuple[Array | Complex, Array]:
        """Of the bare plate's stiffness and mass, its length as stated. Shapes of `STIFFNESS` and `MASS`."""
        # A hammer test is a mounting of its own.
        at = np.zeros(len(self))
        at[self.of_bare_plate] = z[self.of_bare_plate]
        c = self._kept_of_bare.get("c", at, lambda: self._bare_coefficients(at))
        stiff = self._bare_stiff
        return c[:stiff], c[stiff:].real

    def _bare_coefficients(self, z: Array) -> Array:
        c = coefficients(self.moved_specimen(z).bare, self.specimen.bare)
        return np.concatenate([c.K_0, c.M])

    @cached_property
    def _bare_stiff(self) -> int:
        """How many parts the bare plate's K_0 has."""
        return len(coefficients(self.specimen.bare, self.specimen.bare).K_0)

    @cached_property
    def _kept_of_bare(self) -> "Kept":
        return Kept(_MOST_BARE)

    @cached_property
    def _kept(self) -> "Kept":
        return Kept()

    @cached_property
    def _kept_parts(self) -> "SideBySide":
        return SideBySide()

    @cached_property
    def _kept_differences(self) -> "Kept":
        # They are few, and dear.
        return Kept()

    def coefficients(self, z: Array) -> Array:
        """Of all parts and the load above the reference's. Shape (parts + 1,)."""
        return self._kept.get("c", z, lambda: self._coefficients(z) - self._stated)

    def by_coefficients(self, z: Array) -> Array:
        """Their derivatives to z, as far as these vary linearly with each. Shape (count, parts + 1).

        Good to 2 % of a plate with a soft core, and dear to have exactly at every step of a sweep's fit.
        """
        return self._kept.get("dc", z, lambda: self._nearly_by_coefficients(z))

    def by_coefficients_there(self, z: Array) -> Array:
        """The same at the very place: of a stiff core the parts cancel by thousands."""
        return self._kept.get("dc there", z, lambda: self._differences(z))

    def _nearly_by_coefficients(self, z: Array) -> Array:
        found = self._as_stated
        for k in self._of_plate:
            if abs(z[k]) > _FELT:
                found = found + z[k] * self._second(k)
        return found

    @cached_property
    def _as_stated(self) -> Array:
        return self._differences(np.zeros(len(self)))

    def _second(self, k: int) -> Array:
        """How derivatives vary with one number."""
        step = np.zeros(len(self))
        step[k] = 1.0
        return self._kept_differences.get(
            "ddc", step, lambda: (self._differences(step) - self._differences(-step)) / 2
        )

    def _differences(self, z: Array) -> Array:
        by = {}
        for k in self._of_plate:
            up, down = z.copy(), z.copy()
            up[k], down[k] = z[k] + STEP, z[k] - STEP
            by[k] = (self._coefficients(up) - self._coefficients(down)) / (2 * STEP)
        # A loss makes some complex.
        found = np.zeros((len(self), len(self._stated)), np.result_type(self._stated, *by.values()))
        for k, row in by.items():
            found[k] = row
        return found

    def change(self, plate: EnrichedReducedPlate, z: Array) -> Change:
        """What they change of a plate that has the parts of `specimen`."""
        c = self.coefficients(z)
        K, K_1, M = self.counts.summed(c, plate.parts)
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
        """What the load becomes more. Shape (k,)."""
        load = c[self.counts.load].real
        return -loaded(float(load[0]) if len(load) == 1 else load, plate.load_part)

    def _row_change(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        return self.row(plate, z) - plate.pickup_row

    def row(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        """Reads w at the pickup, where it is on the plate as long and as wide as it is. Shape (k,)."""
        (x, _), (y, _) = self._spot("pickup", z)
        return plate.row(x, y)

    def rows_by(self, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        """Derivatives of `row` to those that move it, by number. Shape (k,) each, of `z` (numbers,)."""
        return self._rows_by("pickup", plate, z)

    def _force_change(self, plate: EnrichedReducedPlate, z: Array) -> Array | float:
        """What the load of a force becomes more. Shape (k,)."""
        if self.specimen.drive == "base":
            return 0.0
        (x, _), (y, _) = self._spot("force", z)
        assert self.reference.force_m is not None
        return plate.row(x, y) - plate.row(*self.reference.force_m)

    def _rows_by(self, spot: Spot, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        (x, by_x), (y, by_y) = self._spot(spot, z)
        found: dict[int, Array] = {}
        for slopes, (dx, dy) in ((by_x, (1, 0)), (by_y, (0, 1))):
            if slopes:
                slope = plate.row(x, y, dx, dy)
                found |= {k: size * slope for k, size in slopes.items()}
        return found

    def _spot(self, spot: Spot, z: Array) -> Placed:
        """X and y in m of the point on the plate of `reference`, and how they go with z."""
        s = self.specimen
        place = s.pickup_m if spot == "pickup" else s.force_m
        assert place is not None
        return self._points.at(place, spot, z)

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
        found -= self._by_load(plate, adjoint, z)
        for k, moved_load in self._masses.by_load(plate, adjoint, z).items():
            found[k] += moved_load
        if self.specimen.drive == "force":
            for k, row in self._rows_by("force", plate, z).items():
                found[k] += adjoint @ row
        return found

    def _by_load(self, plate: EnrichedReducedPlate, adjoint: Complex, z: Array) -> Complex:
        by = self.by_coefficients(z)[:, self.counts.load].real
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
        self.counts.weigh(each, G, -(omega**2))
        by = self.by_coefficients(z)[:, self.counts.matrices]
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
        gain, delay, phase = (self._points.by(kind, z) for kind in ("gain", "delay", "phase"))
        if not gain and not delay and not phase:
            return v
        return np.asarray(v * ((1 + gain) * np.exp(1j * (phase - omega * delay))))

    def by_reading(self, read: Complex, omega: Array, z: Array) -> dict[int, Complex]:
        """Derivatives of what has been read. Shape (points,) each."""
        found: dict[int, Complex] = {}
        k = self._places.get("gain")
        if k is not None:
            found[k] = read * (self._sigma[k] / (1 + self._points.by("gain", z)))
        k = self._places.get("delay")
        if k is not None:
            found[k] = read * (-1j * omega * self._sigma[k])
        k = self._places.get("phase")
        if k is not None:
            found[k] = read * (1j * self._sigma[k])
        return found
