"""Every structure to scale, as boxes, marks and arrows in mm: its clamps, its drive, where it is read.

No drawing library: report and window draw the same sketch.
"""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from typing import Literal

import numpy as np

from fitting.specimen import PlateSpecimen
from fitting.stated.edges import Edge
from fitting.structures import AnySpecimen, Beam, ShearPair

Kind = Literal["face", "core", "bare", "treated", "held", "support", "mass"]
MarkKind = Literal["spot", "force", "mass", "hit", "sensor"]

_HELD = 0.04
"""Of a view's length: what is drawn of a clamp."""
_MASS = 0.5
"""Of the discs' diameter: the mass between them, whose size nobody states."""


@dataclass(frozen=True)
class Box:
    """A rectangle, mm."""

    x: float
    y: float
    width: float
    height: float
    kind: Kind


@dataclass(frozen=True)
class Mark:
    """A point, mm."""

    x: float
    y: float
    name: str
    kind: MarkKind


@dataclass(frozen=True)
class Arrow:
    """What drives it, mm: from a point, by so much."""

    x: float
    y: float
    dx: float
    dy: float
    name: str


@dataclass(frozen=True)
class View:
    """One view, to one scale; y is up."""

    title: str
    boxes: tuple[Box, ...]
    marks: tuple[Mark, ...] = ()
    arrows: tuple[Arrow, ...] = ()
    size_mm: tuple[float, float] | None = None
    """Of a plate from a corner at 0, 0: written along its edges, and with each mark where it is."""

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lowest x and y, highest x and y, of all that is drawn."""
        x = [v for b in self.boxes for v in (b.x, b.x + b.width)] + [m.x for m in self.marks]
        y = [v for b in self.boxes for v in (b.y, b.y + b.height)] + [m.y for m in self.marks]
        x += [v for a in self.arrows for v in (a.x, a.x + a.dx)]
        y += [v for a in self.arrows for v in (a.y, a.y + a.dy)]
        return min(x), min(y), max(x), max(y)


def sketch_of(specimen: AnySpecimen, further: Sequence[Mark] = ()) -> tuple[View, ...]:
    """Its views; `further` are marks on a plate beside its own, a hammer test's."""
    if isinstance(specimen, Beam):
        return _beam(specimen)
    if isinstance(specimen, ShearPair):
        return (_pair(specimen),)
    return (_plate(specimen, further),)


def _plate(s: PlateSpecimen, further: Sequence[Mark]) -> View:
    L, B = 1e3 * s.length_m, 1e3 * s.width_m
    d = _HELD * max(L, B)
    patches = [
        Box(1e3 * x, 1e3 * y, 1e3 * (to_x - x), 1e3 * (to_y - y), "treated")
        for x, to_x, y, to_y in (astuple(p) for p in s.patches)
    ]
    places = ((-d, 0.0, d, B), (0.0, -d, L, d), (L, 0.0, d, B), (0.0, B, L, d))
    held: dict[Edge, Kind] = {"clamped": "held", "simply-supported": "support"}
    edges = [Box(*at, held[edge]) for at, edge in zip(places, s.edges, strict=True) if edge in held]
    whole: Kind = "treated" if s.core is not None and not s.patches else "bare"
    several = len(s.pickups_m) > 1
    marks = [
        Mark(1e3 * x, 1e3 * y, f"spot {k}" if several else "spot", "spot")
        for k, (x, y) in enumerate(s.pickups_m)
    ]
    marks += [Mark(1e3 * m.x_m, 1e3 * m.y_m, f"{1e3 * m.mass_kg:g} g", "mass") for m in s.masses]
    if s.force_m is not None:
        marks.append(Mark(1e3 * s.force_m[0], 1e3 * s.force_m[1], "force", "force"))
    driven = "a force drives it" if s.drive == "force" else "its base moves normal to it"
    return View(
        f"Seen from above, {L:g} x {B:g} mm; {driven}",
        (*edges, Box(0.0, 0.0, L, B, whole), *patches),
        (*marks, *further),
        size_mm=(L, B),
    )


def _layers(beam: Beam) -> list[tuple[float, Kind]]:
    """Thickness in mm, from below."""
    above: list[tuple[float, Kind]] = []
    if beam.core is not None:
        above.append((1e3 * beam.core.thickness_m, "core"))
    if beam.constraining is not None:
        above.append((1e3 * beam.constraining.thickness_m, "face"))
    below = above[::-1] if beam.both_sides else []
    return [*below, (1e3 * beam.substrate.thickness_m, "face"), *above]


def _beam(beam: Beam) -> tuple[View, ...]:
    L, B, layers = 1e3 * beam.length_m, 1e3 * beam.width_m, _layers(beam)
    ends = np.cumsum([0.0, *(h for h, _ in layers)])
    top, d = float(ends[-1]), _HELD * L
    begin = -L / 2 if beam.boundary == "centre-driven" else 0.0
    along = [Box(begin, float(z), L, h, kind) for z, (h, kind) in zip(ends, layers, strict=False)]
    tall = (-d, d + top)
    clamps = {
        "clamped-free": [-d],
        "clamped-clamped": [-d, L],
        "centre-driven": [],
        "free-free": [],
    }[beam.boundary]
    held = [Box(x, tall[0], d, tall[1] - tall[0], "held") for x in clamps]
    if beam.boundary == "centre-driven":
        held.append(Box(-d / 4, -d, d / 2, d, "held"))
    reach = 1.5 * d
    by_base = held if beam.drive == "base" else []
    arrows = [Arrow(b.x + b.width / 2, b.y - reach, 0.0, reach, "base") for b in by_base]
    several = len(beam.pickups_m) > 1
    marks = [
        Mark(1e3 * x, top, f"spot {k}" if several else "spot", "spot") for k, x in enumerate(beam.pickups_m)
    ]
    if beam.force_m is not None:
        marks.append(Mark(1e3 * beam.force_m, top, "force", "force"))
    marks += [Mark(1e3 * m.x_m, top, f"{1e3 * m.mass_kg:g} g", "mass") for m in beam.masses]
    section = [Box(0.0, float(z), B, h, kind) for z, (h, kind) in zip(ends, layers, strict=False)]
    said = ", ".join(f"{h:g}" for h, _ in layers)
    return (
        View(f"Seen from the side, {L:g} mm, {beam.boundary}", (*held, *along), tuple(marks), tuple(arrows)),
        View(f"Its section, {B:g} mm wide, layers of {said} mm from below", tuple(section)),
    )


def _pair(pair: ShearPair) -> View:
    """Cut along the discs' axis: a disc between base and mass, or one on either side of it."""
    # A = pi/4 (D^2 - d^2), kappa^2 = (D^2 + d^2)/16; a full disc where the area alone is stated.
    square = 4e6 * pair.area_m2 / np.pi
    total = 16e6 * pair.gyration_m**2 if pair.gyration_m is not None else square
    outer, inner = float(np.sqrt((total + square) / 2)), float(np.sqrt(max(total - square, 0.0) / 2))
    t, m, d = 1e3 * pair.core.thickness_m, _MASS * outer, _HELD * outer * 3
    sides = 1 if pair.discs == 1 else 2
    boxes = [Box(0.0, 0.0, m, outer, "mass")]
    for x, wall in ((-t, -t - d), (m, m + t))[:sides]:
        thick = (outer - inner) / 2
        parts = [(0.0, outer)] if inner < 1e-3 * outer else [(0.0, thick), (outer - thick, thick)]
        boxes += [Box(x, y, t, h, "core") for y, h in parts]
        boxes.append(Box(wall, -d, d, outer + 2 * d, "held"))
    spot = Mark(m / 2, outer, "spot", "spot")
    arrow = Arrow(-t - d / 2, -4 * d, 0.0, 3 * d, "base")
    hole = f", hole {inner:.3g} mm" if inner >= 1e-3 * outer else ""
    count = f"{pair.discs} disc{'s' if pair.discs > 1 else ''}"
    return View(
        f"{count} of {outer:.3g} mm{hole}, {t:g} mm thick; {pair.mass_kg:g} kg, its size not stated",
        tuple(boxes),
        (spot,),
        (arrow,),
    )
