"""The treated plate under a hammer: hung by two threads, as a solid of its own; or in its clamp."""

from dataclasses import replace

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant import air
from drivers.simulated.plant.basis import basis_of, moduli, motions
from drivers.simulated.plant.built_plate import ReducedPlate
from drivers.simulated.plant.effects import LOOSE, Effects, PartialDebond
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.progress import Report
from drivers.simulated.plant.solid_plate import PIECES, PlateStated, SolidPlate
from drivers.simulated.plant.structure import Branch, Structure, condensed

_MODES = 20
"""Of the free plate at each modulus, six rigid ones among them."""
_SHIFT = (2 * np.pi * 20.0) ** 2
"""Of its eigenvalues: without a clamp its stiffness alone cannot be solved with."""
_SWAY_HZ, _SWAY_RATIO = 0.8, 0.05
"""Of the plate on its threads, whichever way it swings: a pendulum of 0.4 m."""
_PANELS = (30, 20)
"""Of the air."""


@one_thread
def reduced_free_plate(
    stated: PlateStated,
    law: MaxwellLaw,
    report: Report = lambda done: None,
    pieces: tuple[int, int] = PIECES,
    loose: PartialDebond | None = None,
) -> ReducedPlate:
    """The solid plate without a clamp on its basis, for a law; its loads are M times six rigid motions."""
    solid = SolidPlate(stated, pieces, loose)
    layers = [solid.stiffness(k) for k in range(len(stated.sheets))]
    faces, core = layers[::2], layers[1]
    if loose is not None:
        strip = (loose.from_m, loose.to_m)
        along_x = loose.along == "x"
        lost = solid.stiffness(1, only_x=strip) if along_x else solid.stiffness(1, only_y=strip)
        core = core - (1 - LOOSE) * lost
    K_0, rigid = sum(faces[1:], faces[0]), _rigid(solid)
    parts = [rigid]
    each = moduli(law)
    for k, G in enumerate(each):
        parts.append(motions(K_0 + G * core + _SHIFT * solid.M, solid.M, solid.M @ rigid, _MODES))
        report((k + 1) / len(each))
    V = basis_of(np.hstack(parts), solid.M)
    return ReducedPlate(
        V.T @ (solid.M @ V), V.T @ (core @ V), np.array([V.T @ (K @ V) for K in faces]),
        V.T @ (solid.M @ rigid), V[solid.top], np.array(solid.x.ends), np.array(solid.y.ends), solid.x.order,
    )  # fmt: skip


@one_thread
def hung_plate(
    stated: PlateStated,
    reduced: ReducedPlate,
    law: MaxwellLaw,
    effects: Effects,
    hit_m: tuple[float, float],
    read_m: tuple[float, float],
) -> Structure:
    """Hit and read at places, its clamp and its base left behind, on few coordinates.

    Effects heeded: substrate stiffness, air, added mass; a core of another thickness where `stated` has it,
    one that is loose where `reduced` has it. The laser is aimed anew, and its spot is where it is meant to
    be. Raises `ValueError` for a place off the plate.
    """
    for place in (hit_m, read_m):
        stated.refuse_off(*place)
    M = reduced.M
    K, lossy = reduced.faces(stated, effects)
    if effects.air_added_mass is not None:
        size = stated.length_m, stated.width_m
        x, y = air.centres(*size, _PANELS)
        w = np.array([reduced.row(a, b) for a in x for b in y])
        M = M + effects.air_added_mass.density_kg_m3 * (w.T @ air.mass_per_density(*size, _PANELS) @ w)
    if effects.added_mass is not None:
        w = reduced.row(effects.added_mass.x_m, effects.added_mass.y_m)
        M = M + effects.added_mass.mass_kg * np.outer(w, w)
    # The threads take hold of the motions that need no force.
    R = np.linalg.qr(reduced.load)[0]
    sway = 2 * np.pi * _SWAY_HZ
    C, K = 2 * _SWAY_RATIO * sway * (R @ R.T), K + sway**2 * (R @ R.T)
    hit, read = reduced.row(*hit_m), reduced.row(*read_m)
    return _few(Structure(M, C, K, (Branch(reduced.K_1, law), *lossy), hit[:, None], read[None]))


@one_thread
def struck_where_it_stands(standing: Structure, law: MaxwellLaw, hit: Array) -> Structure:
    """A plate on a base at rest: `hit` reads w where the hammer strikes, shape (n,); read at its spot."""
    structure = replace(standing, loads=hit[:, None], readings=standing.readings[:1])
    return _few(structure.with_laws(law))


def _few(structure: Structure) -> Structure:
    found, _ = condensed(structure, (structure.branches[0].law,))
    return found


def _rigid(solid: SolidPlate) -> Array:
    """Three shifts and three turns. Shape (size, 6)."""
    grid = np.meshgrid(solid.x.nodes, solid.y.nodes, solid.z.nodes, indexing="ij")
    x, y, z = (g.ravel() for g in grid)
    out = np.zeros((3 * x.size, 6))
    for axis in range(3):
        out[axis::3, axis] = 1.0
    out[2::3, 3], out[0::3, 3] = x, -z
    out[2::3, 4], out[1::3, 4] = y, -z
    out[1::3, 5], out[0::3, 5] = x, -y
    return out
