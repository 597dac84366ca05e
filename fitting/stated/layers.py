"""What a specimen is made of: faces, glue and a core, in SI units. Frozen data only."""

from dataclasses import dataclass, replace
from math import sin

from fitting.arrays import Array
from fitting.laws import CoreLaw

_ALIGNED = 1e-9
"""Of a sine, what rounding makes of axes that are one."""


@dataclass(frozen=True)
class Orthotropy:
    """What an orthotropic face has beside Young's modulus along its own first axis and nu_12."""

    young_y_pa: float
    """Along its second axis."""
    shear_pa: float
    """G_12."""
    angle_rad: float = 0.0
    """From the plate's x to its first axis, towards y."""

    @property
    def aligned(self) -> bool:
        """Whether its axes are the plate's."""
        return abs(sin(2 * self.angle_rad)) < _ALIGNED


METAL_PER_K = -4e-4
"""Of Young's modulus where nothing is stated: steel has -3e-4, aluminium -5e-4, brass and titanium about."""
METAL_AT_C = 20.0
"""Where a stated modulus is taken to hold."""


@dataclass(frozen=True)
class Face:
    """An elastic layer: the substrate or the constraining layer."""

    thickness_m: float
    young_pa: float
    """Along its own first axis where it is orthotropic."""
    poisson: float
    density_kg_m3: float
    loss_factor: float = 0.0
    loss_is_stated: bool = False
    """Whether nothing is known of it but that: a bare metal loses something, and so does its clamp."""
    rolled: Orthotropy | None = None
    """None: isotropic."""
    young_per_k: float | None = None
    """Change of Young's modulus for a kelvin, relative; None: a metal's, `METAL_PER_K`."""
    young_at_c: float = METAL_AT_C
    """The temperature that it is stated for."""

    @property
    def taken_per_k(self) -> float:
        """Its modulus's change for a kelvin as stated, else a metal's."""
        return METAL_PER_K if self.young_per_k is None else self.young_per_k

    def warmed(self, temperature_c: float | None, by_per_k: Array | float = 0.0) -> Array | float:
        """Factor on Young's modulus at a temperature, its change for a kelvin moved by so much.

        None: as stated. Shape of `by_per_k`.
        """
        if temperature_c is None:
            return 1.0
        return 1 + (self.taken_per_k + by_per_k) * (temperature_c - self.young_at_c)


@dataclass(frozen=True)
class Glue:
    """A thin layer between the core and a face: it shears, and weighs."""

    thickness_m: float
    shear_pa: float
    density_kg_m3: float
    loss_factor: float = 0.0


def as_isotropic(face: Face) -> Face:
    """An orthotropic face's like, of Young's modulus sqrt(E_1 E_2) and the ratio sqrt(nu_12 nu_21)."""
    if face.rolled is None:
        return face
    ratio = face.rolled.young_y_pa / face.young_pa
    return replace(face, young_pa=face.young_pa * ratio**0.5, poisson=face.poisson * ratio**0.5, rolled=None)


@dataclass(frozen=True)
class Core:
    """The viscoelastic layer between the faces.

    Its law gives G*(omega) and is where identification starts.
    """

    thickness_m: float
    poisson: float
    density_kg_m3: float
    law: CoreLaw
    glue: tuple[Glue, ...] = ()
    """On one or both of its sides; in series, so it does not matter on which."""

    @property
    def between_faces_m(self) -> float:
        """Its thickness and the glue's."""
        return self.thickness_m + sum(g.thickness_m for g in self.glue) if self.glue else self.thickness_m

    @property
    def glue_mass_kg_m2(self) -> float:
        """Per area."""
        return sum(g.density_kg_m3 * g.thickness_m for g in self.glue)

    @property
    def glue_stiffness_pa_m(self) -> complex:
        """Shear stress over slip of all glue in series, complex where it loses energy; zero without any."""
        if not self.glue:
            return 0.0
        return 1 / sum(g.thickness_m / (g.shear_pa * (1 + 1j * g.loss_factor)) for g in self.glue)
