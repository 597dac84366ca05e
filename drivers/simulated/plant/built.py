"""A beam or a shear pair as it is mounted: its solid on a basis of modes, with what it hides.

The basis holds real modes at several moduli of the core and the motion under a slow base: what the law in use
will stir. It is found again for every specimen, in seconds.
"""

from dataclasses import dataclass, replace
from math import isnan

import numpy as np
import scipy.sparse as sp

from drivers.arrays import Array
from drivers.simulated.plant.basis import basis_of, moduli, motions
from drivers.simulated.plant.beam_basis import Place, on_basis
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.law import MaxwellLaw, even_loss
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.progress import Report
from drivers.simulated.plant.solid_beam import PIECES, BeamBuild, BeamStated, RootSprings, SolidBeam
from drivers.simulated.plant.solid_pad import PairStated, SolidPad
from drivers.simulated.plant.structure import Branch, Structure

_HEEDED = {
    "plate": (
        *("spot_offset", "added_mass", "temperature_drift", "amplitude_softening", "viscous_damping"),
        *("base_rocking", "fixture_resonance", "core_thickness", "substrate_stiffness", "core_law"),
    ),
    "beam": (
        *("spot_offset", "added_mass", "temperature_drift", "amplitude_softening", "base_rocking"),
        *("fixture_resonance", "core_thickness", "substrate_stiffness", "core_law", "clamp_compliance"),
    ),
    "shear-pair": (
        *("added_mass", "temperature_drift", "amplitude_softening", "core_thickness", "core_law"),
    ),
}
"""What each may hide."""
_RIGID_N_M3 = 1e16
"""What a clamp that yields along and across still holds sideways by."""


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
    """Spot, tip, and of a beam where a mass sits. Shape (3, n), or (2, n)."""
    K_root: Array
    """Of a clamp that yields, else zero. Shape (n, n)."""


def refuse_effects(kind: str, effects: Effects) -> None:
    """Raise `ValueError` for one that this structure cannot have."""
    for name, value in vars(effects).items():
        if value is not None and name not in _HEEDED[kind]:
            known = ", ".join(_HEEDED[kind])
            raise ValueError(f"effects.{name}: not on a {kind} from a file, expected one of {known}")


def refuse_placeless(kind: str, effects: Effects) -> None:
    """Raise `ValueError` for a mass that says not where on a plate it sits."""
    added = effects.added_mass
    if kind == "plate" and added is not None and (isnan(added.x_m) or isnan(added.y_m)):
        raise ValueError("effects.added_mass: x_m or y_m missing, expected where on the plate it sits")


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
    stated: BeamStated,
    law: MaxwellLaw,
    report: Report = lambda done: None,
    pieces: int = PIECES,
    effects: Effects | None = None,
) -> Reduced:
    """The solid beam on its basis, for a law. Raises `ValueError` for a spot or a mass off the beam.

    Of the effects its clamp and where a mass sits have a part in it.
    """
    effects = effects or Effects()
    at = (stated.spot_x_m, _tip_m(stated), mass_x_m(stated, effects))
    for x, what in zip(at, ("spot", "tip", "added_mass"), strict=True):
        if not 0 <= x <= stated.span_m:
            raise ValueError(f"{what} at {1e3 * x:.1f} mm is off the beam")
    solid = SolidBeam(stated, pieces, BeamBuild(springs=_springs(effects)))
    found = on_basis(solid, moduli(law), [Place(x) for x in at], report=report)
    return Reduced(found.M, found.K_core[0], found.K_faces, found.load, found.w, found.K_root)


def _tip_m(stated: BeamStated) -> float:
    """The free end; of a beam between two clamps its middle."""
    return stated.span_m / 2 if stated.ends == "clamped-clamped" else stated.span_m


def mass_x_m(stated: BeamStated, effects: Effects) -> float:
    """Where a hidden mass sits, or would sit: at the tip, or the middle, unless it says where."""
    added = effects.added_mass
    return _tip_m(stated) if added is None or isnan(added.x_m) else added.x_m


def _springs(effects: Effects) -> RootSprings | None:
    """Along y the root stays as good as rigid."""
    yields = effects.clamp_compliance
    if yields is None:
        return None
    return RootSprings(yields.along_x_n_m3, _RIGID_N_M3, yields.along_z_n_m3)


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
    none = np.zeros((V.shape[1],) * 2)
    return Reduced(V.T @ (M @ V), V.T @ (K @ V), np.zeros((0, *none.shape)), loads, V[[0, 0]], none)


def mounted_beam(stated: BeamStated, reduced: Reduced, law: MaxwellLaw, effects: Effects) -> Mounted:
    """With what it hides but its geometry. Raises `ValueError` for an effect that it cannot have."""
    refuse_effects("beam", effects)
    scale = effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0
    M, load, K = reduced.M, reduced.load, reduced.K_root
    lossy = []
    faces = [s for k, s in enumerate(stated.sheets) if k not in stated.cores]
    substrate = sum(k not in stated.cores for k in range(stated.substrate))
    for k, (face, part) in enumerate(zip(faces, reduced.K_faces, strict=True)):
        stiff = (scale if k == substrate else 1.0) * part
        if face.loss_factor:
            lossy.append(Branch(stiff, even_loss(face.loss_factor)))
        else:
            K = K + stiff
    if effects.added_mass:
        row = reduced.readings[2]
        M = M + effects.added_mass.mass_kg * np.outer(row, row)
        load = load + effects.added_mass.mass_kg * np.outer(row, [1.0, mass_x_m(stated, effects)])
    core = sum(stated.sheets[k].thickness_m for k in stated.cores)
    volume = stated.length_m * stated.width_m * core
    return _mounted(reduced, M, K, load, (Branch(reduced.K_1, law), *lossy), stated.spot_x_m, volume)


def mounted_pair(stated: PairStated, reduced: Reduced, law: MaxwellLaw, effects: Effects) -> Mounted:
    """A shear pair of these parts with a core of this law, as effects change it."""
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
    structure = Structure(M, np.zeros_like(M), K, branches, -load, reduced.readings[:2])
    return Mounted(structure, spot_x_m, volume_m3)
