"""Coefficients of a beam's matrices and loads: what its layers weigh, and how they stretch, bend and shear.

Of one beam, its stated numbers moved, or of many at once: every number may be an array. In the order of
`beam_shapes.BeamMatrices`, all per width but for the width itself:

    4   of the faces' stiffness     their stretching, E h / L, and their bending, E h^3 / (12 L^3)
    4   of the same                 as much of it as clamps hold the width
    1   of what pulls along
    3   of the core's slip          as the sandwich slips, per G
    3   of a free layer             its stretching, what couples it to bending, and its bending, per G
    8   of faces that move apart    by slip, by their rising, by how far the core is stretched, per G
    15  of inertia                  of all, of each face, of what turns, of faces that move apart
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fitting.arrays import Array, Complex
from fitting.stated.layers import Face
from fitting.structures.small import as_coefficients
from fitting.structures.stated_beam import StatedBeam

Number = Any
"""Of one beam, or of many at once: real or complex."""
Layer = dict[str, Number]
"""What is stated of one, moved; empty: there is none."""


def coefficients(beam: StatedBeam, by: Mapping[str, Number]) -> Complex:
    """Of the parts of `beam_shapes.BeamMatrices`, of what it carries, and the loads. Shape (39 or more,).

    Of many beams at once (39 or more, beams), `by` of shape (beams,) each. A mass that it carries is part of
    the inertia, and a load where the base drives.
    """
    b, c, v = (_moved(beam, name, by) for name in ("substrate", "constraining", "core"))
    span = beam.span_m
    # `span` is of one piece, where a clamp's line is elsewhere.
    L = span + by.get("length", 0.0) * (span / beam.length_m) + by.get("span", 0.0)
    held = (1.0 if beam.held_width else 0.0) + by.get("held_width", 0.0) / (beam.held_width_m or 1.0)
    width = (beam.width_m + by.get("width", 0.0)) * beam.copies
    E_b, h_b, m_b = _of_face(b)
    E_c, h_c, m_c = _of_face(c)
    # Bending of a beam alike on both sides: its middle does not stretch, and every coating counts twice.
    twice = 2 if beam.is_doubled else 1
    K_0 = [E_b * h_b / L, twice * E_c * h_c / L]
    K_0 += [E_b * h_b**3 / 12 / L**3, twice * E_c * h_c**3 / 12 / L**3]
    core = _between_faces(beam, b, c, v, L, by) if v and c else _free_layer(beam, b, c, v, L)
    turn = 0.0 if beam.slender else 1 / 12 / L
    turning = [m_b * h_b**2 * turn, twice * m_c * h_c**2 * turn]
    M = [core.mass * L, m_b * L, twice * m_c * L, *core.inertia, *turning]
    M += [x * L for x in core.moved_apart]
    load = width * core.mass * L if beam.force_m is None else 1.0
    carried = _carried(beam, by)
    pull = by.get("axial", 0.0) * (h_b + twice * h_c) / L
    own = [*K_0, *(held * k for k in K_0), pull, *core.slip, *core.free, *core.apart, *M]
    loads = [load, *(carried if beam.force_m is None else ())]
    return as_coefficients([*(width * x for x in own), *carried, *loads])


def place_of(mass: int) -> str:
    """Name of the stated number: how far along the beam a mass sits, counted from none."""
    return f"place_{mass + 1}_x"


def _carried(beam: StatedBeam, by: Mapping[str, Number]) -> list[Number]:
    """Of the parts of every mass as `beam_parts.carrying` has them: m, m d, m d^2, d how far it is off."""
    found: list[Number] = []
    for k, one in enumerate(beam.masses):
        m, d = one.mass_kg * np.exp(by.get("mass", 0.0)), by.get(place_of(k), 0.0)
        found += [m, m * d, m * d**2]
    return found


@dataclass(frozen=True)
class _OfCore:
    """What a core or a free layer adds, and what the whole weighs."""

    mass: Number
    """Of all layers, per area."""
    inertia: Sequence[Number]
    """Of a core that slips as its faces do, twice, and of how it turns with them."""
    slip: Sequence[Number] = (0.0,) * 3
    free: Sequence[Number] = (0.0,) * 3
    apart: Sequence[Number] = (0.0,) * 8
    moved_apart: Sequence[Number] = (0.0,) * 7


def _between_faces(
    beam: StatedBeam, b: Layer, c: Layer, v: Layer, L: Number, by: Mapping[str, Number]
) -> _OfCore:
    """A core that shears between two faces, and lets them move apart."""
    twice = 2 if beam.is_doubled else 1
    _, h_b, m_b = _of_face(b)
    _, h_c, m_c = _of_face(c)
    H = v["thickness"]
    m_c, m_v = twice * m_c, twice * (v["density"] * H)
    d, e = H + (h_b + h_c) / 2, (h_c - h_b) / 2
    # What w_b = w - share a and w_c = w + (1 - share) a add to slip: the mean, and the change across.
    share = beam.share
    more = (h_c + H) / 2 * (1 - share) - (h_b + H) / 2 * share
    stretch = L / H * np.exp(-by.get("core_stretch", 0.0))
    by_slip = [more / H, more * d / H / L, (more**2 / H + H / 12) / L]
    # m rises as a parabola between the faces: two thirds on the average, 8/15 its square.
    by_rising = [2 / 3, 2 / 3 * d / L, 2 / 3 * more / L, 8 / 15 * H / L]
    # What its two faces differ by turns it.
    turned = 0.0 if beam.slender else m_v / 12
    turning = m_v / 4 * e**2 + turned * (d - H) ** 2
    return _OfCore(
        mass=m_b + m_c + m_v,
        inertia=(m_v / 4 * L, m_v / 4 * e, turning / L),
        slip=[twice * L / H, twice * d / H, twice * d**2 / H / L],
        apart=[twice * x for x in (*by_slip, *by_rising, 0.0 if beam.slender else stretch)],
        moved_apart=[
            (1 - share) * m_c - share * m_b + (1 / 2 - share) * m_v,
            (1 - share) ** 2 * m_c + share**2 * m_b + ((1 / 2 - share) ** 2 + 1 / 12) * m_v,
            *(2 / 3 * m_v, 2 / 3 * (1 / 2 - share) * m_v, 8 / 15 * m_v),
            *(turned, turned * (d - H) / L),
        ],
    )


def _free_layer(beam: StatedBeam, b: Layer, c: Layer, v: Layer, L: Number) -> _OfCore:
    """A layer that stretches and bends with the substrate, on one side or on both; or none."""
    sides = 2 if beam.both_sides else 1
    _, h_b, m_b = _of_face(b)
    H = v["thickness"] if v else 0.0
    m_v = v["density"] * H if v else 0.0
    low, high = h_b / 2, h_b / 2 + H
    first = 0.0 if beam.both_sides else (high**2 - low**2) / 2
    moments = (sides * H, first, sides * (high**3 - low**3) / 3)
    turns = 0.0 if beam.slender or not v else v["density"] * moments[2]
    return _OfCore(
        mass=m_b + sides * m_v,
        inertia=(0.0, 0.0, turns / L),
        free=[_young_per_shear(beam) * x / L**n for n, x in enumerate(moments, 1)],
    )


def _young_per_shear(beam: StatedBeam) -> float:
    """Of a free layer: it narrows as the substrate does that it is bonded to."""
    if beam.core is None:
        return 0.0
    nu, its = beam.core.poisson, beam.substrate.poisson
    if beam.slender:
        return 2 * (1 + nu)
    return 2 * (1 - 2 * nu * its + its**2) / (1 - nu)


def _moved(beam: StatedBeam, name: str, by: Mapping[str, float | Array]) -> Layer:
    layer = getattr(beam, name)
    if layer is None:
        return {}
    values = {
        "young": getattr(layer, "young_pa", 0.0),
        "thickness": layer.thickness_m,
        "density": layer.density_kg_m3,
    }
    found: Layer = {k: value * np.exp(by.get(f"{name}_{k}", 0.0)) for k, value in values.items()}
    if isinstance(layer, Face):
        warmed = layer.warmed(beam.temperature_c, by.get(f"{name}_young_per_k", 0.0))
        found["young"] = found["young"] * warmed
        found["loss"] = layer.loss_factor + by.get("metal_loss", 0.0)
    return found


def _of_face(face: Layer) -> tuple[Number, Number, Number]:
    """E (1 + i eta), h and mass per area; zero for none."""
    if not face:
        return 0.0, 0.0, 0.0
    young = face["young"] * (1 + 1j * face["loss"]) if np.any(face["loss"]) else face["young"]
    return young, face["thickness"], face["density"] * face["thickness"]
