"""The plates of the campaign: what each really is. A specimen file only states something near it."""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Metal:
    """A face: the substrate or the constraining layer."""

    thickness_m: float
    young_pa: float
    poisson: float
    density_kg_m3: float
    rolled: float = 0.0
    """Young's modulus is larger along x by half of this share and smaller along y: a rolled sheet."""


@dataclass(frozen=True)
class DampingLayer:
    """The viscoelastic layer but for its modulus."""

    thickness_m: float
    poisson: float
    density_kg_m3: float


@dataclass(frozen=True)
class TruePlate:
    """A cantilever plate with a constrained core, or bare. x from the clamp, y from a long edge."""

    name: str
    length_m: float
    width_m: float
    substrate: Metal
    core: DampingLayer | None
    constraining: Metal | None
    spot_m: tuple[float, float]
    """Where the laser is meant to point."""
    ratios: tuple[float, ...]
    """Remaining damping of the first eight modes as a fraction of critical."""

    @property
    def bare(self) -> "TruePlate":
        """Before its treatment."""
        return replace(self, core=None, constraining=None)

    @property
    def heights_m(self) -> tuple[float, ...]:
        """Thickness of the layers from z = 0 upwards."""
        layers = (self.substrate, self.core, self.constraining)
        return tuple(layer.thickness_m for layer in layers if layer is not None)


def _aluminium(mm: float, gpa: float = 69.5, poisson: float = 0.33, density: float = 2705.0) -> Metal:
    return Metal(mm * 1e-3, gpa * 1e9, poisson, density)


def _steel(mm: float, gpa: float = 206.0, poisson: float = 0.285, density: float = 7850.0) -> Metal:
    return Metal(mm * 1e-3, gpa * 1e9, poisson, density)


def _brass(mm: float, gpa: float = 104.0, poisson: float = 0.345, density: float = 8480.0) -> Metal:
    return Metal(mm * 1e-3, gpa * 1e9, poisson, density)


def _core(mm: float, poisson: float, density: float) -> DampingLayer:
    return DampingLayer(mm * 1e-3, poisson, density)


def _percent(*ratios: float) -> tuple[float, ...]:
    return tuple(r / 100 for r in ratios)


PLATES: tuple[TruePlate, ...] = (
    TruePlate(
        "P1",
        0.2400,
        0.1600,
        _steel(1.2),
        _core(0.25, 0.47, 980.0),
        _aluminium(0.4),
        (0.072, 0.042),
        _percent(0.21, 0.12, 0.17, 0.14, 0.09, 0.08, 0.11, 0.06),
    ),
    TruePlate(
        "P2",
        0.3200,
        0.1780,
        _aluminium(2.5, 70.8, 0.335, 2690.0),
        _core(0.5, 0.465, 1050.0),
        _steel(0.3, 203.0, 0.29),
        (0.085, 0.089),
        _percent(0.34, 0.16, 0.12, 0.2, 0.1, 0.09, 0.07, 0.08),
    ),
    TruePlate(
        "P3",
        0.1800,
        0.1400,
        _aluminium(1.6, 68.2, 0.33, 2720.0),
        _core(0.15, 0.475, 1100.0),
        _aluminium(0.5, 70.2),
        (0.117, 0.070),
        _percent(0.25, 0.19, 0.11, 0.13, 0.15, 0.07, 0.08, 0.1),
    ),
    TruePlate(
        "P4",
        0.4000,
        0.2200,
        _brass(2.0),
        _core(1.0, 0.46, 930.0),
        _steel(0.5, 208.0, 0.28, 7810.0),
        (0.380, 0.060),
        _percent(0.4, 0.22, 0.15, 0.16, 0.11, 0.12, 0.06, 0.05),
    ),
    TruePlate(
        "P5",
        0.3500,
        0.1650,
        _steel(2.0, 209.5, 0.28, 7870.0),
        _core(0.35, 0.47, 1010.0),
        _steel(0.5, 199.0, 0.295),
        (0.110, 0.030),
        _percent(0.16, 0.09, 0.13, 0.1, 0.07, 0.08, 0.06, 0.07),
    ),
    TruePlate(
        "P6",
        0.2800,
        0.2300,
        _aluminium(3.0, 71.5, 0.34, 2780.0),
        _core(0.2, 0.465, 1150.0),
        _aluminium(0.6, 69.0),
        (0.182, 0.115),
        _percent(0.3, 0.24, 0.14, 0.18, 0.12, 0.1, 0.09, 0.11),
    ),
    TruePlate(
        "P7",
        0.1500,
        0.0950,
        _brass(1.0, 101.0, 0.35, 8520.0),
        _core(0.18, 0.47, 990.0),
        _steel(0.15, 201.0),
        (0.062, 0.070),
        _percent(0.28, 0.13, 0.15, 0.12, 0.08, 0.1, 0.07, 0.06),
    ),
    TruePlate(
        "P8",
        0.2100,
        0.1200,
        _aluminium(1.5, 67.5, 0.325, 2690.0),
        _core(0.7, 0.46, 960.0),
        _steel(0.2, 205.0),
        (0.137, 0.060),
        _percent(0.38, 0.2, 0.18, 0.12, 0.15, 0.09, 0.1, 0.07),
    ),
    TruePlate(
        "P9",
        0.3800,
        0.2850,
        _steel(2.6, 204.5, 0.285, 7840.0),
        _core(0.5, 0.475, 1080.0),
        _steel(0.6, 207.0),
        (0.240, 0.080),
        _percent(0.14, 0.11, 0.08, 0.09, 0.06, 0.05, 0.07, 0.05),
    ),
    TruePlate(
        "P10",
        0.2600,
        0.1500,
        _brass(1.5, 107.0, 0.34, 8450.0),
        _core(0.3, 0.47, 1000.0),
        _aluminium(0.55, 70.5),
        (0.100, 0.040),
        _percent(0.22, 0.15, 0.1, 0.13, 0.09, 0.08, 0.1, 0.06),
    ),
)
"""Lengths 150 to 400 mm, aspect 1.2 to 2.2; four lasers point at the axis, most well inside the plate."""


def plate_named(name: str) -> TruePlate:
    """One of `PLATES`. Raises `KeyError`."""
    return {plate.name: plate for plate in PLATES}[name]
