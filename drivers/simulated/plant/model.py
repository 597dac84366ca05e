"""The reduced plate of `scripts/build_plant.py`: on one basis a matrix for each thing that may change."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from drivers.arrays import Array

FILE = Path(__file__).with_name("plate.npz")


@dataclass(frozen=True)
class ReducedModel:
    """Arrays by name, SI units; symmetric ones unpacked.

    `M_substrate`, `M_core`, `M_constraining`, `M_air` (unit density); `load_...` is M times heave and pitch,
    shape (n, 2); `K_substrate`, `K_constraining`; `K_core_in_plane`, `K_core_mixed`, `K_core_normal` (unit
    modulus; to be multiplied by thickness, one, and one over thickness) and `K_core_strips_x`,
    `K_core_strips_y`, shape (strips, n, n); `S_x`, `S_z` springs of unit stiffness per area of the root;
    `w_top`, `w_bottom` read the deflection on the grid of `grid.py`.
    """

    rigid_count: int
    """The first coordinates, whose motions vanish at the root."""
    arrays: dict[str, Array]

    def __getitem__(self, name: str) -> Array:
        return self.arrays[name]


def unpacked(upper: Array, n: int) -> Array:
    """Symmetric matrices from their upper triangles, the last axis.

    Shapes (..., n (n + 1) / 2) to (..., n, n).
    """
    out = np.zeros((*upper.shape[:-1], n, n))
    i, j = np.triu_indices(n)
    out[..., i, j] = out[..., j, i] = upper
    return out


def model_from(arrays: dict[str, Array]) -> ReducedModel:
    """A model of arrays as built. Shapes as stored: symmetric matrices as `unpacked` takes them."""
    n = arrays["w_top"].shape[1]
    packed = {name for name in arrays if name[:2] in ("M_", "K_", "S_")}
    whole = {k: unpacked(v, n) if k in packed else v for k, v in arrays.items() if k != "rigid_count"}
    return ReducedModel(int(arrays["rigid_count"]), whole)


@cache
def shipped(kind: str) -> ReducedModel:
    """The "sandwich" or the "bare" plate of the shipped file."""
    with np.load(FILE, allow_pickle=False) as data:
        names = [name for name in data.files if name.startswith(f"{kind}_")]
        return model_from({name.removeprefix(f"{kind}_"): data[name] for name in names})
