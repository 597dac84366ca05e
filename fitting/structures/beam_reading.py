"""Where a beam is read, driven and hung on: in the middle of its width, which curves across."""

import numpy as np

from fitting.arrays import Array
from fitting.structures.beam_section import BeamSection
from fitting.structures.beam_width import PLACES, at_the_middle

_MIDDLE_WITHIN = 0.15
"""How well is known by what the middle of the width is higher: of solids, 10 mm and more from a free end, it
is 0.9 to 1.15 times that (a free layer at kilohertz: 1.3)."""
ELEMENTS = 200
"""Along the beam, w a cubic on each: of any column off by 1e-5, of ten modes by 1e-7."""


def read_otherwise(section: BeamSection, at: float | None) -> dict[str, Array]:
    """What the deflection at a place may be more, one standard deviation, by why. Shape (size,) each.

    A face there moves apart from w, nobody says which one; and the middle of the width is higher than w.
    """
    if at is None or section.is_slender:
        return {}
    x = np.array([min(at, 1.0)])
    found = {"middle": _MIDDLE_WITHIN * _higher_in_the_middle(section, x)[0][:, 0]}
    if section.is_sandwich:
        size = np.hypot(section.share, 1 - section.share) / np.sqrt(2)
        found["apart"] = size * section.shapes.rows("a", x)[:, 0]
    return found


def row_at(section: BeamSection, V: Array, at: float, derivative: int = 0) -> Array:
    """Reads the deflection at a share of the length, or is driven there. Shape (k,), of `V` (size, k).

    Or one of its first two derivatives by that share.
    """
    return np.asarray(V.T @ _in_the_middle(section, np.array([min(at, 1.0)]))[derivative][:, 0])


def _in_the_middle(section: BeamSection, x: Array) -> tuple[Array, Array, Array]:
    """The deflection of the middle of the width, where a beam is read and struck, its slope and curvature.

    The last without what the middle is higher. Shape (size, n) each, of `x` (n,).
    """
    w, slope, bend = (section.shapes.rows("w", x, d) for d in (0, 1, 2))
    if section.is_slender:
        return w, slope, bend
    higher, rising = _higher_in_the_middle(section, x)
    return w + higher, slope + rising, bend


def _higher_in_the_middle(section: BeamSection, x: Array) -> tuple[Array, Array]:
    """A beam that curves across is higher there than on the average: nu b^2/24 times that curvature.

    With its slope. Shape (size, n) each, of `x` (n,).
    """
    bend = section.shapes.rows("w", PLACES, 2)
    share = section.faces_poisson * (section.width_m / section.length_m) ** 2 / 24
    higher, rising = at_the_middle(bend, section.reach(0), section.ends, x)
    return share * higher, share * rising


def deflection(section: BeamSection, V: Array) -> Array:
    """w, dw/dy and -dw/dx at the nodes of a strip one element wide. Shape (nodes, 3, k)."""
    x = np.linspace(0.0, 1.0, ELEMENTS + 1)
    w, slope = (each.T @ V for each in _in_the_middle(section, x)[:2])
    along = np.stack([w, np.zeros_like(w), -slope / section.length_m], axis=1)
    return np.repeat(along, 2, axis=0)
