"""Members of a fit: a specimen's matrices on the motions of its first modes, whatever the core's modulus."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array
from fitting.discrepancy.model_error import model_error_at
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.real_modes import real_modes
from fitting.dynamics.unstated_damping import with_unstated_damping
from fitting.laws import CoreLaw
from fitting.mode_tables.member import Member
from fitting.mode_tables.table import ModalTable
from fitting.nuisances.nuisances import Nuisances, nuisances_of
from fitting.plate.element import THETA_X, THETA_Y, W
from fitting.plate.layers_array import layers_of
from fitting.plate.part_matrices import load_part, on_motions, projected_parts
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import PLATE
from fitting.structures import AnySpecimen
from fitting.structures.small import nuisances_of as small_nuisances_of
from fitting.structures.small import widened_system_of
from fitting.widened.enriched_plate import EnrichedReducedPlate

MODULI_PA = (2e4, 3e5, 4e6, 5e7, 5e8, 5e9)
"""Whose real modes a plate is spanned by, from gels to glass: up to 1 GPa f to 1e-4 and eta to 1e-3.

Spanned to 20 MPa alone, losses of a core of 0.1 GPa were 1 % and of one of 1 GPa 15 % too high."""
SPARE = 8
"""Real modes of each beyond the table's last."""
_INDEPENDENT = 1e-11
"""Of the largest product: below it, motions differ by rounding."""
_FEWEST = 4
"""Elements across half a mesh."""
MESH_LEFT = 1 / 3
"""Of what a mesh gets wrong, where it is taken off: beside edges an error goes less than with the square."""
_PEAK_OFF, _WIDTH_OFF, _ALONE = 0.8, 6.0, 0.1
"""Of a mode read off its peak, times its loss factor squared: cantilevers of Euler and Bernoulli, driven by
their base or a force at five places, read at the tip or between, have 0.1 to 2.8 of f and 0.3 to 69 of eta in
modes 2 and 3, a tenth and less in the first. A judgement; what lies further off is no reading."""
_READ, _STRUCK = (0.77, 0.31), (0.93, 0.12)
"""Of length and width: a plate has to be struck and read somewhere, though no mode depends on it."""
Widen = Callable[[PlateSpecimen, Array], EnrichedReducedPlate]
"""A plate and its own motions, shape (n, k), to the plate with all that effects need."""


def member_of(table: ModalTable, specimen: AnySpecimen, widen: Widen | None = None) -> Member:
    """A table with its specimen; `widen` where effects are to be tried on a plate."""
    if isinstance(specimen, PlateSpecimen):
        return _of_plate(table, with_unstated_damping(specimen), widen)
    parts = specimen.parts()
    stated = small_nuisances_of(specimen, parts, has_phase=False)
    own = replace(stated, each=tuple(n for n in stated.each if n.kind in specimen.numbers))
    return Member(table, specimen, widened_system_of(specimen, parts), own)


def with_own_error(member: Member, law: CoreLaw) -> Member:
    """With what its theory gets wrong at a law's modes, and what reading may do where nobody says how."""
    f, s = member.table.frequency_hz, member.specimen
    if member.table.read is None and not s.exact:
        otherwise = np.array(member.reads_otherwise(law, np.zeros(len(member.stated)), "half-power"))
        member = replace(member, otherwise=otherwise / 2)
    neighbours = np.zeros(1), np.zeros(1)
    if member.table.read == "half-power" and not s.exact:
        neighbours = _neighbours(member.table)
        member = replace(member, own_error=neighbours)
    G = law.modulus(2 * np.pi * f)
    found = model_error_at(s, f, G, of_mesh=False) if isinstance(s, PlateSpecimen) else s.theory_error(f, G)
    if found is None:
        return member
    mesh_off = member.off_by_mesh(law)
    left = MESH_LEFT * np.abs(mesh_off)
    together = [np.array([one, np.zeros(len(one))]) for one in found.together]
    together += [np.array(found.signed)] if found.signed else []
    return replace(
        member,
        own_error=_all(neighbours, (found.frequency, found.loss), (left[0], left[1])),
        mesh_off=mesh_off,
        together=np.array(together).reshape(-1, 2, len(f)),
    )


def _neighbours(table: ModalTable) -> tuple[Array, Array]:
    """What other modes do to peaks and widths, relative: it goes with the square of the loss factor."""
    square = table.loss_factor**2 * np.where(table.mode == 1, _ALONE, 1.0)
    return _PEAK_OFF * square, _WIDTH_OFF * square


def _all(*errors: tuple[Array, Array]) -> tuple[Array, Array]:
    """Independent ones together, of f and of eta."""
    f, eta = (np.sqrt(sum(np.square(one[k]) for one in errors)) for k in (0, 1))
    return np.asarray(f), np.asarray(eta)


def tapped(specimen: PlateSpecimen) -> PlateSpecimen:
    """The plate struck and read off its axes: all its motions are carried, and no base is asked for."""
    x, y = _READ
    a, b = _STRUCK
    L, B = specimen.length_m, specimen.width_m
    return replace(specimen, pickup_m=(x * L, y * B), force_m=(a * L, b * B))


def _of_plate(table: ModalTable, specimen: PlateSpecimen, widen: Widen | None) -> Member:
    specimen = tapped(specimen)
    plate = Plate(specimen)
    V = own_motions(plate, int(table.mode.max()) + SPARE)
    wide = _plain(plate, V) if widen is None else widen(specimen, V)
    stated: Nuisances = nuisances_of(specimen, wide, has_phase=False)
    each = tuple(n for n in stated.each if n.kind in PLATE or n.kind == "damping")
    return Member(table, specimen, wide, replace(stated, each=each), halved=_halved(table, specimen))


def _halved(table: ModalTable, specimen: PlateSpecimen) -> Member | None:
    """The same on half as many elements each way; None where that leaves too few to tell anything."""
    n_x, n_y = (n // 2 for n in specimen.mesh)
    if min(n_x, n_y) < _FEWEST:
        return None
    coarse = replace(specimen, elements=(n_x, n_y))
    plate = Plate(coarse)
    wide = _plain(plate, own_motions(plate, int(table.mode.max()) + SPARE))
    return Member(table, coarse, wide, nuisances_of(coarse, wide, has_phase=False))


def own_motions(plate: Plate, count: int) -> Array:
    """Real modes at a few moduli, orthonormal by mass. Shape (n, k)."""
    moduli = MODULI_PA if plate.specimen.core is not None else (0.0,)
    count = min(count, plate.size - 8)
    shapes = np.hstack([real_modes(plate, G, count).shapes for G in moduli])
    values, vectors = la.eigh(shapes.T @ (plate.M @ shapes))
    kept = values > _INDEPENDENT * values[-1]
    return np.asarray(shapes @ (vectors[:, kept] / np.sqrt(values[kept])))


def _plain(plate: Plate, V: Array) -> EnrichedReducedPlate:
    """A plate that nothing but what is stated changes."""
    s, k = plate.specimen, V.shape[1]
    assert s.pickup_m is not None
    damping = viscous_damping(plate)
    modes = len(s.modal_ratios)
    U, d = np.zeros((k, modes)), np.zeros(modes)
    U[:, damping.mode], d[damping.mode] = V.T @ damping.U, damping.d
    none = np.zeros(0, dtype=str)
    return EnrichedReducedPlate(
        group=np.full(k, "plate"),
        M=V.T @ (plate.M @ V),
        K_0=np.asarray(V.T @ (plate.K_0 @ V), dtype=complex),
        K_1=V.T @ (plate.K_1 @ V),
        U=U,
        d=d,
        load=np.zeros(k),
        pitch=np.zeros(k),
        observe=V.T @ plate.observe(*s.pickup_m),
        gram=np.eye(k),
        names=none,
        matrices=np.zeros((0, k, k)),
        vector_names=none,
        vectors=np.zeros((0, k)),
        deflection=plate.on_nodes(V)[:, [W, THETA_X, THETA_Y]],
        size=np.array([s.length_m, s.width_m, *s.mesh], dtype=float),
        pickup=np.array(s.pickup_m),
        parts=projected_parts(plate, V),
        load_part=on_motions(load_part(s)[..., plate.free], V),
        layers=layers_of(s),
    )
