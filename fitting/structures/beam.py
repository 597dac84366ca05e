"""A beam in bending: bare, with a free layer on one side or on both, or a sandwich.

Euler-Bernoulli faces with their own stretching, a core that shears between them (Mead and Markus, J. Sound
Vib. 10 (1969)); a free layer stretches and bends with the beam, E = 2 (1 + mu) G. Over a length L, per width:

    gamma = (u_c - u_b + d w')/H,   d = H + (h_c + h_b)/2

What is stated, and what it makes of the matrices' coefficients; the matrices themselves are in
`beam_parts.py`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.model_error import ModelError
from fitting.specimen import METAL_PER_K, Core, Drive, Face, PlacedMass, Reading, Specimen
from fitting.structures.beam_apart import APART_WITHIN, open_by_poisson
from fitting.structures.beam_error import (
    HELD_WIDTH_WITHIN,
    METAL_LOSS,
    free_layer_error,
    sandwich_error,
    shortened_m,
)
from fitting.structures.beam_parts import carrying, parts_of
from fitting.structures.beam_section import PARTS, BeamSection
from fitting.structures.small import Parts, as_coefficients
from fitting.tolerances import OF_TEMPERATURE, STATED, STATED_PER_K

Ends = Literal["clamped-free", "free-free", "clamped-clamped", "centre-driven"]

_HELD_ENDS = {"clamped-free": 1, "free-free": 0, "clamped-clamped": 2, "centre-driven": 1}
"""Of one piece."""
Number = Any
"""Of one beam, or of many at once: real or complex."""
Layer = dict[str, Number]
"""What is stated of one, moved."""

_BY_PLACE = 4.0
"""What a share of the span off is to a mass, relative: twice the slope of a cantilever's first modes at its
tip, 1.4 and 4.8."""


@dataclass(frozen=True)
class Beam:
    """What is stated of it, in SI units; x from a clamped end, or from the centre where that is driven."""

    length_m: float
    """Free length; of both halves together where it is driven in its centre, the mount taken off."""
    width_m: float
    boundary: Ends
    substrate: Face
    constraining: Face | None = None
    core: Core | None = None
    """Without a constraining layer it is a free layer."""
    both_sides: bool = False
    """The same on either side: a free layer, or core and constraining layer."""
    held_width: bool = False
    """Whether it is counted that clamps hold the width (`beam_error`): its held ends are then stiffer."""
    pickup_m: float | None = None
    further_pickups_m: tuple[float, ...] = ()
    """Spots beside the first: rows of data say which one they are of (`at_pickup`)."""
    force_m: float | None = None
    """Where a force drives it, its ends at rest; None: the base does."""
    masses: tuple[PlacedMass, ...] = ()
    """What sits on it, in the middle of its width: a sensor. Of one piece alone."""
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    exact: bool = False
    slender: bool = False
    """Whether it is as thin and narrow as handbooks' formulas have it: nothing turns, shears or curves across
    but the core."""
    temperature_c: float | None = None
    """That its faces have; None: the one their moduli are stated for."""

    kind = "beam"
    modal_ratios: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.force_m is not None:
            # Its ends are at rest: one reading is the other.
            object.__setattr__(self, "reads", "relative")

    @property
    def drive(self) -> Drive:
        """What moves it."""
        return "base" if self.force_m is None else "force"

    @property
    def drive_amplitude(self) -> float:
        """Of the base in m/s^2, or one newton."""
        return self.base_acceleration_m_s2 if self.force_m is None else 1.0

    @property
    def offers(self) -> frozenset[str]:
        """As `StatedSpecimen` has it; `one piece`: not two halves about a driven centre."""
        found = {"base"} if self.force_m is None else {"force"}
        if self.boundary != "free-free":
            found.add("clamp")
        if self.boundary != "centre-driven":
            found.add("one piece")
        if self.boundary == "clamped-clamped":
            found.add("two clamps")
        if self.constraining is not None:
            found |= {"constraining"} if self.both_sides else {"constraining", "whole"}
        return frozenset(found)

    @property
    def places(self) -> Mapping[str, float]:
        """Where it is read, and where a force drives it, in m: stated numbers too."""
        stated = {"pickup": self.pickup_m, "force": self.force_m}
        return {name: x for name, x in stated.items() if x is not None}

    @property
    def pickups_m(self) -> tuple[float, ...]:
        """All spots, in the order of their numbers from 0."""
        return () if self.pickup_m is None else (self.pickup_m, *self.further_pickups_m)

    def at_pickup(self, number: int) -> "Beam":
        """The same beam read at one of its spots."""
        if not self.further_pickups_m:
            return self
        return replace(self, pickup_m=self.pickups_m[number], further_pickups_m=())

    def at_temperature(self, temperature_c: float) -> "Beam":
        """The same beam warmer or colder; an exact one that states nothing of its metal is as stated."""
        faces = (self.substrate, self.constraining)
        if self.exact and all(f is None or f.young_per_k is None for f in faces):
            return self
        return replace(self, temperature_c=temperature_c)

    @property
    def span_m(self) -> float:
        """What vibrates as one piece: half of it where the centre is driven."""
        return self.length_m / 2 if self.boundary == "centre-driven" else self.length_m

    @property
    def is_doubled(self) -> bool:
        """Whether a constrained layer is on both sides."""
        return self.both_sides and self.constraining is not None

    @property
    def numbers(self) -> tuple[str, ...]:
        """Kinds of stated numbers that move its matrices."""
        layers: list[tuple[str, tuple[str, ...]]] = [("substrate", ("young", "thickness", "density"))]
        if self.constraining is not None:
            layers.append(("constraining", ("young", "thickness", "density")))
        if self.core is not None:
            # How a free layer stretches depends on Poisson's ratio as on the modulus.
            layers.append(("core", ("thickness", "density")))
        if self.temperature_c is not None:
            faces = [layer for layer, _ in layers if layer != "core"]
            layers += [(layer, ("young_per_k",)) for layer in faces]
        # A base drives a wider beam by as much more.
        wide = ("width",) if self.force_m is not None else ()
        held = ("held_width",) if _HELD_ENDS[self.boundary] and not self.slender else ()
        across = ("core_stretch",) if self.parts_faces else ()
        lossy = () if self.states_loss else ("metal_loss",)
        carried = ("mass",) if self.masses else ()
        each = (f"{layer}_{n}" for layer, numbers in layers for n in numbers)
        pulled = ("axial",) if "two clamps" in self.offers else ()
        return (*each, "length", *wide, *held, *across, *pulled, *lossy, *carried)

    @property
    def states_loss(self) -> bool:
        """Whether it is known what its metal loses: a core's loss is what is left beside that."""
        faces = (self.substrate, self.constraining)
        return self.exact or any(f is not None and f.loss_is_stated for f in faces)

    @property
    def parts_faces(self) -> bool:
        """Whether a core lets two faces move apart."""
        return self.core is not None and self.constraining is not None and not self.slender

    def parts(self) -> Parts:
        """For unit coefficients, on the basis of modes."""
        pickup, force = (self.places.get(name) for name in ("pickup", "force"))
        span = self.span_m
        parts = parts_of(
            self.section,
            pickup / span if pickup is not None else None,
            force / span if force is not None else None,
        )
        if not self.masses:
            return parts
        masses = [(m.mass_kg, m.x_m / span) for m in self.masses]
        return carrying(parts, self.section, masses, by_base=force is None)

    @property
    def section(self) -> BeamSection:
        """What its matrices are made of: the same at all temperatures."""
        layers = (self.substrate, self.core, self.constraining)
        return BeamSection(
            ends="clamped-free" if self.boundary == "centre-driven" else self.boundary,
            length_m=self.span_m,
            width_m=self.width_m,
            copies=self.copies,
            thickness_m=tuple(0.0 if x is None else x.thickness_m for x in layers),  # type: ignore[arg-type]
            both_sides=self.both_sides,
            coefficients=tuple(
                replace(self, temperature_c=None, masses=()).coefficients({}).real[:-1].tolist()
            ),
            rigidity=self._rigidity,
            poisson=tuple(0.0 if x is None else x.poisson for x in layers),  # type: ignore[arg-type]
            share=self._share,
            is_slender=self.slender,
        )

    @property
    def _share(self) -> float:
        """Of the substrate in how far faces move apart: w is then where the mass is."""
        b, v, c = self.substrate, self.core, self.constraining
        if v is None or c is None:
            return 0.0
        m_b, m_v, m_c = (x.density_kg_m3 * x.thickness_m for x in (b, v, c))
        twice = 2 if self.is_doubled else 1
        return twice * (m_c + m_v / 2) / (m_b + twice * (m_c + m_v))

    @property
    def copies(self) -> int:
        """How many pieces move alike."""
        return 2 if self.boundary == "centre-driven" else 1

    def coefficients(self, by: Mapping[str, Number]) -> Complex:
        """Of the parts of `beam_shapes.BeamMatrices`, of what it carries, and the loads. Shape (37 or more,).

        Of many beams at once (37 or more, beams), `by` of shape (beams,) each. Four of the faces' stiffness,
        as much of it as clamps hold, what pulls along, 14 of the core, 13 of inertia; a mass is part of the
        inertia, and a load where the base drives.
        """
        b, c, v = (self._moved(name, by) for name in ("substrate", "constraining", "core"))
        span = self.span_m
        # `span` is of one piece, where a clamp's line is elsewhere.
        L = span + by.get("length", 0.0) * (span / self.length_m) + by.get("span", 0.0)
        held = (1.0 if self.held_width else 0.0) + by.get("held_width", 0.0) / (self.held_width_m or 1.0)
        width = (self.width_m + by.get("width", 0.0)) * self.copies
        E_b, h_b, m_b = _of_face(b)
        E_c, h_c, m_c = _of_face(c)
        H = v["thickness"] if v else 0.0
        m_v = v["density"] * H if v else 0.0
        # Bending of a beam alike on both sides: its middle does not stretch, and every coating counts twice.
        twice = 2 if self.is_doubled else 1
        m_c, m_v = twice * m_c, (twice if c else 1) * m_v
        K_0 = [E_b * h_b / L, twice * E_c * h_c / L]
        K_0 += [E_b * h_b**3 / 12 / L**3, twice * E_c * h_c**3 / 12 / L**3]
        slip, free, apart, moved_apart = ([0.0] * n for n in (3, 3, 8, 7))
        d, e = H + (h_b + h_c) / 2, (h_c - h_b) / 2
        if v and c:
            slip = [twice * L / H, twice * d / H, twice * d**2 / H / L]
            # What w_b = w - share a and w_c = w + (1 - share) a add to it: the mean, and the change across.
            share = self._share
            more = (h_c + H) / 2 * (1 - share) - (h_b + H) / 2 * share
            stretch = L / H * np.exp(-by.get("core_stretch", 0.0))
            by_slip = [more / H, more * d / H / L, (more**2 / H + H / 12) / L]
            # m rises as a parabola between the faces: two thirds on the average, 8/15 its square.
            by_rising = [2 / 3, 2 / 3 * d / L, 2 / 3 * more / L, 8 / 15 * H / L]
            apart = [twice * x for x in (*by_slip, *by_rising, 0.0 if self.slender else stretch)]
            # What its two faces differ by turns it.
            turned = 0.0 if self.slender else m_v / 12
            turning = m_v / 4 * e**2 + turned * (d - H) ** 2 + self._turning(b, c, v)
            inertia = [m_v / 4 * L, m_v / 4 * e, turning / L]
            moved_apart = [
                (1 - share) * m_c - share * m_b + (1 / 2 - share) * m_v,
                (1 - share) ** 2 * m_c + share**2 * m_b + ((1 / 2 - share) ** 2 + 1 / 12) * m_v,
                *(2 / 3 * m_v, 2 / 3 * (1 / 2 - share) * m_v, 8 / 15 * m_v),
                *(turned, turned * (d - H) / L),
            ]
            mass = m_b + m_c + m_v
        else:
            sides = 2 if self.both_sides else 1
            low, high = h_b / 2, h_b / 2 + H
            first = 0.0 if self.both_sides else (high**2 - low**2) / 2
            moments = (sides * H, first, sides * (high**3 - low**3) / 3)
            free = [self._young_per_shear * x / L**n for n, x in enumerate(moments, 1)]
            inertia = [0.0, 0.0, self._turning(b, c, v) / L]
            mass = m_b + sides * m_v
        M = [mass * L, m_b * L, m_c * L, *inertia, *(x * L for x in moved_apart)]
        load = width * mass * L if self.force_m is None else 1.0
        heavier = np.exp(by.get("mass", 0.0))
        carried = [m.mass_kg * heavier for m in self.masses]
        pull = by.get("axial", 0.0) * (h_b + twice * h_c) / L
        own = [*K_0, *(held * k for k in K_0), pull, *slip, *free, *apart, *M]
        loads = [load, *(carried if self.force_m is None else ())]
        return as_coefficients([*(width * x for x in own), *carried, *loads])

    def _turning(self, b: Layer, c: Layer, v: Layer) -> Number:
        """Inertia of what turns with the sections, per area: of layers about their own middles, in kg."""
        if self.slender:
            return 0.0
        sides = 2 if self.both_sides else 1
        own = [(1, b), (sides, c)] if c else [(1, b)]
        found = sum(n * x["density"] * x["thickness"] ** 3 / 12 for n, x in own)
        if v and not c:
            low, high = b["thickness"] / 2, b["thickness"] / 2 + v["thickness"]
            found = found + sides * v["density"] * (high**3 - low**3) / 3
        return found

    @property
    def _young_per_shear(self) -> float:
        """Of a free layer: it narrows as the substrate does that it is bonded to."""
        if self.core is None:
            return 0.0
        nu, its = self.core.poisson, self.substrate.poisson
        if self.slender:
            return 2 * (1 + nu)
        return 2 * (1 - 2 * nu * its + its**2) / (1 - nu)

    @property
    def _rigidity(self) -> tuple[float, float]:
        """Of both faces' bending, N m."""
        b, c = self.substrate, self.constraining
        twice = 2 if self.is_doubled else 1
        above = twice * c.young_pa * c.thickness_m**3 if c is not None else 0.0
        return b.young_pa * b.thickness_m**3 / 12, above / 12

    @property
    def held_width_m(self) -> float:
        """What makes it stiffer at all held ends, as a shorter span."""
        return _HELD_ENDS[self.boundary] * shortened_m(self.width_m, self._poisson)

    @property
    def _poisson(self) -> float:
        """Of the faces, weighed by their stiffness."""
        faces = [f for f in (self.substrate, self.constraining) if f is not None]
        stiff = np.array([f.young_pa * f.thickness_m for f in faces])
        return float(stiff @ [f.poisson for f in faces] / stiff.sum())

    @property
    def as_plate(self) -> Specimen | None:
        """A plate of the same layers: what a wave in them sees. None where no core shears between faces."""
        if self.core is None or self.constraining is None:
            return None
        sides = (self.length_m, self.width_m)
        both = self.both_sides
        return Specimen(*sides, "free", self.substrate, self.constraining, self.core, both_sides=both)

    def theory_error(self, frequency_hz: Array, G: Complex) -> ModelError:
        """What its theory gets wrong around some frequencies, the core's modulus there given.

        Shape (points,) each.
        """
        layers = self.as_plate
        if layers is not None:
            return sandwich_error(layers, self._poisson * self.width_m, frequency_hz, G)
        c = self.coefficients({})
        K_0, K_1, M = (c[PARTS[name]] for name in ("K_0", "K_1", "M"))
        L, mass = self.span_m, float(M[0].real / self.span_m)
        axial = K_0[0] * L + G * K_1[3] * L
        bending = (K_0[2] + K_0[3]) * L**3 + G * K_1[5] * L**3 - (G * K_1[4] * L**2) ** 2 / axial
        return free_layer_error(bending, mass, self._poisson * self.width_m, frequency_hz)

    def _moved(self, name: str, by: Mapping[str, float | Array]) -> Layer:
        layer = getattr(self, name)
        if layer is None:
            return {}
        values = {
            "young": getattr(layer, "young_pa", 0.0),
            "thickness": layer.thickness_m,
            "density": layer.density_kg_m3,
        }
        found: Layer = {k: value * np.exp(by.get(f"{name}_{k}", 0.0)) for k, value in values.items()}
        if isinstance(layer, Face):
            warmed = layer.warmed(self.temperature_c, by.get(f"{name}_young_per_k", 0.0))
            found["young"] = found["young"] * warmed
            found["loss"] = layer.loss_factor + by.get("metal_loss", 0.0)
        return found | {"poisson": layer.poisson}

    def tolerance(self, name: str) -> float:
        """Named, else typical; of `held_width` what the theory leaves open, however exact the beam is."""
        if name == "held_width":
            return self.held_width_m * (HELD_WIDTH_WITHIN if self.held_width else 1.0)
        if name == "core_stretch":
            return self._stretch_open
        if self.exact:
            return 0.0
        if name == "metal_loss":
            return METAL_LOSS
        if name == "mass":
            weighed, laid = (self.tolerances.get(n, STATED[n].typical) for n in ("mass", "place"))
            return float(np.hypot(weighed, _BY_PLACE * laid / self.span_m))
        typical = STATED[name].typical
        if name in OF_TEMPERATURE and getattr(self, name.partition("_")[0]).young_per_k is not None:
            typical *= STATED_PER_K
        return float(self.tolerances.get(name, typical))

    @property
    def _stretch_open(self) -> float:
        """Of how a core stretches, in the logarithm: by the theory, and by Poisson's ratio as stated."""
        v = self.core
        assert v is not None
        stated = 0.0 if self.exact else self.tolerances.get("core_poisson", STATED["core_poisson"].typical)
        return float(np.hypot(APART_WITHIN, open_by_poisson(v.thickness_m, self.width_m, v.poisson, stated)))

    def stated_number(self, kind: str) -> tuple[float, float, str]:
        """In SI, with the factor to the unit of results."""
        others = {"gain": (1.0, 1.0, "1"), "delay": (0.0, 1e6, "us"), "phase": (0.0, 180 / np.pi, "deg")}
        others |= {"length": (self.length_m, 1e3, "mm"), "width": (self.width_m, 1e3, "mm")}
        others |= {name: (x, 1e3, "mm") for name, x in self.places.items()}
        others["core_stretch"], others["metal_loss"] = (1.0, 1.0, "1"), (0.0, 1.0, "1")
        others["axial"] = 0.0, 1e-6, "MPa"
        others["mass"] = sum(m.mass_kg for m in self.masses), 1e3, "g"
        others["held_width"] = (self.held_width_m if self.held_width else 0.0, 1e3, "mm")
        if kind in others:
            return others[kind]
        layer, _, quantity = kind.partition("_")
        if quantity == "young_per_k":
            stated = getattr(self, layer).young_per_k
            return METAL_PER_K if stated is None else stated, 100.0, "%/K"
        name, factor, unit = {
            "young": ("young_pa", 1e-9, "GPa"),
            "thickness": ("thickness_m", 1e3, "mm"),
            "density": ("density_kg_m3", 1.0, "kg/m^3"),
        }[quantity]
        return getattr(getattr(self, layer), name), factor, unit


def _of_face(face: Layer) -> tuple[Number, Number, Number]:
    """E (1 + i eta), h and mass per area; zero for none."""
    if not face:
        return 0.0, 0.0, 0.0
    young = face["young"] * (1 + 1j * face["loss"]) if np.any(face["loss"]) else face["young"]
    return young, face["thickness"], face["density"] * face["thickness"]
