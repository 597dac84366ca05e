"""A mass on viscoelastic discs or pads in shear, between it and a moving base.

With relative displacement u(z) over a pad of thickness t, from base (0) to mass (t), all pads in parallel:

    -omega^2 (m U phi(t) + rho A int u phi) + G* A int u' phi' = -(m phi(t) + rho A int phi) a

u is spanned by integrated Legendre polynomials: the first is the massless pad, all of them the wave in it,
exact long before its length comes down to the pad's thickness. For a light pad a third of its mass moves
with the mass.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import radians
from types import MappingProxyType
from typing import ClassVar

import numpy as np
from numpy.polynomial import Legendre

from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import BaseDriven, Kind, Reading
from fitting.stated.layers import Core
from fitting.stated.number_names import number_name
from fitting.stated.tolerances import KG, STATED, StatedValue
from fitting.structures.small import Parts, as_coefficients

ORDER = 6
"""Polynomials over the thickness: the wave is then exact to 1e-9 where kt < 2."""
NUMBERS = ("mass", "area", "core_thickness", "core_density", "free_edges")
EDGE = 0.1153
"""c of an edge: of a long strip of incompressible rubber, its plane problem, and of annular and full discs as
solids, to 0.4 % up to a thickness of half their width (`tests/drivers/simulated/plant/test_solid_pad.py`)."""
MOST_BY_EDGES = 0.5
"""Of G A/t: thicker discs are blocks that bend and tip, of which no formula here holds."""
TYPICAL = {"mass": 2e-3, "gain": 5e-3, "phase": radians(0.5)}
"""Of a moving mass, weighed; of two accelerometers, calibrated by comparison: their sheets allow a degree."""


@dataclass(frozen=True)
class ShearPair(BaseDriven):
    """What is stated of it, in SI units."""

    mass_kg: float
    discs: int
    """In parallel."""
    area_m2: float
    """Area of each disc."""
    core: Core
    """Its thickness is a disc's."""
    gyration_m: float | None = None
    """Radius of gyration of a disc's face about a diameter; None where only its area is stated."""
    bending: bool = False
    """Whether the discs' bending is counted."""
    edges: bool = False
    """Whether what their free edges give way is counted, bending in it."""
    reads: Reading = "absolute"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    exact: bool = False

    kind: ClassVar[Kind] = "shear-pair"
    narrow_resonances: ClassVar[bool] = False
    numbers = NUMBERS
    places: ClassVar[Mapping[str, float]] = MappingProxyType({})
    modal_ratios: tuple[float, ...] = ()

    @property
    def softer_by_bending(self) -> float:
        """t^2 / (36 kappa^2): what bending adds to the shear deflection, the discs' faces held parallel.

        A disc as a beam in shear and bending with E = 3 G: F t/(G A) + F t^3/(12 E A kappa^2). Rivlin and
        Saunders, Trans. IRI 24 (1949); zero where the shape is not stated.
        """
        if self.gyration_m is None:
            return 0.0
        return (self.core.thickness_m / (6 * self.gyration_m)) ** 2

    @property
    def softer_by_edges(self) -> float:
        """The part of G A/t that free edges take, c t/(r_o - r_i).

        In plain shear the face across would carry the same stress, and a free edge carries none: a zone as
        wide as the disc is thick gives way, where the edge lies across the motion, c t cos^2 ds/A of its
        length. The bending of the disc is in it. Zero where the shape is not stated.
        """
        if self.gyration_m is None:
            return 0.0
        # D^2 - d^2 = 4 A/pi, D^2 + d^2 = 16 kappa^2.
        difference, total = 4 * self.area_m2 / np.pi, 16 * self.gyration_m**2
        outer, inner = np.sqrt((total + difference) / 2), np.sqrt(max(total - difference, 0.0) / 2)
        return float(EDGE * self.core.thickness_m / ((outer - inner) / 2))

    @property
    def left_out_by_edges(self) -> float:
        """How much higher G' is where they are counted, relative; of a full disc where no shape is stated."""
        softer = self.softer_by_edges
        if self.gyration_m is None:
            softer = EDGE * self.core.thickness_m / np.sqrt(self.area_m2 / np.pi)
        # Bending is in what edges give way: where it is counted that much less is missing.
        counted = self.softer_by_bending if self.bending else 0.0
        return float(max(1 / (1 - min(softer, MOST_BY_EDGES)) / (1 + counted) - 1, 0.0))

    def parts(self) -> Parts:
        """For unit mass, unit rubber mass and unit A/t."""
        P, dP, mean = pad(ORDER)
        at_mass = np.zeros(ORDER)
        at_mass[0] = 1.0
        return Parts(
            K_0=np.zeros((0, ORDER, ORDER)),
            K_1=dP[None],
            M=np.array([np.outer(at_mass, at_mass), P]),
            load=-np.array([at_mass, mean]),
            observe=at_mass,
            matrices={"strain.mean_square": dP / self.core.thickness_m**2},
            deflection=np.zeros((4, 3, ORDER)),
            size=(1.0, 1.0, 1, 1),
            pickup_m=(0.0, 0.0),
        )

    def coefficients(self, by: Mapping[str, float | Array]) -> Complex:
        """N A/t over the bending's share; mass and rubber; both again as loads. Shape (5,), or (5, pairs)."""
        area = self.discs * self.area_m2 * np.exp(by.get("area", 0.0))
        t = self.core.thickness_m * np.exp(by.get("core_thickness", 0.0))
        mass = self.mass_kg * np.exp(by.get("mass", 0.0))
        rubber = self.core.density_kg_m3 * np.exp(by.get("core_density", 0.0)) * area * t
        stiff = 1 - self.softer_by_edges * np.exp(by.get("core_thickness", 0.0)) if self.edges else 1.0
        stiff = stiff * np.exp(by.get("free_edges", 0.0))
        softer = self.softer_by_bending * np.exp(2 * by.get("core_thickness", 0.0)) if self.bending else 0.0
        return as_coefficients([stiff * area / t / (1 + softer), mass, rubber, mass, rubber])

    def tolerance(self, name: str) -> float:
        """Named, else typical; of `free_edges` what is not counted of them, or what the count leaves open."""
        if self.exact:
            return 0.0
        if name == "free_edges":
            return self.softer_by_edges**2 if self.edges else self.left_out_by_edges
        return float(self.tolerances.get(name, TYPICAL.get(name, STATED[name].typical)))

    @property
    def carried_kg(self) -> float:
        """The mass on the pads."""
        return self.mass_kg

    def theory_error(self, frequency_hz: Array, G: Complex) -> None:
        """The wave in the pad is exact; what its edges do is stated. Shape (points,) each."""
        return

    def names_of(self, kind: str) -> tuple[str, ...]:
        """As `SmallSpecimen` has it: one of each."""
        return (kind,)

    def stated_number(self, name: str) -> StatedValue:
        """As `StatedSpecimen` has it; its mass in kilograms, where what sits on a plate weighs grams."""
        number = number_name(name).number
        owner = self.core if number.layer == "core" else self
        in_si = number.unstated if number.unstated is not None else float(getattr(owner, number.field))
        return (replace(number, shown=KG) if number.name == "mass" else number).valued(in_si)


def disc(outer_m: float, inner_m: float = 0.0) -> tuple[float, float]:
    """Area and radius of gyration about a diameter of an annular disc, from its diameters."""
    return float(np.pi / 4 * (outer_m**2 - inner_m**2)), float(np.hypot(outer_m, inner_m) / 4)


def pad(order: int) -> tuple[Array, Array, Array]:
    """Integrals over 0 < z < 1 of phi phi^T, phi' phi'^T and phi: z, then integrals of Legendre polynomials.

    All but the first vanish at both ends. Shapes (order, order) twice, (order,).
    """
    slopes = [Legendre.basis(k, domain=[0.0, 1.0]) for k in range(order)]
    phi = [p.integ(lbnd=0.0) for p in slopes]
    z, weight = np.polynomial.legendre.leggauss(order + 2)
    z, weight = (z + 1) / 2, weight / 2
    values, steep = np.array([p(z) for p in phi]), np.array([p(z) for p in slopes])
    return (values * weight) @ values.T, (steep * weight) @ steep.T, values @ weight
