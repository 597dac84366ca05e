"""A small structure: full matrices of the equation, by what is stated, for unit coefficients.

    (-omega^2 M + i omega C_1 + K_0 + G* K_1) X = load,   K_0 = sum of c_p P_p,   so K_1, M, load

It needs no reduced basis, and answers at every frequency by itself. What fits and effects are given is the
same kind of object as the widened reduced plate (`fitting.widened.enriched_plate`): its columns are the
unknowns themselves, in groups where some are for an effect alone.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar, Protocol

import numpy as np

from fitting.arrays import Array, Complex
from fitting.discrepancy.model_error import ModelError
from fitting.errors import OutsideModel
from fitting.nuisances.nuisance import Nuisance, channels_felt
from fitting.nuisances.nuisances import Nuisances
from fitting.nuisances.spots import SPOTS, Place, Spot
from fitting.nuisances.stated_coefficients import STEP, StatedCoefficients
from fitting.plate.part_counts import PartCounts
from fitting.specimen import PlacedMass, StatedSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate, Names

_STILL = 1e-9
"""A reading below this reads nothing but rounding."""


@dataclass(frozen=True)
class Parts:
    """Matrices and loads for unit coefficients. Shapes (parts, k, k), the load's (parts, k)."""

    K_0: Array
    K_1: Array
    M: Array
    load: Array
    observe: Array
    """Reads the displacement relative to the base. Shape (k,)."""
    matrices: Mapping[str, Array]
    """What effects may ask for, by name. Shape (k, k) each."""
    deflection: Array
    """w, dw/dy and -dw/dx of every unknown at every node of a strip one element wide. Shape (nodes, 3, k)."""
    size: tuple[float, float, int, int]
    """Length and width in m, elements along each."""
    pickup_m: tuple[float, float]
    group: Names | None = None
    """Of every unknown, as `EnrichedReducedPlate` has it; None: all are its own. Shape (k,)."""
    gram: Array | None = None
    """Inner products of the unknowns; None: one. Shape (k, k)."""
    pitch: Array | None = None
    """Load of a turning base; None: none turns it. Shape (k,)."""
    vectors: Mapping[str, Array] = field(default_factory=dict)
    """What else effects may ask for. Shape (k,) each."""

    @property
    def unknowns(self) -> int:
        """How many there are."""
        return len(self.observe)

    @property
    def counts(self) -> PartCounts:
        """How many parts each matrix has."""
        return PartCounts(len(self.K_0), len(self.K_1), len(self.M))


class SmallSpecimen(StatedSpecimen, Protocol):
    """What a specimen says of itself so that it can be fitted."""

    @property
    def numbers(self) -> tuple[str, ...]:
        """Kinds of stated numbers that move its matrices."""

    @property
    def narrow_resonances(self) -> bool:
        """Whether a resonance may be narrower than stated numbers and theory say where it lies."""

    @property
    def places(self) -> Mapping[str, float]:
        """Points along it that are stated in m: `pickup`, `force`. None where it has no length."""

    def names_of(self, kind: str) -> tuple[str, ...]:
        """The stated numbers of a kind that moves its matrices, as results list them."""

    def parts(self) -> Parts:
        """Its matrices for unit coefficients."""

    def coefficients(self, by: Mapping[str, float | Array]) -> Complex:
        """Of the parts of K_0, K_1, M and the load in this order, its numbers moved. Shape (parts,).

        `by` gives changes of the numbers, relative ones in the logarithm; of many structures at once shape
        (many,) each, and (parts, many) is returned.
        """

    def tolerance(self, name: str) -> float:
        """Standard deviation of a stated number."""

    def theory_error(self, frequency_hz: Array, G: Complex) -> ModelError | None:
        """What its theory gets wrong around some frequencies, the core's modulus given; None: nothing.

        Shape (points,) each.
        """


@dataclass(frozen=True)
class SmallCoefficients(StatedCoefficients):
    """Coefficients of a small structure's parts, as functions of its stated numbers."""

    specimen: SmallSpecimen
    parts: Parts
    # The parts already carry the minus sign.
    load_sign: ClassVar[float] = 1.0

    @property
    def counts(self) -> PartCounts:
        """How many parts K_0, K_1 and M have; those of the load follow them."""
        return self.parts.counts

    @cached_property
    def moving(self) -> list[int]:
        """Places in `each` of the numbers that change its matrices."""
        return [k for k, n in enumerate(self.each) if n.kind in self.specimen.numbers]

    @cached_property
    def as_stated(self) -> Array:
        """Coefficients as stated. Shape (parts,)."""
        return np.asarray(_real_where_it_is(self.specimen.coefficients({})))

    def at(self, z: Array) -> Array:
        """Coefficients of all parts and the load. Shape (parts,)."""
        by = {self.each[k].name: float(self.sigma[k] * z[k]) for k in self.moving}
        return np.asarray(_real_where_it_is(self.specimen.coefficients(by)))

    def by(self, z: Array) -> Array:
        """As `by_there`: they are cheap. Shape (count, parts)."""
        return self.by_there(z)

    def _differences(self, z: Array) -> Array:
        # All at once: one by one they took a fifth of a beam's diagnosis.
        count = len(self.moving)
        by = {self.each[k].name: np.full(2 * count, self.sigma[k] * z[k]) for k in self.moving}
        for n, k in enumerate(self.moving):
            by[self.each[k].name][[n, count + n]] += self.sigma[k] * STEP * np.array([1.0, -1.0])
        c = np.asarray(_real_where_it_is(self.specimen.coefficients(by)))
        found = np.zeros((len(self.each), len(c)), np.result_type(c))
        found[self.moving] = (c[:, :count] - c[:, count:]).T / (2 * STEP)
        return found


@dataclass(frozen=True)
class SmallNuisances(Nuisances):
    """The stated numbers of a small structure as unknowns."""

    specimen: SmallSpecimen  # type: ignore[assignment]
    parts: Parts | None = None
    """The matrices that the coefficients multiply."""

    @property
    def masses(self) -> tuple[PlacedMass, ...]:
        """None: its matrices hold them."""
        return ()

    @cached_property
    def of_parts(self) -> SmallCoefficients:
        """What they make of the coefficients of its parts."""
        assert self.parts is not None
        return SmallCoefficients(self.each, self.specimen, self.parts)

    def _spots_of(self) -> tuple[dict[Spot, Place], dict[Spot, Place]]:
        # No other structure lends it matrices: the reference is the specimen itself.
        own = {spot: (self.specimen.places[spot], 0.0) for spot in SPOTS if spot in self.specimen.places}
        return own, own

    def placed(self, plate: EnrichedReducedPlate, z: Array) -> EnrichedReducedPlate:
        """The same, read and driven where these numbers say. `z` of shape (numbers,)."""
        observe, load = self.spots.row_change(plate, z), self.spots.force_change(plate, z)
        return replace(plate, observe=plate.observe + observe, load=plate.load + load)


def as_coefficients(rows: Sequence[Array | complex]) -> Complex:
    """Of one structure, numbers to (parts,); of many at once, (many,) each or one for all, (parts, many)."""
    found = np.empty((len(rows), *np.broadcast_shapes(*(np.shape(row) for row in rows))), complex)
    for k, row in enumerate(rows):
        found[k] = row
    return found


def _real_where_it_is(c: Complex) -> Complex | Array:
    return c if np.any(np.imag(c)) else np.real(c)


def nuisances_of(specimen: SmallSpecimen, parts: Parts, *, has_phase: bool) -> SmallNuisances:
    """All its stated numbers, and those of the channels."""
    kinds = {name: kind for kind in specimen.numbers for name in specimen.names_of(kind)}
    kinds |= {n: n for n in channels_felt(has_phase=has_phase)}
    kinds |= {f"{n}_x": n for n in specimen.places}
    each = [Nuisance(name, kind, specimen.tolerance(kind)) for name, kind in kinds.items()]
    return SmallNuisances(specimen, tuple(n for n in each if n.sigma > 0), None, parts)


@dataclass(frozen=True)
class SmallSystem(EnrichedReducedPlate):
    """As fits and effects take it; it knows how its stated numbers change it."""

    stated: SmallSpecimen | None = None
    counts: PartCounts = field(default_factory=PartCounts)
    """How many parts K_0, K_1 and M have."""

    def moved(self, by: Mapping[str, float]) -> Change:
        """What it becomes with some numbers moved, as `SmallSpecimen.coefficients` takes them."""
        s = self.stated
        assert s is not None
        c = s.coefficients(by) - s.coefficients({})
        K, K_1, M = self.counts.summed(c, self.parts)
        load = c[self.counts.load].real @ self.load_part
        return Change(K=_real_where_it_is(K), K_1=K_1.real, M=M.real, load=load)


def system_of(
    specimen: SmallSpecimen, parts: Parts, by: Mapping[str, float] | None = None
) -> EnrichedReducedPlate:
    """As stated, or its numbers moved (`SmallSpecimen.coefficients`), on its own unknowns alone."""
    return widened_system_of(specimen, parts, by).take([])


def widened_system_of(
    specimen: SmallSpecimen, parts: Parts, by: Mapping[str, float] | None = None
) -> SmallSystem:
    """System with the additional unknowns that effects need."""
    counts = parts.counts
    c = specimen.coefficients(by or {})
    k = parts.unknowns
    return SmallSystem(
        group=np.full(k, "plate") if parts.group is None else parts.group,
        M=_sum(c[counts.M], parts.M, k).real,
        K_0=_sum(c[counts.K_0], parts.K_0, k),
        K_1=_sum(c[counts.K_1], parts.K_1, k).real,
        U=np.zeros((k, 0)),
        d=np.zeros(0),
        load=c[counts.load].real @ parts.load,
        pitch=np.zeros(k) if parts.pitch is None else parts.pitch,
        observe=parts.observe,
        gram=np.eye(k) if parts.gram is None else parts.gram,
        names=np.array(list(parts.matrices), dtype=str),
        matrices=np.array(list(parts.matrices.values())).reshape(-1, k, k),
        vector_names=np.array(list(parts.vectors), dtype=str),
        vectors=np.array(list(parts.vectors.values())).reshape(-1, k),
        deflection=parts.deflection,
        size=np.array(parts.size, dtype=float),
        pickup=np.array(parts.pickup_m),
        parts=np.concatenate([parts.K_0, parts.K_1, parts.M]),
        load_part=parts.load,
        layers=np.zeros((3, 5)),
        stated=specimen,
        counts=counts,
    )


def check_driven(parts: Parts, specimen: SmallSpecimen) -> None:
    """Raise `OutsideModel` where nothing drives it, or nothing is read."""
    # What effects let go moves where the specimen as stated is held.
    own = slice(None) if parts.group is None else parts.group == "plate"
    if not np.any(np.abs(parts.load[..., own]) > _STILL):
        if specimen.drive == "force":
            raise OutsideModel("[excitation] lies on a held end, expected x_mm of a point that moves")
        raise OutsideModel(f"a free {specimen.kind} has no base to be excited by, expected another boundary")
    if not np.any(np.abs(parts.observe[own]) > _STILL):
        raise OutsideModel("[pickup] is missing or lies on a held end, expected x_mm of a point that moves")


def _sum(c: Complex, P: Array, k: int) -> Complex:
    return np.asarray(np.tensordot(c, P, axes=1)) if len(P) else np.zeros((k, k), complex)


def displacement(system: EnrichedReducedPlate, omega: Array, G: Complex) -> Complex:
    """Relative displacement at the reading for a unit load, by a full solve. Shape (points,)."""
    w = np.asarray(omega, dtype=float)[:, None, None]
    C_1 = (system.U * system.d) @ system.U.T
    A = system.K_0 + np.asarray(G)[:, None, None] * system.K_1 - w**2 * system.M + 1j * w * C_1
    load = np.broadcast_to(system.load.astype(complex)[:, None], (len(omega), len(system.load), 1))
    return np.asarray(np.linalg.solve(A, load)[:, :, 0] @ system.observe)
