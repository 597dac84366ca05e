"""What a plate's mesh gets wrong: a wave on endless elements, against elements of half the sides.

The element's matrices over one node, its neighbours' motions by the phase of the wave between them,

    K(k) = T^H K_e T,  T = e^{i (k_x x + k_y y)} at the element's corners,

have the wave's lambda as the mesh has it, exactly. The deflection of Adini, Clough and Melosh is too soft,
bilinear motions in the plane are too stiff, both as the square of an element's share of the wave; which of
them is larger goes with the plate, how large with the wave's direction.

Beside a clamped or a free edge faces slide on their core within a length of sqrt(h_v/(c |G|)), h_v the core's
thickness and c the sum of 1/(E h) over both faces; where an element is a good part of that its straight sides
are too stiff there, whatever the mode.

Source: the dispersion of periodic structures, Brillouin, Wave Propagation in Periodic Structures (1946).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fitting.arrays import Array, Complex
from fitting.plate.element import CORNERS, G_X, U_B, U_C, V_B, V_C
from fitting.plate.element_matrices import element_matrices
from fitting.plate.mesh import Mesh, mesh_of
from fitting.specimen import PlateSpecimen

_WAYS = np.radians([0.0, 45.0, 90.0])
"""From x."""
_SHARES = np.array([0.25, 0.5, 0.25])
"""Of each way in the mean over all: an error goes with the cosine of four times the angle."""
_OF_HALVES = 4 / 3
"""Of what halving an element's sides changes: the error goes with their square."""

_FAR = 0.25
"""An element over the length of sliding up to which errors go with its square there, as elsewhere."""
_SLIDING_FREQUENCY, _SLIDING_LOSS, _STIFF_LOSS = 4e-3, 1.2e-2, 3e-2
"""Sizes of the errors beside edges, times r/(1 + r), r an element over the length of sliding: of a frequency,
of a loss factor, and, times what r is beyond `_FAR`, of a loss factor besides.

Six modes each of fourteen cantilevers and free plates against meshes twice as fine, r 0.03 to 4.5: 0.02 % at
0.05, up to 0.15 % at 0.5 and 0.3 % at 4. Loss factors of steel and aluminium about stiff cores: 0.2, 1, 3 and
8 % (rms) at 0.13, 0.4, 1.3 and 3.2.
"""


_FINE_ENOUGH, _FINEST = 0.5, 1.5
"""An element over the length of sliding that a default mesh is made finer down to, and how much finer at
most: twice the elements. A bound on time and memory."""


@dataclass(frozen=True)
class MeshError:
    """(mesh - theory)/theory of a wave, over all directions. Shape (waves,) each."""

    frequency: Array
    """Mean error of the frequency over all directions."""
    loss: Array
    """Mean error of the loss factor over all directions."""
    frequency_by_way: Array
    """Standard deviation from one direction to another."""
    loss_by_way: Array
    """The same of the loss factor."""


def mesh_error(specimen: PlateSpecimen, wavenumber: Array, G: Complex) -> MeshError:
    """Of waves in 1/m, the core's moduli given, on a plate treated all over. Shape (waves,) both."""
    k, G = np.asarray(wavenumber, dtype=float), np.asarray(G, dtype=complex)
    found = []
    for way in _WAYS:
        coarse, fine = (_lambda(_node(specimen, n), k * np.cos(way), k * np.sin(way), G) for n in (1, 2))
        by_frequency = np.log(coarse.real / fine.real) / 2
        eta, eta_fine = coarse.imag / coarse.real, fine.imag / fine.real
        lossy = eta_fine != 0
        found.append([by_frequency, np.where(lossy, eta / np.where(lossy, eta_fine, 1.0) - 1, 0.0)])
    each = _OF_HALVES * np.array(found)
    mean = np.tensordot(_SHARES, each, axes=1)
    # Half the difference of the extremes is the amplitude of that cosine.
    by_way = np.abs(each[1] - (each[0] + each[2]) / 2) / np.sqrt(8)
    return MeshError(*mean, *by_way)


def beside_edges(specimen: PlateSpecimen, G: Complex, *, taken_off: bool = False) -> tuple[Array, Array]:
    """Relative sizes, of frequencies and of loss factors, at core moduli; none of a bare plate.

    `taken_off`: of what is left where a mesh of half as many elements each way has said how much to take off.
    It says that well where faces slide over several elements, hardly where they slide within one. Shape of
    `G` each.
    """
    if specimen.core is None or specimen.constraining is None:
        return np.zeros(np.shape(G)), np.zeros(np.shape(G))
    r = _over_sliding(specimen, np.abs(G))
    share, beyond = r / (1 + r), np.maximum(r - _FAR, 0.0)
    left = beyond / (1 + beyond) if taken_off else 1.0
    frequency, loss = _SLIDING_FREQUENCY, _SLIDING_LOSS + _STIFF_LOSS * beyond
    return np.asarray(frequency * share * left), np.asarray(loss * share * left)


def fine_enough(specimen: PlateSpecimen, modulus_pa: float) -> tuple[int, int] | None:
    """Elements along x and y where so stiff a core asks for smaller ones than by default; else None.

    Of steel and aluminium about adhesives, laws from tables of six modes were 4 to 20 % off with the default
    mesh and 1 to 10 % with these.
    """
    if specimen.core is None or specimen.constraining is None:
        return None
    finer = min(_FINEST, float(_over_sliding(specimen, np.array(modulus_pa))) / _FINE_ENOUGH)
    n_x, n_y = specimen.mesh
    return (round(finer * n_x), round(finer * n_y)) if finer > 1 else None


def _over_sliding(specimen: PlateSpecimen, modulus_pa: Array) -> Array:
    """r: an element's longer side over the length within which faces slide. Shape of the modulus."""
    b, v, c = specimen.substrate, specimen.core, specimen.constraining
    assert v is not None
    assert c is not None
    give = sum(1 / (face.young_pa * face.thickness_m) for face in (b, c))
    sliding_m = np.sqrt(v.thickness_m / give / modulus_pa)
    return np.asarray(max(mesh_of(specimen).sides_m) / sliding_m)


@dataclass(frozen=True)
class _Node:
    """What is put together over one node of a mesh."""

    mesh: Mesh
    faces: Complex
    """Of both and of what slips. Shape (4 dofs, 4 dofs), as the next two."""
    K_1: Array
    M: Array
    moves: tuple[int, ...]
    """Degrees of freedom of a node that are there."""


@lru_cache(maxsize=32)
def _node(specimen: PlateSpecimen, finer: int) -> _Node:
    n_x, n_y = specimen.mesh
    mesh = mesh_of(specimen)
    mesh = Mesh(mesh.length_m, mesh.width_m, finer * n_x, finer * n_y, mesh.dofs)
    e, b, c = element_matrices(specimen, mesh), specimen.substrate, specimen.constraining
    faces = (1 + 1j * b.loss_factor) * e.K_substrate + np.asarray(e.K_slip)
    if c is not None:
        faces = faces + (1 + 1j * c.loss_factor) * e.K_constraining
    still = {U_C, V_C, *range(G_X, mesh.dofs)} if specimen.core is None else set()
    still |= {U_B, V_B} if specimen.both_sides else set()
    return _Node(mesh, faces, e.K_1, e.M, tuple(dof for dof in range(mesh.dofs) if dof not in still))


def _lambda(node: _Node, k_x: Array, k_y: Array, G: Complex) -> Complex:
    """omega^2 of the bending wave on the mesh. Shape (waves,)."""
    x, y = (np.array(CORNERS) * node.mesh.sides_m).T
    phase = np.exp(1j * (np.outer(k_x, x) + np.outer(k_y, y)))

    def over_one(A: Complex | Array) -> Complex:
        blocks = np.reshape(A, (len(CORNERS), node.mesh.dofs, len(CORNERS), node.mesh.dofs))
        its = blocks[:, node.moves][:, :, :, node.moves]
        return np.asarray(np.einsum("na,aibj,nb->nij", phase.conj(), its, phase, optimize=True))

    K = over_one(node.faces) + G[:, None, None] * over_one(node.K_1)
    values = np.linalg.eigvals(np.linalg.solve(over_one(node.M), K))
    return np.asarray(np.take_along_axis(values, values.real.argmin(axis=1)[:, None], axis=1)[:, 0])
