"""The same mesh of another plate: what its matrices differ by, and in between. No effect by itself."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.effects.base import Change
from fitting.effects.full_plate import FullPlate, Snapshot
from fitting.effects.spanned import SpannedPlate
from fitting.element import CORNERS, DOFS, THETA_X, THETA_Y
from fitting.plate import Mesh, element_matrices
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrices = dict[str, sp.csc_array]

PARTS = ("K_0", "K_1", "M")


def differences(full: FullPlate, name: str, other: Specimen) -> Matrices:
    """By `PARTS`, what the matrices of another plate differ by. Shape (n, n) each.

    Its trial functions are the stated plate's, stretched with it: w(x / length, y / width) stays.
    """

    def make() -> Matrices:
        s, mesh = full.specimen, full.loose.mesh
        stretch = np.ones(DOFS)
        stretch[THETA_X], stretch[THETA_Y] = s.width_m / other.width_m, s.length_m / other.length_m
        t = np.tile(stretch, len(CORNERS))
        here = full.once("stated elements", lambda: element_matrices(s, mesh))
        there = element_matrices(other, Mesh(other.length_m, other.width_m, mesh.n_x, mesh.n_y))
        return {
            part: full.loose.scatter(t[:, None] * getattr(there, part) * t - getattr(here, part))
            for part in PARTS
        }

    return full.once(name, make)


def matrices(full: FullPlate, others: Mapping[str, Specimen]) -> dict[str, sp.csc_array]:
    """Differences of some plates, named by part and plate."""
    return {
        f"{part}_{name}": A
        for name, other in others.items()
        for part, A in differences(full, name, other).items()
    }


def loads(full: FullPlate, others: Mapping[str, Specimen]) -> dict[str, Array]:
    """Differences of their loads."""
    return {
        f"load_{name}": -(differences(full, name, other)["M"] @ full.heave) for name, other in others.items()
    }


def responses(full: FullPlate, at: Snapshot, others: Mapping[str, Specimen]) -> Complex:
    """To first order, how their motions differ. Shape (n, 2 plates)."""
    forces = []
    for name, other in others.items():
        d, X = differences(full, name, other), at.both
        forces.append(d["K_0"] @ X + at.G * (d["K_1"] @ X) - at.omega**2 * (d["M"] @ X))
    return at.solve(np.hstack(forces), odd=False)


Functions = Callable[[Array], Sequence[Array]]
"""As many as there are other plates, all zero where the plate is the stated one."""


def between(
    plate: SpannedPlate, span: str, others: Mapping[str, float], at: float, functions: Mapping[str, Functions]
) -> Change:
    """What a plate between others changes, by functions of a number that each part is a sum of.

    `others` gives that number of each other plate, `functions` is by `PARTS`.
    """
    known = np.array(list(others.values()))

    def mixed(part: str, get: Callable[[str], Array], by: str) -> Array:
        table, wanted = np.array(functions[by](known)), np.array(functions[by](np.array([at])))[:, 0]
        weights = np.linalg.solve(table, wanted)
        return np.asarray(sum(c * get(f"{span}.{part}_{n}") for c, n in zip(weights, others, strict=True)))

    return Change(
        K=mixed("K_0", plate.matrix, "K_0"),
        K_1=mixed("K_1", plate.matrix, "K_1"),
        M=mixed("M", plate.matrix, "M"),
        load=mixed("load", plate.vector, "M"),
    )
