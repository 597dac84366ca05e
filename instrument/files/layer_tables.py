"""Tables of a specimen file that say what layers there are, and where: faces, glue, patches."""

from collections.abc import Sequence
from itertools import combinations
from math import radians
from typing import Annotated

from pydantic import Field, model_validator

from fitting.stated.layers import METAL_AT_C, Face, Glue, Orthotropy
from fitting.stated.patches import Patch
from instrument.files.toml import NotNegative, Positive, TomlTable

Poisson = Annotated[float, Field(gt=-1, lt=0.5, allow_inf_nan=False)]
_LEAST_SIDE_MM = 2.0
"""What a structure's side is above: the shortest that is not asked about."""
_OWN_AXES = ("young_x_gpa", "young_y_gpa", "shear_gpa")


class StatedLayer(TomlTable):
    """An elastic layer: isotropic, or orthotropic about axes of its own."""

    thickness_mm: Positive
    young_gpa: Positive | None = None
    poisson: Poisson
    """Of an orthotropic layer nu_xy: how much narrower it gets as it is stretched along its own x."""
    density_kg_m3: Positive
    loss_factor: NotNegative | None = None
    """Left out: none, but for what a beam's metal may lose."""
    young_percent_per_k: Annotated[float, Field(ge=-1, le=1, allow_inf_nan=False)] | None = None
    """Change of Young's modulus with temperature, for data of several; left out: a metal's."""
    young_at_c: Annotated[float, Field(gt=-100, lt=200, allow_inf_nan=False)] | None = None
    """The temperature that it is stated for; left out: 20."""
    young_x_gpa: Positive | None = None
    """With the next two in the place of `young_gpa`: of a rolled sheet or a laminate."""
    young_y_gpa: Positive | None = None
    shear_gpa: Positive | None = None
    angle_deg: Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)] | None = None
    """From the plate's x to the layer's own, towards y."""

    @model_validator(mode="after")
    def _elastic(self) -> "StatedLayer":
        own = [name for name in _OWN_AXES if getattr(self, name) is not None]
        if self.young_gpa is not None and (own or self.angle_deg is not None):
            raise ValueError(f"young_gpa with {(own or ['angle_deg'])[0]}, expected one or the other")
        if self.young_gpa is None and len(own) < len(_OWN_AXES):
            raise ValueError(
                f"expected young_gpa, or {', '.join(_OWN_AXES)}"
                + (f"; found {', '.join(own)}" if own else "")
            )
        if self.young_x_gpa and self.young_y_gpa and self.poisson**2 * self.young_y_gpa >= self.young_x_gpa:
            most = (self.young_x_gpa / self.young_y_gpa) ** 0.5
            raise ValueError(f"poisson = {self.poisson:g}, expected below sqrt(young_x/young_y) = {most:.3g}")
        return self

    def face(self) -> Face:
        """In SI units."""
        young = self.young_gpa if self.young_gpa is not None else self.young_x_gpa
        assert young is not None
        return Face(
            thickness_m=self.thickness_mm * 1e-3,
            young_pa=young * 1e9,
            poisson=self.poisson,
            density_kg_m3=self.density_kg_m3,
            loss_factor=self.loss_factor or 0.0,
            loss_is_stated=self.loss_factor is not None,
            rolled=self._own_axes(),
            young_per_k=None if self.young_percent_per_k is None else 1e-2 * self.young_percent_per_k,
            young_at_c=METAL_AT_C if self.young_at_c is None else self.young_at_c,
        )

    def _own_axes(self) -> Orthotropy | None:
        if self.young_y_gpa is None or self.shear_gpa is None:
            return None
        return Orthotropy(self.young_y_gpa * 1e9, self.shear_gpa * 1e9, radians(self.angle_deg or 0.0))


class GluePart(TomlTable):
    """A thin layer between the core and a face."""

    thickness_mm: Positive
    shear_mpa: Positive
    density_kg_m3: Positive
    loss_factor: NotNegative = 0.0

    def glue(self) -> Glue:
        """In SI units."""
        return Glue(self.thickness_mm * 1e-3, self.shear_mpa * 1e6, self.density_kg_m3, self.loss_factor)


class PatchPart(TomlTable):
    """A rectangle that is treated, from the clamp and from a long edge."""

    from_x_mm: NotNegative
    to_x_mm: Positive
    from_y_mm: NotNegative
    to_y_mm: Positive

    def patch(self) -> Patch:
        """In SI units."""
        return Patch(*(1e-3 * v for v in (self.from_x_mm, self.to_x_mm, self.from_y_mm, self.to_y_mm)))


def refuse_place(name: str, at_mm: float, side: str, side_mm: float, structure: str = "plate") -> None:
    """Raises `ValueError` for a place off a structure whose `side` ends at so many mm."""
    if at_mm <= side_mm:
        return
    # A side in m is a thousandth of what it is in mm, and no structure is as small.
    in_m = f": {side}, is it in m?" if side_mm < _LEAST_SIDE_MM and at_mm <= 1e3 * side_mm else ""
    raise ValueError(f"{name} = {at_mm:g} is off the {structure}, expected 0 to {side_mm:g}{in_m}")


def refuse_patches(patches: Sequence[PatchPart], length_mm: float, width_mm: float) -> None:
    """Raises `ValueError` for patches that are none or slivers, off the plate or over each other."""
    for k, p in enumerate(patches):
        for axis, low, high, side in (
            ("x", p.from_x_mm, p.to_x_mm, length_mm),
            ("y", p.from_y_mm, p.to_y_mm, width_mm),
        ):
            if low >= high:
                raise ValueError(
                    f"patch.{k}.from_{axis}_mm = {low:g}, expected less than to_{axis}_mm = {high:g}"
                )
            if high - low < _SHORTEST_MM:
                raise ValueError(
                    f"patch.{k} is {high - low:g} mm long along {axis}, expected {_SHORTEST_MM:g} mm at least"
                )
            its = f"plate.{'length' if axis == 'x' else 'width'}_mm = {side:g}"
            refuse_place(f"patch.{k}.to_{axis}_mm", high, its, side)
    for (i, p), (k, q) in combinations(enumerate(patches), 2):
        if p.patch().common_m2(q.patch()) > _TOUCH_M2:
            raise ValueError(f"patch.{i} and patch.{k} overlap, expected patches beside each other")


_SHORTEST_MM = 1.0
"""Of a patch: what is cut shorter holds on to nothing, and a file in metres says 0.1."""
_TOUCH_M2 = 1e-12
"""A square micrometre is rounding."""
