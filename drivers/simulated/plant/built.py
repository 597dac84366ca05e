"""A beam or a shear pair as it is mounted: its solid on a basis of modes, with what it hides.

The basis holds real modes at several moduli of the core and the motion under a slow base: what the law in use
will stir. It is found again for every specimen, in seconds.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from drivers.arrays import Array
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.law import MaxwellLaw, even_loss
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.solid_beam import PIECES, BeamStated, SolidBeam
from drivers.simulated.plant.solid_pad import PairStated, SolidPad
from drivers.simulated.plant.structure import Branch, Structure

Report = Callable[[float], None]

_MODES = 10
_MODULI = 5
_BAND = 2 * np.pi * np.geomspace(5.0, 2000.0, 40)
_ROOM = 3.0
"""The moduli reach so much beyond the law's over the band: softening, drift."""
_SMALLEST = 1e-8
"""Of the basis' vectors, relative."""
_HEEDED = {
    "plate": (
        *("spot_offset", "added_mass", "temperature_drift", "amplitude_softening", "viscous_damping"),
        *("base_rocking", "fixture_resonance", "core_thickness", "substrate_stiffness", "core_law"),
    ),
    "beam": (
        *("spot_offset", "added_mass", "temperature_drift", "amplitude_softening", "base_rocking"),
        *("fixture_resonance", "core_thickness", "substrate_stiffness", "core_law"),
    ),
    "shear-pair": (
        *("added_mass", "temperature_drift", "amplitude_softening", "core_thickness", "core_law"),
    ),
}
"""What each may hide."""


@dataclass(frozen=True)
class Reduced:
    """Matrices on the basis. What the faces of a beam lose, they lose apart from each other."""

    M: Array
    K_1: Array
    """Of the core for unit modulus."""
    K_faces: Array
    """Shape (faces, n, n); none of a pair."""
    load: Array
    """M times heave and pitch. Shape (n, 2)."""
    readings: Array
    """Spot and tip. Shape (2, n)."""


def refuse_effects(kind: str, effects: Effects) -> None:
    """Raise `ValueError` for one that this structure cannot have."""
    for name, value in vars(effects).items():
        if value is not None and name not in _HEEDED[kind]:
            known = ", ".join(_HEEDED[kind])
            raise ValueError(f"effects.{name}: not on a {kind} from a file, expected one of {known}")


def beam_stated(stated: BeamStated, effects: Effects) -> BeamStated:
    """The beam as it really is."""
    thick = effects.core_thickness.scale if effects.core_thickness else 1.0
    sheets = tuple(
        replace(s, thickness_m=thick * s.thickness_m) if k in stated.cores else s
        for k, s in enumerate(stated.sheets)
    )
    offset = effects.spot_offset.dx_m if effects.spot_offset else 0.0
    return replace(stated, sheets=sheets, spot_x_m=stated.spot_x_m + offset)


@one_thread
def reduced_beam(
    stated: BeamStated, law: MaxwellLaw, report: Report = lambda done: None, pieces: int = PIECES
) -> Reduced:
    """The solid beam on its basis, for a law. Raises `ValueError` for a spot off the beam."""
    if not 0 <= stated.spot_x_m <= stated.span_m:
        raise ValueError(f"spot at {1e3 * stated.spot_x_m:.1f} mm is off the beam")
    solid = SolidBeam(stated, pieces)
    free = solid.free
    layers = [solid.stiffness(k)[free][:, free] for k in range(len(stated.sheets))]
    faces = [K for k, K in enumerate(layers) if k not in stated.cores]
    K_0 = sum(faces[1:], faces[0])
    K_1 = sum((layers[k] for k in stated.cores[1:]), layers[stated.cores[0]])
    M = solid.M[free][:, free]
    load = (solid.M @ solid.rigid)[free]
    parts = []
    for k, G in enumerate(moduli(law)):
        parts.append(motions(K_0 + G * K_1, M, load))
        report((k + 1) / _MODULI)
    V = basis_of(np.hstack(parts), M)
    tip = 0.0 if stated.ends == "clamped-clamped" else stated.span_m
    rows = np.array([solid.deflection(x)[free] @ V for x in (stated.spot_x_m, tip)])
    return Reduced(V.T @ (M @ V), V.T @ (K_1 @ V), np.array([V.T @ (K @ V) for K in faces]), V.T @ load, rows)


@one_thread
def reduced_pair(stated: PairStated) -> Reduced:
    """The solid discs and the mass on their basis; the first coordinate is not the mass alone."""
    solid = SolidPad(stated)
    T = solid.moves
    M, K = T.T @ solid.M @ T, T.T @ solid.K_1 @ T
    first = sp.coo_array(([stated.mass_kg], ([0], [0])), shape=M.shape)
    load = T.T @ (solid.M @ solid.rigid)
    load[0] += stated.mass_kg
    M = (M + first).tocsr()
    V = basis_of(motions(K, M, load[:, None]), M)
    loads = np.column_stack([V.T @ load, np.zeros(V.shape[1])])
    return Reduced(V.T @ (M @ V), V.T @ (K @ V), np.zeros((0, *(V.shape[1],) * 2)), loads, V[[0, 0]])


def mounted_beam(stated: BeamStated, reduced: Reduced, law: MaxwellLaw, effects: Effects) -> Mounted:
    """With what it hides but its geometry. Raises `ValueError` for an effect that it cannot have."""
    refuse_effects("beam", effects)
    scale = effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0
    M, load, K = reduced.M, reduced.load, np.zeros_like(reduced.M)
    lossy = []
    faces = [s for k, s in enumerate(stated.sheets) if k not in stated.cores]
    # The substrate is the thickest; of a beam alike on both sides the one in the middle.
    substrate = len(faces) // 2 if len(stated.cores) > 1 else 0
    for k, (face, part) in enumerate(zip(faces, reduced.K_faces, strict=True)):
        stiff = (scale if k == substrate else 1.0) * part
        if face.loss_factor:
            lossy.append(Branch(stiff, even_loss(face.loss_factor)))
        else:
            K = K + stiff
    if effects.added_mass:
        # Where the spot is read: the basis knows that row.
        row = reduced.readings[1]
        M = M + effects.added_mass.mass_kg * np.outer(row, row)
        load = load + effects.added_mass.mass_kg * np.outer(row, [1.0, stated.span_m])
    core = sum(stated.sheets[k].thickness_m for k in stated.cores)
    volume = stated.length_m * stated.width_m * core
    return _mounted(reduced, M, K, load, (Branch(reduced.K_1, law), *lossy), stated.spot_x_m, volume)


def mounted_pair(stated: PairStated, reduced: Reduced, law: MaxwellLaw, effects: Effects) -> Mounted:
    """The same of a pair."""
    refuse_effects("shear-pair", effects)
    M, load = reduced.M, reduced.load
    if effects.added_mass:
        row = reduced.readings[0]
        M = M + effects.added_mass.mass_kg * np.outer(row, row)
        load = load + effects.added_mass.mass_kg * np.outer(row, [1.0, 0.0])
    branch = Branch(reduced.K_1, law)
    return _mounted(reduced, M, np.zeros_like(M), load, (branch,), 0.0, stated.volume_m3)


def _mounted(
    reduced: Reduced,
    M: Array,
    K: Array,
    load: Array,
    branches: tuple[Branch, ...],
    spot_x_m: float,
    volume_m3: float,
) -> Mounted:
    structure = Structure(M, np.zeros_like(M), K, branches, -load, reduced.readings)
    return Mounted(structure, spot_x_m, volume_m3)


def moduli(law: MaxwellLaw) -> Array:
    """Real ones that enclose a law's over the band. Shape (moduli,)."""
    size = np.abs(law.modulus(_BAND))
    return np.geomspace(size.min() / _ROOM, size.max() * _ROOM, _MODULI)


def motions(K: sp.csr_array, M: sp.csr_array, load: Array, modes: int = _MODES) -> Array:
    """Modes, and what a slow base stirs, each of unit kinetic energy. Shape (n, k)."""
    options = {"SymmetricMode": True}
    lu = splu(K.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    solve = LinearOperator(K.shape, matvec=lu.solve, dtype=float)
    start = np.sin(np.arange(1, K.shape[0] + 1))
    _, phi = eigsh(K, modes, M, sigma=0.0, OPinv=solve, v0=start)
    X = np.hstack([phi, lu.solve(np.ascontiguousarray(load))])
    return np.asarray(X / np.sqrt(np.einsum("ij,ij->j", X, M @ X)))


def basis_of(X: Array, M: sp.csr_array) -> Array:
    """What X spans, orthonormal in M. Shape (n, k)."""
    lam, u = np.linalg.eigh(X.T @ (M @ X))
    kept = lam > _SMALLEST * lam[-1]
    V = X @ (u[:, kept] / np.sqrt(lam[kept]))
    R = cholesky(V.T @ (M @ V))
    return np.asarray(solve_triangular(R, V.T, trans="T").T)
