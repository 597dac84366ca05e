"""The bare plate as a hammer test finds it: with the sensor's mass, and what plate theory leaves out."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array
from fitting.dynamics.real_modes import RealModes, lowest_scale, real_modes
from fitting.numerics.linear import factorise
from fitting.plate.element import THETA_Y
from fitting.plate.element_matrices import element_matrices
from fitting.plate.plate import Plate


@dataclass(frozen=True)
class CarriedSensor:
    """The accelerometer on the bare plate: a gram at the tip takes half a percent off mode 1."""

    mass_kg: float
    x_m: float
    y_m: float

    @property
    def words(self) -> str:
        """For people, where it cannot be."""
        return "the hammer test's accelerometer"


def bare_modes(plate: Plate, count: int, sensor: CarriedSensor | None = None) -> tuple[RealModes, Array]:
    """The bare plate's modes as plate theory has them, the sensor on it, and their `edge_softening`.

    The last of shape (modes,).
    """
    modes = real_modes(plate, 0.0, count)
    if sensor is not None:
        modes = loaded_modes(plate, modes, sensor)
    return modes, edge_softening(plate, modes)


def loaded_modes(plate: Plate, modes: RealModes, sensor: CarriedSensor) -> RealModes:
    """The modes with the sensor on the plate, as many: in the span of the unloaded ones and of its own push.

    (K - omega^2 (M + m w^T w)) x = 0, w reading the deflection under the sensor.
    """
    row = plate.observe(sensor.x_m, sensor.y_m, sensor.words)
    K = plate.K_0.real.tocsc()
    rigid = plate.rigid.shape[1]
    pushed = factorise(K + lowest_scale(plate) * plate.M if rigid else K)(row)
    V = np.column_stack([modes.shapes, pushed, *plate.rigid.T])
    w = row @ V
    squared, q = la.eigh(V.T @ (K @ V), V.T @ (plate.M @ V) + sensor.mass_kg * np.outer(w, w))
    its = slice(rigid, rigid + len(modes.omega))
    return RealModes(np.sqrt(squared[its]), V @ q[:, its])


def edge_softening(plate: Plate, modes: RealModes) -> Array:
    """Relative fall of each frequency that twist at the free edges brings, and plate theory leaves out.

    Zero where the plate has it in its stiffness. Shape (modes,).
    """
    if plate.specimen.lacks_edge_twist:
        return np.zeros(len(modes.omega))
    lost = np.einsum("im,im->m", modes.shapes, plate.edge_twist @ modes.shapes)
    return np.asarray(lost / 2 / modes.omega**2)


def clamp_softness(plate: Plate, modes: RealModes) -> Array:
    """Fall of ln f for a root that yields in rotation, one for mode 1; zero without a clamp.

    Shape (modes,).
    """
    if plate.specimen.boundary != "cantilever":
        return np.zeros(len(modes.omega))
    mesh = plate.mesh
    dofs = mesh.element_dofs()
    K = element_matrices(plate.specimen, mesh).K_0
    moment = np.zeros((mesh.size, len(modes.omega)))
    np.add.at(moment, dofs, np.einsum("ij,ejk->eik", K, plate.on_elements(modes.shapes)))
    root = np.arange(mesh.n_y + 1) * mesh.dofs + THETA_Y
    width = np.full(mesh.n_y + 1, mesh.sides_m[1])
    width[[0, -1]] /= 2
    energy = (moment[root] ** 2 / width[:, None]).sum(axis=0) / modes.omega**2
    return np.asarray(energy / energy[0])
