"""The beams of the campaign: what each really is. A specimen file only states something near it."""

from dataclasses import dataclass

from campaign.plates.geometry import DampingLayer, Metal
from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.solid_beam import BeamStated, Ends
from fitting.specimen import Reading


@dataclass(frozen=True)
class TrueBeam:
    """A beam with a constrained core, or with a free layer; x from a clamped end, or from the centre."""

    name: str
    length_m: float
    width_m: float
    ends: Ends
    substrate: Metal
    core: DampingLayer
    constraining: Metal | None
    spot_m: float
    """Where the laser is meant to point."""
    reads: Reading = "relative"
    force_m: float | None = None
    """Where a hammer strikes, on the face away from the laser; None: the base drives."""
    both_sides: bool = False
    axial_pa: float = 0.0
    """That its clamps pull it along by, in its faces."""
    stiffer: float = 1.0
    """Times what a soft core's law says: a free layer is a stiff plastic."""

    @property
    def span_m(self) -> float:
        """What vibrates as one piece."""
        return self.length_m / 2 if self.ends == "centre-driven" else self.length_m

    @property
    def clamped(self) -> bool:
        """Whether an end is."""
        return self.ends != "free-free"

    @property
    def whole(self) -> bool:
        """Whether it is one piece: what sits on one half of a beam driven in its centre parts them."""
        return self.ends != "centre-driven"

    @property
    def mass_kg(self) -> float:
        """Mass of all layers."""
        sides = 2 if self.both_sides else 1
        above: list[DampingLayer | Metal] = [self.core, *([self.constraining] if self.constraining else [])]
        areal = sum(k.thickness_m * k.density_kg_m3 for k in above)
        s = self.substrate
        return self.length_m * self.width_m * (s.thickness_m * s.density_kg_m3 + sides * areal)

    @property
    def solid(self) -> BeamStated:
        """Dimensions, layers and ends as `SolidBeam` takes them."""
        c = self.core
        core = Sheet(c.thickness_m, 2 * (1 + c.poisson), c.poisson, c.density_kg_m3)
        above = [core, *([_sheet(self.constraining)] if self.constraining else [])]
        sheets = [*(reversed(above) if self.both_sides else ()), _sheet(self.substrate), *above]
        cores = tuple(k for k, sheet in enumerate(sheets) if sheet is core)
        return BeamStated(
            self.length_m, self.width_m, self.ends, tuple(sheets), cores, self.spot_m, self.axial_pa
        )


def _sheet(m: Metal) -> Sheet:
    return Sheet(m.thickness_m, m.young_pa, m.poisson, m.density_kg_m3)


def _aluminium(mm: float, gpa: float = 69.5) -> Metal:
    return Metal(mm * 1e-3, gpa * 1e9, 0.33, 2705.0)


def _steel(mm: float, gpa: float = 206.0) -> Metal:
    return Metal(mm * 1e-3, gpa * 1e9, 0.285, 7850.0)


def _core(mm: float, density: float = 1000.0) -> DampingLayer:
    return DampingLayer(mm * 1e-3, 0.47, density)


def _plastic(mm: float) -> DampingLayer:
    return DampingLayer(mm * 1e-3, 0.42, 1400.0)


BEAMS: tuple[TrueBeam, ...] = (
    TrueBeam("strip", 0.22, 0.02, "clamped-free", _steel(1.5), _core(0.25), _aluminium(0.5), 0.15),
    TrueBeam(
        "bar", 0.18, 0.0127, "clamped-free", _aluminium(2.0), _core(0.15), _aluminium(0.5), 0.17, "absolute"
    ),
    TrueBeam("free", 0.3, 0.03, "free-free", _aluminium(3.0), _core(0.5), _steel(0.5), 0.285, force_m=0.018),
    TrueBeam("bridge", 0.25, 0.02, "clamped-clamped", _steel(1.0), _core(0.1, 1100.0), _steel(0.3), 0.09),
    TrueBeam("balance", 0.26, 0.025, "centre-driven", _aluminium(2.5), _core(0.4), _aluminium(0.8), 0.12),
    TrueBeam("coated", 0.2, 0.012, "clamped-free", _steel(1.0), _plastic(2.0), None, 0.13, stiffer=150.0),
    TrueBeam(
        "padded", 0.21, 0.015, "clamped-free", _steel(1.0), _core(0.2), _steel(0.3), 0.19, both_sides=True
    ),
    TrueBeam(
        "struck", 0.2, 0.018, "clamped-free", _aluminium(2.0), _core(0.3), _steel(0.25), 0.19, force_m=0.07
    ),
    TrueBeam("laminate", 0.24, 0.025, "clamped-free", _steel(0.8), _core(0.06, 1100.0), _steel(0.8), 0.1),
    TrueBeam("long", 0.32, 0.024, "free-free", _steel(2.0), _core(0.3), _steel(0.4), 0.16, force_m=0.31),
)
"""Lengths 180 to 320 mm, widths 12 to 30 mm; all kinds of ends, three of them driven by a force."""


def beam_named(name: str) -> TrueBeam:
    """One of `BEAMS`. Raises `KeyError`."""
    return {beam.name: beam for beam in BEAMS}[name]
