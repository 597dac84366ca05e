"""What coefficients ask of a specimen as one array, so that a model's cached file has it, and back."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.laws.constant import ConstantModulus
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, Glue, Orthotropy
from fitting.stated.patches import Patch

_LAYER = ("thickness_m", "young_pa", "poisson", "density_kg_m3", "loss_factor")
_AXES = ("young_y_pa", "shear_pa", "angle_rad")
_GLUE = ("thickness_m", "shear_pa", "density_kg_m3", "loss_factor")
_PATCH = ("from_x_m", "to_x_m", "from_y_m", "to_y_m")
_SUBSTRATE, _CONSTRAINING, _CORE, _GLUES, _WHOLE, _PATCHES = 0, 1, 2, 3, 5, 6
"""Rows of `layers_of`: each layer's, the first of glue, that of the plate as a whole, the first patch's."""
_OF_WHOLE: dict[str, Callable[[PlateSpecimen], float]] = {
    "both_sides": lambda s: s.both_sides,
    "pulled_x": lambda s: "x" in s.pulled_along,
    "pulled_y": lambda s: "y" in s.pulled_along,
    "axial_x_pa": lambda s: s.axial_pa[0] or 0.0,
    "axial_y_pa": lambda s: s.axial_pa[1] or 0.0,
    "faces_shear": lambda s: s.faces_shear,
}
"""The numbers of row `_WHOLE` in their order, each with where it is read; a model's cached file has it so."""


def layers_of(specimen: PlateSpecimen) -> Array:
    """What `coefficients` asks of substrate, constraining layer and core, in the order of `_LAYER`.

    Zero where a layer is missing or has no such number. Shape (3, 5). What few plates have besides is behind:
    own axes of a face in three columns more (`_AXES`), then rows of two layers of glue (`_GLUE`), of the
    plate as a whole (`_OF_WHOLE`), and of patches (`_PATCH`). Shape (6 + patches, 8).
    """
    s = specimen
    each = (s.substrate, s.constraining, s.core)
    plain = np.array([[getattr(layer, name, 0.0) for name in _LAYER] for layer in each])
    axes = [face.rolled for face in (s.substrate, s.constraining) if face is not None]
    if not (any(axes) or s.patches or s.both_sides or s.slips or s.pulled_along):
        return plain
    found = np.zeros((_PATCHES + len(s.patches), len(_LAYER) + len(_AXES)))
    found[: len(each), : len(_LAYER)] = plain
    for row, face in ((_SUBSTRATE, s.substrate), (_CONSTRAINING, s.constraining)):
        if face is not None and face.rolled is not None:
            found[row, len(_LAYER) :] = [getattr(face.rolled, name) for name in _AXES]
    for row, glue in enumerate(s.core.glue if s.core is not None else (), _GLUES):
        found[row, : len(_GLUE)] = [getattr(glue, name) for name in _GLUE]
    found[_WHOLE, : len(_OF_WHOLE)] = [read(s) for read in _OF_WHOLE.values()]
    for row, patch in enumerate(s.patches, _PATCHES):
        found[row, : len(_PATCH)] = [getattr(patch, name) for name in _PATCH]
    return found


def specimen_of(size: Array, layers: Array) -> PlateSpecimen:
    """As far as `coefficients` asks: `size` gives length and width in m and elements along each.

    Shapes (4,) and (3, 5) or more, see `layers_of`.
    """
    n = len(_LAYER)
    substrate, constraining = (
        replace(Face(*row[:n]), rolled=Orthotropy(*row[n:]) if any(row[n:]) else None)
        for row in layers[[_SUBSTRATE, _CONSTRAINING]].tolist()
    )
    core_numbers = dict(zip(_LAYER, layers[_CORE, :n].tolist(), strict=True))
    length, width, n_x, n_y = size.tolist()
    whole = dict.fromkeys(_OF_WHOLE, 0.0)
    if len(layers) > _WHOLE:
        whole = dict(zip(_OF_WHOLE, layers[_WHOLE, : len(_OF_WHOLE)].tolist(), strict=True))
    axial = (
        whole["axial_x_pa"] if whole["pulled_x"] else None,
        whole["axial_y_pa"] if whole["pulled_y"] else None,
    )
    plain = PlateSpecimen(length, width, "free", substrate, elements=(int(n_x), int(n_y)), axial_pa=axial)
    if not core_numbers["thickness_m"]:
        return plain
    core = Core(
        core_numbers["thickness_m"],
        core_numbers["poisson"],
        core_numbers["density_kg_m3"],
        law=ConstantModulus(1e6, 0.0),
        glue=tuple(Glue(*row[: len(_GLUE)]) for row in layers[_GLUES:_WHOLE].tolist() if row[0]),
    )
    return replace(
        plain,
        constraining=constraining,
        core=core,
        both_sides=bool(whole["both_sides"]),
        faces_shear=bool(whole["faces_shear"]),
        patches=tuple(Patch(*row[: len(_PATCH)]) for row in layers[_PATCHES:].tolist()),
    )
