"""A clamp that yields, rubs, bites elsewhere, or leaves the treatment free."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden.base import HiddenInBeam, Setting
from campaign.draws import either_sign, log_uniform
from campaign.plates.hidden.sizes import ACROSS, CLAMP_LINE_M, FRICTION_LOSS
from drivers.simulated.plant.solid_beam import BeamBuild, RootSprings

_SOFT = (0.004, 0.02)
"""What the first mode falls by: a short beam strains its clamp more than a plate does."""
_WHOLE_JAWS, _WORN = 0.6, (0.1, 0.3)
"""Share of jaws that hold all of the edge; of the others, what of the substrate's height is not held."""
_SHORT_M = (1e-3, 8e-3)
"""How far a treatment ends short of the jaw, where it does not end at it."""
_PULLS, _PULLED, _PRESSED = 0.6, (0.5, 2.0), (0.3, 0.6)
"""Share of clamps that pull; stress over what buckles the faces: pressed harder a beam would buckle."""


@dataclass(frozen=True)
class HiddenClampCompliance(HiddenInBeam):
    """Springs at the root face in three directions; a worn jaw may leave the substrate's edge unheld."""

    name: ClassVar[str] = "clamp_compliance"

    along_x_n_m3: float
    along_y_n_m3: float
    along_z_n_m3: float
    worn: float
    """Share of the substrate's height that is not held, from its outer face; the treatment is."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.clamped

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampCompliance":
        return cls(*cls._springs(rng, at))

    @classmethod
    def _springs(cls, rng: np.random.Generator, at: Setting) -> tuple[float, float, float, float]:
        # A rotation spring k H^3 / 12 against some twice the substrate's rigidity: what mode 1 falls by.
        # A free layer has no hold of its own.
        beam, layers = at.beam, at.beam.solid.sheets if at.beam.constraining else (at.beam.substrate,)
        height = sum(s.thickness_m for s in layers)
        rigidity = 2 * beam.substrate.young_pa * (beam.substrate.thickness_m / height) ** 3
        x = rigidity / (log_uniform(rng, *_SOFT) * beam.span_m)
        y, z = (x * log_uniform(rng, *ACROSS) for _ in range(2))
        return x, y, z, 0.0 if beam.both_sides or rng.random() < _WHOLE_JAWS else float(rng.uniform(*_WORN))

    def build(self, build: BeamBuild, true: TrueBeam) -> BeamBuild:
        unheld = self.worn * true.substrate.thickness_m
        springs = RootSprings(self.along_x_n_m3, self.along_y_n_m3, self.along_z_n_m3, from_m=unheld)
        return replace(build, springs=springs)


@dataclass(frozen=True)
class HiddenClampFriction(HiddenClampCompliance):
    """The root yields as in `HiddenClampCompliance`, and rubs: every spring has a loss factor."""

    name: ClassVar[str] = "clamp_friction"
    near: ClassVar[tuple[str, ...]] = ("clamp_compliance",)

    loss: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampFriction":
        return cls(*cls._springs(rng, at), float(rng.uniform(*FRICTION_LOSS)))

    @property
    def root_loss(self) -> float:
        return self.loss


@dataclass(frozen=True)
class HiddenClampLine(HiddenInBeam):
    """The beam bends from another line than the jaw's visible edge: lengths count from there."""

    name: ClassVar[str] = "clamp_line"

    longer_m: float

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.ends in ("clamped-free", "centre-driven")

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampLine":
        return cls(either_sign(rng, *CLAMP_LINE_M))

    def beam(self, true: TrueBeam) -> TrueBeam:
        halves = 1 if true.whole else 2
        force = None if true.force_m is None else true.force_m + self.longer_m
        length, spot = true.length_m + halves * self.longer_m, true.spot_m + self.longer_m
        return replace(true, length_m=length, spot_m=spot, force_m=force)


@dataclass(frozen=True)
class HiddenTreatmentNotGripped(HiddenInBeam):
    """The clamp holds the substrate alone; core and constraining layer end at it, or short of it, free."""

    name: ClassVar[str] = "treatment_not_gripped"

    begins_m: float = 0.0
    """Distance of the treatment from the clamp."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.clamped and beam.constraining is not None

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTreatmentNotGripped":
        return cls(0.0 if rng.random() < 0.5 else float(rng.uniform(*_SHORT_M)))

    def build(self, build: BeamBuild, true: TrueBeam) -> BeamBuild:
        gripped = true.solid.heights_m(true.solid.substrate)
        return replace(build, gripped_m=gripped, treatment_from_m=self.begins_m or None)


@dataclass(frozen=True)
class HiddenAxialStress(HiddenInBeam):
    """Two clamps that pull a beam along or press it, far more than a kelvin does."""

    name: ClassVar[str] = "axial_stress"
    on_request: ClassVar[bool] = True

    stress_pa: float

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.ends == "clamped-clamped"

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAxialStress":
        # Shares of what its faces, each by itself, would buckle at.
        beam = at.beam
        faces = [beam.substrate] + ([beam.constraining] if beam.constraining is not None else [])
        rigidity = sum(f.young_pa * f.thickness_m**3 for f in faces) / 12
        buckles = 4 * np.pi**2 * rigidity / beam.length_m**2 / sum(f.thickness_m for f in faces)
        share = log_uniform(rng, *_PULLED) if rng.random() < _PULLS else -log_uniform(rng, *_PRESSED)
        return cls(float(share * buckles))

    def beam(self, true: TrueBeam) -> TrueBeam:
        return replace(true, axial_pa=self.stress_pa)
