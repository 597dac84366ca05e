"""A beam in bending: bare, with a free layer on one side or on both, or a sandwich.

Euler-Bernoulli faces with their own stretching, a core that shears between them (Mead and Markus, J. Sound
Vib. 10 (1969)); a free layer stretches and bends with the beam, E = 2 (1 + mu) G. Over a length L, per width:

    gamma = (u_c - u_b + d w')/H,   d = H + (h_c + h_b)/2

What is stated of it is in `stated_beam.py`, what that makes of coefficients in `beam_coefficients.py`, the
matrices themselves in `beam_parts.py`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.discrepancy.model_error import ModelError
from fitting.stated.number_names import NumberName, number_name
from fitting.stated.tolerances import (
    OF_TEMPERATURE,
    STATED,
    STATED_PER_K,
    StatedValue,
)
from fitting.structures.beam_apart import APART_WITHIN, open_by_poisson
from fitting.structures.beam_coefficients import Number, coefficients, place_of
from fitting.structures.beam_error import (
    HELD_WIDTH_WITHIN,
    METAL_LOSS,
    free_layer_error,
    sandwich_error,
)
from fitting.structures.beam_parts import carrying, parts_of
from fitting.structures.beam_section import PARTS, BeamSection
from fitting.structures.beam_shapes import ORDER, ORDER_OF_FORCED
from fitting.structures.small import Parts
from fitting.structures.stated_beam import StatedBeam


@dataclass(frozen=True)
class Beam(StatedBeam):
    """Its matrices, the stated numbers that move them, and what its theory leaves open."""

    narrow_resonances: ClassVar[bool] = True

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
        held = ("held_width",) if self.held_ends and not self.slender else ()
        across = ("core_stretch",) if self.parts_faces else ()
        lossy = () if self.states_loss else ("metal_loss",)
        carried = ("mass", "place") if self.masses else ()
        each = (f"{layer}_{n}" for layer, numbers in layers for n in numbers)
        pulled = ("axial",) if "two clamps" in self.offers else ()
        return (*each, "length", *wide, *held, *across, *pulled, *lossy, *carried)

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
        at = self.places if "force" in self.places else {}
        forced_at = tuple(x / self.span_m for x in at.values())
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
            share=self.share,
            is_slender=self.slender,
            order=ORDER_OF_FORCED if forced_at else ORDER,
            forced_at=forced_at,
        )

    def coefficients(self, by: Mapping[str, Number]) -> Complex:
        """Of its matrices and loads, its stated numbers moved, as `beam_coefficients` has them.

        Shape (37 or more,); of many beams at once (37 or more, beams), `by` of shape (beams,) each.
        """
        return coefficients(self, by)

    @property
    def _rigidity(self) -> tuple[float, float]:
        """Of both faces' bending, N m."""
        b, c = self.substrate, self.constraining
        twice = 2 if self.is_doubled else 1
        above = twice * c.young_pa * c.thickness_m**3 if c is not None else 0.0
        return b.young_pa * b.thickness_m**3 / 12, above / 12

    def theory_error(self, frequency_hz: Array, G: Complex) -> ModelError:
        """What its theory gets wrong around some frequencies, the core's modulus there given.

        Shape (points,) each.
        """
        layers = self.as_plate
        if layers is not None:
            return sandwich_error(layers, self.poisson * self.width_m, frequency_hz, G)
        c = self.coefficients({})
        K_0, K_1, M = (c[PARTS[name]] for name in ("K_0", "K_1", "M"))
        L, mass = self.span_m, float(M[0].real / self.span_m)
        axial = K_0[0] * L + G * K_1[3] * L
        bending = (K_0[2] + K_0[3]) * L**3 + G * K_1[5] * L**3 - (G * K_1[4] * L**2) ** 2 / axial
        return free_layer_error(bending, mass, self.poisson * self.width_m, frequency_hz)

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
        typical = STATED[name].typical
        if name in OF_TEMPERATURE and getattr(self, STATED[name].layer).young_per_k is not None:
            typical *= STATED_PER_K
        return float(self.tolerances.get(name, typical))

    @property
    def _stretch_open(self) -> float:
        """Of how a core stretches, in the logarithm: by the theory, and by Poisson's ratio as stated."""
        v = self.core
        assert v is not None
        stated = 0.0 if self.exact else self.tolerances.get("core_poisson", STATED["core_poisson"].typical)
        return float(np.hypot(APART_WITHIN, open_by_poisson(v.thickness_m, self.width_m, v.poisson, stated)))

    def names_of(self, kind: str) -> tuple[str, ...]:
        """As `SmallSpecimen` has it: every mass has a place of its own."""
        return tuple(map(place_of, range(len(self.masses)))) if kind == "place" else (kind,)

    def stated_number(self, name: str) -> StatedValue:
        """As `StatedSpecimen` has it."""
        which = number_name(name)
        return which.number.valued(self._stated_si(which))

    def _stated_si(self, which: NumberName) -> float:
        number = which.number
        if number.unstated is not None:
            return number.unstated
        if number.name in self.places:
            return self.places[number.name]
        match number.name:
            case "length" | "width":
                return float(getattr(self, number.field))
            case "axial":
                return 0.0
            case "mass":
                return sum(m.mass_kg for m in self.masses)
            case "place":
                return self.masses[which.item].x_m
            case "held_width":
                return self.held_width_m if self.held_width else 0.0
            case _:
                return float(getattr(getattr(self, number.layer), number.field))
