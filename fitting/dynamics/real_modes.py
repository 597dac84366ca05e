"""Undamped modes of the plate at a real core modulus: Eq. (6)."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from fitting.arrays import Array
from fitting.errors import OutsideModel
from fitting.numerics.linear import factorise
from fitting.plate.edge_twist import wide_enough
from fitting.plate.plate import Plate


@dataclass(frozen=True)
class RealModes:
    """Natural frequencies in ascending order and mass-normalised shapes, rigid modes left out."""

    omega: Array
    """rad/s. Shape (count,)."""
    shapes: Array
    """Phi with Phi^T M Phi = 1. Shape (n, count)."""


def real_modes(plate: Plate, G: float, count: int) -> RealModes:
    """The first `count` elastic modes at the real core modulus `G` in Pa.

    Raises `OutsideModel` where the mesh has hardly more degrees of freedom than that, or is too fine to have
    a stiffness.
    """
    if count + 8 > plate.size:
        raise OutsideModel(f"{count} modes asked of a mesh of {plate.size} degrees of freedom, refine [mesh]")
    K = (plate.K_0.real + G * plate.K_1).tocsc()
    # A free plate has six motions without energy: shift off them so that K - shift M can be factorised.
    rigid = plate.rigid.shape[1]
    shift = -lowest_scale(plate) if rigid else 0.0
    solve = factorise(K - shift * plate.M)
    inverse = LinearOperator(K.shape, matvec=solve, dtype=float)
    start = np.random.default_rng(0).normal(size=plate.size)
    squared, shapes = eigsh(K, count + rigid, plate.M, sigma=shift, OPinv=inverse, v0=start)
    refuse_negative(plate, float(squared.min()))
    order = np.argsort(squared)[rigid:]
    return RealModes(np.sqrt(squared[order]), shapes[:, order])


def refuse_negative(plate: Plate, squared: float) -> None:
    """Raise `OutsideModel` where the lowest omega^2 in (rad/s)^2 is negative by more than rounding."""
    if squared < -lowest_scale(plate):
        a, b = (1e3 * side for side in plate.mesh.sides_m)
        n_x, n_y = wide_enough(plate.specimen, (plate.mesh.n_x, plate.mesh.n_y))
        raise OutsideModel(
            f"elements of {a:.3g} x {b:.3g} mm are too small for faces so thick, expected about {n_x} x "
            f"{n_y} of them in [mesh], or fewer"
        )


def lowest_scale(plate: Plate) -> float:
    """About a hundredth of the square of the first bending frequency, in (rad/s)^2."""
    s = plate.specimen
    h, face = s.substrate.thickness_m, s.substrate
    side = max(s.length_m, s.width_m)
    return 0.01 * face.young_pa * h**2 / (12 * face.density_kg_m3) / side**4 * 3.5**2
